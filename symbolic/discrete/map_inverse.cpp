#include "symbolic/discrete/map_inverse.hpp"

#include <algorithm>
#include <random>

#include "symbolic/discrete/map_claim_parts.hpp"
#include "symbolic/discrete/modular_program.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/run_claims.hpp"

namespace casimir::discrete {
namespace {

using GiNaC::ex;
using Inverse = std::vector<ex>;

/// psi(phi(x)) = x, in the ring of the prover.
bool is_proved_inverse(const MapModel& map, const Inverse& inverse) {
  Claim claim{ClaimKind::map, "inverse", false, [&map, &inverse](Prover& prover, Proof& proof) {
                // Of arbitrary functions no point has values.
                prover.take_as_inhabited(has_arbitrary_functions(map.base));
                std::vector<Residual> residuals;
                for (std::size_t i = 0; i < inverse.size(); ++i) {
                  const ex value = map.composed(inverse[i]) - map.base.variables[i];
                  residuals.push_back({map.base.variables[i].get_name(), prover.convert(value),
                                       [value] { return value; }});
                }
                prover.decide(proof, residuals, {});
              }};
  claim.expressions = map.next;
  claim.expressions.insert(claim.expressions.end(), map.next_domain.begin(), map.next_domain.end());
  for (const ex& previous : inverse) append(claim.expressions, map.composed_with_parts(previous));
  claim.subject = Subject::functions;
  const Proof proof = decide_claims(map.base, {claim}, Meaningless::thrown, {}).front();
  return proof.verdict == Verdict::proved && proof.where.empty();
}

/// Whether it is the inverse at a random point modulo the prime, which is soon seen.
class Screen {
 public:
  explicit Screen(const MapModel& map) : symbols_(map.base.symbols()) {
    const PrimeField field;
    std::mt19937_64 random(24);
    for (std::size_t i = 0; i < symbols_.size(); ++i) point_.push_back(field.random(random));
    image_ = point_;
    try {
      const auto next = ModularProgram(symbols_, map.next).run(point_);
      rational_ = next.has_value();
      if (next) std::copy(next->begin(), next->end(), image_.begin());
    } catch (const ModelError&) {
      rational_ = false;  // the prover alone decides
    }
  }

  bool passes(const Inverse& inverse) const {
    if (!rational_) return true;
    try {
      const auto back = ModularProgram(symbols_, inverse).run(image_);
      return back && std::equal(back->begin(), back->end(), point_.begin());
    } catch (const ModelError&) {
      return true;
    }
  }

 private:
  std::vector<GiNaC::symbol> symbols_;
  std::vector<Element> point_, image_;
  bool rational_ = false;
};

/// Arguments of functions that are next values are written as these: in p' = p - U(q + p) with
/// q' = q + p stands U(q').
class PutImages : public GiNaC::map_function {
 public:
  PutImages(const Inverse& next, const std::vector<GiNaC::symbol>& image)
      : next_(next), image_(image) {}

  ex operator()(const ex& e) override {
    if (!GiNaC::is_a<GiNaC::function>(e)) return e.map(*this);
    GiNaC::exvector operands;
    for (const ex& argument : e) operands.push_back(put(argument));
    return GiNaC::function(GiNaC::ex_to<GiNaC::function>(e).get_serial(), operands);
  }

 private:
  ex put(const ex& argument) {
    for (std::size_t k = 0; k < next_.size(); ++k)
      if ((argument - next_[k]).expand().is_zero()) return image_[k];
    return argument.map(*this);
  }

  const Inverse& next_;
  const std::vector<GiNaC::symbol>& image_;
};

/// x_j' = f_j, and sums and differences of two of these: from p' = p + sin(q), q' = q + p + sin(q)
/// comes q' - p' = q.
std::vector<std::pair<ex, ex>> equations_of(const MapModel& map,
                                            const std::vector<GiNaC::symbol>& image) {
  const std::size_t n = image.size();
  std::vector<std::pair<ex, ex>> result;
  PutImages put(map.next, image);
  for (std::size_t j = 0; j < n; ++j) result.emplace_back(image[j], put(map.next[j]));
  constexpr std::size_t kFew = 4;
  for (std::size_t j = 0; n <= kFew && j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      for (const int sign : {-1, 1})
        result.emplace_back(image[j] + sign * image[k],
                            (result[j].second + sign * result[k].second).expand());
    }
  }
  return result;
}

/// Variables one after the other: each from an equation of next values that is a quotient of
/// functions linear in it, the others in which are known.
std::optional<Inverse> solved_in_turn(const MapModel& map) {
  const auto& x = map.base.variables;
  const std::size_t n = x.size();
  std::vector<GiNaC::symbol> image;
  for (const GiNaC::symbol& variable : x) image.emplace_back(variable.get_name() + "'");
  const std::vector<std::pair<ex, ex>> equations = equations_of(map, image);
  std::vector<bool> used(equations.size(), false), solved(n, false);
  GiNaC::exmap known;
  for (std::size_t round = 0; round < n; ++round) {
    bool found = false;
    for (std::size_t j = 0; j < equations.size() && !found; ++j) {
      if (used[j]) continue;
      const auto& [left, right] = equations[j];
      const ex parts = normal_form(substituted(right, known, map.base.limits)).numer_denom();
      const ex equation = (left * parts.op(1) - parts.op(0)).expand();
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < n; ++i)
        if (!solved[i] && equation.has(x[i])) open.push_back(i);
      if (open.size() != 1 || !equation.is_polynomial(x[open[0]]) ||
          equation.degree(x[open[0]]) != 1)
        continue;
      const std::size_t i = open[0];
      known[x[i]] = normal_form(-equation.coeff(x[i], 0) / equation.coeff(x[i], 1));
      used[j] = solved[i] = found = true;
    }
    if (!found) return std::nullopt;
  }
  GiNaC::exmap names;
  for (std::size_t i = 0; i < n; ++i) names[image[i]] = x[i];
  Inverse inverse;
  for (std::size_t i = 0; i < n; ++i)
    inverse.push_back(substituted(known.at(x[i]), names, map.base.limits));
  return inverse;
}

/// S phi S, with the parameters that S gives.
Inverse conjugate(const MapModel& map, const MapSymmetry& s) {
  GiNaC::exmap at, back;
  for (std::size_t i = 0; i < s.parameters.size(); ++i)
    at[map.base.parameters[i]] = back[map.base.parameters[i]] = s.parameters[i];
  for (std::size_t i = 0; i < s.variables.size(); ++i) {
    at[map.base.variables[i]] = s.variables[i];
  }
  for (std::size_t i = 0; i < s.variables.size(); ++i)
    back[map.base.variables[i]] = substituted(map.next[i], at, map.base.limits);
  Inverse inverse;
  for (const ex& value : s.variables) inverse.push_back(substituted(value, back, map.base.limits));
  return inverse;
}

/// Reversing symmetries that the case gives, and those that many maps have.
std::vector<MapSymmetry> reversals(const MapModel& map) {
  const std::size_t n = map.base.variables.size();
  constexpr std::size_t kFew = 6;
  std::vector<MapSymmetry> result;
  for (const MapSymmetry& s : map.symmetries)
    if (s.reverses) result.push_back(s);
  MapSymmetry identity{.name = "", .variables = {}, .parameters = {}, .reverses = true};
  identity.variables.assign(map.base.variables.begin(), map.base.variables.end());
  identity.parameters.assign(map.base.parameters.begin(), map.base.parameters.end());
  result.push_back(identity);
  for (std::size_t i = 0; i < identity.parameters.size(); ++i) {
    if (function_name(map.base.parameters[i].get_name())) continue;  // U is no number
    result.push_back(identity);
    result.back().parameters[i] = -identity.parameters[i];
  }
  for (std::size_t i = 0; n <= kFew && i < n; ++i) {
    result.push_back(identity);
    result.back().variables[i] = -identity.variables[i];
    for (std::size_t j = 0; j < i; ++j) {
      result.push_back(identity);
      std::swap(result.back().variables[i], result.back().variables[j]);
    }
  }
  return result;
}

std::optional<Inverse> inverse_of_one(const MapModel& map, double largest) {
  double terms = 0;
  for (const ex& value : map.next) terms += most_terms(value);
  if (terms > largest) return std::nullopt;
  const Screen screen(map);
  const auto good = [&](const Inverse& inverse) {
    return screen.passes(inverse) && is_proved_inverse(map, inverse);
  };
  // GiNaC's common denominators of large maps take longer than all else here.
  constexpr double kMostTerms = 3000;
  if (terms < kMostTerms) {
    if (auto inverse = solved_in_turn(map); inverse && good(*inverse)) return inverse;
  }
  for (const MapSymmetry& s : reversals(map)) {
    Inverse inverse = conjugate(map, s);
    if (good(inverse)) return inverse;
  }
  return std::nullopt;
}

/// What has to be positive, or not zero, for these to have values.
std::vector<std::string> implied_by(const Model& model, const std::vector<ex>& expressions) {
  const FunctionRing ring(model.symbols(), model.assumptions, expressions, model.limits);
  std::vector<std::string> conditions;
  const functions::Implied implied = ring.implied_by_values();
  for (const auto& [p, strict] : implied.positive)
    conditions.push_back(ring.text(p) + (strict ? " > 0" : " >= 0"));
  for (const Polynomial& p : implied.nonzero) conditions.push_back(ring.text(p) + " != 0");
  return conditions;
}

bool has_values_where(const MapModel& map, const std::vector<ex>& inverse) {
  std::vector<ex> all = map.next;
  all.insert(all.end(), map.next_domain.begin(), map.next_domain.end());
  const std::vector<std::string> known = implied_by(map.base, all);
  for (const ex& previous : inverse) append(all, map.composed_with_parts(previous));
  if (!FunctionRing(map.base.symbols(), map.base.assumptions, all, map.base.limits)
           .rests_on_what_was_converted())
    return true;
  return std::ranges::all_of(implied_by(map.base, all), [&](const std::string& condition) {
    return std::ranges::find(known, condition) != known.end();
  });
}

}  // namespace

std::optional<std::vector<ex>> proved_inverse(const MapModel& map, double largest) {
  if (map.steps.empty()) return inverse_of_one(map, largest);
  Inverse result(map.base.variables.begin(), map.base.variables.end());
  bool whole = true;
  for (const MapModel& step : map.steps) {
    const std::optional<Inverse> of_step = inverse_of_one(step, largest);
    if (!of_step) return std::nullopt;
    whole = whole && has_values_where(step, *of_step);
    GiNaC::exmap after;
    for (std::size_t i = 0; i < result.size(); ++i) after[map.base.variables[i]] = (*of_step)[i];
    // The inverse of the first step is done last.
    for (ex& value : result) value = substituted(value, after, map.base.limits);
  }
  // An inverse that has no value between the steps says nothing of the points that lead there, but
  // may have one as a whole.
  if (!whole && !is_proved_inverse(map, result)) return std::nullopt;
  return result;
}

bool is_one_to_one(const MapModel& map, double largest) {
  const auto one = [largest](const MapModel& single) {
    const auto inverse = inverse_of_one(single, largest);
    return inverse && has_values_where(single, *inverse);
  };
  return map.steps.empty() ? one(map) : std::ranges::all_of(map.steps, one);
}

}  // namespace casimir::discrete

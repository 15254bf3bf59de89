#include "symbolic/search/darboux_integrals.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/model/bare_motion.hpp"
#include "symbolic/search/integral_space.hpp"

namespace casimir::search {
namespace {

/// A system with the logarithms of Darboux polynomials as further variables.
class Combiner {
 public:
  Combiner(const Model& model, const std::vector<DarbouxPolynomial>& found, int degree,
           const Watch& watch)
      : model_(model), found_(found), degree_(degree), watch_(watch) {}

  /// \param all  becomes false unless it is proved that these are all integrals of the kind
  std::vector<DarbouxCombination> run(bool& all);

 private:
  using Kind = DarbouxCombination::Kind;
  bool search(Kind kind);
  Model extended(Kind kind) const;
  Problem problem(System& system) const;
  DarbouxCombination described(const System& system, const Polynomial& f, Kind kind) const;
  std::string constant_text(const GiNaC::ex& value) const;
  std::string factor(const GiNaC::ex& exponent, const std::string& base) const;

  const Model& model_;
  const std::vector<DarbouxPolynomial>& found_;
  int degree_;
  const Watch& watch_;
  std::vector<GiNaC::ex> known_;  ///< combinations of the logarithms that are integrals
  std::vector<GiNaC::symbol> logarithms_;
  GiNaC::symbol further_{"<further>"};  ///< the time, or the logarithm of the volume
  std::vector<DarbouxCombination> result_;
};

Model Combiner::extended(Kind kind) const {
  Model result = bare_motion(model_);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    result.variables.push_back(logarithms_[i]);
    result.field.push_back(found_[i].cofactor_value);
  }
  if (kind == Kind::integral) return result;
  GiNaC::ex rate = 1;
  if (kind == Kind::multiplier) {
    rate = 0;
    for (std::size_t i = 0; i < model_.variables.size(); ++i)
      rate += model_.field[i].diff(model_.variables[i]);
  }
  result.variables.push_back(further_);
  result.field.push_back(rate);
  return result;
}

/// Polynomials in the state up to the degree, and the further variables linearly: each of them is
/// as heavy as that degree.
Problem Combiner::problem(System& system) const {
  Problem result;
  result.fields = {system.atoms(), {system.flow()}, {system.plain_flow()}};
  result.weights.assign(system.atoms().size(), degree_);
  std::fill_n(result.weights.begin(), model_.variables.size(), 1);
  result.degree = degree_;
  for (const GiNaC::ex& known : known_) {
    const Polynomial p = system.functions().reduced(system.prover().convert(known));
    const int degree = weighted_degree(p, system.atoms(), result.weights);
    if (degree > 0) result.known.push_back({p, degree});
  }
  return result;
}

/// A function of the parameters, its denominator behind it.
std::string Combiner::constant_text(const GiNaC::ex& value) const {
  const GiNaC::ex parts = value.numer_denom();
  const System system(model_, {}, {parts.op(0), parts.op(1)});
  const auto own = [&](const GiNaC::ex& part) {
    const std::string text = system.text_of(part.expand());
    return text.find_first_of("+-*/ ", 1) == std::string::npos ? text : "(" + text + ")";
  };
  return parts.op(1).is_equal(1) ? own(parts.op(0)) : own(parts.op(0)) + "/" + own(parts.op(1));
}

std::string Combiner::factor(const GiNaC::ex& exponent, const std::string& base) const {
  const bool plain = base.find_first_of("+-*/ ") == std::string::npos;
  const std::string own = plain ? base : "(" + base + ")";
  if (exponent.is_equal(1)) return own;
  const std::string power = constant_text(exponent);
  const bool simple = power.find_first_of("+-*/ ") == std::string::npos;
  return own + "^" + (simple ? power : "(" + power + ")");
}

DarbouxCombination Combiner::described(const System& system, const Polynomial& f, Kind kind) const {
  const std::size_t first = model_.variables.size(), last = first + found_.size();
  GiNaC::ex scale = 1;
  if (kind == Kind::multiplier) scale = system.expression(f.derivative(last));
  Polynomial g = f;
  DarbouxCombination result;
  result.kind = kind;
  result.rational = kind == Kind::integral;
  std::string top, bottom;
  for (std::size_t i = first; i < last; ++i) {
    const Polynomial slope = f.derivative(i);
    if (slope.is_zero()) continue;
    g -= slope * system.ring().variable(i);
    const GiNaC::ex exponent = (system.expression(slope) / scale).normal();
    result.rational = result.rational && exponent.info(GiNaC::info_flags::integer);
    const bool negative = exponent.info(GiNaC::info_flags::negative);
    std::string& side = negative ? bottom : top;
    side += (side.empty() ? "" : "*") +
            factor(negative ? GiNaC::ex(-exponent) : exponent, found_[i - first].text);
  }
  std::vector<std::string> exponents;
  if (kind != Kind::integral) {
    const Polynomial slope = f.derivative(last);
    g -= slope * system.ring().variable(last);
    if (kind == Kind::time_dependent)
      exponents.push_back(constant_text(system.expression(slope)) + "*t");
  }
  const GiNaC::ex rest = (system.expression(g) / scale).normal();
  if (!rest.is_zero()) exponents.insert(exponents.begin(), system.text_of(rest));
  result.rational = result.rational && exponents.empty();
  if (!exponents.empty()) {
    std::string sum;
    for (const std::string& e : exponents) sum += (sum.empty() ? "" : " + ") + e;
    top += (top.empty() ? "" : "*") + ("exp(" + sum + ")");
  }
  result.text = top.empty() ? "1" : top;
  if (!bottom.empty()) {
    const bool product = bottom.find_first_of("*/") != std::string::npos;
    result.text += "/" + (product ? "(" + bottom + ")" : bottom);
  }
  return result;
}

/// Whether a function of the parameters is zero at special values of them only: a polynomial is,
/// and one with roots or the like may be a divisor of zero.
bool may_be_divided_by(const System& system, const Polynomial& scale) {
  const FunctionRing& ring = system.functions();
  for (std::size_t i = ring.symbols().size(); i < ring.end_of_generators(); ++i)
    if (scale.uses(i)) return ring.is_nowhere_zero(ring.numerator(scale));
  return true;
}

/// Whether it is proved that there are no others.
bool Combiner::search(Kind kind) {
  const Model model = extended(kind);
  System system(model, {}, {});
  const Solution solution = solve(system, problem(system), watch_);
  for (const Generator& g : solution.found) {
    const GiNaC::ex value = system.expression(g.function);
    const Verdict verdict =
        prove_claim(model, ClaimKind::integral, {"a sum of logarithms", value, {}}).verdict;
    known_.push_back(value);
    const auto uses = [&](std::size_t place) { return g.function.uses(place); };
    bool logarithmic = false;
    for (std::size_t i = model_.variables.size(); i < model.variables.size(); ++i)
      logarithmic = logarithmic || uses(i);
    if (!logarithmic) continue;  // a polynomial integral
    if (kind != Kind::integral && !uses(model.variables.size() - 1)) continue;
    result_.push_back(described(system, g.function, kind));
    // a + |a| is zero for all a < 0: what is divided by it is no density there.
    const bool divided =
        kind != Kind::multiplier ||
        may_be_divided_by(system, g.function.derivative(model.variables.size() - 1));
    result_.back().verdict = divided ? verdict : Verdict::undecided;
  }
  return solution.complete;
}

std::vector<DarbouxCombination> Combiner::run(bool& all) {
  const bool wanted = all;
  all = false;
  for (std::size_t i = 0; i < found_.size(); ++i)
    logarithms_.emplace_back(fmt::format("<log {}>", i));
  try {
    all = search(Kind::integral) && wanted;
    const std::vector<GiNaC::ex> integrals = known_;
    search(Kind::multiplier);
    known_ = integrals;
    search(Kind::time_dependent);
  } catch (const NoAnswer&) {
    // What was found before stands; that there is no other is not said.
  }
  return std::move(result_);
}

}  // namespace

std::vector<DarbouxCombination> combine(const Model& model,
                                        const std::vector<DarbouxPolynomial>& found, int degree,
                                        const Watch& watch, bool* all_integrals) {
  std::vector<DarbouxPolynomial> proved;
  std::copy_if(found.begin(), found.end(), std::back_inserter(proved),
               [](const DarbouxPolynomial& f) { return f.verdict == Verdict::proved; });
  bool all = proved.size() == found.size();
  std::vector<DarbouxCombination> result;
  if (!proved.empty()) result = Combiner(model, proved, degree, watch).run(all);
  if (all_integrals != nullptr) *all_integrals = all;
  return result;
}

}  // namespace casimir::search

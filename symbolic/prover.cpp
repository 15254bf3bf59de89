#include "symbolic/prover.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/rational_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "symbolic/exact_point.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using Point = std::vector<cln::cl_RA>;

constexpr int kPointTrials = 400;
constexpr std::size_t kMaxResidualText = 2000;

std::string number_text(const cln::cl_RA& value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

std::string shortened(std::string text, std::size_t terms) {
  if (text.size() <= kMaxResidualText) return text;
  const std::size_t cut = text.rfind(' ', kMaxResidualText);
  return text.substr(0, cut) + fmt::format(" ... ({} terms)", terms);
}

/// A rational root of c0 + c1 x + c2 x^2 (higher coefficients: none is looked for).
bool rational_root(const std::vector<cln::cl_RA>& c, cln::cl_RA* root) {
  std::size_t degree = c.size();
  while (degree > 0 && cln::zerop(c[degree - 1])) --degree;
  if (degree == 2) {
    *root = -c[0] / c[1];
    return true;
  }
  if (degree != 3) return false;
  const cln::cl_RA discriminant = c[1] * c[1] - 4 * c[2] * c[0];
  cln::cl_RA square_root;
  if (cln::minusp(discriminant) || !cln::sqrtp(discriminant, &square_root)) return false;
  *root = (square_root - c[1]) / (2 * c[2]);
  return true;
}

}  // namespace

std::vector<GiNaC::symbol> Prover::symbols_of(const Model& model) {
  std::vector<GiNaC::symbol> symbols = model.variables;
  symbols.insert(symbols.end(), model.parameters.begin(), model.parameters.end());
  if (model.time) symbols.push_back(*model.time);
  for (const LaxPair& pair : model.lax_pairs) {
    if (pair.spectral) symbols.push_back(*pair.spectral);
  }
  return symbols;
}

std::vector<ex> Prover::expressions_of(const Model& model, const std::vector<ex>& further) {
  std::vector<ex> all = further;
  const auto add = [&](const std::vector<NamedExpression>& list) {
    for (const NamedExpression& item : list) all.push_back(item.value);
  };
  if (model.hamiltonian) all.push_back(*model.hamiltonian);
  if (model.poisson) {
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
      for (std::size_t j = i + 1; j < model.variables.size(); ++j)
        all.push_back((*model.poisson)(i, j));
    }
  } else {
    all.insert(all.end(), model.field.begin(), model.field.end());
  }
  add(model.casimirs);
  add(model.integrals);
  for (const Measure& measure : model.measures) all.push_back(measure.density.value);
  for (const auto* claims : {&model.conditionals, &model.invariant_relations}) {
    for (const LevelClaim& claim : *claims) {
      all.push_back(claim.expression.value);
      add(claim.on);
    }
  }
  for (const LaxPair& pair : model.lax_pairs) {
    for (std::size_t k = 0; k < pair.l.nops(); ++k) {
      all.push_back(pair.l.op(k));
      all.push_back(pair.a.op(k));
    }
  }
  for (const PoissonMap& map : model.maps) {
    all.insert(all.end(), map.expressions.begin(), map.expressions.end());
    add(map.on);
    for (const ex& composed : map.composed_brackets()) all.push_back(composed);
  }
  return all;
}

Prover::Prover(const Model& model, const std::vector<ex>& further)
    : model_(model), ring_(symbols_of(model), model.assumptions, expressions_of(model, further)) {
  const std::size_t n = dimension();
  if (!model.poisson) {
    for (const ex& rate : model.field) field_.push_back(ring_.convert(rate));
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      brackets_.push_back(i < j ? ring_.convert((*model.poisson)(i, j)) : Polynomial(ring_.ring()));
      if (i > j) brackets_.back() = -brackets_[j * n + i];
    }
  }
  const std::vector<Polynomial> slope = gradient(ring_.convert(*model.hamiltonian));
  for (std::size_t i = 0; i < n; ++i) {
    Polynomial rate(ring_.ring());
    for (std::size_t j = 0; j < n; ++j) {
      if (!bracket_entry(i, j).is_zero() && !slope[j].is_zero())
        rate += bracket_entry(i, j) * slope[j];
    }
    field_.push_back(std::move(rate));
  }
}

std::vector<Polynomial> Prover::gradient(const Polynomial& f) const {
  std::vector<Polynomial> result;
  for (std::size_t i = 0; i < dimension(); ++i) result.push_back(ring_.derivative(f, i));
  return result;
}

Polynomial Prover::bracket(const Polynomial& f, const Polynomial& g) const {
  const std::vector<Polynomial> df = gradient(f);
  const std::vector<Polynomial> dg = gradient(g);
  Polynomial sum(ring_.ring());
  for (std::size_t i = 0; i < dimension(); ++i) {
    for (std::size_t j = i + 1; j < dimension(); ++j) {
      if (bracket_entry(i, j).is_zero()) continue;
      sum += bracket_entry(i, j) * (df[i] * dg[j] - df[j] * dg[i]);
    }
  }
  return sum;
}

Polynomial Prover::rate(const Polynomial& f) const {
  Polynomial sum(ring_.ring());
  for (std::size_t i = 0; i < dimension(); ++i) {
    const Polynomial slope = ring_.derivative(f, i);
    if (!slope.is_zero()) sum += slope * field_[i];
  }
  if (model_.time) sum += ring_.derivative(f, dimension() + model_.parameters.size());
  return sum;
}

Polynomial Prover::divergence() const {
  Polynomial sum(ring_.ring());
  for (std::size_t i = 0; i < dimension(); ++i) sum += ring_.derivative(field_[i], i);
  return sum;
}

Level Prover::level(const std::vector<NamedExpression>& on) {
  Level result;
  for (const NamedExpression& f : on) {
    result.texts.push_back(f.name);
    result.functions.push_back(f.value);
    result.numerators.push_back(ring_.numerator(ring_.convert(f.value)));
  }
  result.solved = triangular_set(result.numerators, dimension());
  if (result.solved.empty()) result.basis = groebner_basis(result.numerators);
  return result;
}

std::vector<Residual> Prover::level_rates(const Level& level) {
  std::vector<Residual> result;
  for (std::size_t i = 0; i < level.functions.size(); ++i) {
    const ex f = level.functions[i];
    result.push_back({fmt::format("d({})/dt", level.texts[i]), rate(ring_.convert(f)),
                      [this, f] { return model_.rate(f); }});
  }
  return result;
}

/// Is the residual in the ideal of the level's functions? `rest` becomes what is left of it.
bool Prover::vanishes_on(const Residual& residual, Polynomial& rest, const Level& level,
                         Proof& proof) {
  std::vector<Polynomial> cofactors;
  const Polynomial plain = rest.remainder(level.numerators, &cofactors);
  if (plain.is_zero()) {
    for (std::size_t i = 0; i < cofactors.size(); ++i) {
      if (cofactors[i].is_zero()) continue;
      if (!proof.evidence.empty()) proof.evidence += "; ";
      proof.evidence +=
          fmt::format("{} has the cofactor {} of {}", residual.label,
                      shortened(ring_.text(cofactors[i]), cofactors[i].terms()), level.texts[i]);
    }
    rest = plain;
    return true;
  }
  if (level.solved.empty()) {
    rest = plain.remainder(level.basis, &cofactors);
    return rest.is_zero();
  }
  rest = pseudo_remainder(rest, level.solved);
  if (!rest.is_zero()) return false;
  for (const SolvedRelation& solved : level.solved) {
    if (solved.leading.is_constant()) continue;
    const std::string text = ring_.text(solved.leading);
    if (std::find(proof.nonzero.begin(), proof.nonzero.end(), text) == proof.nonzero.end()) {
      proof.nonzero.push_back(text);
    }
  }
  return true;
}

void Prover::decide(Proof& proof, const std::vector<Residual>& residuals, const Level& level) {
  proof.verdict = Verdict::proved;
  int searches = 0;
  for (const Residual& residual : residuals) {
    Polynomial rest = ring_.numerator(residual.value);
    if (!rest.is_zero() && !level.empty() && vanishes_on(residual, rest, level, proof)) continue;
    if (rest.is_zero()) continue;
    const bool first = proof.verdict == Verdict::proved;
    // A level on which no exact point is found the first time is not searched again and again.
    constexpr int kSearches = 2;
    std::optional<Witness> found;
    if (searches++ < kSearches || level.empty()) found = witness(residual, rest, level);
    if (!first && !found) continue;
    proof.verdict = found ? Verdict::refuted : Verdict::undecided;
    proof.residual = shortened(ring_.text(rest), rest.terms());
    proof.reason = found ? fmt::format("{} is not zero", residual.label)
                         : fmt::format(
                               "{} does not reduce to zero, and no exact point was found at which "
                               "it is not zero",
                               residual.label);
    proof.witness = std::move(found);
    if (proof.witness) break;
  }
  if (proof.verdict != Verdict::proved) proof.evidence.clear();
  for (const Polynomial& d : ring_.denominators()) proof.nonzero.push_back(ring_.text(d));
}

cln::cl_RA Prover::draw() {
  std::uniform_int_distribution<int> numerators(-9, 9);
  std::uniform_int_distribution<int> denominators(1, 4);
  const int numerator = numerators(random_);
  return cln::cl_RA(numerator) / denominators(random_);
}

/// Moves some coordinates so that the level's functions vanish: each is solved for one variable
/// that it contains and that no earlier one was solved for.
bool Prover::solve_level(Point& point, const Level& level) {
  std::vector<bool> used(dimension());
  for (const Polynomial& f : level.numerators) {
    std::vector<std::size_t> order(dimension());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random_);
    bool solved = false;
    for (const std::size_t i : order) {
      if (used[i] || !f.uses(i) || f.degree(i) > 2) continue;
      std::vector<cln::cl_RA> values;
      for (const Polynomial& c : f.coefficients(i)) values.push_back(c.evaluate(point));
      if (!rational_root(values, &point[i])) continue;
      used[i] = solved = true;
      break;
    }
    if (!solved && !cln::zerop(f.evaluate(point))) return false;
  }
  return std::all_of(level.numerators.begin(), level.numerators.end(),
                     [&](const Polynomial& f) { return cln::zerop(f.evaluate(point)); });
}

GiNaC::exmap Prover::substitution(const Point& point) const {
  GiNaC::exmap values;
  for (std::size_t i = 0; i < ring_.symbols().size(); ++i)
    values[ring_.symbols()[i]] = GiNaC::numeric(point[i]);
  return values;
}

bool Prover::inside_assumptions(const Point& point) const {
  if (model_.assumptions.empty()) return true;
  const GiNaC::exmap values = substitution(point);
  return std::all_of(model_.assumptions.begin(), model_.assumptions.end(),
                     [&](const Assumption& a) { return a.holds_at(values); });
}

std::optional<Point> Prover::random_point(const Level& level) {
  return random_point(level, {.formal = true});
}

std::optional<Point> Prover::random_point(const Level& level,
                                          const FunctionRing::Freedom& freedom) {
  const int trials = level.empty() ? kPointTrials : 20 * kPointTrials;
  for (int trial = 0; trial < trials; ++trial) {
    Point point(ring_.ring().size(), 0);
    for (std::size_t i = 0; i < ring_.symbols().size(); ++i) {
      // Functions whose arguments are not plain symbols have rational values at zero at best.
      const bool at_zero = !freedom.formal && !ring_.is_polynomial() && trial % 4 == 3;
      point[i] = at_zero && i < dimension() && freedom.bare[i] ? 0 : draw();
    }
    if (!level.empty() && !solve_level(point, level)) continue;
    if (!inside_assumptions(point)) continue;
    if (!ring_.complete(
            point, [this] { return draw(); }, freedom))
      continue;
    return point;
  }
  return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> Prover::describe(const Point& point) const {
  // The sines of a formal point are drawn; the angles to print are those that belong to them.
  return ExactPoint(ring_, point, std::vector<bool>(ring_.symbols().size())).coordinates();
}

/// A point where the residual, evaluated anew by GiNaC's own substitution, is a rational number
/// other than zero.
std::optional<Witness> Prover::witness(const Residual& residual, const Polynomial& numerator,
                                       const Level& level) {
  if (!ring_.has_value(numerator)) return std::nullopt;
  FunctionRing::Freedom freedom{false, ring_.bare_symbols(numerator)};
  const auto keep = [&](const ex& e) {
    for (std::size_t i = 0; i < freedom.bare.size(); ++i) {
      freedom.bare[i] = freedom.bare[i] || e.has(ring_.symbols()[i]);
    }
  };
  for (const ex& f : level.functions) keep(f);
  for (const Assumption& a : model_.assumptions) keep(a.difference);
  const ex check = residual.by_ginac();
  constexpr int kTrials = 60;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::optional<Point> point = random_point(level, freedom);
    if (!point) return std::nullopt;
    if (cln::zerop(numerator.evaluate(*point))) continue;
    const ExactPoint exact(ring_, *point, freedom.bare);
    ex value;
    try {
      value = exact.evaluate(check);
      const bool on_level = std::all_of(level.functions.begin(), level.functions.end(),
                                        [&](const ex& f) { return exact.evaluate(f).is_zero(); });
      if (!on_level) continue;
    } catch (const std::exception&) {
      continue;  // a pole at this point
    }
    if (!GiNaC::is_a<GiNaC::numeric>(value) || value.is_zero()) continue;
    const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(value);
    if (!number.is_rational()) continue;
    return Witness{exact.coordinates(), number_text(cln::the<cln::cl_RA>(number.to_cl_N()))};
  }
  return std::nullopt;
}

}  // namespace casimir

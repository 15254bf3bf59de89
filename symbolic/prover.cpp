#include "symbolic/prover.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/rational_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "symbolic/exact_point.hpp"
#include "symbolic/measure.hpp"
#include "symbolic/witness.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

constexpr std::size_t kMaxResidualText = 2000;

std::string shortened(std::string text, std::size_t terms) {
  if (text.size() <= kMaxResidualText) return text;
  const std::size_t cut = text.rfind(' ', kMaxResidualText);
  return text.substr(0, cut) + fmt::format(" ... ({} terms)", terms);
}

/// What holds between the functions everywhere, as c^2 - (1 - s^2): on a level such as c = 1 it
/// says more than the normal form of the ring, that s^2 = 0.
std::vector<Polynomial> square_relations(const FunctionRing& ring) {
  std::vector<Polynomial> relations;
  for (std::size_t i = ring.symbols().size(); i < ring.ring().size(); ++i) {
    const Polynomial square = ring.ring().variable(i) * ring.ring().variable(i);
    const Polynomial relation = square - ring.numerator(square);
    // Not so for 1/d, whose numerator is another function.
    if (!relation.is_zero() && ring.numerator(relation).is_zero()) relations.push_back(relation);
  }
  return relations;
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

std::vector<ex> Prover::with_dynamics(const Model& model, std::vector<ex> expressions) {
  if (!model.poisson) {
    expressions.insert(expressions.end(), model.field.begin(), model.field.end());
    return expressions;
  }
  expressions.push_back(*model.hamiltonian);
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    for (std::size_t j = i + 1; j < model.variables.size(); ++j)
      expressions.push_back((*model.poisson)(i, j));
  }
  return expressions;
}

Prover::Prover(const Model& model, const std::vector<ex>& expressions)
    : model_(model),
      ring_(symbols_of(model), model.assumptions, with_dynamics(model, expressions)),
      points_(model, ring_) {
  const std::size_t n = dimension();
  if (!model.poisson) {
    for (const ex& rate : model.field) field_.push_back(ring_.convert(rate));
    return;
  }
  brackets_.assign(n * n, Polynomial(ring_.ring()));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const ex entry = (*model.poisson)(i, j);
      if (entry.is_zero()) continue;
      brackets_[i * n + j] = ring_.convert(entry);
      brackets_[j * n + i] = -brackets_[i * n + j];
    }
  }
  field_ = flow_of(gradient(ring_.convert(*model.hamiltonian)));
}

const Polynomial& Prover::convert(const ex& expression) {
  if (!ring_.is_polynomial()) {
    // What cancels in the sum was divided by all the same.
    for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part) {
      if (GiNaC::is_a<GiNaC::power>(*part) || GiNaC::is_a<GiNaC::function>(*part))
        used(ring_.convert(*part));
    }
  }
  return used(ring_.convert(expression));
}

const std::vector<Polynomial>& Prover::field() const {
  for (const Polynomial& rate : field_) used(rate);
  return field_;
}

std::vector<Polynomial> Prover::gradient(const Polynomial& f) const {
  std::vector<Polynomial> result;
  result.reserve(dimension());
  for (std::size_t i = 0; i < dimension(); ++i) result.push_back(ring_.derivative(f, i));
  return result;
}

std::vector<Polynomial> Prover::flow_of(const std::vector<Polynomial>& slope) const {
  std::vector<Polynomial> result;
  result.reserve(dimension());
  for (std::size_t i = 0; i < dimension(); ++i) {
    SumOfProducts sum(ring_.ring());
    for (std::size_t j = 0; j < dimension(); ++j) sum.add(bracket_entry(i, j), slope[j]);
    result.push_back(sum.finish());
  }
  return result;
}

/// {f, g} = df . (J dg): a flow is as short as a gradient, while products of gradients are not.
Polynomial Prover::bracket(const Polynomial& f, const Polynomial& g) const {
  return along(f, flow_of(gradient(g)));
}

Polynomial Prover::along(const Polynomial& f, const std::vector<Polynomial>& field) const {
  SumOfProducts sum(ring_.ring());
  for (std::size_t i = 0; i < dimension(); ++i) {
    if (!field[i].is_zero()) sum.add(ring_.derivative(f, i), field[i]);
  }
  return sum.finish();
}

const std::vector<Polynomial>& Prover::flow(const ex& f) {
  const auto known = flows_.find(f);
  if (known != flows_.end()) {
    for (const Polynomial& rate : known->second) used(rate);
    return known->second;
  }
  return flows_.emplace(f, flow_of(gradient(convert(f)))).first->second;
}

Polynomial Prover::bracket(const ex& f, const ex& g) {
  if (f.compare(g) > 0) return -bracket(g, f);
  const auto known = known_brackets_.find({f, g});
  if (known != known_brackets_.end()) return known->second;
  Polynomial result = ring_.numerator(along(convert(f), flow(g)));
  return known_brackets_.emplace(std::pair(f, g), std::move(result)).first->second;
}

Polynomial Prover::rate(const Polynomial& f) const {
  Polynomial result = along(f, field());
  if (model_.time) result += ring_.derivative(f, dimension() + model_.parameters.size());
  return result;
}

Polynomial Prover::divergence() const {
  std::vector<Polynomial> slopes;
  slopes.reserve(dimension());
  for (std::size_t i = 0; i < dimension(); ++i) slopes.push_back(ring_.derivative(field()[i], i));
  return Polynomial::sum(ring_.ring(), slopes);
}

Level Prover::level(const std::vector<NamedExpression>& on) {
  Level result;
  for (const NamedExpression& f : on) {
    result.texts.push_back(f.name);
    result.functions.push_back(f.value);
    result.numerators.push_back(ring_.numerator(convert(f.value)));
  }
  result.solved = triangular_set(result.numerators, dimension());
  if (result.solved.empty()) {
    std::vector<Polynomial> ideal = result.numerators;
    const std::vector<Polynomial> identities = square_relations(ring_);
    ideal.insert(ideal.end(), identities.begin(), identities.end());
    result.basis = groebner_basis(ideal);
  }
  result.orthogonal = orthogonal_vectors(result.numerators, dimension());
  return result;
}

std::vector<Residual> Prover::level_rates(const Level& level) {
  std::vector<Residual> result;
  for (std::size_t i = 0; i < level.functions.size(); ++i) {
    const ex f = level.functions[i];
    result.push_back({fmt::format("d({})/dt", level.texts[i]), rate(convert(f)),
                      [this, f] { return model_.rate(f); }});
  }
  return result;
}

/// The same where relations x = value are put in first: on the level the functions may be simpler
/// than the ring knows, as sqrt(G^2 - H^2) where H = 0 and G > 0.
bool Prover::vanishes_by_substitution(const Residual& residual, const Level& level) const {
  if (ring_.is_polynomial() || level.solved.empty()) return false;
  try {
    ex value = residual.by_ginac();
    for (const SolvedRelation& solved : level.solved) {
      if (!solved.leading.is_constant() || solved.relation.degree(solved.variable) != 1) continue;
      const Polynomial rest = solved.relation.coefficients(solved.variable)[0];
      const cln::cl_RA factor = -1 / solved.leading.term_list()[0].first;
      value = substituted(
          value, {{ring_.symbols()[solved.variable], ring_.expression(rest.scaled(factor))}});
    }
    FunctionRing fresh(ring_.symbols(), model_.assumptions, {value});
    return fresh.numerator(fresh.convert(value)).is_zero();
  } catch (const std::exception&) {
    return false;  // a pole on the level, or too large
  }
}

/// Is the residual in the ideal of the level's functions? `rest` becomes what is left of it.
bool Prover::in_ideal(const Residual& residual, const Level& level) {
  const Polynomial value = ring_.numerator(residual.value);
  std::vector<Polynomial> quotients;
  if (value.is_zero() || value.remainder(level.numerators, &quotients).is_zero()) return true;
  const Polynomial rest = level.solved.empty()
                              ? value.remainder(level.basis, &quotients)
                              : ring_.numerator(pseudo_remainder(value, level.solved));
  return rest.is_zero() || vanishes_by_substitution(residual, level);
}

void Prover::decide_invariance(Proof& proof, std::vector<NamedExpression> functions) {
  const Proof blank = proof;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const Level own = level(functions);
    const std::vector<Residual> rates = level_rates(own);
    proof = blank;
    decide(proof, rates, own);
    if (proof.verdict != Verdict::proved) return;
    const std::size_t before = functions.size();
    for (const Residual& rate : rates) {
      if (!in_ideal(rate, own)) functions.push_back({rate.label, rate.by_ginac(), {}});
    }
    if (functions.size() == before) return;
  }
  proof = blank;
  proof.verdict = Verdict::undecided;
  proof.reason =
      "the rates of the functions vanish on their zero level, but are no combinations of them";
}

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
  const auto reduced = [&](const Polynomial& p) {
    return level.solved.empty() ? p.remainder(level.basis, &cofactors)
                                : ring_.numerator(pseudo_remainder(p, level.solved));
  };
  rest = reduced(rest);
  // The ideal need not contain all that vanishes on the level: cos(q) = 1 gives sin(q)^2 = 0.
  constexpr std::size_t kMaxSquared = 100;
  if (!rest.is_zero() && rest.terms() <= kMaxSquared &&
      reduced(ring_.numerator(rest * rest)).is_zero())
    rest = Polynomial(ring_.ring());
  if (!rest.is_zero() && !vanishes_by_substitution(residual, level)) return false;
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
    if (searches++ < kSearches || level.empty()) {
      found = find_witness(model_, ring_, points_, rest, residual.by_ginac, level);
    }
    if (!first && !found) continue;
    proof.verdict = found ? Verdict::refuted : Verdict::undecided;
    proof.residual = shortened(ring_.text(rest), rest.terms());
    proof.reason = found ? fmt::format("{} is not zero", residual.label)
                         : fmt::format(
                               "{} does not reduce to zero, and no exact point was found at which "
                               "it is not zero",
                               residual.label);
    if (found) found->point = without_other_spectra(std::move(found->point));
    proof.witness = std::move(found);
    if (proof.witness) break;
  }
  if (proof.verdict != Verdict::proved) proof.evidence.clear();
  const std::vector<Polynomial> denominators = ring_.denominators();
  for (std::size_t k = 0; k < divided_by_.size(); ++k) {
    if (divided_by_[k] && !ring_.is_exponential(denominators[k]))
      proof.nonzero.push_back(ring_.text(denominators[k]));
  }
  for (const Polynomial& p : ring_.implied_positive()) proof.positive.push_back(ring_.text(p));
}

std::optional<Witness> Prover::nonzero_point(const Residual& function) {
  return find_witness(model_, ring_, points_, ring_.numerator(function.value), function.by_ginac,
                      {});
}

std::optional<Point> Prover::random_point(const Level& level) {
  return points_.completed(level, {.formal = true});
}

std::vector<std::pair<std::string, std::string>> Prover::describe(const Point& point) const {
  // The sines of a formal point are drawn; the angles to print are those that belong to them.
  return without_other_spectra(
      ExactPoint(ring_, point, std::vector<bool>(ring_.symbols().size())).coordinates());
}

/// Of the values of all symbols of the ring, in its order, those that this claim may speak of.
Prover::NamedValues Prover::without_other_spectra(NamedValues all) const {
  const std::size_t own = dimension() + model_.parameters.size() + (model_.time ? 1 : 0);
  NamedValues result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i < own || (spectral_ && ring_.symbols()[i].is_equal(*spectral_)))
      result.push_back(std::move(all[i]));
  }
  return result;
}

}  // namespace casimir

#include "symbolic/proof/prover.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/rational_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "symbolic/expression/expression_size.hpp"
#include "symbolic/expression/pairs.hpp"
#include "symbolic/proof/points/exact_point.hpp"
#include "symbolic/proof/points/witness.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

}  // namespace

std::vector<GiNaC::symbol> Prover::symbols_of(const Model& model) {
  std::vector<GiNaC::symbol> symbols = model.symbols();
  if (model.time) symbols.push_back(*model.time);
  for (const LaxPair& pair : model.lax_pairs) {
    if (pair.spectral) symbols.push_back(*pair.spectral);
  }
  return symbols;
}

std::vector<ex> Prover::lost_of_dynamics(const Model& model, Subject subject) {
  std::vector<ex> lost;
  const auto add = [&](const std::vector<ex>& parts) {
    lost.insert(lost.end(), parts.begin(), parts.end());
  };
  if (subject == Subject::motion) add(model.domain);
  for (const NamedExpression& constraint : model.constraints) add(constraint.domain);
  if (subject != Subject::functions) add(model.bracket_domain);
  return lost;
}

std::vector<ex> Prover::with_dynamics(const Model& model, std::vector<ex> expressions,
                                      Subject subject) {
  if (subject == Subject::motion) {
    expressions.insert(expressions.end(), model.field.begin(),
                       model.poisson ? model.field.begin() : model.field.end());
    if (model.hamiltonian) expressions.push_back(*model.hamiltonian);
  }
  // Where a constraint has no value is no point of the phase space.
  for (const NamedExpression& constraint : model.constraints)
    expressions.push_back(constraint.value);
  const std::vector<ex> lost = lost_of_dynamics(model, subject);
  expressions.insert(expressions.end(), lost.begin(), lost.end());
  if (subject == Subject::functions || !model.poisson) return expressions;
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    for (std::size_t j = i + 1; j < model.variables.size(); ++j)
      expressions.push_back((*model.poisson)(i, j));
  }
  return expressions;
}

Prover::Prover(const Model& model, const std::vector<ex>& expressions, Subject subject)
    : model_(model),
      ring_(symbols_of(model), model.assumptions, with_dynamics(model, expressions, subject),
            model.limits),
      points_(model, ring_),
      real_points_(model, ring_),
      domain_(with_dynamics(model, expressions, subject)),
      all_(domain_),
      subject_(subject) {
  const std::size_t n = dimension();
  if (!model.poisson) {
    if (subject != Subject::motion) return;
    for (const ex& rate : model.field) field_.push_back(ring_.convert(rate));
    return;
  }
  if (subject == Subject::functions) return;
  brackets_.assign(n * n, Polynomial(ring_.ring()));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const ex entry = (*model.poisson)(i, j);
      if (entry.is_zero()) continue;
      brackets_[i * n + j] = ring_.convert(entry);
      brackets_[j * n + i] = -brackets_[i * n + j];
    }
  }
  if (subject == Subject::motion && model.hamiltonian)
    field_ = flow_of(gradient(ring_.convert(*model.hamiltonian)));
}

void Prover::begin_claim(const std::vector<ex>& expressions, Subject subject) {
  divided_by_.clear();
  spectral_.reset();
  claim_ = expressions;
  domain_ = with_dynamics(model_, expressions, subject);
  subject_ = subject;
  divisors_.reset();
  motion_divisors_.reset();
  kinks_.reset();
  kinks_almost_.reset();
  claim_inhabited_.reset();
  claim_on_constraints_.reset();
  holds_on_constraints_ = false;
  constraints_count_ = true;
  kept_from_zero_.clear();
}

const Level& Prover::level(const std::vector<NamedExpression>& on) {
  const auto same = [](const NamedExpression& f, const NamedExpression& g) {
    return f.name == g.name && f.value.is_equal(g.value);
  };
  for (const KnownLevel& known : known_levels_) {
    if (known.in_branch == in_branch_ &&
        std::equal(on.begin(), on.end(), known.on.begin(), known.on.end(), same)) {
      // What it divides by counts for each claim.
      for (const NamedExpression& whole : on) {
        for (const auto& [f, numerator] : level_functions(whole))
          if (!f.value.is_equal(whole.value)) convert(f.value);
      }
      return known.level;
    }
  }
  known_levels_.push_back({on, in_branch_, make_level(on)});
  return known_levels_.back().level;
}

const std::vector<Prover::LevelFunction>& Prover::level_functions(const NamedExpression& f) {
  constexpr int kDepth = 3;
  convert(f.value);  // what it divides by counts for each claim
  const auto known = level_functions_.find(f.name);
  if (known != level_functions_.end() && known->second.first.is_equal(f.value))
    return known->second.second;
  std::vector<LevelFunction> parts;
  for (NamedExpression& part : simplified(f, kDepth)) {
    Polynomial numerator = ring_.lowest_terms(convert(part.value)).first;
    if (numerator.is_zero()) continue;  // no condition, and no divisor
    parts.push_back({std::move(part), std::move(numerator)});
  }
  return (level_functions_[f.name] = {f.value, std::move(parts)}).second;
}

namespace {

/// Marks the ring's denominators that an expression or a part of it has: what cancels in a sum was
/// divided by all the same.
class Denominators {
 public:
  Denominators(FunctionRing& ring, std::vector<bool>& marks) : ring_(ring), marks_(marks) {}

  void in(const ex& e) {
    if (GiNaC::is_a<GiNaC::expairseq>(e)) {
      const bool product = GiNaC::is_a<GiNaC::mul>(e);
      for (const GiNaC::expair& pair : Pairs::of(e)) {
        if (!product || pair.coeff.info(GiNaC::info_flags::posint))
          in(pair.rest);
        else
          in_power(pair.rest, pair.coeff);
      }
    } else if (GiNaC::is_a<GiNaC::power>(e)) {
      in_power(e.op(0), e.op(1));
    } else if (GiNaC::is_a<GiNaC::function>(e) && is_new(e, ex(1))) {
      ring_.mark_denominators(ring_.convert(e), marks_);
      for (std::size_t i = 0; i < e.nops(); ++i) in(e.op(i));
    }
  }

 private:
  void in_power(const ex& base, const ex& exponent) {
    if (!is_new(base, exponent)) return;
    ring_.mark_denominators(ring_.convert(GiNaC::pow(base, exponent)), marks_);
    in(base);
    in(exponent);
  }

  bool is_new(const ex& base, const ex& exponent) {
    std::vector<ex>& exponents = seen_[base];
    const auto same = [&](const ex& e) { return e.is_equal(exponent); };
    if (std::any_of(exponents.begin(), exponents.end(), same)) return false;
    exponents.push_back(exponent);
    return true;
  }

  FunctionRing& ring_;
  std::vector<bool>& marks_;
  std::unordered_map<ex, std::vector<ex>> seen_;
};

}  // namespace

const Polynomial& Prover::convert(const ex& expression) {
  const Polynomial& result = ring_.convert(expression);
  if (ring_.is_polynomial()) return result;
  const auto [known, fresh] = denominators_of_.try_emplace(expression);
  std::vector<bool>& marks = known->second;
  if (fresh) {
    ring_.mark_denominators(result, marks);
    Denominators(ring_, marks).in(expression);
  }
  divided_by_.resize(std::max(divided_by_.size(), marks.size()));
  for (std::size_t i = 0; i < marks.size(); ++i) divided_by_[i] = divided_by_[i] || marks[i];
  return result;
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
  Polynomial result = ring_.reduced(along(convert(f), flow(g)));
  return known_brackets_.emplace(std::pair(f, g), std::move(result)).first->second;
}

Polynomial Prover::rate(const Polynomial& f) const {
  if (!has_motion()) throw std::logic_error("a claim about the motion is not declared as one");
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

std::optional<Witness> Prover::witness(const Polynomial& rest, const Residual& residual,
                                       const Level& level) {
  auto found = find_witness(model_, ring_, points_, real_points_,
                            {rest, residual.by_ginac(), domain_}, level, in_branch_);
  if (!found) return found;
  // Of the values of all symbols of the ring, in its order, those that this claim may speak of.
  const std::size_t own = own_symbols(model_);
  std::vector<std::pair<std::string, std::string>> all = std::exchange(found->point, {});
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i < own || (spectral_ && ring_.symbols()[i].is_equal(*spectral_)))
      found->point.push_back(std::move(all[i]));
  }
  return found;
}

std::optional<Point> Prover::random_point(const Level& level) {
  return points_.completed(level, {.formal = true});
}

std::optional<RealPoint> Prover::exact_point(const Level& level) {
  constexpr int kPoints = 20;
  for (int i = 0; i < kPoints; ++i) {
    const auto found = points_.rational(level);
    if (!found) return std::nullopt;
    std::vector<ex> coordinates;
    for (std::size_t k = 0; k < ring_.symbols().size(); ++k)
      coordinates.emplace_back(GiNaC::numeric((*found)[k]));
    RealPoint point = real_points_.at(std::move(coordinates));
    if (ring_.is_polynomial() || real_points_.admits(point, domain_)) return point;
  }
  return std::nullopt;
}

}  // namespace casimir

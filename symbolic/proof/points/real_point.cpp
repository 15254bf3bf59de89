#include "symbolic/proof/points/real_point.hpp"

#include <cln/rational.h>

#include <algorithm>
#include <functional>
#include <map>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/expression/arbitrary.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// For the states of scenes, which may be close to where something ends; tried in this order.
constexpr long kSceneBits[] = {RealPoints::kBits, 640};

/// A lower bound of the modulus, to choose pivots by.
double size_of(const Ball& ball) {
  if (!ball.is_finite() || ball.contains_zero()) return 0;
  arf_t bound;
  arf_init(bound);
  acb_get_abs_lbound_arf(bound, ball.raw(), 53);
  const double size = arf_get_d(bound, ARF_RND_DOWN);
  arf_clear(bound);
  return size > 0 ? size : 1e-300;
}

/// Values of polynomials at one point: each power of a variable is taken once for all of them.
class PolynomialBalls {
 public:
  /// \param variable  the value of each variable of the ring
  PolynomialBalls(const PolynomialRing& ring, long bits,
                  std::function<const Ball&(std::size_t)> variable)
      : bits_(bits),
        variable_(std::move(variable)),
        powers_(ring.size()),
        exponents_(ring.size()) {}

  /// With integers for coefficients, over one denominator at the end.
  Ball operator()(const Polynomial& p) {
    const fmpz_mpoly_struct* terms = p.raw()->zpoly;
    Ball total;
    for (slong k = 0; k < terms->length; ++k) {
      fmpz_mpoly_get_term_exp_ui(exponents_.data(), terms, k, p.ring().context()->zctx);
      const Ball* product = monomial();
      if (product == nullptr)
        acb_add_fmpz(total.raw(), total.raw(), terms->coeffs + k, bits_);
      else
        acb_addmul_fmpz(total.raw(), product->raw(), terms->coeffs + k, bits_);
    }
    const fmpq* content = p.raw()->content;
    if (fmpz_is_one(fmpq_numref(content)) == 0)
      acb_mul_fmpz(total.raw(), total.raw(), fmpq_numref(content), bits_);
    if (fmpz_is_one(fmpq_denref(content)) == 0)
      acb_div_fmpz(total.raw(), total.raw(), fmpq_denref(content), bits_);
    return total;
  }

 private:
  /// With the exponents that were read last; null for 1.
  const Ball* monomial() {
    const Ball* product = nullptr;
    for (std::size_t i = 0; i < exponents_.size(); ++i) {
      if (exponents_[i] == 0) continue;
      const Ball& factor = power(i, exponents_[i]);
      if (product != nullptr) acb_mul(product_.raw(), product->raw(), factor.raw(), bits_);
      product = product == nullptr ? &factor : &product_;
    }
    return product;
  }

  const Ball& power(std::size_t place, unsigned long exponent) {
    if (exponent == 1) return variable_(place);
    const auto [known, fresh] = powers_[place].try_emplace(exponent);
    if (fresh) acb_pow_ui(known->second.raw(), variable_(place).raw(), exponent, bits_);
    return known->second;
  }

  long bits_;
  std::function<const Ball&(std::size_t)> variable_;
  std::vector<std::map<unsigned long, Ball>> powers_;  ///< of each variable, as they are needed
  std::vector<unsigned long> exponents_;
  Ball product_;
};

}  // namespace

RealPoint::RealPoint(const FunctionRing& ring, std::vector<ex> coordinates, long bits,
                     std::size_t shown)
    : ring_(&ring),
      coordinates_(std::move(coordinates)),
      shown_(shown),
      evaluator_(ring.is_complex() ? BallEvaluator::Numbers::complex : BallEvaluator::Numbers::real,
                 bits),
      variables_(ring.ring().size()) {
  for (std::size_t i = 0; i < coordinates_.size(); ++i)
    evaluator_.set(ring.symbols()[i], coordinates_[i]);
  if (!ring.is_polynomial()) return;
  for (const ex& x : coordinates_) {
    if (!x.info(GiNaC::info_flags::rational)) {
      exact_.clear();
      return;
    }
    exact_.push_back(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(x).to_cl_N()));
  }
}

const Ball& RealPoint::variable(std::size_t place) {
  if (!variables_[place]) variables_[place] = evaluator_(ring_->variable_value(place));
  return *variables_[place];
}

Ball RealPoint::value(const Polynomial& p) {
  return PolynomialBalls(ring_->ring(), evaluator_.bits(),
                         [this](std::size_t i) -> const Ball& { return variable(i); })(p);
}

std::vector<std::vector<Ball>> RealPoint::values(const PolynomialRows& rows) {
  PolynomialBalls value_of(ring_->ring(), evaluator_.bits(),
                           [this](std::size_t i) -> const Ball& { return variable(i); });
  std::vector<std::vector<Ball>> result;
  for (const auto& row : rows) {
    result.emplace_back();
    for (const Polynomial& entry : row) result.back().push_back(value_of(entry));
  }
  return result;
}

RealPoint::Values RealPoint::values(const std::vector<Polynomial>& vector) {
  Values result;
  PolynomialBalls ball_of(ring_->ring(), evaluator_.bits(),
                          [this](std::size_t i) -> const Ball& { return variable(i); });
  for (const Polynomial& p : vector) {
    if (exact_.empty())
      result.balls.push_back(ball_of(p));
    else
      result.exact.push_back(p.is_zero() ? 0 : p.evaluate(exact_));
  }
  return result;
}

bool RealPoint::may_be_orthogonal(const Values& a, const Values& b) const {
  cln::cl_RA sum = 0;
  for (std::size_t i = 0; i < a.exact.size(); ++i)
    if (!cln::zerop(a.exact[i]) && !cln::zerop(b.exact[i])) sum = sum + a.exact[i] * b.exact[i];
  Ball total;
  for (std::size_t i = 0; i < a.balls.size(); ++i)
    acb_addmul(total.raw(), a.balls[i].raw(), b.balls[i].raw(), evaluator_.bits());
  return cln::zerop(sum) && total.contains_zero();
}

std::size_t least_rank(std::vector<std::vector<Ball>> matrix, long bits) {
  const std::size_t columns = matrix.empty() ? 0 : matrix[0].size();
  std::vector<bool> used(columns);
  std::size_t rank = 0;
  for (; rank < matrix.size(); ++rank) {
    std::size_t row = 0;
    std::size_t column = 0;
    double best = 0;
    for (std::size_t i = rank; i < matrix.size(); ++i) {
      for (std::size_t j = 0; j < columns; ++j) {
        const double size = used[j] ? 0 : size_of(matrix[i][j]);
        if (size > best) best = size, row = i, column = j;
      }
    }
    if (best == 0) break;
    std::swap(matrix[rank], matrix[row]);
    used[column] = true;
    for (std::size_t i = rank + 1; i < matrix.size(); ++i) {
      Ball factor;
      acb_div(factor.raw(), matrix[i][column].raw(), matrix[rank][column].raw(), bits);
      for (std::size_t j = 0; j < columns; ++j) {
        if (!used[j]) acb_submul(matrix[i][j].raw(), factor.raw(), matrix[rank][j].raw(), bits);
      }
    }
  }
  return rank;
}

std::size_t RealPoint::rank(const PolynomialRows& rows) {
  if (!exact_.empty()) {
    RationalMatrix exact;
    for (const auto& row : rows) {
      exact.emplace_back();
      for (const Polynomial& p : row) exact.back().push_back(p.is_zero() ? 0 : p.evaluate(exact_));
    }
    return casimir::rank(exact);
  }
  return least_rank(values(rows), evaluator_.bits());
}

std::string RealPoint::text() const {
  std::string text;
  for (std::size_t i = 0; i < std::min(shown_, coordinates_.size()); ++i) {
    const std::string name = ring_->symbols()[i].get_name();
    if (function_name(name)) continue;  // the symbol of an arbitrary function has no value
    text += (text.empty() ? "" : ", ") + name + " = " + expression_text(coordinates_[i]);
  }
  return text;
}

std::size_t own_symbols(const Model& model) {
  return model.variables.size() + model.parameters.size() + (model.time ? 1 : 0);
}

RealPoint RealPoints::at(std::vector<ex> coordinates, long bits) const {
  return RealPoint(ring_, std::move(coordinates), bits, own_symbols(model_));
}

BallEvaluator::Numbers RealPoints::numbers() const {
  return ring_.is_complex() ? BallEvaluator::Numbers::complex : BallEvaluator::Numbers::real;
}

bool RealPoints::admits(BallEvaluator& at, const std::vector<ex>& expressions) const {
  try {
    for (const Assumption& assumption : model_.assumptions) {
      const std::optional<int> sign = at.sign(assumption.difference);
      if (!sign || !holds(assumption.comparison, *sign)) return false;
    }
    for (const ex& e : expressions) at.require(e);
    return true;
  } catch (const NotCertified&) {
    return false;
  }
}

bool RealPoints::admits(RealPoint& point, const std::vector<ex>& expressions) const {
  return admits(point.evaluator(), expressions);
}

/// Small fractions, and by turns positive ones, ones below 1, both, and ones of another size.
std::vector<ex> RealPoints::draw() {
  const int way = draws_++ % 5;
  const auto between = [&](int low, int high) {
    return static_cast<long>(std::uniform_int_distribution<int>(low, high)(random_));
  };
  const long sizes[] = {1, 10, 100};
  const GiNaC::numeric size = way != 3             ? GiNaC::numeric(1)
                              : between(0, 1) == 1 ? GiNaC::numeric(sizes[between(0, 2)])
                                                   : GiNaC::numeric(1, sizes[between(0, 2)]);
  std::vector<ex> point;
  for (std::size_t i = 0; i < ring_.symbols().size(); ++i) {
    const GiNaC::numeric value = way == 1   ? GiNaC::numeric(between(1, 19), between(1, 4))
                                 : way == 2 ? GiNaC::numeric(between(-29, 29), 30)
                                 : way == 4
                                     ? GiNaC::numeric(between(1, 29), 30)
                                     : GiNaC::numeric(between(-19, 19), between(1, 4)) * size;
    point.emplace_back(value);
  }
  return point;
}

std::vector<ex> RealPoints::draw_wide() {
  const auto draw_size = [&] {
    const long k = std::uniform_int_distribution<int>(-5, 5)(random_);
    return GiNaC::pow(ex(10), k);
  };
  std::vector<ex> point = draw();
  const bool each = draws_ % 2 == 0;
  const ex size = draw_size();
  for (ex& x : point) x *= each ? draw_size() : size;
  return point;
}

bool RealPoints::has_inner_point(const std::vector<ex>& expressions) {
  const std::vector<Assumption>& assumptions = model_.assumptions;
  const auto is_inside = [&](std::vector<ex> coordinates) {
    try {
      RealPoint point = at(std::move(coordinates));
      BallEvaluator& values = point.evaluator();
      for (const Assumption& a : assumptions) {
        const std::optional<int> sign = values.sign(a.difference);
        if (!sign || *sign == 0 || !holds(a.comparison, *sign)) return false;
      }
      for (const ex& e : expressions) values.require(e);
      return values.smooth();
    } catch (const NotCertified&) {
      return false;
    }
  };
  const std::vector<std::vector<ex>> states = scenes();
  if (std::any_of(states.begin(), states.end(), is_inside)) return true;
  constexpr int kTries = 400, kWide = 1000;
  for (int k = 0; k < kTries; ++k)
    if (is_inside(draw())) return true;
  for (int k = 0; k < kWide; ++k)
    if (is_inside(draw_wide())) return true;
  return false;
}

std::vector<ex> RealPoints::draw_simple(bool parts_of_pi) {
  std::vector<ex> point = draw();
  const bool zeros = std::uniform_int_distribution<int>(0, 1)(random_) == 1;
  for (ex& x : point) {
    const int choice = std::uniform_int_distribution<int>(0, 5)(random_);
    if (choice < (zeros ? 4 : 1)) x = 0;
    if (choice == 4) x = 1;
    if (choice == 5) x = -1;
    if (parts_of_pi && choice >= 4) x = GiNaC::Pi / (choice == 4 ? 1 : 2);
  }
  return point;
}

/// The nearest multiple, not 0, of 1 over a prime that no other coordinate has.
std::vector<ex> RealPoints::draw_generic() {
  std::vector<ex> point = draw();
  GiNaC::numeric prime(101);
  for (ex& x : point) {
    const GiNaC::numeric multiple = GiNaC::ex_to<GiNaC::numeric>(x) * prime;
    GiNaC::numeric whole = GiNaC::iquo(multiple.numer(), multiple.denom());
    if (GiNaC::irem(whole, prime).is_zero()) whole = whole + (whole.is_negative() ? -1 : 1);
    x = whole / prime;
    prime = prime + 2;
    while (!prime.is_prime()) prime = prime + 2;
  }
  return point;
}

bool RealPoints::seems_to_have_values(const std::vector<ex>& coordinates) const {
  if (ring_.is_complex() || ring_.is_polynomial()) return true;
  functions::Probe at;
  for (const ex& x : coordinates)
    at.coordinates.push_back(GiNaC::ex_to<GiNaC::numeric>(x).to_double());
  return functions::FunctionProbe(ring_.table()).has_values_at(at);
}

std::optional<RealPoint> RealPoints::random(const std::vector<ex>& expressions,
                                            bool differentiable) {
  constexpr int kTrials = 400;
  // Most points have no values because a root is not real. Doubles see that in less time than balls
  // do; but not all functions of the ring need to be among the expressions.
  constexpr int kProbed = 20;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<ex> coordinates = draw();
    if (trial < kProbed && !seems_to_have_values(coordinates)) continue;
    RealPoint point = at(std::move(coordinates));
    if (admits(point, expressions) && (!differentiable || point.evaluator().smooth())) return point;
  }
  return std::nullopt;
}

std::optional<RealPoint> RealPoints::generic(const std::vector<ex>& expressions, std::size_t k) {
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials && generic_.size() <= k; ++trial) {
    RealPoint point = at(draw_generic());
    if (admits(point, expressions)) generic_.push_back(std::move(point));
  }
  if (generic_.size() <= k) return std::nullopt;
  return generic_[k];
}

std::vector<std::vector<ex>> RealPoints::scenes() {
  std::vector<std::vector<ex>> result;
  for (const Scene& scene : model_.scenes) {
    if (!scene.unusable.empty() || scene.parameters.size() != model_.parameters.size() ||
        scene.initial.size() != model_.variables.size())
      continue;
    std::vector<ex> coordinates = draw();  // for the time and a spectral parameter
    std::copy(scene.initial.begin(), scene.initial.end(), coordinates.begin());
    std::copy(scene.parameters.begin(), scene.parameters.end(),
              coordinates.begin() + static_cast<std::ptrdiff_t>(scene.initial.size()));
    result.push_back(std::move(coordinates));
  }
  return result;
}

std::optional<RealPoint> RealPoints::any(const std::vector<ex>& expressions, bool differentiable) {
  for (const std::vector<ex>& coordinates : scenes()) {
    for (const long bits : kSceneBits) {
      try {
        RealPoint point = at(coordinates, bits);
        if (admits(point, expressions) && (!differentiable || point.evaluator().smooth()))
          return point;
      } catch (const NotCertified&) {
        continue;
      }
    }
  }
  return random(expressions, differentiable);
}

}  // namespace casimir

#include "symbolic/algebra/ball_evaluator.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include "symbolic/algebra/machine_word.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Exact numbers that are longer become balls.
constexpr std::size_t kMaxExactBits = 4000;
/// The largest power of a number that is taken exactly.
constexpr long kMaxExactPower = 64;

bool is_short(const cln::cl_RA& r) {
  return cln::integer_length(cln::numerator(r)) < kMaxExactBits &&
         cln::integer_length(cln::denominator(r)) < kMaxExactBits;
}

}  // namespace

BallEvaluator::Value BallEvaluator::number(const cln::cl_RA& exact) const {
  Value result{std::nullopt, Ball(exact, bits_)};
  if (is_short(exact)) result.exact = exact;
  return result;
}

BallEvaluator::Value BallEvaluator::checked(Ball ball) const {
  if (!ball.is_finite() || (numbers_ == Numbers::real && !ball.is_real())) throw NotCertified{};
  return {std::nullopt, std::move(ball)};
}

int BallEvaluator::certain_sign(const Value& v) const {
  if (v.exact) return cln::minusp(*v.exact) ? -1 : cln::zerop(*v.exact) ? 0 : 1;
  const std::optional<int> sign = v.ball.sign();
  if (!sign) throw NotCertified{};
  return *sign;
}

void BallEvaluator::set(const GiNaC::symbol& symbol, const ex& exact) {
  known_.insert_or_assign(symbol, Value(value(exact)));
}

void BallEvaluator::set(const GiNaC::symbol& symbol, const Ball& ball) {
  known_.insert_or_assign(symbol, Value{std::nullopt, ball});
}

const Ball& BallEvaluator::operator()(const ex& expression) { return value(expression).ball; }

std::optional<cln::cl_RA> BallEvaluator::exact(const ex& expression) {
  return value(expression).exact;
}

std::optional<int> BallEvaluator::sign(const ex& expression) {
  const Value& v = value(expression);
  return v.exact ? certain_sign(v) : v.ball.sign();
}

const BallEvaluator::Value& BallEvaluator::value(const ex& e) {
  if (const auto it = known_.find(e); it != known_.end()) return it->second;
  return known_.emplace(e, evaluate(e)).first->second;
}

BallEvaluator::Value BallEvaluator::evaluate(const ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    const GiNaC::numeric& n = GiNaC::ex_to<GiNaC::numeric>(e);
    if (!n.is_crational()) throw NotCertified{};
    const auto real = cln::the<cln::cl_RA>(n.real().to_cl_N());
    if (n.is_real()) return number(real);
    const Ball imaginary(cln::the<cln::cl_RA>(n.imag().to_cl_N()), bits_);
    Ball result(real, bits_);
    arb_set(acb_imagref(result.raw()), acb_realref(imaginary.raw()));
    return checked(std::move(result));
  }
  if (GiNaC::is_a<GiNaC::add>(e)) return sum(e);
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
  if (GiNaC::is_a<GiNaC::power>(e)) return power(e);
  if (GiNaC::is_a<GiNaC::function>(e)) return function(GiNaC::ex_to<GiNaC::function>(e));
  if (e.is_equal(GiNaC::Pi)) {
    Ball pi;
    acb_const_pi(pi.raw(), bits_);
    return {std::nullopt, std::move(pi)};
  }
  throw NotCertified{};  // a symbol without a value, for one
}

BallEvaluator::Value BallEvaluator::sum(const ex& e) {
  std::optional<cln::cl_RA> exact = cln::cl_RA(0);
  Ball total;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const Value& term = value(e.op(i));
    if (exact && term.exact)
      exact = *exact + *term.exact;
    else
      exact.reset();
    acb_add(total.raw(), total.raw(), term.ball.raw(), bits_);
  }
  return exact ? number(*exact) : checked(std::move(total));
}

BallEvaluator::Value BallEvaluator::product(const ex& e) {
  std::optional<cln::cl_RA> exact = cln::cl_RA(1);
  bool zero = false;
  Ball total(1, bits_);
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const Value& factor = value(e.op(i));
    zero = zero || (factor.exact && cln::zerop(*factor.exact));
    if (exact && factor.exact)
      exact = *exact * *factor.exact;
    else
      exact.reset();
    acb_mul(total.raw(), total.raw(), factor.ball.raw(), bits_);
  }
  if (zero) return number(0);
  return exact ? number(*exact) : checked(std::move(total));
}

BallEvaluator::Value BallEvaluator::whole_power(const Value& base,
                                                const cln::cl_I& exponent) const {
  const bool negative = cln::minusp(exponent);
  if (negative) {
    const bool zero = base.exact ? cln::zerop(*base.exact) : base.ball.contains_zero();
    if (zero) throw NotCertified{};
  }
  if (base.exact && cln::abs(exponent) <= kMaxExactPower) {
    const cln::cl_RA power = cln::expt(*base.exact, exponent);
    if (is_short(power)) return number(power);
  }
  if (cln::integer_length(exponent) > 40) throw NotCertified{};
  Ball result;
  acb_pow_si(result.raw(), base.ball.raw(), cln::cl_I_to_long(exponent), bits_);
  return checked(std::move(result));
}

/// The principal root; of real numbers a real one, of those that are not negative.
BallEvaluator::Value BallEvaluator::root(const Value& base, unsigned long order) {
  if (base.exact && cln::zerop(*base.exact)) smooth_ = false;
  if (base.exact && !cln::minusp(*base.exact)) {
    cln::cl_RA result;
    if (order <= 64 && cln::rootp(*base.exact, static_cast<unsigned>(order), &result))
      return number(result);
  }
  if (numbers_ == Numbers::real && certain_sign(base) < 0) throw NotCertified{};
  if (numbers_ == Numbers::complex && base.ball.contains_zero()) throw NotCertified{};
  Ball result;
  if (order == 2)
    acb_sqrt(result.raw(), base.ball.raw(), bits_);
  else
    acb_root_ui(result.raw(), base.ball.raw(), order, bits_);
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::power(const ex& e) {
  const Value base = value(e.op(0));
  const Value exponent = value(e.op(1));
  if (GiNaC::is_a<GiNaC::numeric>(e.op(1)) && exponent.exact) {
    const cln::cl_RA& number = *exponent.exact;
    if (cln::denominator(number) == 1) return whole_power(base, cln::numerator(number));
    if (cln::integer_length(cln::denominator(number)) > 30) throw NotCertified{};
    return whole_power(root(base, machine_word(cln::denominator(number))), cln::numerator(number));
  }
  // exp(exponent * log(base)), as everywhere in this program.
  if (numbers_ == Numbers::real && certain_sign(base) <= 0) throw NotCertified{};
  if (base.ball.contains_zero()) throw NotCertified{};
  Ball result;
  acb_pow(result.raw(), base.ball.raw(), exponent.ball.raw(), bits_);
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::angle_of(const Value& y, const Value& x) {
  if (!y.ball.is_real() || !x.ball.is_real()) throw NotCertified{};
  const bool y_is_zero = y.exact && cln::zerop(*y.exact);
  if (y_is_zero) {
    const int side = certain_sign(x);
    if (side == 0) throw NotCertified{};
    if (side > 0) return number(0);
    smooth_ = false;
    Ball pi;
    acb_const_pi(pi.raw(), bits_);
    return {std::nullopt, std::move(pi)};
  }
  // Away from the cut, so that the ball is that of one branch.
  const bool right = x.ball.sign() == 1;
  if (!right && !y.ball.sign()) throw NotCertified{};
  Ball result;
  arb_atan2(acb_realref(result.raw()), acb_realref(y.ball.raw()), acb_realref(x.ball.raw()), bits_);
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::function(const GiNaC::function& f) {
  const std::string name = f.get_name();
  const Value v = value(f.op(0));
  if (name == "atan2") return angle_of(v, Value(value(f.op(1))));
  const bool zero = v.exact && cln::zerop(*v.exact);
  Ball result;
  if (name == "sin") {
    if (zero) return number(0);
    acb_sin(result.raw(), v.ball.raw(), bits_);
  } else if (name == "cos") {
    if (zero) return number(1);
    acb_cos(result.raw(), v.ball.raw(), bits_);
  } else if (name == "tan") {
    if (zero) return number(0);
    acb_cos(result.raw(), v.ball.raw(), bits_);
    if (result.contains_zero()) throw NotCertified{};
    acb_tan(result.raw(), v.ball.raw(), bits_);
  } else if (name == "exp") {
    if (zero) return number(1);
    acb_exp(result.raw(), v.ball.raw(), bits_);
  } else if (name == "sinh") {
    if (zero) return number(0);
    acb_sinh(result.raw(), v.ball.raw(), bits_);
  } else if (name == "cosh") {
    if (zero) return number(1);
    acb_cosh(result.raw(), v.ball.raw(), bits_);
  } else if (name == "tanh") {
    if (zero) return number(0);
    acb_cosh(result.raw(), v.ball.raw(), bits_);
    if (result.contains_zero()) throw NotCertified{};
    acb_tanh(result.raw(), v.ball.raw(), bits_);
  } else if (name == "log") {
    if (v.exact && *v.exact == 1) return number(0);
    if (numbers_ == Numbers::real && certain_sign(v) <= 0) throw NotCertified{};
    if (v.ball.contains_zero()) throw NotCertified{};
    acb_log(result.raw(), v.ball.raw(), bits_);
  } else if (name == "atan") {
    if (zero) return number(0);
    acb_atan(result.raw(), v.ball.raw(), bits_);
  } else if (name == "asin" || name == "acos") {
    const bool sine = name == "asin";
    if (v.exact && cln::abs(*v.exact) == 1) smooth_ = false;
    if (sine && zero) return number(0);
    if (v.exact && *v.exact == 1 && !sine) return number(0);
    if (numbers_ == Numbers::real) {
      // An argument that is exactly 1 or -1 has a value; a ball around it leaves that open.
      if (v.exact && cln::abs(*v.exact) > 1) throw NotCertified{};
      if (!v.exact) {
        Ball room;  // 1 - v^2
        acb_mul(room.raw(), v.ball.raw(), v.ball.raw(), bits_);
        acb_sub_ui(room.raw(), room.raw(), 1, bits_);
        if (room.sign() != -1) throw NotCertified{};
      }
    }
    if (sine)
      acb_asin(result.raw(), v.ball.raw(), bits_);
    else
      acb_acos(result.raw(), v.ball.raw(), bits_);
    if (numbers_ == Numbers::real) arb_zero(acb_imagref(result.raw()));
  } else {
    throw NotCertified{};
  }
  return checked(std::move(result));
}

}  // namespace casimir

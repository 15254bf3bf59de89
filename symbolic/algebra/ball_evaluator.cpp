#include "symbolic/algebra/ball_evaluator.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include "symbolic/algebra/elliptic_balls.hpp"
#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/expression/pairs.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Exact numbers that are longer become balls.
constexpr std::size_t kMaxExactBits = 4000;
/// The largest power of a number that is taken exactly.
constexpr long kMaxExactPower = 64;

const ex kOne = 1;

bool is_short(const cln::cl_RA& r) {
  return cln::integer_length(cln::numerator(r)) < kMaxExactBits &&
         cln::integer_length(cln::denominator(r)) < kMaxExactBits;
}

}  // namespace

BallEvaluator::Value BallEvaluator::number(const cln::cl_RA& exact) const {
  return is_short(exact) ? Value(exact, bits_) : Value(Ball(exact, bits_));
}

BallEvaluator::Value BallEvaluator::constant(const GiNaC::numeric& number) const {
  if (!number.is_crational()) throw NotCertified{};
  const auto real = cln::the<cln::cl_RA>(cln::realpart(number.to_cl_N()));
  if (number.is_real()) return this->number(real);
  const Ball imaginary(cln::the<cln::cl_RA>(cln::imagpart(number.to_cl_N())), bits_);
  Ball result(real, bits_);
  arb_set(acb_imagref(result.raw()), acb_realref(imaginary.raw()));
  return checked(std::move(result));
}

class BallEvaluator::Total {
 public:
  enum class Kind { sum, product };
  Total(const BallEvaluator& at, Kind kind)
      : at_(at), sum_(kind == Kind::sum), exact_(kind == Kind::sum ? 0 : 1) {}

  void take(const Value& v) {
    if (v.exact && cln::zerop(*v.exact)) {
      zero_ = zero_ || !sum_;
    } else if (v.exact) {
      exact_ = sum_ ? exact_ + *v.exact : exact_ * *v.exact;
    } else if (!ball_) {
      ball_ = v.ball();
    } else if (sum_) {
      acb_add(ball_->raw(), ball_->raw(), v.ball().raw(), at_.bits_);
    } else {
      acb_mul(ball_->raw(), ball_->raw(), v.ball().raw(), at_.bits_);
    }
  }

  Value value() {
    if (zero_) return at_.number(0);
    const Value exact = at_.number(exact_);
    if (!ball_) return exact;
    if (sum_)
      acb_add(ball_->raw(), ball_->raw(), exact.ball().raw(), at_.bits_);
    else
      acb_mul(ball_->raw(), ball_->raw(), exact.ball().raw(), at_.bits_);
    return at_.checked(std::move(*ball_));
  }

 private:
  const BallEvaluator& at_;
  bool sum_;
  bool zero_ = false;
  cln::cl_RA exact_;
  std::optional<Ball> ball_;
};

BallEvaluator::Value BallEvaluator::checked(Ball ball) const {
  if (!ball.is_finite() || (numbers_ == Numbers::real && !ball.is_real())) throw NotCertified{};
  return Value(std::move(ball));
}

int BallEvaluator::certain_sign(const Value& v) const {
  if (v.exact) return cln::minusp(*v.exact) ? -1 : cln::zerop(*v.exact) ? 0 : 1;
  const std::optional<int> sign = v.ball().sign();
  if (!sign) throw NotCertified{};
  return *sign;
}

void BallEvaluator::set(const GiNaC::symbol& symbol, const ex& exact) {
  known_.insert_or_assign(symbol, Value(value(exact)));
}

void BallEvaluator::set(const GiNaC::symbol& symbol, const Ball& ball) {
  known_.insert_or_assign(symbol, Value(ball));
}

const Ball& BallEvaluator::operator()(const ex& expression) { return value(expression).ball(); }

std::optional<cln::cl_RA> BallEvaluator::exact(const ex& expression) {
  return value(expression).exact;
}

std::optional<int> BallEvaluator::sign(const ex& expression) {
  const Value& v = value(expression);
  return v.exact ? certain_sign(v) : v.ball().sign();
}

const BallEvaluator::Value& BallEvaluator::value(const ex& e) {
  if (const auto it = known_.find(e); it != known_.end()) return it->second;
  return known_.emplace(e, evaluate(e)).first->second;
}

BallEvaluator::Value BallEvaluator::evaluate(const ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return constant(GiNaC::ex_to<GiNaC::numeric>(e));
  if (GiNaC::is_a<GiNaC::add>(e)) return sum(e);
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
  if (GiNaC::is_a<GiNaC::power>(e)) return power(value(e.op(0)), e.op(1));
  if (GiNaC::is_a<GiNaC::function>(e)) return function(GiNaC::ex_to<GiNaC::function>(e));
  if (e.is_equal(GiNaC::Pi)) {
    Ball pi;
    acb_const_pi(pi.raw(), bits_);
    return Value(std::move(pi));
  }
  throw NotCertified{};  // a symbol without a value, for one
}

BallEvaluator::Value BallEvaluator::sum(const ex& e) {
  Total total(*this, Total::Kind::sum);
  total.take(constant(GiNaC::ex_to<GiNaC::numeric>(Pairs::number(e))));
  for (const GiNaC::expair& pair : Pairs::of(e)) {
    const Value& rest = value(pair.rest);
    if (pair.coeff.is_equal(kOne)) {
      total.take(rest);
      continue;
    }
    Total term(*this, Total::Kind::product);
    term.take(rest);
    term.take(constant(GiNaC::ex_to<GiNaC::numeric>(pair.coeff)));
    total.take(term.value());
  }
  return total.value();
}

BallEvaluator::Value BallEvaluator::product(const ex& e) {
  Total total(*this, Total::Kind::product);
  total.take(constant(GiNaC::ex_to<GiNaC::numeric>(Pairs::number(e))));
  for (const GiNaC::expair& pair : Pairs::of(e)) {
    const Value& rest = value(pair.rest);
    if (pair.coeff.is_equal(kOne))
      total.take(rest);
    else
      total.take(power(rest, pair.coeff));
  }
  return total.value();
}

BallEvaluator::Value BallEvaluator::whole_power(const Value& base,
                                                const cln::cl_I& exponent) const {
  const bool negative = cln::minusp(exponent);
  if (negative) {
    const bool zero = base.exact ? cln::zerop(*base.exact) : base.ball().contains_zero();
    if (zero) throw NotCertified{};
  }
  if (base.exact && cln::abs(exponent) <= kMaxExactPower) {
    const cln::cl_RA power = cln::expt(*base.exact, exponent);
    if (is_short(power)) return number(power);
  }
  if (cln::integer_length(exponent) > 40) throw NotCertified{};
  Ball result;
  acb_pow_si(result.raw(), base.ball().raw(), cln::cl_I_to_long(exponent), bits_);
  return checked(std::move(result));
}

/// The principal root; of real numbers a real one, of those that are not negative.
BallEvaluator::Value BallEvaluator::root(const Value& base, unsigned long order) {
  if (base.exact ? cln::zerop(*base.exact) : base.ball().contains_zero()) smooth_ = false;
  if (base.exact && !cln::minusp(*base.exact)) {
    cln::cl_RA result;
    if (order <= 64 && cln::rootp(*base.exact, static_cast<unsigned>(order), &result))
      return number(result);
  }
  if (numbers_ == Numbers::real && certain_sign(base) < 0) throw NotCertified{};
  if (numbers_ == Numbers::complex && base.ball().contains_zero()) throw NotCertified{};
  Ball result;
  if (order == 2)
    acb_sqrt(result.raw(), base.ball().raw(), bits_);
  else
    acb_root_ui(result.raw(), base.ball().raw(), order, bits_);
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::power(const Value& base, const ex& exponent_of) {
  const Value exponent = value(exponent_of);
  if (GiNaC::is_a<GiNaC::numeric>(exponent_of) && exponent.exact) {
    const cln::cl_RA& number = *exponent.exact;
    if (cln::denominator(number) == 1) return whole_power(base, cln::numerator(number));
    if (cln::integer_length(cln::denominator(number)) > 30) throw NotCertified{};
    return whole_power(root(base, machine_word(cln::denominator(number))), cln::numerator(number));
  }
  // exp(exponent * log(base)), as everywhere in this program.
  if (numbers_ == Numbers::real && certain_sign(base) <= 0) throw NotCertified{};
  if (base.ball().contains_zero()) throw NotCertified{};
  Ball result;
  acb_pow(result.raw(), base.ball().raw(), exponent.ball().raw(), bits_);
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::angle_of(const Value& y, const Value& x) {
  if (!y.ball().is_real() || !x.ball().is_real()) throw NotCertified{};
  const bool y_is_zero = y.exact && cln::zerop(*y.exact);
  if (y_is_zero) {
    const int side = certain_sign(x);
    if (side == 0) throw NotCertified{};
    if (side > 0) return number(0);
    smooth_ = false;
    Ball pi;
    acb_const_pi(pi.raw(), bits_);
    return Value(std::move(pi));
  }
  // Away from the cut, so that the ball is that of one branch.
  const bool right = x.ball().sign() == 1;
  if (!right && !y.ball().sign()) throw NotCertified{};
  Ball result;
  arb_atan2(acb_realref(result.raw()), acb_realref(y.ball().raw()), acb_realref(x.ball().raw()),
            bits_);
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::elliptic(const GiNaC::function& f) {
  std::vector<Value> arguments;
  for (std::size_t i = 0; i < f.nops(); ++i) arguments.push_back(value(f.op(i)));
  std::vector<acb_srcptr> balls;
  for (const Value& argument : arguments) balls.push_back(argument.ball().raw());
  Ball result;
  if (!elliptic_ball(f.get_name(), result.raw(), balls, bits_)) throw NotCertified{};
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::arc_of(const Value& v, bool sine) {
  if (v.exact && cln::abs(*v.exact) == 1) smooth_ = false;
  if (sine && v.exact && cln::zerop(*v.exact)) return number(0);
  if (!sine && v.exact && *v.exact == 1) return number(0);
  if (numbers_ == Numbers::real) {
    // An argument that is exactly 1 or -1 has a value; a ball around it leaves that open.
    if (v.exact && cln::abs(*v.exact) > 1) throw NotCertified{};
    if (!v.exact) {
      Ball room;  // v^2 - 1
      acb_mul(room.raw(), v.ball().raw(), v.ball().raw(), bits_);
      acb_sub_ui(room.raw(), room.raw(), 1, bits_);
      if (room.sign() != -1) throw NotCertified{};
    }
  }
  Ball result;
  if (sine)
    acb_asin(result.raw(), v.ball().raw(), bits_);
  else
    acb_acos(result.raw(), v.ball().raw(), bits_);
  if (numbers_ == Numbers::real) arb_zero(acb_imagref(result.raw()));
  return checked(std::move(result));
}

BallEvaluator::Value BallEvaluator::function(const GiNaC::function& f) {
  const std::string name = f.get_name();
  if (is_elliptic_function(f)) return elliptic(f);
  const Value v = value(f.op(0));
  if (name == "atan2") return angle_of(v, Value(value(f.op(1))));
  const bool zero = v.exact && cln::zerop(*v.exact);
  Ball result;
  if (name == "sin") {
    if (zero) return number(0);
    acb_sin(result.raw(), v.ball().raw(), bits_);
  } else if (name == "cos") {
    if (zero) return number(1);
    acb_cos(result.raw(), v.ball().raw(), bits_);
  } else if (name == "tan") {
    if (zero) return number(0);
    acb_cos(result.raw(), v.ball().raw(), bits_);
    if (result.contains_zero()) throw NotCertified{};
    acb_tan(result.raw(), v.ball().raw(), bits_);
  } else if (name == "exp") {
    if (zero) return number(1);
    acb_exp(result.raw(), v.ball().raw(), bits_);
  } else if (name == "sinh") {
    if (zero) return number(0);
    acb_sinh(result.raw(), v.ball().raw(), bits_);
  } else if (name == "cosh") {
    if (zero) return number(1);
    acb_cosh(result.raw(), v.ball().raw(), bits_);
  } else if (name == "tanh") {
    if (zero) return number(0);
    acb_cosh(result.raw(), v.ball().raw(), bits_);
    if (result.contains_zero()) throw NotCertified{};
    acb_tanh(result.raw(), v.ball().raw(), bits_);
  } else if (name == "log") {
    if (v.exact && *v.exact == 1) return number(0);
    if (numbers_ == Numbers::real && certain_sign(v) <= 0) throw NotCertified{};
    if (v.ball().contains_zero()) throw NotCertified{};
    acb_log(result.raw(), v.ball().raw(), bits_);
  } else if (name == "atan") {
    if (zero) return number(0);
    acb_atan(result.raw(), v.ball().raw(), bits_);
  } else if (name == "asin" || name == "acos") {
    return arc_of(v, name == "asin");
  } else {
    throw NotCertified{};
  }
  return checked(std::move(result));
}

}  // namespace casimir

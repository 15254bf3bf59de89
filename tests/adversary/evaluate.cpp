#include "tests/adversary/evaluate.hpp"

namespace casimir::adversary {
namespace {

using Unary = void (*)(acb_ptr, acb_srcptr, slong);

Ball apply(Unary f, const Ball& a) {
  Ball result;
  f(result.get(), a.get(), Ball::kBits);
  return result;
}

class Evaluator {
 public:
  Evaluator(const Point& point, const std::vector<std::string>& along, bool real)
      : point_(point), along_(along), real_(real) {}

  Dual operator()(const Expr& e) const {
    Dual result = plain(e.node());
    if (!result.value.is_finite()) throw Unknown();
    if (real_ && !result.value.is_real()) throw NotReal();
    return result;
  }

 private:
  Dual constant(Ball ball) const { return {std::move(ball), std::vector<Ball>(along_.size())}; }

  Dual plain(const Node& n) const {
    switch (n.op) {
      case Op::number:
        return constant(Ball::ratio(n.numerator, n.denominator));
      case Op::pi: {
        Ball ball;
        acb_const_pi(ball.get(), Ball::kBits);
        return constant(std::move(ball));
      }
      case Op::imaginary: {
        Ball ball;
        acb_onei(ball.get());
        return constant(std::move(ball));
      }
      case Op::symbol:
        return symbol(n.name);
      case Op::add:
        return sum((*this)(n.arguments[0]), (*this)(n.arguments[1]));
      case Op::mul:
        return product((*this)(n.arguments[0]), (*this)(n.arguments[1]));
      case Op::power:
        return power(n);
      case Op::function:
        return n.name == "atan2" ? angle((*this)(n.arguments[0]), (*this)(n.arguments[1]))
                                 : function(n.name, (*this)(n.arguments[0]));
    }
    throw Unknown();
  }

  Dual symbol(const std::string& name) const {
    const auto it = point_.find(name);
    if (it == point_.end()) throw std::logic_error("no value of " + name);
    Dual result = constant(it->second);
    for (std::size_t i = 0; i < along_.size(); ++i) {
      if (along_[i] == name) result.slope[i] = Ball(1);
    }
    return result;
  }

  static Dual sum(Dual a, const Dual& b) {
    a.value = a.value + b.value;
    for (std::size_t i = 0; i < a.slope.size(); ++i) a.slope[i] = a.slope[i] + b.slope[i];
    return a;
  }

  static Dual product(const Dual& a, const Dual& b) {
    Dual result{a.value * b.value, {}};
    for (std::size_t i = 0; i < a.slope.size(); ++i)
      result.slope.push_back(a.slope[i] * b.value + a.value * b.slope[i]);
    return result;
  }

  /// f(a), where f has this value and this derivative. A derivative that has no value matters only
  /// if a varies.
  static Dual chain(Ball value, const Ball& derivative, const Dual& a) {
    Dual result{std::move(value), {}};
    for (const Ball& slope : a.slope) {
      if (!slope.is_exact_zero() && !derivative.is_finite()) throw Unknown();
      result.slope.push_back(slope.is_exact_zero() ? Ball() : derivative * slope);
    }
    return result;
  }

  Dual power(const Node& n) const {
    const Dual base = (*this)(n.arguments[0]);
    const Node& exponent = n.arguments[1].node();
    if (exponent.op == Op::number && exponent.denominator == 1)
      return integer_power(base, exponent.numerator);
    if (exponent.op == Op::number) {
      const Ball radicand = checked_root(base.value);
      const Ball k = Ball::ratio(exponent.numerator, exponent.denominator);
      const Ball less = k - Ball(1);
      Ball value, slope;
      acb_pow(value.get(), radicand.get(), k.get(), Ball::kBits);
      acb_pow(slope.get(), radicand.get(), less.get(), Ball::kBits);
      return chain(value, k * slope, base);
    }
    check_positive(base.value);
    const Dual logarithm = chain(apply(acb_log, base.value), Ball(1) / base.value, base);
    const Dual product_of = product((*this)(n.arguments[1]), logarithm);
    const Ball value = apply(acb_exp, product_of.value);
    return chain(value, value, product_of);
  }

  Dual integer_power(const Dual& base, long k) const {
    if (k < 0 && !base.value.is_nonzero()) no_value(base.value);
    Ball value, derivative;
    acb_pow_si(value.get(), base.value.get(), k, Ball::kBits);
    if (k != 0) {
      acb_pow_si(derivative.get(), base.value.get(), k - 1, Ball::kBits);
      derivative = derivative * Ball(k);
    }
    return chain(value, derivative, base);
  }

  /// A radicand that is zero as far as 60 digits can tell is zero: x - y/3 at x = y/3 is a ball, of
  /// which one half has no real root.
  Ball checked_root(const Ball& a) const {
    if (!real_ || a.is_positive()) return a;
    if (a.is_negative()) throw NotReal();
    if (!a.is_tiny()) throw Unknown();
    return Ball();
  }

  /// Of 1/a or log(a), where `a` may be zero: a claim says nothing where it certainly is.
  [[noreturn]] void no_value(const Ball& a) const {
    if (real_ && a.is_tiny()) throw NotReal();
    throw Unknown();
  }

  void check_positive(const Ball& a) const {
    if (checked_root(a).is_nonzero()) return;
    no_value(a);
  }

  /// Between -1 and 1; at the ends, as far as 60 digits can tell, exactly these.
  Ball checked_sine(const Ball& a) const {
    if (!real_) return a;
    const Ball room = Ball(1) - a * a;
    if (room.is_positive()) return a;
    if (room.is_negative()) throw NotReal();
    if (!room.is_tiny()) throw Unknown();
    return Ball(a.is_positive() ? 1 : -1);
  }

  Dual function(const std::string& name, const Dual& a) const {
    const Ball& x = a.value;
    if (name == "sqrt") {
      const Ball root = apply(acb_sqrt, checked_root(x));
      return chain(root, Ball(1) / (Ball(2) * root), a);
    }
    if (name == "sin") return chain(apply(acb_sin, x), apply(acb_cos, x), a);
    if (name == "cos") return chain(apply(acb_cos, x), Ball(-1) * apply(acb_sin, x), a);
    if (name == "tan") {
      const Ball t = apply(acb_tan, x);
      return chain(t, Ball(1) + t * t, a);
    }
    if (name == "exp") {
      const Ball e = apply(acb_exp, x);
      return chain(e, e, a);
    }
    if (name == "sinh") return chain(apply(acb_sinh, x), apply(acb_cosh, x), a);
    if (name == "cosh") return chain(apply(acb_cosh, x), apply(acb_sinh, x), a);
    if (name == "tanh") {
      const Ball t = apply(acb_tanh, x);
      return chain(t, Ball(1) - t * t, a);
    }
    if (name == "log") {
      check_positive(x);
      return chain(apply(acb_log, x), Ball(1) / x, a);
    }
    if (name == "atan") return chain(apply(acb_atan, x), Ball(1) / (Ball(1) + x * x), a);
    const Ball sine = checked_sine(x);
    const Ball slope = Ball(1) / apply(acb_sqrt, Ball(1) - sine * sine);
    if (name == "asin") return chain(apply(acb_asin, sine), slope, a);
    if (name == "acos") return chain(apply(acb_acos, sine), Ball(-1) * slope, a);
    throw std::logic_error("no function " + name);
  }

  static Dual angle(const Dual& y, const Dual& x) {
    if (!y.value.is_real() || !x.value.is_real()) throw Unknown();
    const Ball square = x.value * x.value + y.value * y.value;
    if (!square.is_nonzero()) throw Unknown();
    Dual result;
    arb_atan2(acb_realref(result.value.get()), y.value.real(), x.value.real(), Ball::kBits);
    for (std::size_t i = 0; i < y.slope.size(); ++i)
      result.slope.push_back((x.value * y.slope[i] - y.value * x.slope[i]) / square);
    return result;
  }

  const Point& point_;
  const std::vector<std::string>& along_;
  bool real_;
};

}  // namespace

Dual evaluate(const Expr& e, const Point& point, const std::vector<std::string>& along, bool real) {
  return Evaluator(point, along, real)(e);
}

Ball value(const Expr& e, const Point& point, bool real) {
  return evaluate(e, point, {}, real).value;
}

}  // namespace casimir::adversary

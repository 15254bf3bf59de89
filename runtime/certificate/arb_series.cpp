#include "runtime/certificate/arb_series.hpp"

#include <stdexcept>

#include "runtime/program/operation.hpp"

namespace casimir::certificate {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// result = sum over j = from..to of u_j v_{k-j}
void convolve(ArbBall& result, const Vector& u, const Vector& v, int k, int from, int to,
              slong bits) {
  arb_zero(result.raw());
  if (to < from) return;
  arb_dot(result.raw(), nullptr, 0, u[at(from)].raw(), 1, v[at(k - from)].raw(), -1, to - from + 1,
          bits);
}

/// result = sum over j = from..to of j u_j v_{k-j}
void convolve_weighted(ArbBall& result, const Vector& u, const Vector& v, int k, int from, int to,
                       slong bits) {
  arb_zero(result.raw());
  ArbBall part;
  for (int j = from; j <= to; ++j) {
    arb_mul_si(part.raw(), u[at(j)].raw(), j, bits);
    arb_addmul(result.raw(), part.raw(), v[at(k - j)].raw(), bits);
  }
}

bool has_two_operands(const Instruction& line) { return line.b >= 0; }

bool has_helper(Op op) {
  switch (op) {
    case Op::sin:
    case Op::cos:
    case Op::sinh:
    case Op::cosh:
    case Op::tan:
    case Op::tanh:
    case Op::asin:
    case Op::acos:
    case Op::atan2:
      return true;
    default:
      return false;
  }
}

/// The function whose series goes with that of another one.
Op partner_of(Op op) {
  switch (op) {
    case Op::sin:
      return Op::cos;
    case Op::cos:
      return Op::sin;
    case Op::sinh:
      return Op::cosh;
    default:
      return Op::sinh;
  }
}

}  // namespace

ArbSeries::ArbSeries(const Program& program, int order, slong bits)
    : program_(program), order_(order), bits_(bits) {
  const Vector empty(at(order) + 1);
  states_.assign(program.outputs.size(), empty);
  lines_.assign(program.code.size(), empty);
  helper_.resize(program.code.size());
  root_.resize(program.code.size());
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& line = program.code[i];
    if (is_literal(line)) {
      constant_.push_back(true);
    } else if (line.op == Op::input) {
      constant_.push_back(false);
    } else {
      constant_.push_back(constant_[at(line.a)] &&
                          (!has_two_operands(line) || constant_[at(line.b)]));
    }
    if (has_helper(line.op)) helper_[i] = empty;
    if (line.op == Op::asin || line.op == Op::acos) root_[i] = empty;
  }
}

void ArbSeries::expand(const ArbBall& time, const Vector& states, bool forwards, int order) {
  const validated::BallPrecision precision(bits_);
  for (std::size_t i = 0; i < states_.size(); ++i) states_[i][0] = states[i];
  for (std::size_t i = 0; i < lines_.size(); ++i)
    if (!constant_[i] || !constants_known_) begin(i, time);
  constants_known_ = true;
  for (int k = 0;; ++k) {
    if (k > 0)
      for (std::size_t i = 0; i < lines_.size(); ++i)
        if (!constant_[i]) extend(i, k, forwards);
    if (k == order) return;
    // (k + 1) x_{k+1} = +- rate_k
    // A product costs a third of a quotient, so the quotient is made once an order.
    ArbBall share(1.);
    arb_div_si(share.raw(), share.raw(), forwards ? k + 1 : -(k + 1), bits_);
    for (std::size_t i = 0; i < states_.size(); ++i)
      arb_mul(states_[i][at(k) + 1].raw(), lines_[at(program_.outputs[i])][at(k)].raw(),
              share.raw(), bits_);
    if (k + 1 == order) return;
  }
}

void ArbSeries::begin(std::size_t i, const ArbBall& time) {
  const Instruction& line = program_.code[i];
  const Arithmetic<ArbBall> arithmetic;
  Vector& y = lines_[i];
  if (line.op == Op::input) {
    y[0] = at(line.a) < states_.size() ? states_[at(line.a)][0] : time;
    return;
  }
  if (is_literal(line)) {
    y[0] = literal_value(program_, line, arithmetic);
    return;
  }
  const ArbBall& a = lines_[at(line.a)][0];
  const ArbBall& b = has_two_operands(line) ? lines_[at(line.b)][0] : a;
  y[0] = applied(line.op, a, b, arithmetic);
  if (constant_[i] || !has_helper(line.op)) return;
  const ArbBall one(1.);
  switch (line.op) {
    case Op::tan:
      helper_[i][0] = one + y[0] * y[0];
      break;
    case Op::tanh:
      helper_[i][0] = one - y[0] * y[0];
      break;
    case Op::asin:
    case Op::acos:
      helper_[i][0] = one - a * a;
      root_[i][0] = Arithmetic<ArbBall>::sqrt(helper_[i][0]);
      break;
    case Op::atan2:
      helper_[i][0] = a * a + b * b;
      if (arb_is_positive(helper_[i][0].raw()) == 0) throw std::domain_error("angle of the origin");
      break;
    default:
      helper_[i][0] = Arithmetic<ArbBall>::function(partner_of(line.op), a);
  }
}

void ArbSeries::extend_input(std::size_t i, int k, bool forwards) {
  const Instruction& line = program_.code[i];
  if (at(line.a) < states_.size())
    lines_[i][at(k)] = states_[at(line.a)][at(k)];
  else
    lines_[i][at(k)] = ArbBall(k > 1 ? 0. : forwards ? 1. : -1.);
}

void ArbSeries::extend(std::size_t i, int k, bool forwards) {
  const Instruction& line = program_.code[i];
  if (line.op == Op::input) return extend_input(i, k, forwards);
  const Vector& a = lines_[at(line.a)];
  const Vector& b = has_two_operands(line) ? lines_[at(line.b)] : a;
  ArbBall& next = lines_[i][at(k)];
  switch (line.op) {
    case Op::add:
      arb_add(next.raw(), a[at(k)].raw(), b[at(k)].raw(), bits_);
      break;
    case Op::sub:
      arb_sub(next.raw(), a[at(k)].raw(), b[at(k)].raw(), bits_);
      break;
    case Op::neg:
      arb_neg(next.raw(), a[at(k)].raw());
      break;
    case Op::mul:
      if (constant_[at(line.a)])
        arb_mul(next.raw(), a[0].raw(), b[at(k)].raw(), bits_);
      else if (constant_[at(line.b)])
        arb_mul(next.raw(), a[at(k)].raw(), b[0].raw(), bits_);
      else
        convolve(next, a, b, k, 0, k, bits_);
      break;
    case Op::div:  // b y = a
      convolve(sum_, b, lines_[i], k, 1, constant_[at(line.b)] ? 0 : k, bits_);
      next = (a[at(k)] - sum_) / b[0];
      break;
    default:
      extend_function(i, k);
  }
}

void ArbSeries::extend_function(std::size_t i, int k) {
  const Instruction& line = program_.code[i];
  const Vector& a = lines_[at(line.a)];
  Vector &y = lines_[i], &w = helper_[i];
  const ArbBall by(static_cast<double>(k));
  switch (line.op) {
    case Op::sqrt:  // y y = a
      convolve(sum_, y, y, k, 1, k - 1, bits_);
      y[at(k)] = (a[at(k)] - sum_) / (y[0] + y[0]);
      break;
    case Op::exp:  // y' = y a'
      convolve_weighted(sum_, a, y, k, 1, k, bits_);
      y[at(k)] = sum_ / by;
      break;
    case Op::log:  // a y' = a'
      convolve_weighted(sum_, y, a, k, 1, k - 1, bits_);
      y[at(k)] = (by * a[at(k)] - sum_) / (by * a[0]);
      break;
    case Op::pow: {  // a y' = e y a'
      convolve_weighted(sum_, a, y, k, 1, k, bits_);
      const ArbBall first = lines_[at(line.b)][0] * sum_;
      convolve_weighted(sum_, y, a, k, 1, k - 1, bits_);
      y[at(k)] = (first - sum_) / (by * a[0]);
      break;
    }
    case Op::sin:
    case Op::sinh:  // y' = w a', w' = -+ y a'
    case Op::cos:   // y' = - w a', w' = y a'
    case Op::cosh:
      convolve_weighted(sum_, a, w, k, 1, k, bits_);
      y[at(k)] = (line.op == Op::cos ? -sum_ : sum_) / by;
      convolve_weighted(sum_, a, y, k, 1, k, bits_);
      w[at(k)] = (line.op == Op::sin ? -sum_ : sum_) / by;
      break;
    case Op::tan:
    case Op::tanh:  // y' = w a', w = 1 +- y y
      convolve_weighted(sum_, a, w, k, 1, k, bits_);
      y[at(k)] = sum_ / by;
      convolve(sum_, y, y, k, 0, k, bits_);
      w[at(k)] = line.op == Op::tanh ? -sum_ : sum_;
      break;
    case Op::asin:
    case Op::acos:
      extend_arc(i, k);
      break;
    case Op::atan2:
      extend_angle(i, k);
      break;
    case Op::abs:  // its argument has one sign
      y[at(k)] = Arithmetic<ArbBall>::sign(a[0]) < 0 ? -a[at(k)] : a[at(k)];
      break;
    case Op::sign:
      y[at(k)] = ArbBall();
      break;
    default:
      throw std::domain_error("an operation that has no series");
  }
}

/// v y' = +- a' with v = sqrt(w), w = 1 - a a
void ArbSeries::extend_arc(std::size_t i, int k) {
  const Instruction& line = program_.code[i];
  const Vector& a = lines_[at(line.a)];
  Vector &y = lines_[i], &w = helper_[i], &v = root_[i];
  const ArbBall by(static_cast<double>(k));
  convolve(sum_, a, a, k, 0, k, bits_);
  w[at(k)] = -sum_;
  convolve(sum_, v, v, k, 1, k - 1, bits_);
  v[at(k)] = (w[at(k)] - sum_) / (v[0] + v[0]);
  convolve_weighted(sum_, y, v, k, 1, k - 1, bits_);
  const ArbBall rate = by * a[at(k)];
  y[at(k)] = ((line.op == Op::acos ? -rate : rate) - sum_) / (by * v[0]);
}

/// w y' = b a' - a b' with w = a a + b b, for the angle y of the point (b, a)
void ArbSeries::extend_angle(std::size_t i, int k) {
  const Instruction& line = program_.code[i];
  const Vector &a = lines_[at(line.a)], &b = lines_[at(line.b)];
  Vector &y = lines_[i], &w = helper_[i];
  convolve(sum_, a, a, k, 0, k, bits_);
  w[at(k)] = sum_;
  convolve(sum_, b, b, k, 0, k, bits_);
  w[at(k)] = w[at(k)] + sum_;
  convolve_weighted(sum_, a, b, k, 1, k, bits_);
  ArbBall right = sum_;
  convolve_weighted(sum_, b, a, k, 1, k, bits_);
  right = right - sum_;
  convolve_weighted(sum_, y, w, k, 1, k - 1, bits_);
  y[at(k)] = (right - sum_) / (ArbBall(static_cast<double>(k)) * w[0]);
}

}  // namespace casimir::certificate

#pragma once

#include <arb.h>

#include <vector>

#include "runtime/program/number.hpp"
#include "runtime/validated/linear.hpp"
#include "runtime/validated/mid_rad.hpp"

namespace casimir::validated {

/// A real number in a ball of Arb's (http://arblib.org), whose operations enclose by themselves,
/// at the precision of the thread: see `BallPrecision`.
class ArbBall {
 public:
  ArbBall() { arb_init(value_); }
  explicit ArbBall(double exact) : ArbBall() { arb_set_d(value_, exact); }
  explicit ArbBall(const MidRad& ball);
  explicit ArbBall(const cln::cl_RA& value);
  ArbBall(const ArbBall& other) : ArbBall() { arb_set(value_, other.value_); }
  ArbBall(ArbBall&& other) noexcept : ArbBall() { arb_swap(value_, other.value_); }
  ArbBall& operator=(const ArbBall& other) {
    arb_set(value_, other.value_);
    return *this;
  }
  ArbBall& operator=(ArbBall&& other) noexcept {
    arb_swap(value_, other.value_);
    return *this;
  }
  ~ArbBall() { arb_clear(value_); }

  static slong precision() { return bits; }
  static void set_precision(slong new_bits) { bits = new_bits; }

  arb_ptr raw() { return value_; }
  arb_srcptr raw() const { return value_; }

  friend ArbBall operator+(const ArbBall& a, const ArbBall& b) { return with(arb_add, a, b); }
  friend ArbBall operator-(const ArbBall& a, const ArbBall& b) { return with(arb_sub, a, b); }
  friend ArbBall operator*(const ArbBall& a, const ArbBall& b) { return with(arb_mul, a, b); }
  /// \throws std::domain_error  where b contains zero.
  friend ArbBall operator/(const ArbBall& a, const ArbBall& b);
  ArbBall operator-() const {
    ArbBall result;
    arb_neg(result.value_, value_);
    return result;
  }

 private:
  template <class Operation>
  static ArbBall with(Operation operation, const ArbBall& a, const ArbBall& b) {
    ArbBall result;
    operation(result.value_, a.value_, b.value_, bits);
    return result;
  }

  static thread_local slong bits;
  arb_t value_;
};

// Arb reads a vector of them in place.
static_assert(sizeof(ArbBall) == sizeof(arb_struct));

/// The precision of this thread's balls while the object lives.
class BallPrecision {
 public:
  explicit BallPrecision(slong bits) : before_(ArbBall::precision()) {
    ArbBall::set_precision(bits);
  }
  ~BallPrecision() { ArbBall::set_precision(before_); }
  BallPrecision(const BallPrecision&) = delete;
  BallPrecision& operator=(const BallPrecision&) = delete;

 private:
  slong before_;
};

template <>
inline ArbBall power_of_two<ArbBall>(int exponent) {
  ArbBall result(1.);
  arb_mul_2exp_si(result.raw(), result.raw(), exponent);
  return result;
}
bool is_exact(const ArbBall& a);
bool contains_zero(const ArbBall& a);
bool is_usable(const ArbBall& a);
ArbBall middle_of(const ArbBall& a);
double approximate(const ArbBall& a);
double magnitude(const ArbBall& a);
double log2_magnitude(const ArbBall& a);
double radius_of(const ArbBall& a);
ArbBall deviation_of(const ArbBall& a);
ArbBall symmetric(const ArbBall& a);
ArbBall from_zero_to(const ArbBall& a);
ArbBall widened(const ArbBall& a, const ArbBall& by);
bool intersect(ArbBall& a, const ArbBall& b);
bool contains(const ArbBall& b, const ArbBall& a);

/// The ball of doubles around one of Arb's, outwards. \throws std::domain_error  if not finite.
MidRad outwards(const ArbBall& ball);

/// A ball of the wanted kind around one of Arb's.
template <class Ball>
Ball ball_from(const ArbBall& ball);
template <>
inline MidRad ball_from<MidRad>(const ArbBall& ball) {
  return outwards(ball);
}
template <>
inline ArbBall ball_from<ArbBall>(const ArbBall& ball) {
  return ball;
}

/// In place, by Arb.
template <>
class ProductSums<ArbBall> {
 public:
  explicit ProductSums(std::size_t) {}
  void begin(const ArbBall& a) { a_ = a; }
  void begin(double a) { arb_set_d(a_.raw(), a); }
  void add(ArbBall& sum, const ArbBall& b) const {
    arb_addmul(sum.raw(), a_.raw(), b.raw(), ArbBall::precision());
  }
  void add(ArbBall& sum, double b) const { add(sum, ArbBall(b)); }
  void finish(ArbBall&) const {}

 private:
  ArbBall a_;
};

}  // namespace casimir::validated

namespace casimir {

/// As Arithmetic<MidRad>.
template <>
struct Arithmetic<validated::ArbBall> {
  using N = validated::ArbBall;
  using Series = std::vector<N>;

  static N from(const cln::cl_RA& value) { return N(value); }
  static N pi();
  static N divide(const N& a, const N& b) { return a / b; }
  static N sqrt(const N& a);
  static N power(const N& a, const N& e);
  static N function(Op op, const N& a);
  static N log(const N& a);
  static N asin(const N& a);
  static N acos(const N& a);
  static N atan2(const N& y, const N& x);
  static int sign(const N& a);

  static N convolution(const Series& u, const Series& v, int k, int from, int to);
  static N weighted(const Series& u, const Series& v, int k, int from, int to);
  static void begin_order(int) {}
};

}  // namespace casimir

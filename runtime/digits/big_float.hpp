#pragma once

#include <arb.h>
#include <cln/real.h>

#include <functional>
#include <utility>
#include <vector>

#include "runtime/program/number.hpp"

namespace casimir {

/// A floating-point number of any length on Arb's (http://arblib.org), whose scalar products make
/// long Taylor recurrences several times faster than CLN's numbers do. Exponents have no bounds.
///
/// Results of operations are rounded to the precision of the thread, see `Precision`.
class BigFloat {
 public:
  BigFloat() { arb_init(&value_); }
  BigFloat(const BigFloat& other) : BigFloat() { arf_set(mid(), other.mid()); }
  BigFloat(BigFloat&& other) noexcept : BigFloat() { arb_swap(&value_, &other.value_); }
  BigFloat& operator=(const BigFloat& other) {
    arf_set(mid(), other.mid());
    return *this;
  }
  BigFloat& operator=(BigFloat&& other) noexcept {
    arb_swap(&value_, &other.value_);
    return *this;
  }
  ~BigFloat() { arb_clear(&value_); }

  /// Rounded to the precision of the thread.
  explicit BigFloat(const cln::cl_R& exact);

  /// The same number.
  cln::cl_RA rational() const;

  /// log2 |x| as a double, -infinity for zero.
  double log2() const;

  bool is_zero() const { return arf_is_zero(mid()) != 0; }
  int sign() const { return arf_sgn(mid()); }
  bool finite() const { return arf_is_finite(mid()) != 0; }

  friend BigFloat operator+(const BigFloat& a, const BigFloat& b) { return with(arf_add, a, b); }
  friend BigFloat operator-(const BigFloat& a, const BigFloat& b) { return with(arf_sub, a, b); }
  friend BigFloat operator*(const BigFloat& a, const BigFloat& b) {
    BigFloat result;
    arf_mul(result.mid(), a.mid(), b.mid(), bits, ARF_RND_DOWN);
    return result;
  }
  friend BigFloat operator/(const BigFloat& a, const BigFloat& b) { return with(arf_div, a, b); }
  BigFloat operator-() const {
    BigFloat result;
    arf_neg_round(result.mid(), mid(), precision(), ARF_RND_DOWN);
    return result;
  }
  friend bool operator==(const BigFloat& a, const BigFloat& b) {
    return arf_equal(a.mid(), b.mid()) != 0;
  }
  friend bool operator<(const BigFloat& a, const BigFloat& b) {
    return arf_cmp(a.mid(), b.mid()) < 0;
  }

  static slong precision() { return bits; }
  static void set_precision(slong new_bits) { bits = new_bits; }

  /// Arb's own; the radius stays zero.
  arf_ptr mid() { return arb_midref(&value_); }
  arf_srcptr mid() const { return arb_midref(&value_); }
  arb_ptr ball() { return &value_; }
  arb_srcptr ball() const { return &value_; }

 private:
  template <class Operation>
  static BigFloat with(Operation operation, const BigFloat& a, const BigFloat& b) {
    BigFloat result;
    operation(result.mid(), a.mid(), b.mid(), bits, ARF_RND_DOWN);
    return result;
  }

  static thread_local slong bits;
  arb_struct value_;
};

// Arb reads a vector of them in place.
static_assert(sizeof(BigFloat) == sizeof(arb_struct));

/// The precision of this thread while the object lives.
class Precision {
 public:
  explicit Precision(slong bits) : before_(BigFloat::precision()) { BigFloat::set_precision(bits); }
  ~Precision() { BigFloat::set_precision(before_); }
  Precision(const Precision&) = delete;
  Precision& operator=(const Precision&) = delete;

 private:
  slong before_;
};

/// The elementary functions at the precision of the thread. For Taylor series it shortens the
/// numbers from order to order: a coefficient that the step makes small needs fewer digits.
template <>
struct Arithmetic<BigFloat> {
  using N = BigFloat;
  using Series = std::vector<BigFloat>;

  static N from(const cln::cl_RA& value) { return N(value); }
  static N from(const cln::cl_R& value) { return N(value); }
  static N pi();
  static N divide(const N& a, const N& b);
  static N sqrt(const N& a);
  static N power(const N& a, const N& e);
  static N function(Op op, const N& a);
  static N log(const N& a);
  static N asin(const N& a);
  static N acos(const N& a);
  static N atan2(const N& y, const N& x);
  static int sign(const N& a) { return a.sign(); }

  /// What TaylorJet takes in the place of its own loops, where an arithmetic has them:
  /// sum over j = from..to of u_j v_{k-j} ..
  static N convolution(const Series& u, const Series& v, int k, int from, int to);
  /// .. and of j u_j v_{k-j}.
  static N weighted(const Series& u, const Series& v, int k, int from, int to);
  /// Sets the bits of coefficients of order k.
  /// \throws GivenUp
  void begin_order(int k) const;

  slong bits = 0;  ///< of coefficients of order 0; 0: those of the thread, for all
  int order = 1;   ///< at which none of them but the spare ones are left
  slong spare = 0;
  std::function<bool()> give_up = {};  ///< asked now and then along a series
};

/// Thrown out of a series that was given up.
struct GivenUp {};

/// With the digits of a CLN format.
cln::cl_F to_cln(const BigFloat& value, cln::float_format_t format);

}  // namespace casimir

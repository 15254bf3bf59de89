#pragma once

#include "runtime/kernels/lanes/lanes.hpp"
#include "runtime/kernels/taylor/step_policy.hpp"
#include "runtime/kernels/unroll.hpp"

namespace casimir_kernel::taylor {

/// How a series goes on behind the last coefficient that was worked out.
///
/// Coefficients of high order are those of the nearest singularities, and those of a pole satisfy a
/// linear recurrence, as c[k] = c[k-1]/r do for 1/(r - s). Other singularities satisfy one nearly,
/// and all states of a system have theirs at the same places: so one recurrence
///
///     c[k] + a_1 c[k-1] + .. + a_4 c[k-4] = 0,
///
/// that of two pairs of complex poles, is fitted to all states by least squares. All that follows
/// is then s^(order+1) (n_0 + .. + n_3 s^3) / (1 + a_1 s + .. + a_4 s^4), and with that the sum is
/// a Pade approximant whose states have one denominator. (Chang, Corliss: J. Inst. Maths Applics 25
/// (1980) 349, find the radius of convergence by such recurrences.)
///
/// The last two coefficients take no part in the fit. By how much these miss what it says of them
/// is what it is trusted for; where they miss it much, nothing is continued.
/// \tparam room  the most registers of a state
template <class V, int room>
class Continuation {
  static constexpr int kTerms = 4;
  /// The last coefficients that are not fitted but compared.
  static constexpr int kCompared = 3;

 public:
  /// By how much the fit misses the last coefficient but one, and the last, in allowed errors.
  struct Missed {
    double before, last;
  };

  /// Whether anything is continued.
  bool used() const { return used_; }
  void forget() { used_ = false; }

  /// Fits the recurrence.
  /// \param weight  one over the allowed error of each state
  template <class Series>
  CASIMIR_INLINE Missed fit(const Series& series, const V* weight) {
    double gram[4 * kTerms];
    sum_up(series, weight, gram);
    solve(gram);
    return compare(series, weight);
  }

  /// Continues the series for steps of up to s units. Whether it does: not where what it is divided
  /// by comes near zero up to half as far again. A singularity that the motion itself runs into has
  /// its zero there, and nothing may be continued across it.
  template <class Series>
  CASIMIR_INLINE bool use(const Series& series, double s) {
    constexpr double kLeast = StepPolicy::kLeastDenominator;
    // Not a number is not above it.
    used_ = denominator(s / 2) > kLeast && denominator(s) > kLeast &&
            denominator(1.25 * s) > kLeast && denominator(1.5 * s) > kLeast;
    if (!used_) return false;
    const int blocks = series.blocks;
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) {
      const auto* const c = &series.c[series.order][b];
      const V c0 = c[0], c1 = c[-blocks], c2 = c[-2 * blocks], c3 = c[-3 * blocks];
      numerator_[0][b] = -((c0 * a_[0] + c1 * a_[1]) + (c2 * a_[2] + c3 * a_[3]));
      numerator_[1][b] = -((c0 * a_[1] + c1 * a_[2]) + c2 * a_[3]);
      numerator_[2][b] = -(c0 * a_[2] + c1 * a_[3]);
      numerator_[3][b] = -(c0 * a_[3]);
    }
    return true;
  }

  /// Half of the way to where what it is divided by comes near zero, if it does within s units;
  /// else s. A component that is far below the tolerance may have its pole there, unseen by the
  /// size of its terms.
  __attribute__((cold, noinline)) double before_zero(double s) const {
    constexpr int kPlaces = 16;
    for (int i = 1; i <= kPlaces; ++i) {
      const double place = s * i / kPlaces;
      if (denominator(place) < StepPolicy::kLeastDenominator) return place / 2;
    }
    return s;
  }

  /// Adds what follows to a sum of the series after s units.
  CASIMIR_INLINE void add(int order, int blocks, double s, V* sum) const {
    const V factor = all_lanes<V>(power(order, s) * s / denominator(s));
    const V s1 = all_lanes<V>(s), s2 = s1 * s1;
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b)
      sum[b] += ((numerator_[0][b] + numerator_[1][b] * s1) +
                 (numerator_[2][b] + numerator_[3][b] * s1) * s2) *
                factor;
  }

  /// The same for the derivative of the series, times s.
  __attribute__((noinline)) void add_slope(int order, int blocks, double s, V* sum) const {
    const double q = denominator(s), factor = power(order, s) * s / q;
    const double dq = (((4 * a_[3] * s + 3 * a_[2]) * s + 2 * a_[1]) * s + a_[0]) * s;
    const double k = order + 1 - dq / q;
    for (int b = 0; b < blocks; ++b) {
      V rest = numerator_[3][b] * (k + 3);
      for (int j = 2; j >= 0; --j) rest = rest * s + numerator_[j][b] * (k + j);
      sum[b] += rest * factor;
    }
  }

 private:
  /// s to the power `order`, a multiple of 4.
  static CASIMIR_INLINE double power(int order, double s) {
    const double s4 = (s * s) * (s * s);
    double result = s4;
    CASIMIR_UNROLL
    for (int k = 4; k < order; k += 4) result *= s4;
    return result;
  }

  CASIMIR_INLINE double denominator(double s) const {
    return (1 + a_[0] * s) + ((a_[1] + a_[2] * s) + a_[3] * (s * s)) * (s * s);
  }

  /// The normal equations: for one order of each state where there are more states than terms, else
  /// for two. (Six states of which only two are independent do not determine the terms then; that
  /// is what is missed.) Entries 00 01 02 03, the right-hand side, 11 12 13 22, 23 33.
  template <class Series>
  static CASIMIR_INLINE void sum_up(const Series& series, const V* weight, double* gram) {
    constexpr int width = sizeof(V) / sizeof(double);
    V sums[4 * kTerms];
    const int blocks = series.blocks;
    const bool both = blocks == 1 || (blocks - 1) * width < kTerms;
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) {
      V v[kTerms + 2];
      CASIMIR_UNROLL
      for (int r = 0; r < kTerms + 2; ++r)
        v[r] = series.c[series.order - kCompared - r][b] * weight[b];
      const auto add = [&](int place, int i, int j) CASIMIR_INLINE_LAMBDA {
        const V term = both ? v[i] * v[j] + v[i + 1] * v[j + 1] : v[i] * v[j];
        sums[place] = b == 0 ? term : sums[place] + term;
      };
      CASIMIR_UNROLL
      for (int j = 0; j < kTerms; ++j) add(j, 1, j + 1);
      CASIMIR_UNROLL
      for (int j = 0; j < kTerms; ++j) add(kTerms + j, 0, j + 1);
      CASIMIR_UNROLL
      for (int j = 0; j < 3; ++j) add(2 * kTerms + j, 2, j + 2);
      add(2 * kTerms + 3, 3, 3);
      add(3 * kTerms, 3, 4);
      add(3 * kTerms + 1, 4, 4);
    }
    sums[3 * kTerms + 2] = sums[3 * kTerms + 3] = V{};
    CASIMIR_UNROLL
    for (int g = 0; g < kTerms; ++g) {
      const V* const four = sums + 4 * g;
      lane_sums(four[0], four[1], four[2], four[3], gram + 4 * g);
    }
  }

  /// Elimination without pivots: the matrix is positive, and as good as singular where fewer terms
  /// would do, which the diagonal is made a little larger for.
  CASIMIR_INLINE void solve(const double* gram) {
    constexpr double kLarger = 1 + 0x1p-43;
    const double g00 = gram[0] * kLarger, g01 = gram[1], g02 = gram[2], g03 = gram[3];
    const double i0 = 1 / g00, f1 = g01 * i0, f2 = g02 * i0, f3 = g03 * i0;
    const double r0 = gram[4];
    const double g11 = gram[8] * kLarger - f1 * g01, g12 = gram[9] - f1 * g02;
    const double g13 = gram[10] - f1 * g03, r1 = gram[5] - f1 * r0;
    const double i1 = 1 / g11, h2 = g12 * i1, h3 = g13 * i1;
    const double g22 = (gram[11] * kLarger - f2 * g02) - h2 * g12;
    const double g23 = (gram[12] - f2 * g03) - h2 * g13, r2 = (gram[6] - f2 * r0) - h2 * r1;
    const double i2 = 1 / g22, e3 = g23 * i2;
    const double g33 = ((gram[13] * kLarger - f3 * g03) - h3 * g13) - e3 * g23;
    const double r3 = ((gram[7] - f3 * r0) - h3 * r1) - e3 * r2;
    a_[3] = -r3 / g33;
    a_[2] = -(r2 * i2) - e3 * a_[3];
    a_[1] = (-(r1 * i1) - h3 * a_[3]) - h2 * a_[2];
    a_[0] = ((-(r0 * i0) - f3 * a_[3]) - f2 * a_[2]) - f1 * a_[1];
  }

  template <class Series>
  CASIMIR_INLINE Missed compare(const Series& series, const V* weight) const {
    const int blocks = series.blocks;
    V before = V{}, last = V{};
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) {
      const auto* const c = &series.c[series.order][b];
      const V c1 = c[-blocks], c2 = c[-2 * blocks], c3 = c[-3 * blocks], c4 = c[-4 * blocks];
      const V one = ((c1 + c2 * a_[0]) + c3 * a_[1]) + (c4 * a_[2] + c[-5 * blocks] * a_[3]);
      const V two = ((c[0] + c1 * a_[0]) + c2 * a_[1]) + (c3 * a_[2] + c4 * a_[3]);
      before += absolute(one) * weight[b];
      last += absolute(two) * weight[b];
    }
    return {lane_sum(before), lane_sum(last)};
  }

  double a_[kTerms];
  V numerator_[kTerms][room];
  bool used_ = false;
};

}  // namespace casimir_kernel::taylor

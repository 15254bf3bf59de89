#pragma once

#include "runtime/kernels/lanes/lane_march.hpp"
#include "runtime/kernels/lanes/lane_tables.h"

namespace casimir_kernel::lanes {

/// Taylor coefficients of x' = constant + linear + quadratic, one trajectory in each lane.
///
/// Coefficient k+1 needs sums of l[j] r[k-j] for many pairs of rows. Four orders are formed
/// together: what the coefficients of earlier orders give, for which the rows slide along each
/// other in registers, so that two loads serve four products; then, order by order, what has just
/// become known.
///
/// Tables is a class with casimir_lane_tables `tables`, their number of `states`, `static constexpr
/// bool known` and, where they are, the numbers of sums and states as `most_sums` and
/// `most_states`. Where they are constants all loops over sums and products are written out, and
/// the coefficients that several products need are loaded once. The operations on a lane are the
/// same in the same order, so both give the same bits.
template <class Tables, int width>
class Quadratic : Tables {
 public:
  using V = Lanes<width>;
  using Tables::states;
  static constexpr int room = Tables::known ? Tables::most_states : CASIMIR_MOST_LANE_STATES;
  static constexpr bool smooth = true, fixed_states = Tables::known;
  const int order;

  /// The rows of two factors.
  struct Pair {
    const V *a, *b;
  };
  /// What it works in: `rows`, `sums` and `numbers` may follow each other.
  struct Memory {
    V *rows, *sums, *numbers;
    Pair* pairs;
  };
  static constexpr int count_of_rows(const casimir_lane_tables& from) {
    return from.states + from.copies;
  }
  static constexpr int count_of_numbers(const casimir_lane_tables& from) {
    return from.copies + from.shared[from.states] + from.linear[from.states] + from.states;
  }

  /// \param stride  of the rows, at least order + 1.
  Quadratic(const Tables& from, int the_order, int stride, const Memory& memory)
      : Tables(from),
        order(the_order),
        stride_(stride),
        rows_(memory.rows),
        sums_(memory.sums),
        numbers_(memory.numbers),
        shared_(numbers_ + tables.copies),
        linear_(shared_ + tables.shared[tables.states]),
        constant_(linear_ + tables.linear[tables.states]),
        pairs_(memory.pairs) {
    for (int p = 0; !Tables::known && p < tables.first[tables.sums]; ++p)
      memory.pairs[p] = {row(tables.product[p].left), row(tables.product[p].right)};
  }

  CASIMIR_INLINE V* row(int i) { return rows_ + i * stride_; }

  void enter(int lane, const double* numbers) {
    const int count = count_of_numbers(tables);
    for (int i = 0; i < count; ++i) numbers_[i][lane] = numbers[i];
  }

  __attribute__((noinline)) void begin(V, const V* x, V* rate) const {
    for (int i = 0; i < tables.states; ++i) {
      rate[i] = constant_[i] + value_of_sum(i, x);
      for (int e = tables.linear[i]; e < tables.linear[i + 1]; ++e)
        rate[i] += linear_[e] * x[tables.linear_state[e]];
      for (int e = tables.shared[i]; e < tables.shared[i + 1]; ++e)
        rate[i] += shared_[e] * value_of_sum(tables.shared_sum[e], x);
    }
  }

  __attribute__((noinline)) void expand(V unit) {
    unit_ = unit;
    for (int c = 0; c < tables.copies; ++c)
      row(tables.states + c)[0] = numbers_[c] * row(tables.copied[c])[0];
    step<Part::order_0>(0, 0);
    step<Part::order_1>(1, 1);
    step<Part::order_2>(2, 2);
    step<Part::order_3>(3, 3);
    for (int k = 4; k < order; k += 4) {
      step<Part::known>(k, 0);
      step<Part::even>(k, 0);
      step<Part::odd>(k + 1, 1);
      step<Part::middle>(k, 0);
      step<Part::even>(k + 2, 2);
      step<Part::odd>(k + 3, 3);
    }
  }

 private:
  using Tables::tables;

  /// What is done at an order. `known` and `middle` are functions below; the others make the next
  /// coefficient and say which terms of its sums are still missing: all in the first block; else
  /// those with coefficient 0, and in the second of two orders those with coefficient 1.
  enum class Part { order_0, order_1, order_2, order_3, even, odd, known, middle };

  /// Loops that are written out get the registers of a function of their own; the others are best
  /// all in one.
  template <Part part>
  CASIMIR_INLINE void step(int at, int column) {
    if constexpr (Tables::known)
      apart<part>(at, column);
    else
      together<part>(at, column);
  }
  template <Part part>
  __attribute__((noinline)) void apart(int at, int column) {
    together<part>(at, column);
  }
  template <Part part>
  CASIMIR_INLINE void together(int at, int column) {
    if constexpr (part == Part::known)
      known(at);
    else if constexpr (part == Part::middle)
      middle(at);
    else
      next<part>(at, column);
  }

  V value_of_row(int i, const V* x) const {
    return i < tables.states ? x[i]
                             : numbers_[i - tables.states] * x[tables.copied[i - tables.states]];
  }

  V value_of_sum(int g, const V* x) const {
    V sum = V{};
    for (int p = tables.first[g]; p < tables.first[g + 1]; ++p) {
      const V term =
          value_of_row(tables.product[p].left, x) * value_of_row(tables.product[p].right, x);
      sum += p < tables.negative[g] ? term : -term;
    }
    return sum;
  }

  /// For i = begin .. end - 1, written out where the tables are known.
  template <class Action>
  static CASIMIR_INLINE void repeat(int begin, int end, Action action) {
    if constexpr (Tables::known) {
#pragma GCC unroll 64
      for (int i = begin; i < end; ++i) action(i);
    } else {
      for (int i = begin; i < end; ++i) action(i);
    }
  }

  CASIMIR_INLINE Pair pair(int p) const {
    if constexpr (Tables::known)
      return {rows_ + tables.product[p].left * stride_, rows_ + tables.product[p].right * stride_};
    else
      return pairs_[p];
  }

  /// `positive` for the products of a sum that are added, then `negative` for the others.
  template <class Positive, class Negative>
  CASIMIR_INLINE void products(int g, Positive positive, Negative negative) const {
    repeat(tables.first[g], tables.negative[g],
           [&](int p) CASIMIR_INLINE_LAMBDA { positive(pair(p)); });
    repeat(tables.negative[g], tables.first[g + 1],
           [&](int p) CASIMIR_INLINE_LAMBDA { negative(pair(p)); });
  }

  template <int sign>
  static CASIMIR_INLINE void add(V& sum, V a, V b) {
    if constexpr (sign > 0)
      sum += a * b;
    else
      sum -= a * b;
  }

  /// What the coefficients below k give to the sums of order k .. k+3.
  CASIMIR_INLINE void known(int k) {
    repeat(0, tables.sums, [&](int g) CASIMIR_INLINE_LAMBDA {
      V s0 = V{}, s1 = V{}, s2 = V{}, s3 = V{};
      products(
          g, [&](Pair p) CASIMIR_INLINE_LAMBDA { slide<1>(p, k, s0, s1, s2, s3); },
          [&](Pair p) CASIMIR_INLINE_LAMBDA { slide<-1>(p, k, s0, s1, s2, s3); });
      V* const sum = sums_ + 4 * g;
      sum[0] = s0;
      sum[1] = s1;
      sum[2] = s2;
      sum[3] = s3;
    });
  }

  template <int sign>
  static CASIMIR_INLINE void slide(Pair p, int k, V& s0, V& s1, V& s2, V& s3) {
    const V *a = p.a, *b = p.b + k;
    V b1 = b[-1], b2 = b[-2], b3 = b[-3];
    add<sign>(s0, a[1], b1);
    add<sign>(s1, a[2], b1);
    add<sign>(s2, a[3], b1);
    add<sign>(s0, a[2], b2);
    add<sign>(s1, a[3], b2);
    add<sign>(s0, a[3], b3);
    for (int j = 4; j < k; j += 4) {
      a += 4;
      b -= 4;
      const V b0 = b[0];
      add<sign>(s1, a[0], b3);
      add<sign>(s2, a[0], b2);
      add<sign>(s3, a[0], b1);
      add<sign>(s2, a[1], b3);
      add<sign>(s3, a[1], b2);
      add<sign>(s3, a[2], b3);
      add<sign>(s0, a[0], b0);
      add<sign>(s1, a[1], b0);
      add<sign>(s2, a[2], b0);
      add<sign>(s3, a[3], b0);
      b1 = b[-1], b2 = b[-2], b3 = b[-3];
      add<sign>(s0, a[1], b1);
      add<sign>(s1, a[2], b1);
      add<sign>(s2, a[3], b1);
      add<sign>(s0, a[2], b2);
      add<sign>(s1, a[3], b2);
      add<sign>(s0, a[3], b3);
    }
  }

  /// What coefficients k and k+1 give to the sums of order k+2 and k+3 with the coefficients 1, 2,
  /// 3.
  CASIMIR_INLINE void middle(int k) {
    V made[Tables::known ? 2 * Tables::most_sums : 1];  // stored at the end, see `next`
    repeat(0, tables.sums, [&](int g) CASIMIR_INLINE_LAMBDA {
      V* const sum = sums_ + 4 * g;
      V s2 = sum[2], s3 = sum[3];
      products(
          g, [&](Pair p) CASIMIR_INLINE_LAMBDA { middle_of<1>(p, k, s2, s3); },
          [&](Pair p) CASIMIR_INLINE_LAMBDA { middle_of<-1>(p, k, s2, s3); });
      (Tables::known ? made[2 * g] : sum[2]) = s2;
      (Tables::known ? made[2 * g + 1] : sum[3]) = s3;
    });
    if constexpr (Tables::known)
      repeat(0, 2 * tables.sums,
             [&](int i) CASIMIR_INLINE_LAMBDA { sums_[4 * (i / 2) + 2 + i % 2] = made[i]; });
  }

  template <int sign>
  static CASIMIR_INLINE void middle_of(Pair p, int k, V& s2, V& s3) {
    const V *a = p.a, *b = p.b;
    add<sign>(s2, a[1], b[k + 1]);
    add<sign>(s3, a[3], b[k]);
    add<sign>(s2, a[k + 1], b[1]);
    add<sign>(s3, a[k], b[3]);
    add<sign>(s2, a[2], b[k]);
    add<sign>(s3, a[2], b[k + 1]);
    add<sign>(s2, a[k], b[2]);
    add<sign>(s3, a[k + 1], b[2]);
  }

  /// Of these, what has been known for an order: nothing shall wait for the newest coefficient
  /// longer than it must.
  template <Part part, int sign>
  static CASIMIR_INLINE void early(Pair p, int at, V& sum) {
    if constexpr (part == Part::order_2) {
      add<sign>(sum, p.a[1], p.b[1]);
    } else if constexpr (part == Part::order_3 || part == Part::odd) {
      add<sign>(sum, p.a[1], p.b[at - 1]);
      add<sign>(sum, p.b[1], p.a[at - 1]);
    }
  }
  template <Part part, int sign>
  static CASIMIR_INLINE void late(Pair p, int at, V& sum, V& other) {
    add<sign>(sum, p.a[0], p.b[at]);
    if constexpr (part != Part::order_0) add<sign>(other, p.b[0], p.a[at]);
  }

  template <Part part>
  CASIMIR_INLINE V finished(int g, int at, int i) const {
    V sum = part < Part::even ? V{} : sums_[4 * g + i], other = V{};
    products(
        g, [&](Pair p) CASIMIR_INLINE_LAMBDA { early<part, 1>(p, at, sum); },
        [&](Pair p) CASIMIR_INLINE_LAMBDA { early<part, -1>(p, at, sum); });
    products(
        g, [&](Pair p) CASIMIR_INLINE_LAMBDA { late<part, 1>(p, at, sum, other); },
        [&](Pair p) CASIMIR_INLINE_LAMBDA { late<part, -1>(p, at, sum, other); });
    return sum + other;
  }

  /// Coefficient at + 1, from the sums of order `at`, which stand in column i.
  template <Part part>
  CASIMIR_INLINE void next(int at, int i) {
    const V part_of_unit = unit_ * (1. / (at + 1));
    V total[Tables::known ? Tables::most_sums : 1];
    repeat(tables.states, tables.sums, [&](int g) CASIMIR_INLINE_LAMBDA {
      (Tables::known ? total[g] : sums_[4 * g + i]) = finished<part>(g, at, i);
    });
    V made[room];  // stored at the end: until then what is loaded stays known
    repeat(0, tables.states, [&](int r) CASIMIR_INLINE_LAMBDA {
      V rate = finished<part>(r, at, i);
      if constexpr (part == Part::order_0) rate += constant_[r];
      repeat(tables.linear[r], tables.linear[r + 1], [&](int e) CASIMIR_INLINE_LAMBDA {
        rate += linear_[e] * row(tables.linear_state[e])[at];
      });
      repeat(tables.shared[r], tables.shared[r + 1], [&](int e) CASIMIR_INLINE_LAMBDA {
        const int g = tables.shared_sum[e];
        rate += shared_[e] * (Tables::known ? total[g] : sums_[4 * g + i]);
      });
      made[r] = rate * part_of_unit;
      if constexpr (!Tables::known) row(r)[at + 1] = made[r];
    });
    if constexpr (Tables::known)
      repeat(0, tables.states, [&](int r) CASIMIR_INLINE_LAMBDA { row(r)[at + 1] = made[r]; });
    repeat(0, tables.copies, [&](int c) CASIMIR_INLINE_LAMBDA {
      row(tables.states + c)[at + 1] = numbers_[c] * made[tables.copied[c]];
    });
  }

  const int stride_;
  V* const rows_;
  V* const sums_;
  V* const numbers_;
  V* const shared_;
  V* const linear_;
  V* const constant_;
  const Pair* const pairs_;
  V unit_ = {};
};

}  // namespace casimir_kernel::lanes

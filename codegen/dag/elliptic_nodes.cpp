#include "codegen/dag/elliptic_nodes.hpp"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/real.h>

#include <algorithm>
#include <cmath>

#include "symbolic/error.hpp"

namespace casimir::codegen {
namespace {

/// Of a modulus that is a double, k' is 1e-8 at least, and after eight means nothing is left of
/// what they differ by.
constexpr int kMeans = 8, kDuplications = 10, kShortDuplications = 8;
/// A p of R_J that is larger than the other arguments comes down to a quarter each time: these are
/// for 10^8 times as large.
constexpr int kDuplicationsOfThirdKind = 18;
/// Where the arguments of Carlson's integrals differ from their mean by this part, series of
/// seventh order have all digits of a double.
constexpr double kNear = 0.01;

/// Sums and products of nodes as they are written.
class Terms {
 public:
  explicit Terms(Dag& dag) : dag_(dag) {}

  Scaled number(const cln::cl_RA& value) const { return dag_.product({scaled(value, one())}); }
  Scaled times(const cln::cl_RA& factor, const Scaled& a) const { return scaled(factor, a); }
  Scaled sum(const std::vector<Scaled>& parts) const { return dag_.sum(parts); }
  Scaled product(const std::vector<Scaled>& parts) const { return dag_.product(parts); }
  Scaled power(const Scaled& a, const cln::cl_RA& exponent) const {
    return dag_.power(a, exponent);
  }
  Scaled root(const Scaled& a) const { return power(a, cln::cl_RA(1) / 2); }
  Scaled over(const Scaled& a, const Scaled& b) const { return product({a, power(b, -1)}); }
  Scaled minus(const Scaled& a, const Scaled& b) const { return sum({a, scaled(-1, b)}); }
  Scaled call(Op function, const Scaled& a) const { return dag_.call(function, {a}); }
  static Scaled one() { return {1, Dag::kOne}; }

 private:
  static Scaled scaled(const cln::cl_RA& factor, const Scaled& a) {
    return {factor * a.coefficient, a.node};
  }

  Dag& dag_;
};

cln::cl_RA ratio(int top, int bottom) { return cln::cl_RA(top) / bottom; }

/// Numbers from it to its inverse can be multiplied, and their roots, without leaving the doubles.
cln::cl_RA least_double() { return 1 / cln::expt(cln::cl_RA(10), 150); }

/// How many duplications bring arguments together; constants need more where their sizes differ.
/// \throws ModelError  where one is not positive, or their sizes are beyond those of doubles
int duplications_of(const std::vector<Scaled>& arguments) {
  constexpr std::size_t kInSum = 3;  // the last of R_J is in no product of roots
  std::vector<double> x;
  for (const Scaled& argument : arguments) {
    if (argument.node != Dag::kOne) continue;
    if (!cln::plusp(argument.coefficient))
      throw ModelError("Carlson's integrals need positive arguments");
    if (argument.coefficient < least_double() || argument.coefficient > 1 / least_double())
      throw ModelError("an argument of Carlson's integrals is too large or too small");
    x.push_back(cln::double_approx(argument.coefficient));
  }
  if (x.size() < arguments.size())
    return arguments.size() > kInSum ? kDuplicationsOfThirdKind : kDuplications;
  int count = 0;
  for (constexpr int kMost = 60;; ++count) {
    if (count == kMost)
      throw ModelError("the sizes of the arguments of Carlson's integrals are too different");
    double sum = 0;
    for (const double own : x) sum += own;
    const double mean = sum / static_cast<double>(x.size());
    if (std::ranges::all_of(x, [&](double own) { return std::abs(own - mean) < kNear * mean; }))
      break;
    double lambda = 0;
    for (std::size_t i = 0; i < kInSum; ++i)
      for (std::size_t j = 0; j < i; ++j) lambda += std::sqrt(x[i]) * std::sqrt(x[j]);
    for (double& own : x) own = (own + lambda) / 4;
  }
  return std::max(count, kDuplications);
}

/// A factor of a series that is 1, to the last digit of a double, where its arguments are near
/// zero, and no number where they are not: what the series says there is wrong, and nobody would
/// see it. The last term of the sum is a small part of it, so that what lies between does no harm.
Scaled one_where_near(const Terms& t, const std::vector<Scaled>& arguments) {
  constexpr int kPower = 64, kOfSquares = 50;
  std::vector<Scaled> squares;
  for (const Scaled& argument : arguments) squares.push_back(t.power(argument, 2));
  const Scaled far = t.power(t.times(kOfSquares, t.sum(squares)), kPower);
  return t.root(t.minus(t.one(), far));
}

/// A number with what of its powers a series needs.
Scaled seventh_order(const Terms& t, const Scaled& e2, const Scaled& e3, const Scaled& e4,
                     const Scaled& e5) {
  return t.sum({t.one(), t.times(ratio(-3, 14), e2), t.times(ratio(1, 6), e3),
                t.times(ratio(9, 88), t.power(e2, 2)), t.times(ratio(-3, 22), e4),
                t.times(ratio(-9, 52), t.product({e2, e3})), t.times(ratio(3, 26), e5),
                t.times(ratio(-1, 16), t.power(e2, 3)), t.times(ratio(3, 40), t.power(e3, 2)),
                t.times(ratio(3, 20), t.product({e2, e4})),
                t.times(ratio(45, 272), t.product({t.power(e2, 2), e3})),
                t.times(ratio(-9, 68), t.sum({t.product({e3, e4}), t.product({e2, e5})}))});
}

/// DLMF 19.36.1 behind duplications by 19.26.18.
Scaled first_kind(const Terms& t, Scaled x, Scaled y, Scaled z, int duplications) {
  for (int n = 0; n < duplications; ++n) {
    const Scaled a = t.root(x), b = t.root(y), c = t.root(z);
    const Scaled lambda = t.sum({t.product({a, b}), t.product({b, c}), t.product({a, c})});
    for (Scaled* argument : {&x, &y, &z})
      *argument = t.times(ratio(1, 4), t.sum({*argument, lambda}));
  }
  const Scaled mean = t.times(ratio(1, 3), t.sum({x, y, z}));
  const Scaled u = t.minus(t.one(), t.over(x, mean)), v = t.minus(t.one(), t.over(y, mean));
  const Scaled w = t.times(-1, t.sum({u, v}));
  const Scaled e2 = t.minus(t.product({u, v}), t.power(w, 2)), e3 = t.product({u, v, w});
  const Scaled series =
      t.sum({t.one(), t.times(ratio(-1, 10), e2), t.times(ratio(1, 14), e3),
             t.times(ratio(1, 24), t.power(e2, 2)), t.times(ratio(-3, 44), t.product({e2, e3})),
             t.times(ratio(-5, 208), t.power(e2, 3)), t.times(ratio(3, 104), t.power(e3, 2)),
             t.times(ratio(1, 16), t.product({t.power(e2, 2), e3}))});
  return t.product({t.power(mean, ratio(-1, 2)), series});
}

/// DLMF 19.36.2, with R_D(x, y, z) = R_J(x, y, z, z).
Scaled second_kind(const Terms& t, Scaled x, Scaled y, Scaled z, int duplications) {
  std::vector<Scaled> sum;
  cln::cl_RA quarter = 1;
  for (int n = 0; n < duplications; ++n) {
    const Scaled a = t.root(x), b = t.root(y), c = t.root(z);
    const Scaled lambda = t.sum({t.product({a, b}), t.product({b, c}), t.product({a, c})});
    sum.push_back(t.times(3 * quarter, t.power(t.product({c, t.sum({z, lambda})}), -1)));
    for (Scaled* argument : {&x, &y, &z})
      *argument = t.times(ratio(1, 4), t.sum({*argument, lambda}));
    quarter = quarter / 4;
  }
  const Scaled mean = t.times(ratio(1, 5), t.sum({x, y, t.times(3, z)}));
  const Scaled u = t.minus(t.one(), t.over(x, mean)), v = t.minus(t.one(), t.over(y, mean));
  const Scaled w = t.times(ratio(-1, 3), t.sum({u, v})), w2 = t.power(w, 2);
  const Scaled uv = t.product({u, v});
  const Scaled e2 = t.sum({uv, t.times(-6, w2)});
  const Scaled e3 = t.product({t.sum({t.times(3, uv), t.times(-8, w2)}), w});
  const Scaled e4 = t.times(3, t.product({t.minus(uv, w2), w2}));
  const Scaled e5 = t.product({uv, w2, w});
  sum.push_back(
      t.times(quarter, t.product({t.power(mean, ratio(-3, 2)), seventh_order(t, e2, e3, e4, e5)})));
  return t.sum(sum);
}

/// Carlson (1995), with R_C(1, 1 + e) = R_F(1, 1 + e, 1 + e).
Scaled third_kind(const Terms& t, Scaled x, Scaled y, Scaled z, Scaled p, int duplications) {
  std::vector<Scaled> sum;
  cln::cl_RA quarter = 1;
  for (int n = 0; n < duplications; ++n) {
    const Scaled a = t.root(x), b = t.root(y), c = t.root(z), r = t.root(p);
    const Scaled d = t.product({t.sum({r, a}), t.sum({r, b}), t.sum({r, c})});
    const Scaled lambda = t.sum({t.product({a, b}), t.product({b, c}), t.product({a, c})});
    // 1 + (p - x)(p - y)(p - z)/d^2, with (r - a)/(r + a) for (p - x)/(r + a)^2 and so on: of
    // positive terms alone, so that nothing cancels where p is small.
    const Scaled second = t.times(2, t.over(t.product({r, t.sum({p, lambda})}), d));
    const int many = n == 0 ? kDuplications : kShortDuplications;
    sum.push_back(t.times(6 * quarter, t.over(first_kind(t, t.one(), second, second, many), d)));
    for (Scaled* argument : {&x, &y, &z, &p})
      *argument = t.times(ratio(1, 4), t.sum({*argument, lambda}));
    quarter = quarter / 4;
  }
  const Scaled mean = t.times(ratio(1, 5), t.sum({x, y, z, t.times(2, p)}));
  const Scaled u = t.minus(t.one(), t.over(x, mean)), v = t.minus(t.one(), t.over(y, mean)),
               w = t.minus(t.one(), t.over(z, mean));
  const Scaled q = t.times(ratio(-1, 2), t.sum({u, v, w})), q2 = t.power(q, 2);
  const Scaled uvw = t.product({u, v, w});
  const Scaled e2 =
      t.sum({t.product({u, v}), t.product({v, w}), t.product({u, w}), t.times(-3, q2)});
  const Scaled e3 = t.sum({uvw, t.times(2, t.product({e2, q})), t.times(4, t.product({q2, q}))});
  const Scaled e4 =
      t.product({t.sum({t.times(2, uvw), t.product({e2, q}), t.times(3, t.product({q2, q}))}), q});
  const Scaled e5 = t.product({uvw, q2});
  sum.push_back(
      t.times(quarter, t.product({t.power(mean, ratio(-3, 2)), seventh_order(t, e2, e3, e4, e5),
                                  one_where_near(t, {u, v, w, q})})));
  return t.sum(sum);
}

/// What the means a, b of 1 and k' are for: q = b/a in the end, and (a - b)/(a + b) = (1 - q)/(1 +
/// q) on the way, from the first on.
struct Means {
  Scaled a, q;
  std::vector<Scaled> ratios;
};

/// Of quotients q alone, so that no coefficient is squared again and again.
Means means(const Terms& t, const Scaled& k) {
  Means result{t.one(), t.root(t.product({t.minus(t.one(), k), t.sum({t.one(), k})})), {}};
  for (int n = 0; n < kMeans; ++n) {
    const Scaled sum = t.sum({t.one(), result.q});
    result.ratios.push_back(t.over(t.minus(t.one(), result.q), sum));
    result.a = t.times(ratio(1, 2), t.product({result.a, sum}));
    result.q = t.times(2, t.over(t.root(result.q), sum));
  }
  return result;
}

/// The number up to 2^-140, which is more than any type of generated code has digits for.
cln::cl_RA rounded(const cln::cl_F& value) {
  constexpr int kBits = 140;
  return cln::cl_RA(cln::round1(cln::scale_float(value, kBits))) / cln::ash(1, kBits);
}

/// Of a number. Left as roots, derivatives would multiply them out, to giants that cancel.
/// \throws ModelError  where no double tells it from 1
Means means_of_number(const Terms& t, const cln::cl_RA& k) {
  const cln::cl_RA square = (1 - k) * (1 + k);
  if (!(square > least_double()))
    throw ModelError("the modulus of Jacobi's functions is too near to 1 or -1");
  const cln::float_format_t digits = cln::float_format(100);
  const cln::cl_F one = cln::cl_float(1, digits);
  cln::cl_F a = one, q = cln::the<cln::cl_F>(cln::sqrt(cln::cl_float(square, digits)));
  Means result;
  for (const cln::cl_F same = cln::scale_float(one, -140); one - q > same;) {
    result.ratios.push_back(t.number(rounded((one - q) / (one + q))));
    a = cln::scale_float(a * (one + q), -1);
    q = cln::scale_float(cln::the<cln::cl_F>(cln::sqrt(q)), 1) / (one + q);
  }
  result.a = t.number(cln::rational(cln::cl_float(a, cln::float_format(45))));
  result.q = t.one();
  return result;
}

/// Descending through the means from an angle that is 2^n times as large (DLMF 22.20.ii).
Scaled amplitude(const Terms& t, const Scaled& u, const Means& m) {
  // By now q is 1; where k is 1, it is 0, and there is no angle.
  Scaled angle =
      t.times(cln::ash(1, static_cast<long>(m.ratios.size())), t.product({t.over(m.a, m.q), u}));
  for (std::size_t n = m.ratios.size(); n-- > 0;) {
    const Scaled bent = t.call(Op::asin, t.product({m.ratios[n], t.call(Op::sin, angle)}));
    angle = t.times(ratio(1, 2), t.sum({angle, bent}));
  }
  return angle;
}

}  // namespace

Scaled elliptic_node(Dag& dag, const std::string& name, const std::vector<Scaled>& arguments,
                     const std::optional<cln::cl_RA>& modulus) {
  const Terms t(dag);
  if (name == "R_F")
    return first_kind(t, arguments[0], arguments[1], arguments[2], duplications_of(arguments));
  if (name == "R_D")
    return second_kind(t, arguments[0], arguments[1], arguments[2], duplications_of(arguments));
  if (name == "R_J")
    return third_kind(t, arguments[0], arguments[1], arguments[2], arguments[3],
                      duplications_of(arguments));
  const Scaled& k = arguments[1];
  if (modulus && cln::abs(*modulus) >= 1)
    throw ModelError(
        "the modulus of Jacobi's functions, the second argument, lies between -1 and 1");
  const Scaled angle =
      amplitude(t, arguments[0], modulus ? means_of_number(t, *modulus) : means(t, k));
  if (name == "am") return angle;
  if (name == "sn") return t.call(Op::sin, angle);
  const Scaled cosine = t.call(Op::cos, angle);
  if (name == "cn") return cosine;
  // dn, as a sum of what is positive: near k = 1 nothing cancels.
  const Scaled square = t.power(k, 2);
  return t.root(t.sum({t.one(), t.times(-1, square), t.product({square, t.power(cosine, 2)})}));
}

}  // namespace casimir::codegen

// The free gyrostat of Zhukovskii and Volterra: x' = x * (A x + k) with a vector product, A any
// symmetric matrix.
#include <cln/real.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "runtime/exact/ball_form.hpp"
#include "runtime/exact/shapes.hpp"

namespace casimir::exact {
namespace {

using N = cln::cl_F;
using Vector = std::array<N, 3>;

/// The coefficients, in units in which start and rates are of size one.
struct Gyrostat {
  std::array<Vector, 3> A;
  Vector k, x;
  N size, rate;  ///< of the state, and of the time
};

std::vector<int> product_of(std::size_t i, std::optional<std::size_t> j) {
  std::vector<int> exponents(9, 0);
  ++exponents[3 * i];
  if (j) ++exponents[3 * *j];
  return exponents;
}

/// The field of those coefficients.
std::vector<ExactPolynomial> gyrostat_field(const Motion& of, const std::array<Vector, 3>& A,
                                            const Vector& k) {
  std::vector<ExactPolynomial> field(3);
  const auto add = [&](ExactPolynomial& to, const std::vector<int>& exponents, const N& factor) {
    const auto at = to.try_emplace(exponents, of.zero()).first;
    at->second = at->second + factor;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    for (std::size_t n = 0; n < 3; ++n) {
      add(field[i], product_of(j, n), A[l][n]);
      add(field[i], product_of(l, n), -A[j][n]);
    }
    add(field[i], product_of(j, {}), k[l]);
    add(field[i], product_of(l, {}), -k[j]);
  }
  return field;
}

/// What is read off the field; A is known but for a multiple of the unit matrix, which does
/// nothing.
std::optional<Gyrostat> read_gyrostat(const Motion& of) {
  Gyrostat g;
  const auto at = [&](std::size_t rate, std::size_t i, std::optional<std::size_t> j) {
    return of.coefficient(rate, product_of(i, j));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    g.A[j][l] = g.A[l][j] = at(i, j, j);
    g.k[l] = at(i, j, {});
    g.x[i] = of.initial[i];
  }
  g.A[0][0] = of.zero();
  g.A[1][1] = at(2, 0, 1);  // less A_00
  g.A[2][2] = g.A[1][1] + at(0, 1, 2);
  if (!same_field(of.field, gyrostat_field(of, g.A, g.k))) return std::nullopt;
  return g;
}

/// Scales x by `size` and the time by `rate`.
void normalise(Gyrostat& g, const Motion& of) {
  g.size = g.rate = of.zero();
  for (const N& x : g.x) g.size = std::max(g.size, N(cln::abs(x)));
  for (std::size_t i = 0; i < 3; ++i) {
    for (const N& a : g.A[i]) g.rate = std::max(g.rate, N(cln::abs(a) * g.size));
    g.rate = std::max(g.rate, N(cln::abs(g.k[i])));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (N& a : g.A[i]) a = a * g.size / g.rate;
    g.k[i] = g.k[i] / g.rate;
    g.x[i] = g.x[i] / g.size;
  }
}

/// A Laurent series in the time, of powers from -5 to kTop.
constexpr int kLowest = -5, kTop = 12;
struct Laurent {
  explicit Laurent(const N& zero) : c(kTop - kLowest + 1, zero) {}
  N& operator[](int power) { return c[static_cast<std::size_t>(power - kLowest)]; }
  const N& operator[](int power) const { return c[static_cast<std::size_t>(power - kLowest)]; }
  std::vector<N> c;
};

/// \param lowest  no power of a is below it, and none of b below zero.
Laurent product(const Laurent& a, const std::vector<N>& b, int lowest, const N& zero) {
  Laurent result(zero);
  for (int i = lowest; i <= kTop; ++i)
    for (int j = 0; i + j <= kTop; ++j)
      result[i + j] = result[i + j] + a[i] * b[static_cast<std::size_t>(j)];
  return result;
}

/// How many coefficients of a power series are needed, and of p, whose square is.
constexpr int kOrders = kTop - kLowest + 6;

/// The Taylor series of the motion.
std::array<std::vector<N>, 3> series_of(const Gyrostat& g, const N& zero) {
  std::array<std::vector<N>, 3> x;
  for (std::size_t i = 0; i < 3; ++i) x[i] = {g.x[i]};
  for (int order = 0; order < kOrders; ++order) {
    std::array<std::vector<N>, 3> w;  // A x + k
    const auto m = static_cast<std::size_t>(order);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t n = 0; n <= m; ++n)
        w[i].push_back(g.A[i][0] * x[0][n] + g.A[i][1] * x[1][n] + g.A[i][2] * x[2][n] +
                       (n == 0 ? g.k[i] : zero));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      N sum = x[j][0] * w[l][m] - x[l][0] * w[j][m];
      for (std::size_t n = 1; n <= m; ++n)
        sum = sum + (x[j][n] * w[l][m - n] - x[l][n] * w[j][m - n]);
      x[i].push_back(sum / cln::cl_float(cln::cl_RA(order + 1), sum));
    }
  }
  return x;
}

/// The invariants of the quartic det(H - s S) of the two quadrics on whose intersection the motion
/// stays, S = |x|^2 - |x(0)|^2 and H = x A x + 2 k x - that at the start.
std::array<N, 2> invariants(const Gyrostat& g, const N& zero) {
  const auto number = [&](int value) { return cln::cl_float(cln::cl_RA(value), zero); };
  N square = zero, energy = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    square = square + g.x[i] * g.x[i];
    energy = energy + number(2) * g.k[i] * g.x[i];
    for (std::size_t j = 0; j < 3; ++j) energy = energy + g.A[i][j] * g.x[i] * g.x[j];
  }
  // det(A - s) = -s^3 + t s^2 - u s + d; k adj(A - s) k = s^2 k.k - s (t k.k - k A k) + k adj(A) k.
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, e = (j + 2) % 3;
    return g.A[a][c] * g.A[b][e] - g.A[a][e] * g.A[b][c];
  };
  const N t = g.A[0][0] + g.A[1][1] + g.A[2][2], u = minor(0, 0) + minor(1, 1) + minor(2, 2);
  const N d = g.A[0][0] * minor(0, 0) + g.A[0][1] * minor(0, 1) + g.A[0][2] * minor(0, 2);
  N kk = zero, kAk = zero, kBk = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    kk = kk + g.k[i] * g.k[i];
    for (std::size_t j = 0; j < 3; ++j) {
      kAk = kAk + g.k[i] * g.A[i][j] * g.k[j];
      kBk = kBk + g.k[i] * minor(i, j) * g.k[j];
    }
  }
  // (s square - energy) det(A - s) - k adj(A - s) k, by powers of s from the fourth down.
  const N a0 = -square, a1 = square * t + energy, a2 = -(square * u) - energy * t - kk,
          a3 = square * d + energy * u + t * kk - kAk, a4 = -(energy * d) - kBk;
  const N b1 = a1 / number(4), b2 = a2 / number(6), b3 = a3 / number(4);
  return {a0 * a4 - number(4) * b1 * b3 + number(3) * b2 * b2,
          a0 * b2 * a4 + number(2) * b1 * b2 * b3 - b2 * b2 * b2 - a0 * b3 * b3 - b1 * b1 * a4};
}

/// 1, p, p', p^2, p p' as Laurent series (Abramowitz & Stegun 18.5), and the powers of their poles.
constexpr std::array<int, 5> kPoles{0, -2, -3, -4, -5};
std::array<Laurent, 5> basis(const N& g2, const N& g3, const N& zero) {
  const auto number = [&](int value) { return cln::cl_float(cln::cl_RA(value), zero); };
  constexpr int kTerms = (kTop + 5) / 2 + 3;  // p = t^-2 + sum c_k t^(2 k - 2)
  std::vector<N> c(kTerms + 1, zero);
  c[2] = g2 / number(20);
  c[3] = g3 / number(28);
  for (int k = 4; k <= kTerms; ++k) {
    N sum = zero;
    for (int m = 2; m <= k - 2; ++m)
      sum = sum + c[static_cast<std::size_t>(m)] * c[static_cast<std::size_t>(k - m)];
    c[static_cast<std::size_t>(k)] = number(3) * sum / number((2 * k + 1) * (k - 3));
  }
  const N one = number(1);
  Laurent constant(zero), p(zero), slope(zero), square(zero), both(zero);
  constant[0] = one;
  // With c_0 = 1 and c_1 = 0, p = sum c_k t^(2 k - 2), also beyond the powers that are kept.
  c[0] = one;
  for (int k = 0; k <= kTerms; ++k) {
    const N& a = c[static_cast<std::size_t>(k)];
    if (2 * k - 2 <= kTop) p[2 * k - 2] = a;
    if (2 * k - 3 <= kTop) slope[2 * k - 3] = number(2 * k - 2) * a;
    for (int m = 0; m <= kTerms; ++m) {
      const N product = a * c[static_cast<std::size_t>(m)];
      if (2 * (k + m) - 4 <= kTop) square[2 * (k + m) - 4] = square[2 * (k + m) - 4] + product;
      if (2 * (k + m) - 5 <= kTop)
        both[2 * (k + m) - 5] = both[2 * (k + m) - 5] + number(2 * m - 2) * product;
    }
  }
  return {constant, p, slope, square, both};
}

/// The coefficients in the basis of what has the same poles at 0 and the same value; `f` becomes
/// what is left.
std::array<N, 5> taken_out(Laurent& f, const std::array<Laurent, 5>& basis, const N& zero) {
  std::array<N, 5> result{zero, zero, zero, zero, zero};
  for (const std::size_t i : {4, 3, 2, 1, 0}) {
    result[i] = f[kPoles[i]] / basis[i][kPoles[i]];
    for (int power = kPoles[i]; power <= kTop; ++power)
      f[power] = f[power] - result[i] * basis[i][power];
  }
  return result;
}

using Row = std::array<N, 5>;

/// A vector other than zero that these rows annul, as far as the digits tell; nothing where there
/// is none.
std::optional<Row> annulled(std::vector<Row> rows, const N& zero) {
  std::array<std::size_t, 5> column{0, 1, 2, 3, 4};
  N first = zero;
  std::size_t rank = 0;
  for (; rank < 5; ++rank) {
    std::size_t best_row = rank, best = rank;
    for (std::size_t r = rank; r < rows.size(); ++r)
      for (std::size_t c = rank; c < 5; ++c)
        if (cln::abs(rows[r][column[c]]) > cln::abs(rows[best_row][column[best]])) {
          best_row = r;
          best = c;
        }
    std::swap(rows[rank], rows[best_row]);
    std::swap(column[rank], column[best]);
    const N pivot = rows[rank][column[rank]];
    if (rank == 0) first = cln::abs(pivot);
    if (cln::abs(pivot) <= first * vanishing_part(zero)) break;
    for (std::size_t r = rank + 1; r < rows.size(); ++r) {
      const N factor = rows[r][column[rank]] / pivot;
      for (std::size_t c = rank; c < 5; ++c)
        rows[r][column[c]] = rows[r][column[c]] - factor * rows[rank][column[c]];
    }
  }
  if (rank == 5) return std::nullopt;
  Row result{zero, zero, zero, zero, zero};
  result[column[rank]] = cln::cl_float(cln::cl_RA(1), zero);
  for (std::size_t r = rank; r-- > 0;) {
    N sum = zero;
    for (std::size_t c = r + 1; c < 5; ++c) sum = sum + rows[r][column[c]] * result[column[c]];
    result[column[r]] = -sum / rows[r][column[r]];
  }
  return result;
}

/// x = n(t) / d(t), all of them sums of 1, p, p', p^2 and p p' of one function p of Weierstrass.
struct Quotients {
  std::array<Row, 3> above;
  Row below;
};

/// They exist (Riemann and Roch: x has four poles, and among the five functions one vanishes in
/// all of them), and are found from the Taylor series of the motion: d such that no x_i d leaves
/// anything when the n_i are taken out.
///
/// That X = n / d is the solution needs no such theory. What is left of x_i d begins with t^13 or
/// later, hence X - x does, as d does not vanish at 0. So (X' - f(X)) d^2, a polynomial in p and
/// p', begins with t^2 or later: d^2 has a pole of order ten at most. An elliptic function without
/// poles that vanishes somewhere is zero (Liouville). The same holds of p that are elementary
/// functions.
std::optional<Quotients> quotients(const Gyrostat& g, const std::array<N, 2>& invariants,
                                   const N& zero) {
  const std::array<std::vector<N>, 3> x = series_of(g, zero);
  const std::array<Laurent, 5> functions = basis(invariants[0], invariants[1], zero);
  std::vector<Row> rows;
  std::array<std::array<Row, 5>, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<Laurent> left;
    for (std::size_t b = 0; b < 5; ++b) {
      left.push_back(product(functions[b], x[i], kPoles[b], zero));
      out[i][b] = taken_out(left.back(), functions, zero);
    }
    for (int power = -1; power <= kTop; ++power) {
      if (power == 0) continue;
      Row row;
      for (std::size_t b = 0; b < 5; ++b) row[b] = left[b][power];
      rows.push_back(row);
    }
  }
  const auto below = annulled(std::move(rows), zero);
  if (!below) return std::nullopt;
  Quotients result{{}, *below};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t n = 0; n < 5; ++n) {
      result.above[i][n] = zero;
      for (std::size_t b = 0; b < 5; ++b)
        result.above[i][n] = result.above[i][n] + (*below)[b] * out[i][b][n];
    }
  return result;
}

/// The same in balls.
class EllipticMotion {
 public:
  EllipticMotion(const Gyrostat& g, const Quotients& of, const RealLattice& lattice)
      : function_(lattice), rate_(known(g.rate)), below_(balls(of.below)) {
    for (const Row& row : of.above) {
      above_.push_back(balls(row));
      for (Ball& b : above_.back()) {
        const validated::BallPrecision precision(kFormBits);
        b = b * known(g.size);
      }
    }
  }

  std::vector<Ball> operator()(const Ball& t) const {
    const auto [p, slope] = function_.at(rate_ * t);
    const std::vector<Ball> values{Ball(1.), p, slope, p * p, p * slope};
    const auto sum = [&](const std::vector<Ball>& factors) {
      Ball result(0.);
      for (std::size_t i = 0; i < factors.size(); ++i) result = result + factors[i] * values[i];
      return result;
    };
    const Ball below = sum(below_);
    std::vector<Ball> state;
    for (const std::vector<Ball>& row : above_) state.push_back(sum(row) / below);
    return state;
  }

 private:
  static std::vector<Ball> balls(const Row& row) {
    std::vector<Ball> result;
    for (const N& value : row) result.push_back(known(value));
    return result;
  }

  WeierstrassInBalls function_;
  Ball rate_;
  std::vector<Ball> below_;
  std::vector<std::vector<Ball>> above_;
};

}  // namespace

Recognised gyrostat(const Motion& motion) {
  const std::string other =
      "the equations are not x' = x * (A x + k) with a vector product and a symmetric matrix";
  if (motion.states() != 3) return {nullptr, other};
  std::optional<Gyrostat> g = read_gyrostat(motion);
  if (!g) return {nullptr, other};
  if (rests(motion)) return at_rest(motion);
  normalise(*g, motion);
  const N zero = motion.zero();
  const std::array<N, 2> of_curve = invariants(*g, zero);
  const auto found = quotients(*g, of_curve, zero);
  if (!found) return {nullptr, "300 digits do not tell the curve that the motion stays on"};
  const RealLattice lattice(of_curve[0], of_curve[1]);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double rate = cln::double_approx(g->rate);
  const double own = cln::double_approx(lattice.rate) * rate;
  const bool separatrix = lattice.kind == RealLattice::Kind::hyperbolic;
  const double period = lattice.periodic() ? cln::double_approx(lattice.period) / rate : 10 / own;
  return {std::make_shared<BallForm>(motion.initial, EllipticMotion(*g, *found, lattice), period,
                                     separatrix ? kSeparatrixHorizon / (2 * own) : kInfinity),
          ""};
}

}  // namespace casimir::exact

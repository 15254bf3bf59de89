#include "symbolic/obstruction/points/straight_lines_in_space.hpp"

#include <cln/integer_io.h>
#include <cln/rational_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"
#include "symbolic/obstruction/equation/kimura.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/homogeneous_table.hpp"
#include "symbolic/obstruction/points/potential_in_space.hpp"
#include "symbolic/obstruction/points/zero_dimensional.hpp"

namespace casimir::obstruction {
namespace {

using GiNaC::ex;
using GiNaC::symbol;
using Field = std::vector<std::vector<Univariate>>;  ///< a matrix over Q[t]/f

constexpr int kMostCuts = 2;
constexpr std::size_t kMostFreeDirections = 6;  ///< for which all directions are sought

Polynomial polynomial_of(const ex& e, const PolynomialRing& ring,
                         const std::vector<symbol>& unknowns) {
  if (is_rational_number(e))
    return ring.constant(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(e).to_cl_N()));
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (e.is_equal(unknowns[i])) return ring.variable(i);
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
    Polynomial result = ring.constant(is_sum ? 0 : 1);
    for (const ex& part : e) {
      const Polynomial own = polynomial_of(part, ring, unknowns);
      if (is_sum)
        result += own;
      else
        result *= own;
    }
    return result;
  }
  if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint) && e.op(1) < 1000)
    return polynomial_of(e.op(0), ring, unknowns)
        .pow(static_cast<unsigned long>(GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int()));
  throw NotDecided("the potential is no rational function");
}

/// Directions with d_i = 1 and d_j = 0 for j < i; the unknowns are the d_j with j > i.
class SpaceChart {
 public:
  SpaceChart(const PotentialInSpace& system, std::size_t first)
      : system_(system),
        first_(first),
        unknowns_(system.q.begin() + static_cast<std::ptrdiff_t>(first) + 1, system.q.end()),
        ring_(std::max<std::size_t>(unknowns_.size(), 1)) {
    for (std::size_t j = 0; j < first; ++j) direction_[system.q[j]] = 0;
    direction_[system.q[first]] = 1;
  }

  /// A V'(d) = gamma d, times denominators; of a chart that is one point, that its only unknown is
  /// zero.
  std::vector<Polynomial> equations() const {
    std::vector<Polynomial> result = conditions();
    if (unknowns_.empty()) result.push_back(ring_.variable(0));
    return result;
  }
  /// Every direction of the chart has a straight line.
  bool is_whole() const { return !unknowns_.empty() && conditions().empty(); }
  std::size_t unknowns() const { return unknowns_.size(); }
  /// d_j = value.
  Polynomial cut(std::size_t j, int value) const {
    return ring_.variable(j) - ring_.constant(value);
  }

  /// The value of a function at a direction; empty at a pole.
  std::optional<Univariate> value(const ex& f, const AlgebraicPoint& point) const {
    const ex both = on(f).numer_denom();
    const Univariate below = value_at(polynomial_of(both.op(1).expand(), ring_, unknowns_), point);
    if (below.is_zero()) return std::nullopt;
    const Univariate above = value_at(polynomial_of(both.op(0).expand(), ring_, unknowns_), point);
    return (above * below.inverse(point.field)).remainder(point.field);
  }

  std::string text(const AlgebraicPoint& point) const {
    std::string result;
    for (std::size_t j = 0; j < system_.q.size(); ++j) {
      const std::string own = j < first_    ? "0"
                              : j == first_ ? "1"
                                            : point.coordinates[j - first_ - 1].text("t");
      result += (result.empty() ? "(" : ", ") + own;
    }
    result += ")";
    if (point.field.degree() > 1) result += fmt::format(" with {} = 0", point.field.text("t"));
    return result;
  }

  std::size_t first() const { return first_; }

 private:
  /// The equations, but those that hold everywhere.
  std::vector<Polynomial> conditions() const {
    std::vector<Polynomial> result;
    for (std::size_t j = 0; j < system_.q.size(); ++j) {
      if (j == first_) continue;
      const ex across = on(system_.slopes[j] - system_.q[j] * system_.slopes[first_]);
      const Polynomial own = polynomial_of(across.numer().expand(), ring_, unknowns_);
      if (!own.is_zero()) result.push_back(own);
    }
    return result;
  }

  ex on(const ex& f) const {
    try {
      return f.subs(direction_).normal();
    } catch (const std::domain_error&) {  // GiNaC's pole_error
      throw NotDecided("V has a pole in all these directions");
    }
  }

  const PotentialInSpace& system_;
  std::size_t first_;
  std::vector<symbol> unknowns_;
  PolynomialRing ring_;
  GiNaC::exmap direction_;
};

/// The characteristic polynomial det(x - m) over a number field, by Leverrier and Faddeev:
/// coefficients of x^0, x^1, ..
std::vector<Univariate> characteristic_polynomial(const Field& m, const Univariate& field) {
  const std::size_t n = m.size();
  std::vector<Univariate> result(n + 1);
  result[n] = Univariate(1);
  Field power(n, std::vector<Univariate>(n));
  for (std::size_t k = 1; k <= n; ++k) {
    for (std::size_t i = 0; i < n; ++i) power[i][i] += result[n - k + 1];
    Field next(n, std::vector<Univariate>(n));
    Univariate trace;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t l = 0; l < n; ++l) next[i][j] += m[i][l] * power[l][j];
        next[i][j] = next[i][j].remainder(field);
      }
      trace += next[i][i];
    }
    result[n - k] = trace * Univariate(cln::cl_RA(-1) / cln::cl_RA(static_cast<long>(k)));
    power = std::move(next);
  }
  return result;
}

/// The eigenvalues of A V''(c) but one k - 1.
struct Eigenvalues {
  std::vector<cln::cl_RA> rational;
  bool others = false;  ///< there are some that are not rational
};

/// A rational number is a root over Q[t]/f if and only if it is one of the coefficients of each
/// power of t; what divides all of them has no other roots in common with the rest.
Eigenvalues eigenvalues(const std::vector<Univariate>& polynomial, const Univariate& field,
                        long degree) {
  Univariate common;
  for (long i = 0; i < field.degree(); ++i) {
    std::vector<cln::cl_RA> own;
    for (const Univariate& c : polynomial) own.push_back(c.coefficient(i));
    common = gcd(common, Univariate(own));
  }
  Eigenvalues result;
  result.others = common.degree() + 1 < static_cast<long>(polynomial.size());
  bool along = false;
  for (const auto& [factor, exponent] : common.factors()) {
    if (factor.degree() > 1) {
      result.others = true;
      continue;
    }
    const cln::cl_RA root = -factor.coefficient(0);
    for (unsigned long i = 0; i < exponent; ++i) {
      const bool is_along = !along && root == cln::cl_RA(degree - 1);
      if (is_along)
        along = true;
      else
        result.rational.push_back(root);
    }
  }
  if (!along) throw std::logic_error("the direction of a Darboux point is no eigenvector");
  return result;
}

/// What the table says of one direction; empty where it is none of a Darboux point.
std::optional<Examined> examine_direction(const PotentialInSpace& system, const SpaceChart& chart,
                                          const AlgebraicPoint& point) {
  const auto scale = chart.value(system.slopes[chart.first()], point);
  if (!scale || scale->is_zero()) return std::nullopt;
  const Univariate inverse = scale->inverse(point.field);
  Field matrix;
  for (const auto& row : system.curvatures) {
    matrix.emplace_back();
    for (const ex& f : row) {
      const auto own = chart.value(f, point);
      if (!own) return std::nullopt;
      matrix.back().push_back((*own * inverse).remainder(point.field));
    }
  }
  const long k = system.degree;
  const Eigenvalues found =
      eigenvalues(characteristic_polynomial(matrix, point.field), point.field, k);
  Examined result;
  result.along = "the straight line in the direction " + chart.text(point);
  result.level = fmt::format(
      "q = phi(t)*c with A V'(c) = c and phi'^2/2 + phi^{0}/{0} = 1/{0}, V homogeneous of degree "
      "{0}, p A p/2 the kinetic energy",
      k);
  std::string list;
  for (const cln::cl_RA& lambda : found.rational) {
    const std::string own = rational_text(lambda);
    list += (list.empty() ? "" : ", ") + own;
    const auto row = integrable_eigenvalue(k, lambda);
    if (row.has_value() != kimura(straight_line_differences(k, lambda)).has_value())
      throw std::logic_error("the table of eigenvalues and Kimura's theorem contradict each other");
    result.cases.emplace_back(fmt::format("table of integrable eigenvalues, lambda = {}", own),
                              row.value_or("lambda is not in it"));
    result.decisive = result.decisive || !row;
  }
  if (found.others) {
    list += list.empty() ? "irrational ones" : " and irrational ones";
    result.cases.emplace_back("table of integrable eigenvalues",
                              "an eigenvalue is not rational, and all of the table are");
    result.decisive = true;
  }
  result.nve =
      fmt::format("y'' = -lambda*phi^({})*y for every eigenvalue lambda of A V''(c) but {}: {}",
                  k - 2, k - 1, list);
  result.reduced = fmt::format(
      "in z = phi^{0} Riemann's P equation with the differences 1/{0}, 1/2, "
      "sqrt(({0} - 2)^2 + 8*{0}*lambda)/(2*{0})",
      k);
  result.outcome = result.decisive
                       ? "SL(2, C): no Liouvillian solution, the identity component is not solvable"
                       : "the identity component is solvable";
  return result;
}

/// The search through one chart.
class LineSearch {
 public:
  LineSearch(const PotentialInSpace& system, const SpaceChart& chart,
             const std::function<void()>& tick, Obstruction& result)
      : system_(system), chart_(chart), tick_(tick), result_(result) {}

  void search(const std::vector<Polynomial>& equations, int cuts) {
    tick_();
    const CommonZeros zeros = common_zeros(equations, tick_);
    for (const AlgebraicPoint& point : zeros.points) {
      if (result_.proved) return;
      const auto own = examine_direction(system_, chart_, point);
      if (!own) continue;
      result_.examined.push_back(*own);
      result_.proved = own->decisive;
    }
    if (zeros.finite) return;
    if (cuts == 0)
      result_.left_out.push_back(
          fmt::format("straight lines with {} = 1: there are infinitely many, or no Groebner basis "
                      "was found; those in some planes were examined",
                      system_.q[chart_.first()].get_name()));
    if (cuts == kMostCuts) return;
    for (std::size_t j = 0; j < chart_.unknowns() && !result_.proved; ++j)
      for (const int value : {0, 1, -1}) {
        if (result_.proved) return;
        std::vector<Polynomial> more = equations;
        more.push_back(chart_.cut(j, value));
        search(more, cuts + 1);
      }
  }

 private:
  const PotentialInSpace& system_;
  const SpaceChart& chart_;
  const std::function<void()>& tick_;
  Obstruction& result_;
};

}  // namespace

void examine_lines_in_space(const HamiltonianSystem& system, const std::function<void()>& tick,
                            Obstruction& result) {
  const auto potential = potential_in_space(system);
  if (!potential) return;
  if (potential->q.size() > kMostFreeDirections) {
    result.left_out.emplace_back("straight lines: more than six degrees of freedom");
    return;
  }
  for (std::size_t first = 0; first < potential->q.size() && !result.proved; ++first) {
    try {
      const SpaceChart chart(*potential, first);
      if (chart.is_whole()) {
        result.left_out.emplace_back(
            "straight lines: every line is one, V depends on the radius only");
        continue;
      }
      LineSearch(*potential, chart, tick, result).search(chart.equations(), 0);
    } catch (const NotDecided& problem) {
      result.left_out.push_back(fmt::format("straight lines: {}", problem.what()));
    } catch (const TooLarge& problem) {
      result.left_out.push_back(fmt::format("straight lines: {}", problem.what()));
    }
  }
}

}  // namespace casimir::obstruction

#include "symbolic/obstruction/examine.hpp"

#include <cln/integer.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "symbolic/obstruction/darboux_points.hpp"
#include "symbolic/obstruction/equation/kimura.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/equation/lame.hpp"
#include "symbolic/obstruction/homogeneous_table.hpp"

namespace casimir::obstruction {
namespace {

const char* group_text(GaloisCase galois) {
  switch (galois) {
    case GaloisCase::reducible:
      return "reducible: the identity component is solvable";
    case GaloisCase::imprimitive:
      return "imprimitive: the identity component is solvable";
    case GaloisCase::finite:
      return "finite: all solutions are algebraic";
    case GaloisCase::sl2:
      return "SL(2, C): no Liouvillian solution, the identity component is not solvable";
    case GaloisCase::undecided:
      break;
  }
  return "not decided";
}

/// The squares of the differences of Riemann's P equation whose three points are rational.
std::optional<SquaredDifferences> riemann_differences(const std::vector<Singularity>& singular) {
  if (singular.size() != 3) return std::nullopt;
  SquaredDifferences result;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!singular[i].regular() || singular[i].at.degree() > 1) return std::nullopt;
    result[i] = singular[i].difference_squared.coefficient(0);
  }
  return result;
}

std::string polynomial_text(const std::vector<RationalFunction>& polynomial, const std::string& z) {
  std::string result;
  for (std::size_t i = polynomial.size(); i-- > 0;) {
    if (polynomial[i].is_zero()) continue;
    const std::string power = i == 0 ? "" : i == 1 ? "w" : fmt::format("w^{}", i);
    const std::string factor = polynomial[i].text(z);
    if (!result.empty()) result += " + ";
    result += power.empty()   ? fmt::format("({})", factor)
              : factor == "1" ? power
                              : fmt::format("({})*{}", factor, power);
  }
  return result + " = 0";
}

std::string equation_text(const RationalFunction& p, const RationalFunction& q,
                          const std::string& z) {
  return fmt::format("{0}'' + ({1})*{0}' + ({2})*{0} = 0", unknown_beside(z), p.text(z), q.text(z));
}

}  // namespace

std::string unknown_beside(const std::string& z) { return z == "y" ? "u" : "y"; }

Examined examine_equation(const NormalEquation<RationalFunction>& equation, const std::string& z,
                          const std::function<void()>& tick) {
  const LiouvillianResult decision = decide_liouvillian(equation.reduced, tick, z);
  Examined result;
  result.nve = equation_text(equation.p, equation.q, z);
  result.reduced = fmt::format("{0}'' = ({1})*{0}", unknown_beside(z), equation.reduced.text(z));
  for (const Singularity& s : decision.singular) {
    result.exponents.push_back(s.text(z));
    result.regular = result.regular && s.regular();
  }
  for (const Attempt& attempt : decision.attempts) {
    result.cases.emplace_back(attempt.what, attempt.outcome);
    result.steps.insert(result.steps.end(), attempt.steps.begin(), attempt.steps.end());
  }
  if (const auto differences = riemann_differences(decision.singular)) {
    const auto solvable = kimura(*differences);
    result.cases.emplace_back("Kimura's theorem",
                              solvable.value_or("none of its conditions holds"));
    const bool is_sl2 = decision.galois == GaloisCase::sl2;
    if (decision.galois != GaloisCase::undecided && is_sl2 == solvable.has_value())
      throw std::logic_error("Kovacic's decision and Kimura's theorem contradict each other");
  }
  if (is_lame(equation.p, equation.q)) {
    const auto may_be = lame_class(decision.singular.back().difference_squared.coefficient(0));
    result.cases.emplace_back("Lame's equation", may_be.value_or("n is in none of its classes"));
    const bool solvable =
        decision.galois != GaloisCase::undecided && decision.galois != GaloisCase::sl2;
    if (solvable && !may_be)
      throw std::logic_error("Kovacic's decision and Lame's classes contradict each other");
  }
  if (!decision.solution.empty()) result.solution = polynomial_text(decision.solution, z);
  result.outcome = decision.galois == GaloisCase::undecided
                       ? fmt::format("not decided: {}", decision.reason)
                       : group_text(decision.galois);
  result.decisive = decision.galois == GaloisCase::sl2 || decision.borel;
  if (decision.borel)
    result.outcome =
        "all triangular matrices: one invariant line, on which infinitely many numbers act; the "
        "identity component is solvable, and not abelian";
  return result;
}

namespace {

/// What the theorem says of one Darboux point. A table's entry is rational for every degree.
Examined examine_point(const HomogeneousPotential& system, const DarbouxPoint& point) {
  const long k = system.degree;
  Examined result;
  result.along = "the straight line " + point.text(system);
  result.level = fmt::format(
      "(q1, q2) = phi(t)*c with A V'(c) = c and phi'^2/2 + phi^{0}/{0} = 1/{0}, "
      "V homogeneous of degree {0}, p A p/2 the kinetic energy",
      k);
  result.nve =
      fmt::format("y'' = -lambda*phi^({})*y with lambda = {}", k - 2, point.eigenvalue_text());
  result.reduced = fmt::format(
      "in z = phi^{0} Riemann's P equation with the differences 1/{0}, 1/2, "
      "sqrt(({0} - 2)^2 + 8*{0}*lambda)/(2*{0})",
      k);
  if (!point.eigenvalue.is_constant()) {
    result.cases.emplace_back("table of integrable eigenvalues", "lambda is not rational");
    result.decisive = true;
  } else {
    const cln::cl_RA lambda = point.eigenvalue.coefficient(0);
    const auto row = integrable_eigenvalue(k, lambda);
    const auto solvable = kimura(straight_line_differences(k, lambda));
    if (row.has_value() != solvable.has_value())
      throw std::logic_error("the table of eigenvalues and Kimura's theorem contradict each other");
    result.cases.emplace_back("table of integrable eigenvalues",
                              row.value_or("lambda is not in it"));
    result.cases.emplace_back("Kimura's theorem",
                              solvable.value_or("none of its conditions holds"));
    result.decisive = !row;
  }
  result.outcome = group_text(result.decisive ? GaloisCase::sl2 : GaloisCase::reducible);
  if (!result.decisive) result.outcome = "the identity component is solvable";
  return result;
}

}  // namespace

void examine_straight_lines(const HamiltonianSystem& system, Obstruction& result) {
  const auto potential = homogeneous_potential(system);
  if (!potential) return;
  DarbouxPoints points;
  try {
    points = darboux_points(*potential);
  } catch (const NotDecided& problem) {
    result.left_out.push_back(fmt::format("straight lines: {}", problem.what()));
    return;
  }
  if (points.all_directions)
    result.left_out.emplace_back("straight lines: every line is one, V depends on the radius only");
  for (const std::string& line : points.improper)
    result.left_out.push_back(fmt::format("straight line {}: V' vanishes on it", line));
  const auto relation = relation_of_all_points(*potential, points);
  if (relation && *relation != -1)
    throw std::logic_error("the eigenvalues of all Darboux points do not obey their relation");
  for (const DarbouxPoint& point : points.points) {
    result.examined.push_back(examine_point(*potential, point));
    if (relation)
      result.examined.back().cases.emplace_back(
          fmt::format("relation of all {} points", potential->degree),
          "the sum of 1/(lambda - 1) is -1");
    if (!result.examined.back().decisive) continue;
    result.proved = true;
    return;
  }
}

}  // namespace casimir::obstruction

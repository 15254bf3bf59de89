#include "tests/benchmarks/prove_problems.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace casimir::test {
namespace {

using Strings = std::vector<std::string>;
using Definitions = std::vector<std::pair<std::string, std::string>>;

/// The text of a case with one integral.
struct Case {
  std::string hamiltonian, integral;
  std::string variables;      ///< separated by spaces
  std::string bracket;        ///< a line of [phase_space]
  std::string parameters{};   ///< separated by spaces
  Definitions definitions{};  ///< used by the hamiltonian and the integral

  std::string toml() const {
    const auto quoted = [](const std::string& words) {
      Strings result;
      for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        result.push_back('"' + words.substr(at, end - at) + '"');
        at = end + 1;
      }
      return result;
    };
    std::string text =
        fmt::format("hamiltonian = \"{}\"\n[phase_space]\nvariables = [{}]\n{}\n[parameters]\n",
                    hamiltonian, fmt::join(quoted(variables), ", "), bracket);
    for (const std::string& parameter : quoted(parameters)) text += parameter + " = {}\n";
    text += "[definitions]\n";
    for (const auto& [name, value] : definitions) text += fmt::format("{} = \"{}\"\n", name, value);
    return text + fmt::format("[integrals]\nF = \"{}\"\n", integral);
  }
};

/// A problem and its twin, which has `extra` added to the integral.
Problem integral_problem(const std::string& name, Case text, const std::string& extra, double limit,
                         Size size = Size::small) {
  Problem problem{name, ClaimKind::integral, text.toml(), {}, size, limit};
  text.integral += " + " + extra;
  problem.bent = text.toml();
  return problem;
}

constexpr const char* kE3 = "algebra = \"e(3)\"";

Problem kovalevskaya() {
  return integral_problem(
      "Kovalevskaya, r1 r2",
      {"(M1^2 + M2^2 + 2*M3^2)/2 - r1*g1 - r2*g2",
       "k1^2 + k2^2",
       "M1 M2 M3 g1 g2 g3",
       kE3,
       "r1 r2",
       {{"k1", "M1^2 - M2^2 + 2*(r1*g1 - r2*g2)"}, {"k2", "2*M1*M2 + 2*(r1*g2 + r2*g1)"}}},
      "r1*g3", 0.1);
}

Problem clebsch() {
  return integral_problem(
      "Clebsch, 4 parameters",
      {"(a1*M1^2 + a2*M2^2 + a3*M3^2)/2 + s*(a2*a3*p1^2 + a3*a1*p2^2 + a1*a2*p3^2)/2",
       "(M1^2 + M2^2 + M3^2)/2 - s*(a1*p1^2 + a2*p2^2 + a3*p3^2)/2", "M1 M2 M3 p1 p2 p3", kE3,
       "a1 a2 a3 s"},
      "s*p1^2", 0.1);
}

Problem steklov() {
  return integral_problem(
      "Steklov, 5 parameters",
      {"(a1*M1^2 + a2*M2^2 + a3*M3^2)/2 + s*(a2*a3*M1*p1 + a3*a1*M2*p2 + a1*a2*M3*p3) + "
       "s^2*(a1*d1^2*p1^2 + a2*d2^2*p2^2 + a3*d3^2*p3^2)/2 + c*(p1^2 + p2^2 + p3^2)",
       "(M1^2 + M2^2 + M3^2)/2 - s*(a1*M1*p1 + a2*M2*p2 + a3*M3*p3) + "
       "s^2*(d1^2*p1^2 + d2^2*p2^2 + d3^2*p3^2)/2",
       "M1 M2 M3 p1 p2 p3",
       kE3,
       "a1 a2 a3 s c",
       {{"d1", "a2 - a3"}, {"d2", "a3 - a1"}, {"d3", "a1 - a2"}}},
      "s*M1*p1", 0.1);
}

/// Kovalevskaya's top in two fields a, b, with a third vector carried along: 12 variables.
Case two_fields(const std::string& integral) {
  return {"H0",
          integral,
          "M1 M2 M3 a1 a2 a3 b1 b2 b3 c1 c2 c3",
          "algebra = \"so(3)+3*R3\"",
          "r1 r2",
          {{"H0", "(M1^2 + M2^2 + 2*M3^2)/2 - r1*a1 - r2*b2"},
           {"k1", "M1^2 - M2^2 + 2*(r1*a1 - r2*b2)"},
           {"k2", "2*M1*M2 + 2*(r1*a2 + r2*b1)"},
           {"K", "k1^2 + k2^2"},
           {"aa", "a1^2 + a2^2 + a3^2"},
           {"bb", "b1^2 + b2^2 + b3^2"},
           {"cc", "c1^2 + c2^2 + c3^2"},
           {"ab", "a1*b1 + a2*b2 + a3*b3"},
           {"ac", "a1*c1 + a2*c2 + a3*c3"},
           {"bc", "b1*c1 + b2*c2 + b3*c3"}}};
}

/// Kovalevskaya's top on a canonical phase space, with m and n as functions there.
Case canonical_kovalevskaya(const std::string& variables, Definitions definitions) {
  return {"(m1^2 + m2^2 + 2*m3^2)/2 - r*n1",
          "(m1^2 - m2^2 + 2*r*n1)^2 + (2*m1*m2 + 2*r*n2)^2",
          variables,
          "canonical = true",
          "r",
          std::move(definitions)};
}

Problem euler_angles() {
  const std::string spin = "(p_psi - p_phi*cos(theta))/sin(theta)";
  return integral_problem(
      "Kovalevskaya in Euler angles",
      canonical_kovalevskaya("theta phi psi p_theta p_phi p_psi",
                             {{"m1", "sin(phi)*" + spin + " + p_theta*cos(phi)"},
                              {"m2", "cos(phi)*" + spin + " - p_theta*sin(phi)"},
                              {"m3", "p_phi"},
                              {"n1", "sin(phi)*sin(theta)"},
                              {"n2", "cos(phi)*sin(theta)"}}),
      "p_phi", 1);
}

Problem andoyer() {
  return integral_problem(
      "Kovalevskaya in Andoyer variables",
      canonical_kovalevskaya("l g h L G H",
                             {{"m1", "sqrt(G^2 - L^2)*sin(l)"},
                              {"m2", "sqrt(G^2 - L^2)*cos(l)"},
                              {"m3", "L"},
                              {"u", "H/G*sqrt(1 - L^2/G^2) + L/G*sqrt(1 - H^2/G^2)*cos(g)"},
                              {"v", "sqrt(1 - H^2/G^2)*sin(g)"},
                              {"n1", "u*sin(l) + v*cos(l)"},
                              {"n2", "u*cos(l) - v*sin(l)"}}),
      "L", 1);
}

/// The entries J_ij of a skew matrix of order n by name, "-J12" and "0" included.
std::string skew_entry(int i, int j) {
  return i == j ? "0" : i < j ? fmt::format("J{}{}", i, j) : fmt::format("-J{}{}", j, i);
}

std::string skew_variables(int n) {
  Strings names;
  for (int i = 1; i <= n; ++i) {
    for (int j = i + 1; j <= n; ++j) names.push_back(skew_entry(i, j));
  }
  return fmt::format("{}", fmt::join(names, " "));
}

/// Manakov's top on so(6): tr L^4 and tr L^6 for L = J + diag(1, .., 6), which commute.
Problem manakov() {
  constexpr int kOrder = 6;
  Definitions powers;  // entries of L, L^2 and L^3
  const auto entry = [](int power, int i, int j) { return fmt::format("L{}_{}{}", power, i, j); };
  const auto product = [&](int p, int q, int i, int j) {
    Strings terms;
    for (int k = 1; k <= kOrder; ++k) terms.push_back(entry(p, i, k) + "*" + entry(q, k, j));
    return fmt::format("{}", fmt::join(terms, " + "));
  };
  Strings fourth, sixth;
  for (int i = 1; i <= kOrder; ++i) {
    for (int j = 1; j <= kOrder; ++j) {
      powers.emplace_back(entry(1, i, j), i == j ? std::to_string(i) : skew_entry(i, j));
      powers.emplace_back(entry(2, i, j), product(1, 1, i, j));
      powers.emplace_back(entry(3, i, j), product(1, 2, i, j));
    }
    fourth.push_back(product(2, 2, i, i));
    sixth.push_back(product(3, 3, i, i));
  }
  return integral_problem(
      "Manakov so(6), {tr L^6, tr L^4}",
      {fmt::format("{}", fmt::join(fourth, " + ")), fmt::format("{}", fmt::join(sixth, " + ")),
       skew_variables(kOrder), "algebra = \"so(6)\"", "", powers},
      "J12^2", 10);
}

/// Structure constants of a linear bracket: {x_i, x_j} = sum_k c[{i, j}][k] x_k for i < j.
using Constants = std::map<std::pair<int, int>, std::vector<long>>;

Problem jacobi_problem(const std::string& name, int dimension, Constants constants) {
  const auto toml = [&] {
    Strings names;
    for (int i = 0; i < dimension; ++i) names.push_back(fmt::format("\"x{}\"", i + 1));
    std::string text = fmt::format(
        "hamiltonian = \"x1\"\n[phase_space]\nvariables = [{}]\n"
        "[phase_space.structure_constants]\n",
        fmt::join(names, ", "));
    for (const auto& [pair, row] : constants) {
      Strings terms;
      for (int k = 0; k < dimension; ++k) {
        const long c = row[static_cast<std::size_t>(k)];
        if (c != 0) terms.push_back(fmt::format("({})*x{}", c, k + 1));
      }
      if (terms.empty()) continue;
      text += fmt::format("\"x{},x{}\" = \"{}\"\n", pair.first + 1, pair.second + 1,
                          fmt::join(terms, " + "));
    }
    return text;
  };
  Problem problem{name, ClaimKind::jacobi, toml(), {}, Size::small, 0.5};
  constants.begin()->second[0] += 1;
  problem.bent = toml();
  return problem;
}

/// so(n): {J_ij, J_jk} = J_ik.
Constants orthogonal(int n) {
  std::map<std::pair<int, int>, int> index;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) index.emplace(std::pair(i, j), static_cast<int>(index.size()));
  }
  Constants result;
  for (const auto& [ab, x] : index) {
    for (const auto& [cd, y] : index) {
      if (x >= y) continue;
      std::vector<long> row(index.size());
      const int pairs[4][4] = {{ab.first, ab.second, cd.first, cd.second},
                               {ab.second, ab.first, cd.first, cd.second},
                               {ab.first, ab.second, cd.second, cd.first},
                               {ab.second, ab.first, cd.second, cd.first}};
      for (int k = 0; k < 4; ++k) {
        const auto [a, b, c, d] = pairs[k];
        if (b != c || a == d) continue;
        const long sign = (k == 0 || k == 3 ? 1 : -1) * (a < d ? 1 : -1);
        row[static_cast<std::size_t>(index.at(std::minmax(a, d)))] += sign;
      }
      result[{x, y}] = std::move(row);
    }
  }
  return result;
}

/// The same algebra in the basis y_i = x_i + x_{i+1} + .. + x_n: nearly every constant is not zero.
Constants in_another_basis(const Constants& constants, int n) {
  const auto bracket = [&](int i, int j, int k) -> long {
    if (i == j) return 0;
    const auto& row = constants.at(std::minmax(i, j));
    return i < j ? row[static_cast<std::size_t>(k)] : -row[static_cast<std::size_t>(k)];
  };
  Constants result;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      std::vector<long> old(static_cast<std::size_t>(n));
      for (int k = 0; k < n; ++k) {
        for (int a = i; a < n; ++a) {
          for (int b = j; b < n; ++b) old[static_cast<std::size_t>(k)] += bracket(a, b, k);
        }
      }
      std::vector<long>& row = result[{i, j}];
      row = old;  // x_k = y_k - y_{k+1}
      for (int k = 1; k < n; ++k)
        row[static_cast<std::size_t>(k)] -= old[static_cast<std::size_t>(k - 1)];
    }
  }
  return result;
}

}  // namespace

std::vector<Problem> prove_problems() {
  constexpr int kDimension = 15;  // of so(6)
  const std::string medium = "(K + H0 + aa + bb + cc + ab)^4";
  const std::string large = "K^2*H0^2*aa*bb*cc*ab*(ab + ac)";
  std::vector<Problem> result = {
      kovalevskaya(),
      clebsch(),
      steklov(),
      integral_problem("Kovalevskaya in two fields, 12 variables", two_fields("K"), "r1*a3", 0.1),
      euler_angles(),
      andoyer(),
      manakov(),
      jacobi_problem("Jacobi, so(6)", kDimension, orthogonal(6)),
      jacobi_problem("Jacobi, so(6) in a dense basis", kDimension,
                     in_another_basis(orthogonal(6), kDimension)),
      integral_problem("a power in 12 variables", two_fields(medium), "a3", 50, Size::large),
      integral_problem("the same as one sum", two_fields(medium), "a3", 50, Size::giant),
      integral_problem("a product in 12 variables", two_fields(large), "a3", 500, Size::giant),
      integral_problem("the same as one sum", two_fields(large), "a3", 500, Size::giant),
  };
  result[result.size() - 3].flat = true;
  result.back().flat = true;
  return result;
}

}  // namespace casimir::test

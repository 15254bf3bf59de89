// Kovacic's decision against that of giac, where it is installed: 1,000 equations with planted
// solutions of every case, and 1,000 without.
#include <cln/rational_io.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <random>

#include "symbolic/obstruction/equation/kimura.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "tests/folder.hpp"
#include "tests/symbolic/obstruction/equation/riemann_equations.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

/// What a process prints.
std::string printed_by(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> part;
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), size);
  ::pclose(pipe);
  return text;
}

enum class Answer { solution, none, nothing };

/// Whether giac finds a Liouvillian solution of y'' = r y. It comes to no end of some equations.
Answer giac(const RationalFunction& r, const test::Folder& folder) {
  const std::string file =
      folder.write("equation.txt", fmt::format("kovacicsols(y''=y*({}));\n", r.text("x")));
  const std::string text = printed_by(fmt::format("timeout 1 giac '{}' 2>/dev/null", file));
  if (text.empty() || text.find("Error") != std::string::npos ||
      text.find("undef") != std::string::npos)
    return Answer::nothing;
  return text.starts_with("[]") ? Answer::none : Answer::solution;
}

bool has_giac() { return printed_by("command -v giac").find("giac") != std::string::npos; }

/// Of all cases: rational w, and pullbacks of Riemann's equation with dihedral, tetrahedral,
/// octahedral and icosahedral groups.
std::vector<RationalFunction> planted(std::size_t count) {
  const std::array<SquaredDifferences, 5> groups{{
      {over(1, 4), over(1, 4), over(1, 49)},
      {over(1, 4), over(1, 4), cl_RA(2)},
      {over(1, 4), over(1, 9), over(1, 9)},
      {over(1, 4), over(1, 9), over(1, 16)},
      {over(1, 4), over(1, 9), over(1, 25)},
  }};
  std::mt19937 random(41);
  const auto number = [&](int low, int high) {
    return cl_RA(std::uniform_int_distribution<int>(low, high)(random));
  };
  const Univariate z = Univariate::variable();
  std::vector<RationalFunction> result;
  while (result.size() < count) {
    if (result.size() % 2 == 0) {
      RationalFunction w(Univariate(std::vector<cl_RA>{number(-2, 2), number(0, 1)}));
      for (int i = 0; i < 2; ++i)
        w = w + RationalFunction(Univariate(number(-3, 3) / 2), z - Univariate(number(-4, 4)));
      if (!w.is_constant()) result.push_back(w.derivative() + w * w);
      continue;
    }
    const Univariate f = Univariate(number(1, 3)) * z + Univariate(number(-3, 3));
    const RationalFunction pull(
        f, result.size() % 4 == 1 ? Univariate(1) : z + Univariate(number(-3, 3)));
    if (!pull.is_constant())
      result.push_back(pulled_back(riemann(groups[result.size() / 2 % groups.size()]), pull));
  }
  return result;
}

/// Polynomials of odd degree, and Riemann's equations that Kimura's theorem excludes.
std::vector<RationalFunction> without(std::size_t count) {
  std::mt19937 random(42);
  const auto number = [&](int low, int high) {
    return cl_RA(std::uniform_int_distribution<int>(low, high)(random));
  };
  const Univariate z = Univariate::variable();
  std::vector<RationalFunction> result;
  while (result.size() < count) {
    if (result.size() % 4 == 0) {
      result.emplace_back(z.pow(3) + Univariate(number(-9, 9)) * z + Univariate(number(-9, 9)));
      continue;
    }
    SquaredDifferences s;
    for (cl_RA& square : s) square = number(1, 40) / number(2, 7);
    if (!kimura(s)) result.push_back(riemann(s));
  }
  return result;
}

struct Agreement {
  std::size_t same = 0, missed_by_giac = 0, unanswered = 0;
};

/// Every solution that giac finds is one here, and every one here obeys its equation.
Agreement compared(const std::vector<RationalFunction>& equations) {
  const test::Folder folder;
  Agreement result;
  for (const RationalFunction& r : equations) {
    const Answer theirs = giac(r, folder);
    const LiouvillianResult own = decide_liouvillian(r);
    EXPECT_NE(own.galois, GaloisCase::undecided) << r.text("x") << ": " << own.reason;
    const bool solved = own.galois != GaloisCase::sl2;
    if (solved) EXPECT_TRUE(solves_riccati(own.solution, r)) << r.text("x");
    if (theirs == Answer::solution) EXPECT_TRUE(solved) << r.text("x");
    if (theirs == Answer::nothing)
      ++result.unanswered;
    else if (solved == (theirs == Answer::solution))
      ++result.same;
    else
      ++result.missed_by_giac;
  }
  return result;
}

constexpr std::size_t kEquations = 1000;

TEST(KovacicAndGiac, AgreeOnPlantedSolutions) {
  if (!has_giac()) GTEST_SKIP() << "giac is not installed (Debian: xcas)";
  const Agreement found = compared(planted(kEquations));
  fmt::print(
      "{} agree, giac finds nothing for {} whose solution obeys its equation, no answer to {}\n",
      found.same, found.missed_by_giac, found.unanswered);
  EXPECT_GT(found.same, kEquations / 2);
}

TEST(KovacicAndGiac, AgreeWhereThereIsNone) {
  if (!has_giac()) GTEST_SKIP() << "giac is not installed (Debian: xcas)";
  const Agreement found = compared(without(kEquations));
  fmt::print("{} agree, no answer to {}\n", found.same, found.unanswered);
  EXPECT_EQ(found.missed_by_giac, 0U);
  EXPECT_GT(found.same, kEquations * 9 / 10);
}

}  // namespace
}  // namespace casimir::obstruction

// Matrices of families in expressions: traces, entries, commutators.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "symbolic/expression/indices.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/expression/reads_expressions.hpp"

namespace casimir::test {
namespace {

/// A and B of three rows, P of two, a skew M, a symmetric S, a vector x of twelve components.
class Matrices : public ReadsExpressions {
 protected:
  Matrices() : ReadsExpressions({"s", "t", "M12", "M13", "M23"}) {
    for (const std::string family : {"A", "B", "P"})
      for (int i = 1; i <= (family == "P" ? 2 : 3); ++i)
        for (int j = 1; j <= (family == "P" ? 2 : 3); ++j)
          declare(family + std::to_string(10 * i + j));
    for (const char* name : {"S11", "S12", "S22", "R11", "R12", "R13", "R21", "R22", "R23"})
      declare(name);
    for (int i = 1; i <= 12; ++i) declare("x" + std::to_string(i));
  }
  /// GiNaC's matrix of the same entries.
  GiNaC::matrix whole(const std::string& family, unsigned size = 3) {
    GiNaC::matrix result(size, size);
    for (unsigned i = 0; i < size; ++i)
      for (unsigned j = 0; j < size; ++j)
        result(i, j) = symbol(family + std::to_string(10 * (i + 1) + j + 1));
    return result;
  }
  GiNaC::matrix skew() {
    GiNaC::matrix result(3, 3);
    for (unsigned i = 0; i < 3; ++i)
      for (unsigned j = i + 1; j < 3; ++j) {
        result(i, j) = symbol("M" + std::to_string(10 * (i + 1) + j + 1));
        result(j, i) = -result(i, j);
      }
    return result;
  }
};

TEST_F(Matrices, AreThoseOfGiNaC) {
  const GiNaC::matrix A = whole("A"), B = whole("B"), M = skew();
  const GiNaC::ex s = symbol("s"), t = symbol("t");
  const std::pair<const char*, GiNaC::ex> same[] = {
      {"trace(A)", A.trace()},
      {"trace(A*B)", A.mul(B).trace()},
      {"trace((A + s*B)^3)", A.add(B.mul_scalar(s)).pow(3).trace()},
      {"trace(A^0)", 3},
      {"trace(-A^2*B)", -A.mul(A).mul(B).trace()},
      {"trace((-A)^2)", A.mul(A).trace()},
      {"trace(2*A - B/s)", 2 * A.trace() - B.trace() / s},
      {"trace((s + t)^2*A)", (s + t) * (s + t) * A.trace()},
      {"trace([A, B])", 0},
      {"trace([A, B]*A^2)", 0},
      {"trace([A, B]*M12)", 0},
      {"matrix(A*B)[2, 3]", A.mul(B)(1, 2)},
      {"matrix([A, B])[3, 1]", A.mul(B).sub(B.mul(A))(2, 0)},
      {"matrix(transpose(A)*B)[1, 2]", A.transpose().mul(B)(0, 1)},
      {"trace(skew(M)^2)", M.mul(M).trace()},
      {"trace(skew(M)*A*transpose(skew(M)))", -M.mul(A).mul(M).trace()},
      {"matrix(skew(M)*B)[3, 2]", M.mul(B)(2, 1)},
      {"trace(symmetric(S)^2)", GiNaC::pow(symbol("S11"), 2) + 2 * GiNaC::pow(symbol("S12"), 2) +
                                    GiNaC::pow(symbol("S22"), 2)},
      {"trace(P)*trace(A*trace(B))", whole("P", 2).trace() * A.trace() * B.trace()},
      {"sum(k, 1, 3, matrix(A)[k, k]) - trace(A)", 0},
      {"trace(P)^2 - trace(P^2) - 2*(P11*P22 - P12*P21)", 0},
      {"trace(sqrt(s)*A)", GiNaC::sqrt(s) * A.trace()},
      {"trace(A[1, 2]*B)", symbol("A12") * B.trace()},
      {"det(A)", A.determinant()},
      {"det(A*B) - det(A)*det(B)", 0},
      {"det(transpose(A) + s*B)", A.transpose().add(B.mul_scalar(s)).determinant()},
      {"det(t*A^0 - A)", -A.charpoly(t)},
      {"det(P)", symbol("P11") * symbol("P22") - symbol("P12") * symbol("P21")},
      {"det(skew(M))", 0},
      {"det(A - A)", 0},
      {"det(2*A^0)", 8},
  };
  for (const auto& [text, wanted] : same)
    EXPECT_TRUE((parse(text) - wanted).expand().is_zero()) << text << " is " << parse(text);
}

TEST_F(Matrices, WhatIsNoMatrixAlgebraIsRefusedWithItsPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {"A", "1: 'A' is not declared"},
      {"trace(s)", "1: trace is of a matrix, and this is a number"},
      {"trace(A + 1)", "9: a matrix and a number are added"},
      {"trace(1 - A)", "9: a matrix and a number are added"},
      {"trace(A*P)", "8: matrices of 3 and 2 rows are multiplied"},
      {"trace(A - P)", "9: matrices of 3 and 2 rows are added"},
      {"trace(1/A)", "8: this divides by a matrix"},
      {"trace(A/(s - s))", "8: division by zero"},
      {"trace(A^(-1))", "9: a power of a matrix has to be an integer"},
      {"trace(A^s)", "9: a power of a matrix has to be an integer"},
      {"trace(A^(1/2))", "9: a power of a matrix has to be an integer"},
      {"trace(s^A)", "9: 'A' is not declared"},
      {"trace(sin(A))", "11: 'A' is not declared"},
      {"trace(R)", "7: the matrix 'R' has no entry R31"},
      {"trace(x)", "7: 'x' is a vector, and no matrix"},
      {"trace([A, s])", "7: a commutator [A, B] is of two matrices"},
      {"trace(skew(A + B))", "14: unexpected '+'"},
      {"trace(skew(x))", "12: 'x' is a vector, and no matrix"},
      {"det(s)", "1: det is of a matrix, and this is a number"},
      {"det(R)", "5: the matrix 'R' has no entry R31"},
      {"det(A", "6: unexpected end"},
      {"matrix(A)", "10: unexpected end"},
      {"matrix(A)[1]", "12: unexpected ']'"},
      {"matrix(A)[4, 1]", "11: the matrix has the rows and columns 1 to 3"},
      {"matrix(A)[1, 0]", "14: the matrix has the rows and columns 1 to 3"},
      {"trace(A", "8: unexpected end"},
      {"trace(A B)", "9: unexpected 'B'"},
      {"trace(A^100000)", "9: the degree here exceeds"},
      {"A*B", "1: 'A' is not declared"},
  };
  expect_errors(wrong);
  std::string brackets = "s";
  for (int i = 0; i < 90; ++i) brackets = "(" + brackets + ")";
  EXPECT_TRUE((parse("trace(" + brackets + "*A)") - parse("s*trace(A)")).expand().is_zero());
}

TEST_F(Matrices, ANameOfTheCaseComesFirst) {
  declare("trace");
  EXPECT_TRUE(error_of("trace(A)").find("write products with '*'") != std::string::npos ||
              error_of("trace(A)").starts_with("6: unexpected"))
      << error_of("trace(A)");
}

/// Of fifteen rows: the limits hold, and zeros cost nothing.
TEST_F(Matrices, DeterminantsAreHeldToTheLimits) {
  constexpr long kRows = 15;
  GiNaC::ex product = 1;
  for (long i = 1; i <= kRows; ++i) {
    for (long j = 1; j <= kRows; ++j) {
      declare(indexed_name("Q", {i, j}));
      const std::string name = indexed_name("D", {i, j});
      if (i == j) {
        declare(name);
        product *= symbol(name);
      } else {
        names_.add(name, Quantity{0});
      }
    }
  }
  EXPECT_NE(error_of("det(Q)").find("more than"), std::string::npos) << error_of("det(Q)");
  EXPECT_TRUE((parse("det(D)") - product).expand().is_zero());
}

TEST_F(Matrices, PartsOfEntriesThatCancelAreKept) {
  const GiNaC::symbol x("x"), one("one");
  Quantity entry = Quantity::symbol(x);
  entry.parts = std::make_shared<const std::vector<GiNaC::ex>>(std::vector{GiNaC::ex(log(x))});
  names_.add("C11", entry);
  const Quantity zero =
      parse_expression({"trace(C) - trace(C)", {"test", 1, 1}, "trace(C) - trace(C)"}, names_);
  EXPECT_TRUE(zero.value.is_zero());
  ASSERT_EQ(lost_parts(zero).size(), 1U);
  EXPECT_TRUE(lost_parts(zero).front().is_equal(log(x)));
}

/// The full lattice of Toda in n^2/2 variables: L' = [L, B] with the skew part B of L.
TEST(MatricesOfCases, TheTracesOfALaxMatrixAreProved) {
  const Model model = model_of(R"toml(
[phase_space]
variables = ["S[i=1..n, j=i..n]"]
[definitions]
n = 3
[equations]
"S[i=1..n, j=i..n]" = "matrix([skew(S), symmetric(S)])[i, j]"
[integrals]
"F[k=1..n]" = "trace(symmetric(S)^k)/k"
wrong = "trace(skew(S)^2)"
)toml");
  std::map<std::string, Verdict> verdicts;
  for (const Proof& proof : prove(model)) verdicts[proof.name] = proof.verdict;
  for (const char* name : {"F1", "F2", "F3"}) EXPECT_EQ(verdicts.at(name), Verdict::proved) << name;
  EXPECT_EQ(verdicts.at("wrong"), Verdict::refuted);
}

}  // namespace
}  // namespace casimir::test

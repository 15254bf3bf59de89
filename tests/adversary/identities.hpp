#pragma once

#include <string>
#include <vector>

#include "tests/adversary/expression.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// What identities are made of: symbols that may have any real value, and such that are positive by
/// an assumption of the case.
struct Atoms {
  std::vector<Expr> reals, positives{};
};

/// Where two expressions are equal.
enum class Equal {
  everywhere,  ///< wherever both have real values
  partly,      ///< on an open set, and not on another one
  nowhere,     ///< on no open set
};

/// Two expressions and where they are equal, known from the theorem they were made by.
struct Disguise {
  std::string family;  ///< as "half-angle"
  Expr left, right;
  Equal equal = Equal::everywhere;
  Expr difference() const { return left - right; }
};

/// A true identity of real functions, about random expressions of the atoms.
Disguise true_identity(Random& random, const Atoms& atoms);
/// One that holds on one branch only, as sqrt(x^2) = x.
Disguise wrong_branch(Random& random, const Atoms& atoms);
/// A true one with one number changed.
Disguise broken_identity(Random& random, const Atoms& atoms);
/// One of the three.
Disguise disguise(Random& random, const Atoms& atoms, Equal equal);

/// A random expression of the atoms that is real at every real point.
Expr real_expression(Random& random, const Atoms& atoms);
/// The same, and positive.
Expr positive_expression(Random& random, const Atoms& atoms);
/// A number other than zero.
Expr small_number(Random& random);
/// A product of powers of some of the expressions, with a coefficient.
Expr monomial(Random& random, const std::vector<Expr>& factors);

}  // namespace casimir::adversary

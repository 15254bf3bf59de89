#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "codegen/dag/expression_dag.hpp"

namespace casimir::codegen {

/// variable ^ exponent, exponent >= 1.
struct VariablePower {
  int variable;
  int exponent;
  friend auto operator<=>(const VariablePower&, const VariablePower&) = default;
};

/// Sorted by variable; empty is 1.
using Monomial = std::vector<VariablePower>;

struct Term {
  cln::cl_RA coefficient;
  Monomial monomial;
};

using Polynomial = std::vector<Term>;

/// A quantity of a TermSystem: an input, a function of other variables, or a polynomial.
struct Variable {
  enum class Kind {
    input,  ///< input number `input`
    pi,
    function,    ///< `function` of `arguments`; Op::div is 1/argument, Op::pow has `exponent`
    polynomial,  ///< `value`
  };
  Kind kind = Kind::input;
  int input = -1;
  Op function = Op::input;
  std::vector<int> arguments;
  cln::cl_RA exponent = 1;
  Polynomial value;
  bool constant = false;  ///< free of inputs
};

/// Definitions in which every sum is a sum of products: what the factoring passes work on.
/// A variable may refer to variables of any index, never to itself through others.
struct TermSystem {
  std::size_t inputs = 0;  ///< variables 0 .. inputs-1 are the inputs
  std::vector<Variable> variables;
  std::vector<int> outputs;  ///< indices of polynomial variables

  int add(Variable variable);
};

/// The expressions as they are structured, with one variable for each sum that is a factor or an
/// argument. Input i is symbol i of the Dag.
TermSystem system_of(const Dag& dag, std::size_t inputs, const std::vector<Scaled>& outputs);

/// The same outputs with products of sums multiplied out, except inside functions, roots and
/// denominators. Nothing if that takes more than `limit` terms in all.
std::optional<TermSystem> expanded(const TermSystem& system, std::size_t limit);

/// One variable of a system multiplied out like that.
std::optional<Polynomial> expanded_value(const TermSystem& system, int variable, std::size_t limit);

/// The outputs of an expansion with k cos(u)^2 + k sin(u)^2 = k, and the same of cosh and sinh.
TermSystem with_squares_joined(TermSystem system);

/// The outputs of an expansion, as far as that takes fewer terms, with the sums of the system as
/// factors again: p^2 - 2 p q + q^2 + p - q is r^2 + r with r = p - q. Where the sum is small a
/// power of it that is multiplied out has lost its digits.
/// \param limit  the most terms of a sum.
TermSystem with_sums_taken_out(TermSystem system, std::size_t limit);

/// Whether an output has a square or a higher power of a sum in it.
bool has_power_of_sum(const TermSystem& system);

/// Whether one term is written before the other: of higher degree first, then by the order of the
/// variables.
bool comes_before(const Monomial& a, const Monomial& b);

/// Substitutes polynomials that are used once, as a plain term of a sum.
TermSystem flattened(TermSystem system);

/// Sums that are factors, made larger by numbers that save multiplications: 1/10*(10*x + 1) is
/// x + 1/10.
TermSystem rescaled(TermSystem system);

/// Whether a number is so large or so small that doubles do not have it, or hardly.
bool beyond_range(const cln::cl_RA& number);

/// The same with numbers that doubles have, as far as they belong to a power: of (u + 2000)^2000
/// times 2000^(-2000), which is how GiNaC writes (u/2000 + 1)^2000, this. Another power than a
/// whole one is left a factor.
TermSystem within_range(TermSystem system);

/// A product of two monomials.
Monomial multiply(const Monomial& a, const Monomial& b);

}  // namespace casimir::codegen

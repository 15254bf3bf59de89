#pragma once

#include <cln/rational.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// A Kovalevskaya exponent, or all roots of one irreducible polynomial.
struct Exponent {
  /// What kind of number it is.
  enum class Kind {
    integer,
    rational,    ///< not an integer
    parametric,  ///< a rational function of parameters, or a root of a polynomial with them
    algebraic,   ///< a root of an irreducible polynomial of degree 2 or more
    numeric,     ///< no minimal polynomial was found
  } kind = Kind::integer;
  std::string text;      ///< the number, or the polynomial in `rho` that has it as a root
  bool is_root = false;  ///< whether the text is a polynomial
  /// Whether a parametric one has roots of numbers only, as sqrt(2), and is not rational.
  bool is_irrational = false;
  cln::cl_RA value = 0;  ///< of integer and rational ones
  unsigned long multiplicity = 1;
  /// Where they cannot be told apart over the rationals, the number of solutions of the balance's
  /// relations that have them together; else 1: each has them so many times.
  unsigned long solutions = 1;
  std::vector<std::pair<double, double>> values;  ///< of algebraic numbers: real, imaginary part
};

/// A solution x_i = c_i (t - t0)^(-g_i) of the quasi-homogeneous equations, or a family of them.
struct Balance {
  std::vector<std::pair<std::string, std::string>> coefficients;  ///< of every coordinate
  std::vector<bool> is_nonzero;        ///< of an exact one: each coefficient, in general
  std::vector<std::string> relations;  ///< that free coefficients and algebraic numbers obey
  std::vector<std::string> free;       ///< coefficients that are arbitrary
  std::size_t family = 0;              ///< of a numeric one: the dimension of its family
  std::vector<Exponent> exponents;
  bool decided = true;
};

/// The leading terms of the rates with numbers for all coefficients.
struct LeadingSystem {
  /// A monomial.
  struct Term {
    double coefficient;
    std::vector<unsigned long> exponents;  ///< of each coordinate
  };
  std::vector<std::string> names;
  std::vector<double> weights;
  std::vector<std::vector<Term>> rates;
};

/// Weights, balances, and what follows from the exponents.
struct ExponentReport {
  std::vector<std::pair<std::string, std::string>> weights;  ///< g_i, rational
  std::vector<std::string> left_out;  ///< terms of lower weight, which do not decide
  std::vector<Balance> balances;
  bool complete = false;
  std::string reason;
  std::vector<std::string> generic;      ///< parameters with generic values
  std::optional<LeadingSystem> leading;  ///< where there are no parameters, and all is real
  std::vector<std::string> conclusions;  ///< with the theorem used
};

/// Balances and Kovalevskaya exponents of the equations of motion.
///
/// The coefficients are in the field of the parameters with the functions of them that occur, as
/// sqrt(2), I or sin(a): what these obey, sqrt(2)^2 = 2, is used wherever something is divided by,
/// or taken not to be zero. Where it is not known that they obey nothing else, there is no answer.
/// \param weights  name and weight; if empty, the weights are found for which most terms count.
/// \throws ModelError  where no weights make the equations quasi-homogeneous
ExponentReport kovalevskaya_exponents(const Model& model,
                                      const std::vector<std::pair<Text, Text>>& weights,
                                      const Watch& watch = {});

/// The same without the balances.
ExponentReport leading_terms(const Model& model, const std::vector<std::pair<Text, Text>>& weights);

}  // namespace casimir::search

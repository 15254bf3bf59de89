#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// A Kovalevskaya exponent, or all roots of one irreducible polynomial.
struct Exponent {
  enum class Kind {
    integer,
    rational,    ///< not an integer
    parametric,  ///< a rational function of parameters
    algebraic,   ///< a root of an irreducible polynomial of degree 2 or more
    numeric,     ///< no minimal polynomial was found
  } kind = Kind::integer;
  std::string text;  ///< the number, or the polynomial in `rho` that has it as a root
  unsigned long multiplicity = 1;
  std::vector<std::pair<double, double>> values;  ///< of algebraic numbers: real, imaginary part
};

/// A solution x_i = c_i (t - t0)^(-g_i) of the quasi-homogeneous equations, or a family of them.
struct Balance {
  std::vector<std::pair<std::string, std::string>> coefficients;  ///< of every coordinate
  std::vector<std::string> relations;  ///< that free coefficients and algebraic numbers obey
  std::vector<std::string> free;       ///< coefficients that are arbitrary
  std::vector<Exponent> exponents;
  bool decided = true;
};

struct ExponentReport {
  std::vector<std::pair<std::string, std::string>> weights;  ///< g_i, rational
  std::vector<std::string> left_out;  ///< terms of lower weight, which do not decide
  std::vector<Balance> balances;
  bool complete = false;
  std::string reason;
  std::vector<std::string> conclusions;  ///< with the theorem used
};

/// Balances and Kovalevskaya exponents of the equations of motion.
/// \param weights  name and weight; if empty, the weights are found for which most terms count.
/// \throws ModelError  where no weights make the equations quasi-homogeneous
ExponentReport kovalevskaya_exponents(const Model& model,
                                      const std::vector<std::pair<Text, Text>>& weights,
                                      const Watch& watch = {});

}  // namespace casimir::search

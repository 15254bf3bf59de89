#pragma once

#include <compare>
#include <set>
#include <string>
#include <vector>

#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir::codegen {

/// One series l times another r, as a kernel sums it. A weighted operand has j times its
/// coefficient j.
struct SeriesSum {
  std::string left, right;
  bool weighted;
  friend auto operator<=>(const SeriesSum&, const SeriesSum&) = default;
};

/// What holds a value in the text of a kernel.
enum class SeriesValue : unsigned char {
  number,  ///< of one trajectory
  lanes    ///< a number for each of several trajectories
};

/// The recurrences of a program's Taylor coefficients as statements, in two passes over the
/// program: the values at a state, which stay as members (`v3`), and coefficient k of the same
/// quantities
/// (`v3_k`).
struct SeriesRecurrences {
  std::vector<std::string> inputs;        ///< names of the states, the parameters and the time
  std::size_t states;                     ///< how many of them are states
  std::set<std::size_t> used_parameters;  ///< places among the inputs
  bool uses_time = false;
  /// Whether the rates are polynomials of the states of a degree so low that the series of a
  /// solution shows all of their terms: no other operation, and no time.
  bool smooth = false;
  std::string members;          ///< names, with commas
  std::string begin, next;      ///< statements of the two passes
  std::vector<SeriesSum> sums;  ///< `sum_[i]`, which `next` reads
  std::vector<std::string> rates, next_rates;

  /// The members of the struct, as a declaration's names: inputs that are used, and values.
  std::string declared() const;
};

/// \param names  for each input of the program, the name of its local; the last is the time.
/// \param limits  of the constants, see `constant_value`
SeriesRecurrences series_recurrences(const Program& rhs, const std::vector<std::string>& names,
                                     SeriesValue value, const Limits& limits);

}  // namespace casimir::codegen

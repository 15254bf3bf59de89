#pragma once

#include <cln/rational.h>

#include <array>
#include <string>
#include <vector>

namespace casimir {

// What an enclosure writes down so that others can verify it. Every number is a text such as
// "-0x1b3p-52", a whole number in base 16 times a power of two, and so exact.

/// A set of states m + C s + B r, where s is what the run began with: see `Doubleton` in
/// runtime/validated.
struct TracedSet {
  std::vector<std::string> middle;   ///< m
  std::vector<std::string> carried;  ///< C, row after row; none where the start is a point
  std::vector<std::string> frame;    ///< B, row after row
  std::vector<std::string> rest;     ///< for each coordinate r the bound of its size
};

/// A step, and the set that it ends in.
struct TracedStep {
  std::string length;        ///< of the last step about: it takes what is left of the duration
  int room = 0;              ///< the rough enclosure leaves 2^room beside the Taylor polynomial
  std::vector<int> columns;  ///< for each integral the coordinate of r that it bounds, or -1
  TracedSet after;           ///< where the flow takes the set before to
};

/// A run, step by step.
struct RunTrace {
  int order = 0;                    ///< of the Taylor polynomials
  long bits = 53;                   ///< of the numbers of the run
  std::vector<std::string> middle;  ///< of the set at the start
  std::vector<std::string> off;     ///< by how much the start may be off that, in each state
  std::vector<TracedStep> steps;    ///< in their order; the last one ends at the duration
  std::vector<std::array<std::string, 2>> end;  ///< for each state the ends of an interval
};

/// Whether a text is a number of a trace, of a size that can be computed with.
bool is_traced_number(const std::string& text);
/// Its value. \throws std::invalid_argument  for what is none.
cln::cl_RA traced_number(const std::string& text);
/// The text of a double, exactly; it has to be finite.
std::string traced_text(double value);

}  // namespace casimir

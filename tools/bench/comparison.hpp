#pragma once

#include <array>
#include <string>
#include <vector>

#include "tools/analysis/benchmark/method_comparison.hpp"

namespace casimir::tools {

/// The errors at which contenders are compared, besides the best that each reaches.
inline constexpr std::array kErrorLevels{1e-3, 1e-6, 1e-9, 1e-12};

/// The time of one contender for an error, and how many times as long that is as the fastest of
/// our own methods takes on specialised code. Not numbers where that error is not reached.
struct Cell {
  double error = 0;
  double seconds = 0, ratio = 0;
  std::string fastest;  ///< of ours there; empty: none of them reaches it
  double fastest_seconds = 0;
};

/// A contender at every level and at its best.
struct Line {
  ComparedMethod contender;
  std::vector<Cell> levels;  ///< one for each of kErrorLevels
  Cell best;                 ///< at the smallest error that it reaches
};

/// One for each contender that has a good row.
std::vector<Line> equal_error_lines(const MethodComparison& contest);

/// How many times as long the general code of a method takes as its specialised code.
struct CodeLine {
  std::string method;
  std::vector<double> ratios;  ///< one for each of kErrorLevels
};
std::vector<CodeLine> code_lines(const MethodComparison& contest);

/// The ratios of one library's method over several cases, at one level or at its best errors.
struct Mean {
  std::string peer = {};
  bool at_best = false;
  double error = 0;  ///< unless `at_best`
  double ratio = 0;  ///< geometric mean; not a number where no case has one
  int cases = 0;     ///< that it is a mean of
  double least = 0;
  std::string least_case = {};
};
std::vector<Mean> means(const std::vector<MethodComparison>& contests);

/// "X: taylor is 2.1 times as fast at 1e-06, 5.0 at 1e-12, ..", one for each method
/// of another library.
std::vector<std::string> sentences(const MethodComparison& contest);

/// How much small changes of the state grow along the run.
std::string growth_sentence(const MethodComparison& contest);

}  // namespace casimir::tools

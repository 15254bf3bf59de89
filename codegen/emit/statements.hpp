#pragma once

#include <string>
#include <vector>

#include "codegen/emit/number_literal.hpp"
#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir::codegen {

/// How a program is written as the body of a function.
struct StatementStyle {
  Scalar scalar = Scalar::real64;
  std::string real = "double";        ///< the type of the locals
  std::string call_prefix = "std::";  ///< before sin, sqrt, ..
  std::string call_suffix;            ///< behind them: "q" for __float128
  bool c_casts = false;               ///< (double)(2) instead of double(2)
  std::string indent = "  ";
  Limits limits{};  ///< of the numbers in it, see `constant_value`
};

/// The statements of a program: the inputs it uses as named locals, shared values as t1, t2, ..
/// with a note where they are used, then one assignment for each output with its name as a comment.
/// Values that are used once stand where they are used, with the parentheses that C++ needs to
/// compute in the order of the program and no others. Lines have at most 100 columns.
/// \param sources  for each input, the expression that holds it, e.g. "x[0]".
/// \param names  for each input, the name of its local; equal to the source: no local.
/// \param targets  for each output, what is assigned, e.g. "dx[0]".
std::string statements(const Program& program, const std::vector<std::string>& sources,
                       const std::vector<std::string>& names,
                       const std::vector<std::string>& targets, const StatementStyle& style);

/// Which inputs some output depends on.
std::vector<bool> used_inputs(const Program& program);

/// Whether the program calls a function of the mathematical library, or a square root.
bool calls_functions(const Program& program);

/// `text` broken after `width` columns where C++ allows it, continued with deeper indentation.
std::string wrapped(const std::string& text, std::size_t width = 100);

/// `text` as lines of a `//` comment, filtered by comment_text and broken at spaces.
std::string comment_lines(const std::string& text, const std::string& indent = "");

}  // namespace casimir::codegen

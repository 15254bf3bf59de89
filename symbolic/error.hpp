#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace casimir {

struct Limits;

/// Where a piece of text stands: a file (or "command line"), and its line and column from 1.
/// Line 0 means that only the file is known.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Bad input. `what()` is the whole message: `FILE:LINE:COLUMN: error: TEXT`, the offending line
/// with a mark below the place, and a hint where there is one.
class CaseError : public std::runtime_error {
 public:
  /// \param text  what is wrong and what was expected, without a full stop.
  /// \param excerpt  the source line in which `where.column` points, or empty.
  /// \param hint  for instance "did you mean 'M3'?", or empty.
  /// \param limit  the one that the input exceeds, or null.
  CaseError(Location where, std::string text, std::string excerpt = {}, std::string hint = {},
            double Limits::*limit = nullptr);

  /// The place.
  const Location& where() const { return where_; }
  /// What is wrong, without the place.
  const std::string& text() const { return text_; }
  /// As it was given, or empty.
  const std::string& hint() const { return hint_; }
  /// The limit that the input exceeds, of which the hint says how to raise it; else null.
  double Limits::*limit() const { return limit_; }

 private:
  Location where_;
  std::string text_, hint_;
  double Limits::*limit_;
};

/// A mathematical object that cannot be made: brackets of the wrong number, a repeated coordinate.
class ModelError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An expression that has a value nowhere: it divides by what is identically zero, or takes the
/// logarithm of it. That is known of the expression; no other ModelError says anything of values.
class NoValue : public ModelError {
  using ModelError::ModelError;
};

/// An expression that exact algebra cannot treat within the limits of this program.
class TooLarge : public ModelError {
 public:
  using ModelError::ModelError;
  /// Beyond a limit that can be raised.
  /// \param text  what is too large; behind it stands how to raise the limit
  TooLarge(const std::string& text, const Limits& limits, double Limits::*limit);

  /// The limit that can be raised; else null.
  double Limits::*limit() const { return limit_; }

 private:
  double Limits::*limit_ = nullptr;
};

/// A point that other variables cannot describe, as the vertical axis in Euler angles.
class SingularPoint : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The name in `known` that is nearest to `name`, as "did you mean 'X'?", or empty if none is near.
std::string suggest(const std::string& name, const std::vector<std::string>& known);

/// The same, only for a name in `known` that differs in upper and lower case and in '_' and '-'.
std::string same_but_for_case(const std::string& name, const std::vector<std::string>& known);

/// `suggest`, and where no name is near, the first of those that there are: "known: a, b, c".
std::string suggest_or_list(const std::string& name, const std::vector<std::string>& known,
                            const std::string& what = "known");

/// `text` with control characters, invisible ones, those that change the direction of writing, and
/// invalid UTF-8 escaped, cut to `limit` characters: what a message may show of text that a
/// stranger wrote.
std::string printable(const std::string& text, std::size_t limit = 60);

/// `text` with tabs and ends of lines as spaces, byte for byte.
std::string flat(std::string text);

/// All of `text` on one line, and printable.
std::string one_line(const std::string& text);

}  // namespace casimir

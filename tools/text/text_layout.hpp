#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace casimir::tools {

/// How many columns UTF-8 text takes (one a code point).
std::size_t display_width(const std::string& text);

/// `text` with spaces up to `width` columns: on its right, or on its left with `right_aligned`.
std::string padded(const std::string& text, std::size_t width, bool right_aligned = false);

/// Lines of at most `width` columns, broken at spaces but not in "M1 = 2", and a longer word where
/// the line ends. At least one line.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

/// The columns of the terminal that standard output is (at least 60), or 100 where it is none.
std::size_t output_width();

}  // namespace casimir::tools

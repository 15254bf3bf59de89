#pragma once

// What people write who come from LaTeX, from Python or from a book, where it has one meaning only.
// What has several, as products without a sign, is refused with a hint: spelling.hpp.

#include <string>
#include <string_view>

namespace casimir {

class Scope;
struct Quantity;

/// The letters of a LaTeX command, `frac` of `\frac`, that starts at the backslash at `at`; empty
/// where none does.
std::string_view latex_command(std::string_view text, std::size_t at);

/// The length of what is only for the eye in LaTeX, `\,` `\;` `\!` `\quad` `\left` `\right`; else
/// 0.
std::size_t latex_space(std::string_view text, std::size_t at);

/// The function or constant of this language under a name that is usual for it elsewhere, `log` for
/// `ln`, `asin` for `arcsin`, `Pi` for `pi`; the word itself where there is none.
std::string usual_name(const std::string& word);

/// What a name with a subscript stands for, M1 for `M_1`, where no name is written so; or null.
const Quantity* find_with_subscript(const std::string& word, Scope& names);

/// The name that begins at `at`, as it is written, but `M_{1}` as M_1; `at` goes on behind it.
std::string read_name(const std::string& text, std::size_t& at, std::size_t end);

/// The character that stands at `at`, a UTF-8 sequence.
std::string utf8_character(const std::string& text, std::size_t at, std::size_t end);

}  // namespace casimir

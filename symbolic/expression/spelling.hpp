#pragma once

// What people write who come from LaTeX, from other languages or from a book: how it is written
// here. Only for hints: nothing of it is ever accepted.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace casimir {

/// A function or constant under a name that it has elsewhere, as "did you mean 'log'?" for `ln`
/// and "sec(x) is written 1/cos(x)" for `sec`; empty for a name that no other notation has.
std::string spelling_of_name(std::string_view name);

/// A character that stands for something in print, as "'·' is written *"; empty for one that does
/// not. `character` is one UTF-8 sequence.
std::string spelling_of_character(std::string_view character);

/// What the ASCII character at `at` means to people who write it where no expression has it, as
/// "decimals have a point: 1.5" for the comma of `1,5`; empty for one that has no other meaning.
std::string spelling_of_sign(std::string_view text, std::size_t at);

/// For the first LaTeX command in `text`, a backslash and a word, as "\frac{a}{b} is written
/// (a)/(b)"; empty where there is none. TOML reads \f and its like in a string as control
/// characters, so what is searched is the line of the file.
std::string spelling_of_latex(std::string_view text);

/// A word that is several of the `known` names in a row, as "did you mean 'M1*g1'?"; else empty.
std::string product_of_names(const std::string& word, const std::vector<std::string>& known);

}  // namespace casimir

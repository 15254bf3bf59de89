#pragma once

// What people write who come from LaTeX, from other languages or from a book: how it is written
// here. Only for hints: what is accepted as it stands is in notation.hpp.

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

/// What to do where TOML has read the beginning of a LaTeX command as a control character, the \f
/// of \frac between double quotes; empty where it has not.
/// \param value    the text as it was read
/// \param written  the line of the file
std::string spelling_of_escape(std::string_view value, std::string_view written);

/// A word that is several of the `known` names in a row, as "did you mean 'M1*g1'?"; else empty.
std::string product_of_names(const std::string& word, const std::vector<std::string>& known);

/// What may have been meant by the name of a function that there is not.
std::string hint_for_function(const std::string& word);

/// The same of any other name. \param known  those that are declared
std::string hint_for_name(const std::string& word, std::vector<std::string> known);

}  // namespace casimir

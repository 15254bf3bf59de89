#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace casimir {

/// The line of a key such as `a.b.c` with more parts than any case file needs. The TOML library
/// makes a table of each part and takes them apart by recursion: a million of them overflow the
/// stack.
std::optional<int> line_of_deep_key(const std::string& toml);

/// The keys of a case file that stand outside all tables, and those of its tables.
const std::vector<std::string>& root_keys();

/// For a key of the whole file that stands in a table: what to do about it. Empty for other keys.
std::string root_key_hint(std::string_view key);

/// For a line of TOML that cannot be read at `column`: what to put in quotes, as "M1 = \"3/5\"".
/// Empty where no value without quotes is to blame.
std::string unquoted_hint(std::string_view line, std::size_t column);

}  // namespace casimir

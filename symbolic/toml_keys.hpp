#pragma once

#include <optional>
#include <string>

namespace casimir {

/// The line of a key such as `a.b.c` with more parts than any case file needs. The TOML library
/// makes a table of each part and takes them apart by recursion: a million of them overflow the
/// stack.
std::optional<int> line_of_deep_key(const std::string& toml);

}  // namespace casimir

#pragma once

#include <string_view>

namespace casimir {

/// The text of a header that generated modules are compiled with, by its path from the root of the
/// source tree. Made at build time from the files themselves: one source of truth.
/// \throws std::out_of_range  for a file that is not among them.
std::string_view embedded_file(std::string_view path);

}  // namespace casimir

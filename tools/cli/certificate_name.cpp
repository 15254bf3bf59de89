#include "tools/cli/certificate_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {

void check_certificate_name(const std::string& path) {
  const std::filesystem::path file(path);
  const std::string stem = file.stem().string();
  const bool identifier = !stem.empty() &&
                          (std::isalpha(static_cast<unsigned char>(stem[0])) != 0) &&
                          std::all_of(stem.begin(), stem.end(), [](char c) {
                            return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
                          });
  if (file.extension() != ".v" || !identifier) {
    throw UsageError(fmt::format(
        "'{}': the name of a certificate is a letter, then letters, digits and '_', and ends in .v",
        printable(path, 200)));
  }
}

}  // namespace casimir::tools

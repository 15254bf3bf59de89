#include "tools/cli/options/choices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "symbolic/error.hpp"

namespace casimir::tools {

std::string none_of_them(const std::string& given, const std::vector<std::string>& names) {
  const std::string near = suggest(given, names);
  return fmt::format("'{}' is none of {}{}", printable(given), fmt::join(names, ", "),
                     near.empty() ? "" : "; " + near);
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  const auto check = [names](std::string& text) {
    return std::ranges::count(names, text) != 0 ? std::string{} : none_of_them(text, names);
  };
  return {check, fmt::format("{{{}}}", fmt::join(names, ",")), ""};
}

}  // namespace casimir::tools

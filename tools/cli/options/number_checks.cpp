#include "tools/cli/options/number_checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "symbolic/error.hpp"

namespace casimir::tools {
namespace {

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* first = text.data();
  const char* const last = first + text.size();
  if (first != last && *first == '+') ++first;
  const auto [end, problem] = std::from_chars(first, last, value);
  if (problem != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string complaint(const std::string& text, const char* expected) {
  return fmt::format("expected {} such as 0.01 or 1e-9, not '{}'", expected, printable(text));
}

}  // namespace

CLI::Validator positive_number() {
  return CLI::Validator(
      [](std::string& text) {
        const std::optional<double> value = number_in(text);
        return value && *value > 0 ? std::string() : complaint(text, "a number above 0");
      },
      "");
}

CLI::Validator count_from_one() {
  return CLI::Validator(
      [](std::string& text) {
        const bool digits = !text.empty() && text.find_first_not_of("0123456789") == text.npos;
        return digits && text.find_first_not_of('0') != text.npos
                   ? std::string()
                   : fmt::format("expected a whole number from 1 on, not '{}'", printable(text));
      },
      "");
}

CLI::Validator number_from_zero() {
  return CLI::Validator(
      [](std::string& text) {
        const std::optional<double> value = number_in(text);
        return value && *value >= 0 ? std::string() : complaint(text, "0 or a number above it");
      },
      "");
}

}  // namespace casimir::tools

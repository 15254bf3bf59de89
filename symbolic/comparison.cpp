#include "symbolic/comparison.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace casimir {
namespace {

using Sign = std::pair<Comparison, const char*>;

constexpr std::array<Sign, 6> kSigns = {{{Comparison::unequal, "!="},
                                         {Comparison::equal, "=="},
                                         {Comparison::less, "<"},
                                         {Comparison::at_most, "<="},
                                         {Comparison::greater, ">"},
                                         {Comparison::at_least, ">="}}};

}  // namespace

std::string to_string(Comparison comparison) {
  return std::ranges::find(kSigns, comparison, &Sign::first)->second;
}

std::optional<Comparison> comparison_of(const std::string& sign) {
  if (sign == "=") return Comparison::equal;
  const auto* const found =
      std::ranges::find_if(kSigns, [&](const Sign& known) { return sign == known.second; });
  return found == kSigns.end() ? std::nullopt : std::optional(found->first);
}

bool holds(Comparison comparison, int sign) {
  switch (comparison) {
    case Comparison::unequal:
      return sign != 0;
    case Comparison::equal:
      return sign == 0;
    case Comparison::less:
      return sign < 0;
    case Comparison::at_most:
      return sign <= 0;
    case Comparison::greater:
      return sign > 0;
    case Comparison::at_least:
      return sign >= 0;
  }
  return false;
}

}  // namespace casimir

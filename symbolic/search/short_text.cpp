#include "symbolic/search/short_text.hpp"

#include <fmt/format.h>

namespace casimir::search {

std::string short_text(const FunctionRing& ring, const Polynomial& p) {
  std::string result;
  const auto factors = p.factors();  // the number first
  for (const auto& [factor, exponent] : factors) {
    if (factor.is_constant()) {
      const std::string text = ring.text(factor);
      if (text != "1") result = text == "-1" ? "-" : text;
      continue;
    }
    std::string text = ring.text(factor);
    const bool alone = factors.size() == 2 && exponent == 1 && result.empty();
    if (factor.terms() > 1 && !alone) text = "(" + text + ")";
    if (exponent > 1) text += fmt::format("^{}", exponent);
    result += (result.empty() || result == "-" ? "" : "*") + text;
  }
  return result;
}

}  // namespace casimir::search

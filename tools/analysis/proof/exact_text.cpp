#include "tools/analysis/proof/exact_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace casimir {

std::string exact_text(long double value) {
  const auto near = static_cast<double>(value);
  const bool fits = std::isfinite(near) && (near != 0 || value == 0);
  return fits ? exact_text(near) : fmt::format("{:.17g}", value);
}

std::string exact_text(double value) { return fmt::format("{:.17g}", value); }

}  // namespace casimir

#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "tools/analysis/run/validated.hpp"
#include "tools/text/runs/outward_decimals.hpp"

namespace casimir::tools {

/// A finished enclosure, and all that a report says of it.
struct EnclosureReport {
  const ValidatedMotion& motion;
  std::optional<int> digits;  ///< asked for
  double seconds = 0;         ///< with the proofs of the integrals

  /// Up to when the solutions are enclosed; of an irrational end the next decimal below.
  std::string time() const;
  std::string advice() const;
};

nlohmann::ordered_json to_json(const EnclosureReport& report);
void print_text(const EnclosureReport& report);

/// Time and box of each sample: `t`, then the low and the high end of each variable.
/// \throws SystemError
void write_boxes(const std::string& path, const EnclosureReport& report);

}  // namespace casimir::tools

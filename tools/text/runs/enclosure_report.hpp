#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "tools/analysis/run/validated.hpp"

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

/// The ends of an interval as decimals, rounded outwards: as many digits as tell its width to about
/// three, but no more than some beyond `least`.
std::pair<std::string, std::string> decimal_ends(const RationalInterval& interval, int least = 17);

/// A number that is not negative as a decimal of three digits, not below it.
std::string decimal_above(const cln::cl_RA& value);

/// The power of ten that is not below a number, which is not negative: "1e-12".
std::string power_of_ten_above(const cln::cl_RA& value);

nlohmann::ordered_json to_json(const EnclosureReport& report);
void print_text(const EnclosureReport& report);

/// Time and box of each sample: `t`, then the low and the high end of each variable.
/// \throws SystemError
void write_boxes(const std::string& path, const EnclosureReport& report);

}  // namespace casimir::tools

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "codegen/specialise.hpp"
#include "runtime/digits/agreed_run.hpp"

namespace casimir::tools {

/// A finished multiprecision run, and all that a report says of it.
struct DigitsReport {
  const Specialisation& spec;
  const AgreedRun& agreed;
  int digits = 0;  ///< asked for
  double generate_seconds = 0, seconds = 0;
  std::string doubt = {};  ///< of the system itself: a sentence, or empty

  /// The status of the whole: that of the run, and `no_convergence` for one whose digits could not
  /// be had.
  Status status() const;
  std::string reason() const;
  std::string advice() const;
  /// Where the run stopped: the singular time, if it is known.
  std::string stop_time() const;
  std::vector<std::string> warnings() const;
  /// The state, each number with those of the digits that are sure.
  std::vector<std::string> state() const;
};

nlohmann::ordered_json to_json(const DigitsReport& report);
void print_text(const DigitsReport& report);

/// Time and state of each sample.
/// \throws SystemError
void write_samples(const std::string& path, const DigitsReport& report);

}  // namespace casimir::tools

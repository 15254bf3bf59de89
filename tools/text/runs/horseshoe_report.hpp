#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/analysis/horseshoe/horseshoe.hpp"

namespace casimir::tools {

/// What a search for a horseshoe found, and of what.
struct HorseshoeReport {
  std::string case_name, scene;
  const Horseshoe& answer;
  double seconds = 0;

  /// The statement, as sentences.
  std::string theorem() const;
};

nlohmann::ordered_json to_json(const HorseshoeReport& report);
void print_text(const HorseshoeReport& report);

}  // namespace casimir::tools

#pragma once

#include <nlohmann/json.hpp>

#include "tools/analysis/stress/cell.hpp"
#include "tools/cli/children.hpp"

namespace casimir::tools {

/// From one process to another: numbers are kept exactly.
nlohmann::ordered_json packed(const SceneReference& truth);
SceneReference unpacked(const nlohmann::ordered_json& json);

/// What a run of `integrate --json` answered.
StressAnswer answer_of(const Reply& reply);

}  // namespace casimir::tools

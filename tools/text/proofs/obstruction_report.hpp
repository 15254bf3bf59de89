#pragma once

#include <nlohmann/json.hpp>

#include "symbolic/model.hpp"
#include "symbolic/obstruction/obstruct.hpp"

namespace casimir::tools {

/// The interface's document for `obstruct`.
nlohmann::ordered_json to_json(const Model& model, const obstruction::Obstruction& answer,
                               double seconds);

/// The same for a person; of what did not decide, `all` prints the evidence too.
void print(const Model& model, const obstruction::Obstruction& answer, double seconds, bool all);

}  // namespace casimir::tools

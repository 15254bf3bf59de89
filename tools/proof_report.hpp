#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "symbolic/prove.hpp"

namespace casimir::tools {

nlohmann::ordered_json to_json(const Proof& proof);
Proof proof_from_json(const nlohmann::ordered_json& json);

/// The interface's document for `verify`: case, verdict, seconds, claims, facts.
nlohmann::ordered_json to_json(const Model& model, const std::vector<Proof>& proofs,
                               double seconds);

/// "proved" and the others, coloured for a terminal.
std::string verdict_text(Verdict verdict, bool colour);

}  // namespace casimir::tools

#pragma once

#include <nlohmann/json.hpp>

#include "symbolic/prove.hpp"

namespace casimir {

/// A proof as the interface writes it, and as it goes from one process to another.
nlohmann::ordered_json to_json(const Proof& proof);

/// The proof that `to_json` wrote; whether it is a fact or a note is not in it.
Proof proof_from_json(const nlohmann::ordered_json& json);

}  // namespace casimir

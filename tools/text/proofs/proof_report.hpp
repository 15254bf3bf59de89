#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "symbolic/prove.hpp"
#include "tools/analysis/proof/proof_json.hpp"

namespace casimir::tools {

/// The interface's document for `verify`: case, verdict, seconds, claims, facts, notes.
nlohmann::ordered_json to_json(const Model& model, const std::vector<Proof>& proofs,
                               double seconds);

/// What the verdict of the case depends on beyond its assumptions, each once: "a != 0". Nothing,
/// where that is not "proved": what refutes or stays open does so without the others' conditions.
std::vector<std::string> conditions_of(const Model& model, const std::vector<Proof>& proofs);

/// " where a != 0, b > 0"; nothing without conditions.
std::string where_text(const std::vector<std::string>& conditions);

/// The findings of a judgement in words: "it is no Casimir function: ..".
std::vector<std::string> judgement_lines(const Proof& note);

/// That of the longest verdict.
inline constexpr int kVerdictWidth = 9;

/// "proved" and the others, coloured for a terminal and filled up to a width.
std::string verdict_text(Verdict verdict, bool colour, int width = 0);

}  // namespace casimir::tools

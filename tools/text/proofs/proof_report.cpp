#include "tools/text/proofs/proof_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/text/proofs/claim_words.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json to_json(const Model& model, const std::vector<Proof>& proofs, double seconds) {
  Json claims = Json::array();
  Json facts = Json::array();
  Json notes = Json::array();
  for (const Proof& proof : proofs)
    (proof.note ? notes : proof.fact ? facts : claims).push_back(to_json(proof));
  Json json = {{"case", model.name}, {"verdict", to_string(overall(model, proofs))},
               {"seconds", seconds}, {"claims", claims},
               {"facts", facts},     {"notes", notes}};
  const std::vector<std::string> where = conditions_of(model, proofs);
  if (!where.empty()) json["where"] = where;
  return json;
}

std::vector<std::string> conditions_of(const Model& model, const std::vector<Proof>& proofs) {
  std::vector<std::string> result;
  if (overall(model, proofs) != Verdict::proved) return result;
  for (const Proof& proof : proofs) {
    if (!counts(model, proof)) continue;
    for (const std::string& condition : proof.where) {
      if (std::find(result.begin(), result.end(), condition) == result.end())
        result.push_back(condition);
    }
  }
  return result;
}

std::string where_text(const std::vector<std::string>& conditions) {
  return conditions.empty() ? "" : fmt::format(" where {}", fmt::join(conditions, ", "));
}

std::vector<std::string> judgement_lines(const Proof& note) {
  std::vector<std::string> lines;
  for (const Proof& finding : note.findings)
    lines.push_back(claim_words(finding.kind).finding(finding));
  return lines;
}

std::string verdict_text(Verdict verdict, bool colour, int width) {
  const char* code = verdict == Verdict::proved ? "32" : verdict == Verdict::refuted ? "31" : "33";
  const std::string word = fmt::format("{:<{}}", to_string(verdict), width);
  return colour ? fmt::format("\x1b[{}m{}\x1b[0m", code, word) : word;
}

}  // namespace casimir::tools

#include "tools/text/proofs/proof_report.hpp"

#include <fmt/format.h>

#include <algorithm>

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

std::vector<std::string> judgement_lines(const Proof& note) {
  std::vector<std::string> lines;
  for (const Proof& finding : note.findings) {
    const bool proved = finding.verdict == Verdict::proved;
    const bool refuted = finding.verdict == Verdict::refuted;
    const std::string why = finding.evidence.empty() ? "" : " (" + finding.evidence + ")";
    if (finding.kind == ClaimKind::integral) {
      lines.push_back(proved    ? "it is a first integral"
                      : refuted ? "it is no first integral: " + finding.reason
                                : "whether it is a first integral is undecided");
    } else if (finding.kind == ClaimKind::casimir) {
      lines.push_back(proved    ? "it is a Casimir function"
                      : refuted ? "it is no Casimir function: " + finding.reason
                                : "whether it is a Casimir function is undecided");
    } else if (finding.kind == ClaimKind::conditional) {
      lines.push_back(
          fmt::format("it is an integral where {} = 0{}", fmt::join(finding.on, " = "), why));
    } else if (finding.kind == ClaimKind::invariant_relation) {
      lines.push_back("its zero level is invariant" + why);
    } else {
      lines.push_back(proved ? finding.evidence : finding.reason);
    }
  }
  return lines;
}

std::string verdict_text(Verdict verdict, bool colour, int width) {
  const char* code = verdict == Verdict::proved ? "32" : verdict == Verdict::refuted ? "31" : "33";
  const std::string word = fmt::format("{:<{}}", to_string(verdict), width);
  return colour ? fmt::format("\x1b[{}m{}\x1b[0m", code, word) : word;
}

}  // namespace casimir::tools

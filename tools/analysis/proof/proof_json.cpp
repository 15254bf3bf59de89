#include "tools/analysis/proof/proof_json.hpp"

namespace casimir {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const SpectrumCount& count) {
  Json json = {{"involution", to_string(count.involution)},
               {"leaf", count.leaf},
               {"verdict", to_string(count.verdict)}};
  if (count.on_leaves) json["independent_on_leaves"] = *count.on_leaves;
  if (!count.where.empty()) json["where"] = count.where;
  if (!count.at.empty()) json["at"] = count.at;
  if (!count.reason.empty()) json["reason"] = count.reason;
  return json;
}

Verdict verdict_from(const std::string& word) {
  return word == "proved"    ? Verdict::proved
         : word == "refuted" ? Verdict::refuted
                             : Verdict::undecided;
}

SpectrumCount spectrum_from(const Json& json) {
  SpectrumCount count;
  count.involution = verdict_from(json.at("involution"));
  count.leaf = json.at("leaf");
  count.verdict = verdict_from(json.at("verdict"));
  if (json.contains("independent_on_leaves")) count.on_leaves = json.at("independent_on_leaves");
  count.where = json.value("where", std::vector<std::string>{});
  count.at = json.value("at", "");
  count.reason = json.value("reason", "");
  return count;
}

}  // namespace

Json to_json(const Proof& proof) {
  Json json = {{"kind", to_string(proof.kind)},
               {"name", proof.name},
               {"verdict", to_string(proof.verdict)},
               {"seconds", proof.seconds}};
  if (!proof.on.empty()) json["on"] = proof.on;
  if (!proof.evidence.empty()) json["evidence"] = proof.evidence;
  if (!proof.where.empty()) json["where"] = proof.where;
  if (!proof.nonzero.empty()) json["nonzero"] = proof.nonzero;
  if (!proof.positive.empty()) json["positive"] = proof.positive;
  if (!proof.not_zero.empty()) json["not_zero"] = proof.not_zero;
  if (!proof.jumps.empty()) json["jumps"] = proof.jumps;
  if (!proof.residual.empty()) json["residual"] = proof.residual;
  if (!proof.reason.empty()) json["reason"] = proof.reason;
  if (proof.witness) {
    Json witness = Json::object();
    for (const auto& [name, value] : proof.witness->point) witness[name] = value;
    witness["value"] = proof.witness->value;
    json["witness"] = witness;
  }
  if (!proof.integrals.empty()) json["integrals"] = proof.integrals;
  if (proof.spectrum) json["spectrum"] = to_json(*proof.spectrum);
  for (const Proof& finding : proof.findings) json["findings"].push_back(to_json(finding));
  return json;
}

Proof proof_from_json(const Json& json) {
  Proof proof;
  proof.kind = claim_kind_of(json.at("kind").get<std::string>()).value();
  proof.name = json.at("name");
  proof.verdict = verdict_from(json.at("verdict"));
  proof.seconds = json.at("seconds");
  proof.on = json.value("on", std::vector<std::string>{});
  proof.evidence = json.value("evidence", "");
  proof.where = json.value("where", std::vector<std::string>{});
  proof.nonzero = json.value("nonzero", std::vector<std::string>{});
  proof.jumps = json.value("jumps", std::vector<std::string>{});
  proof.positive = json.value("positive", std::vector<std::string>{});
  proof.not_zero = json.value("not_zero", std::vector<std::string>{});
  proof.residual = json.value("residual", "");
  proof.reason = json.value("reason", "");
  if (json.contains("witness")) {
    Witness witness;
    for (const auto& [name, value] : json.at("witness").items()) {
      if (name != "value") witness.point.emplace_back(name, value.get<std::string>());
    }
    witness.value = json.at("witness").at("value");
    proof.witness = std::move(witness);
  }
  proof.integrals = json.value("integrals", std::vector<std::string>{});
  if (json.contains("spectrum")) proof.spectrum = spectrum_from(json.at("spectrum"));
  if (json.contains("findings")) {
    for (const Json& finding : json.at("findings"))
      proof.findings.push_back(proof_from_json(finding));
  }
  return proof;
}

}  // namespace casimir

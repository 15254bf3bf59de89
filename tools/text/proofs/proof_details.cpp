#include "tools/text/proofs/proof_details.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/text/proofs/proof_report.hpp"

namespace casimir::tools {
namespace {

std::string witness_text(const Witness& witness) {
  std::string text;
  for (const auto& [name, value] : witness.point)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
  return text;
}

/// What the integrals of a Lax pair are enough for.
std::string spectrum_text(const SpectrumCount& count) {
  std::string text;
  if (count.involution == Verdict::proved) text += "all in involution; ";
  if (count.involution == Verdict::refuted) text += "not all in involution; ";
  if (count.on_leaves && count.leaf > 0)
    text +=
        fmt::format("{} independent on leaves of dimension {}, {}{}", *count.on_leaves, count.leaf,
                    count.at.empty() ? "for almost all values of variables and parameters"
                                     : fmt::format("on the level around {}", count.at),
                    count.verdict == Verdict::undecided ? "; " : ": ");
  switch (count.verdict) {
    case Verdict::proved:
      text += "enough for Liouville integrability";
      break;
    case Verdict::refuted:
      text += "not enough for Liouville integrability, which takes further ones";
      break;
    case Verdict::undecided:
      return text +
             fmt::format("whether they are enough for Liouville integrability is undecided: {}",
                         count.reason);
  }
  return text + where_text(count.where);
}

/// Where the claim has a meaning, beyond the conditions of its verdict.
std::vector<std::string> definition_of(const Proof& proof) {
  std::vector<std::string> where;
  const auto add = [&](const std::string& condition) {
    const auto known = [&](const std::vector<std::string>& list) {
      return std::ranges::find(list, condition) != list.end();
    };
    if (!known(where) && !known(proof.where)) where.push_back(condition);
  };
  for (const std::string& d : proof.nonzero) add(d + " != 0");
  for (const std::string& p : proof.positive) {
    const bool strict = std::ranges::find(proof.not_zero, p) != proof.not_zero.end();
    add(p + (strict ? " > 0" : " >= 0"));
  }
  return where;
}

}  // namespace

std::vector<ProofDetail> details_of(const Proof& proof) {
  std::vector<ProofDetail> details;
  for (const std::string& integral : proof.integrals) details.push_back({"gives", integral});
  if (proof.spectrum) details.push_back({"count", spectrum_text(*proof.spectrum)});
  if (!proof.reason.empty()) details.push_back({"reason", proof.reason});
  if (!proof.residual.empty()) details.push_back({"residual", proof.residual});
  if (proof.witness) {
    details.push_back({"witness", witness_text(*proof.witness)});
    details.push_back({"value", proof.witness->value});
  }
  if (!proof.jumps.empty())
    details.push_back({"jumps", fmt::format("perhaps, where {}", fmt::join(proof.jumps, " or "))});
  const std::vector<std::string> where = definition_of(proof);
  if (!where.empty())
    details.push_back({"defined", fmt::format("where {}", fmt::join(where, ", "))});
  return details;
}

}  // namespace casimir::tools

#include "tools/text/proofs/verify_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <iterator>

#include "tools/cli/output.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

bool colour() { return may_colour(STDOUT_FILENO); }

std::string plural(std::size_t count, const std::string& word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

}  // namespace

CaseReport::CaseReport(const Model& model, const std::vector<Proof>& rows)
    : model_(model), table_(rows, output_width(), colour()) {}

void CaseReport::row(const Proof& proof) {
  if (section_ == Section::none) {
    fmt::print("{} ({}, {}, {} variables)\n\n{}",
               model_.title.empty() ? model_.name : printable(model_.title, 200), model_.name,
               model_.phase_space, model_.variables.size(), table_.heading());
  }
  const Section section = proof.note   ? Section::notes
                          : proof.fact ? Section::facts
                                       : Section::claims;
  if (section == Section::facts && section_ != section)
    fmt::print("\nfacts, {}\n",
               model_.superintegrable
                   ? "of which the rank and the counts of integrals count: superintegrability is "
                     "claimed"
               : model_.integrable ? "which count as claims: the case claims integrability"
                                   : "which do not count");
  if (section == Section::notes && section_ != section) fmt::print("\nbeside the claims\n");
  section_ = section;
  fmt::print("{}", proof.findings.empty() ? table_.row(proof) : table_.judgement(proof));
  std::fflush(stdout);
}

void CaseReport::end(const std::vector<Proof>& proofs, double seconds) const {
  const Tally claims = tally_of(model_, proofs);
  const auto beside = std::ranges::count_if(
      proofs, [&](const Proof& proof) { return proof.fact && !counts(model_, proof); });
  if (claims.all() == 0)
    fmt::print("\n{}", claims.text());
  else
    fmt::print("\n{}{}  {}: {}", verdict_text(overall(model_, proofs), colour(), kVerdictWidth),
               where_text(conditions_of(model_, proofs)), plural(claims.all(), "claim"),
               claims.text());
  if (beside > 0) fmt::print(" (and {} beside)", plural(static_cast<std::size_t>(beside), "fact"));
  fmt::print("; {}\n", duration_text(seconds));
  std::fflush(stdout);
}

CaseOutcome outcome_of(const Model& model, const std::vector<Proof>& proofs, double seconds) {
  std::vector<Proof> open;
  std::ranges::copy_if(proofs, std::back_inserter(open), [&](const Proof& proof) {
    return proof.verdict != Verdict::proved && counts(model, proof);
  });
  return {model.name,
          overall(model, proofs),
          conditions_of(model, proofs),
          tally_of(model, proofs),
          open,
          seconds};
}

AllReport::AllReport(const std::vector<std::filesystem::path>& paths) {
  for (const std::filesystem::path& path : paths)
    name_width_ = std::max(name_width_, display_width(path.stem().string()));
  fmt::print("verdict    {}  claims  proved  refuted  undecided       time\n",
             padded("case", name_width_));
}

void AllReport::row(const CaseOutcome& outcome) {
  const Tally& tally = outcome.tally;
  fmt::print("{}  {}  {:6}  {:6}  {:7}  {:9}  {:>9}{}{}\n",
             verdict_text(outcome.verdict, colour(), kVerdictWidth),
             padded(outcome.name, name_width_), tally.all(), tally.proved, tally.refuted,
             tally.undecided, duration_text(outcome.seconds), outcome.where.empty() ? "" : " ",
             where_text(outcome.where));
  const ProofTable table(outcome.open, output_width(), colour(), 11);
  for (const Proof& proof : outcome.open) fmt::print("{}", table.row(proof));
  std::fflush(stdout);
  ++cases_;
  total_.proved += tally.proved;
  total_.refuted += tally.refuted;
  total_.undecided += tally.undecided;
}

void AllReport::end(Verdict worst, double seconds) const {
  fmt::print("\n{}  {}, {}: {}; {}\n", verdict_text(worst, colour(), kVerdictWidth),
             plural(cases_, "case"), plural(total_.all(), "claim"), total_.text(),
             duration_text(seconds));
}

}  // namespace casimir::tools

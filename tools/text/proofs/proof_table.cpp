#include "tools/text/proofs/proof_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/text/proofs/proof_details.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

constexpr std::size_t kTimeWidth = 9;  // "999.99 ms"
constexpr std::size_t kLeastName = 24;
constexpr std::size_t kLeastText = 30;
const std::string kBetweenColumns = "  ";

std::string name_of(const Proof& proof) {
  std::string name = proof.name;
  if (!proof.on.empty()) name += fmt::format(" on {} = 0", fmt::join(proof.on, " = "));
  // A verdict with a condition says so in its line.
  return name + where_text(proof.where);
}

/// The lines of a name in a column. Conditions that would take many of them stand in a detail.
std::vector<std::string> lines_of_name(const Proof& proof, std::size_t columns, bool* has_detail) {
  constexpr std::size_t kMostLines = 4;
  std::vector<std::string> lines = wrapped(name_of(proof), columns);
  *has_detail = !proof.where.empty() && lines.size() > kMostLines;
  if (!*has_detail) return lines;
  Proof named = proof;
  named.where = {".."};
  return wrapped(name_of(named), columns);
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

void Tally::add(Verdict verdict) {
  ++(verdict == Verdict::proved ? proved : verdict == Verdict::refuted ? refuted : undecided);
}

std::string Tally::text() const {
  if (all() == 0) return "nothing is claimed";
  return fmt::format("{} proved, {} refuted, {} undecided", proved, refuted, undecided);
}

Tally tally_of(const Model& model, const std::vector<Proof>& proofs) {
  Tally tally;
  for (const Proof& proof : proofs) {
    if (counts(model, proof)) tally.add(proof.verdict);
  }
  return tally;
}

ProofTable::ProofTable(const std::vector<Proof>& rows, std::size_t width, bool colour,
                       std::size_t indent)
    : width_(width), indent_(indent), kind_width_(5), name_width_(4), colour_(colour) {
  for (const Proof& proof : rows) {
    if (proof.kind == ClaimKind::judgement) continue;  // lines of findings, not a row
    kind_width_ = std::max(kind_width_, display_width(to_string(proof.kind)));
    name_width_ = std::max(name_width_, display_width(name_of(proof)));
  }
  const std::size_t others =
      indent_ + kVerdictWidth + kind_width_ + kTimeWidth + 3 * kBetweenColumns.size();
  name_width_ = std::min(name_width_, std::max(kLeastName, width_ - std::min(width_, others)));
}

std::string ProofTable::line(const std::string& verdict, const std::string& kind,
                             const std::string& name, const std::string& time) const {
  return std::string(indent_, ' ') + verdict + kBetweenColumns + padded(kind, kind_width_) +
         kBetweenColumns + padded(name, name_width_) + kBetweenColumns +
         padded(time, kTimeWidth, true);
}

std::string ProofTable::heading() const {
  const std::string columns = line(padded("verdict", kVerdictWidth), "claim", "name", "time");
  const std::string evidence = kBetweenColumns + "evidence";
  return columns + (columns.size() + evidence.size() <= width_ ? evidence : "") + '\n';
}

std::string ProofTable::row(const Proof& proof) const {
  bool where_below = false;
  const std::vector<std::string> name = lines_of_name(proof, name_width_, &where_below);
  std::string text = line(verdict_text(proof.verdict, colour_, kVerdictWidth),
                          to_string(proof.kind), name[0], duration_text(proof.seconds));
  const std::size_t used =
      indent_ + kVerdictWidth + kind_width_ + name_width_ + kTimeWidth + 4 * kBetweenColumns.size();
  const bool beside = used + display_width(proof.evidence) <= width_;
  if (beside && !proof.evidence.empty()) text += kBetweenColumns + proof.evidence;
  text = trimmed(text) + '\n';
  for (std::size_t i = 1; i < name.size(); ++i)
    text += trimmed(line(padded("", kVerdictWidth), "", name[i], "")) + '\n';
  return text + details(proof, !beside, where_below);
}

std::string ProofTable::judgement(const Proof& note) const {
  std::string text;
  const std::string space(indent_ + kVerdictWidth + kBetweenColumns.size(), ' ');
  const std::size_t columns = std::max(kLeastText, width_ - std::min(width_, space.size() + 2));
  for (const std::string& line : judgement_lines(note)) {
    bool first = true;
    for (const std::string& part : wrapped(line, columns)) {
      text += space + (first ? "" : "  ") + part + '\n';
      first = false;
    }
  }
  std::string head;
  for (const std::string& part : wrapped(note.name, columns)) {
    head += std::string(indent_, ' ') + padded(head.empty() ? "judged" : "", kVerdictWidth) +
            kBetweenColumns + part + '\n';
  }
  return head + text;
}

std::string ProofTable::details(const Proof& proof, bool with_evidence, bool with_where) const {
  // Below the names of the kinds, so that the column of the verdicts stays free.
  const std::string space(indent_ + kVerdictWidth + kBetweenColumns.size() + 2, ' ');
  std::string text;
  const auto detail = [&](const std::string& label, const std::string& value) {
    const std::string head = label.empty() ? "" : padded(label, 8) + kBetweenColumns;
    const std::size_t left = space.size() + head.size();
    const std::size_t columns = std::max(kLeastText, width_ - std::min(width_, left));
    bool first = true;
    for (const std::string& part : wrapped(value, columns)) {
      text += space + (first ? head : std::string(head.size(), ' ')) + part + '\n';
      first = false;
    }
  };
  if (with_where) detail("where", fmt::format("{}", fmt::join(proof.where, ", ")));
  if (with_evidence && !proof.evidence.empty()) detail("", proof.evidence);
  for (const ProofDetail& own : details_of(proof)) detail(own.label, own.text);
  return text;
}

}  // namespace casimir::tools

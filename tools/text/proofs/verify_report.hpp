#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/text/proofs/proof_table.hpp"

namespace casimir::tools {

/// What `verify` prints of one case: a heading, a row for each proof as it is decided with the
/// facts in a section of their own, and the summary.
class CaseReport {
 public:
  /// \param rows  all that will be decided, as `pending` gives them. Borrows the model.
  CaseReport(const Model& model, const std::vector<Proof>& rows);

  void row(const Proof& proof);
  void end(const std::vector<Proof>& proofs, double seconds) const;

 private:
  enum class Section { none, claims, facts, notes };

  const Model& model_;
  ProofTable table_;
  Section section_ = Section::none;
};

/// What came of a case, for the table of all.
struct CaseOutcome {
  std::string name;
  Verdict verdict;
  std::vector<std::string> where;  ///< as of `conditions_of`
  Tally tally;
  std::vector<Proof> open;  ///< those that count and are not proved
  double seconds;
};

CaseOutcome outcome_of(const Model& model, const std::vector<Proof>& proofs, double seconds);

/// What `verify --all` prints: a line for each case, below it the claims that are not proved, and
/// at the end the total.
class AllReport {
 public:
  /// \param paths  of the cases, whose names make the first column.
  explicit AllReport(const std::vector<std::filesystem::path>& paths);

  void row(const CaseOutcome& outcome);
  void end(Verdict worst, double seconds) const;

 private:
  std::size_t name_width_ = 4;
  std::size_t cases_ = 0;
  Tally total_;
};

}  // namespace casimir::tools

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "symbolic/prove.hpp"

namespace casimir::tools {

/// How many claims came out in which way.
struct Tally {
  std::size_t proved = 0;
  std::size_t refuted = 0;
  std::size_t undecided = 0;

  void add(Verdict verdict);
  std::size_t all() const { return proved + refuted + undecided; }
  /// "7 proved, 0 refuted, 1 undecided", or that nothing is claimed.
  std::string text() const;
};

/// Of those that count towards the verdict.
Tally tally_of(const Model& model, const std::vector<Proof>& proofs);

/// Verdicts as a table that is read from above: verdict, claim, name, time, evidence. Rows can be
/// printed one by one as they are decided, since the columns have their widths beforehand.
class ProofTable {
 public:
  /// \param rows  all that will be shown, as `pending` gives them: kinds and names are known.
  /// \param width  columns of the whole table.
  /// \param indent  columns to its left, of these.
  ProofTable(const std::vector<Proof>& rows, std::size_t width, bool colour,
             std::size_t indent = 0);

  std::string heading() const;

  /// One line for the proof and indented ones for what does not fit: long evidence, and where it is
  /// not proved the reason, the residual and the witness.
  std::string row(const Proof& proof) const;

  /// What else is known of a candidate, a line for each finding.
  std::string judgement(const Proof& note) const;

 private:
  std::string line(const std::string& verdict, const std::string& kind, const std::string& name,
                   const std::string& time) const;
  std::string details(const Proof& proof, bool with_evidence, bool with_where) const;

  std::size_t width_, indent_;
  std::size_t kind_width_, name_width_;
  bool colour_;
};

}  // namespace casimir::tools

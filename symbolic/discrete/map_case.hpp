#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/case_file.hpp"

namespace casimir {

/// A map S of the phase space, and of the parameters, with which a case's map phi commutes, or
/// (`reverses`) for which phi S phi = S: with an involution S that is reversibility.
struct SymmetryText {
  Text name;
  std::vector<Entry> expressions;  ///< of variables and parameters; the others stay as they are
  bool reverses = false;
};

/// A change of variables y = phi(x) that takes the case's map F into a map G of y, which is written
/// out: phi F = G phi, or (`reverses`) G phi F = phi, so that F becomes the inverse of G.
struct ConjugacyText {
  Text name;
  std::vector<Entry> expressions;  ///< y by x
  std::vector<Entry> map;          ///< next y by y: its keys are the names of y
  bool reverses = false;
};

/// A case file with a table [map], the next values, in place of equations of motion; or with tables
/// [[map_step]] that are done one after the other.
struct MapCaseFile {
  CaseFile file;                          ///< with neither Hamiltonian nor equations
  Text map;                               ///< the head of the table, for messages
  std::vector<Entry> next;                ///< empty where there are steps
  std::vector<std::vector<Entry>> steps;  ///< variables that a step does not give stay as they are
  std::optional<Text> sign;  ///< `map_sign`: "-" where the map is claimed to be anti-Poisson
  std::vector<SymmetryText> symmetries;
  std::vector<ConjugacyText> conjugacies{};

  /// That a flow is needed where this case was given.
  CaseError not_a_flow() const;
};

/// A case file of either kind.
using AnyCaseFile = std::variant<CaseFile, MapCaseFile>;

/// What both kinds have.
const CaseFile& common_part(const AnyCaseFile& any);

/// Reads a case file of either kind, as `read_case`.
/// \throws CaseError
AnyCaseFile read_any_case(const std::filesystem::path& path, const Limits& limits = {});

/// The same for text in memory, as `parse_case`.
AnyCaseFile parse_any_case(const std::string& toml, const std::string& file,
                           const Limits& limits = {});

}  // namespace casimir

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/section/problem.hpp"

namespace casimir::tools {

/// What a user says of a section on the command line; what is left out is as in the case file.
struct SectionOptions {
  std::optional<std::string> energy = {};           ///< an exact real constant
  std::vector<std::string> casimirs = {};           ///< NAME=VALUE
  std::optional<std::string> plane = {};            ///< an expression, or LEFT = RIGHT
  std::optional<std::string> direction = {};        ///< "up" or "down"
  std::vector<std::string> pair = {}, labels = {};  ///< none or two
};

/// What the options and, where they say nothing, the case file ask for.
/// \throws CaseError, UsageError  for what cannot be read.
SectionRequest section_request(const CaseFile& file, const Model& model,
                               const SectionOptions& options = {});

/// The same without what is plotted, also for a system that has no Hamiltonian.
SectionRequest plane_request(const CaseFile& file, const Model& model,
                             const SectionOptions& options = {});

}  // namespace casimir::tools

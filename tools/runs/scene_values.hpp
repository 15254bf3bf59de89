#pragma once

#include <string>
#include <vector>

#include "symbolic/case_file.hpp"
#include "tools/analysis/scene_values.hpp"
#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// Words of the command line such as "r=1/2", split at the sign; `option` names it in messages.
/// \throws UsageError  for one without a sign, and for a name that is given twice.
std::vector<Entry> named_values(const std::string& option, const std::vector<std::string>& words);

/// `--initial NAME=VALUE`: another start than that of the scenes.
class OtherStart {
 public:
  void add_to(CLI::App& command);

  /// The case with these initial values in every scene.
  /// \throws CaseError  with the nearest variable for a name that is none of the case.
  /// \throws UsageError
  CaseFile in(CaseFile file) const;

  /// As they were typed.
  const std::vector<std::string>& words() const { return words_; }

 private:
  std::vector<std::string> words_;
};

}  // namespace casimir::tools

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "symbolic/case_file.hpp"
#include "symbolic/model.hpp"

namespace casimir::tools {

/// Has bundled cases looked for in this folder too, after those of CASIMIR_CASES.
void add_case_folder(const std::filesystem::path& folder);

/// The folders that hold bundled cases: those of CASIMIR_CASES (a list like PATH), the installed
/// ones and those of the build tree, both found from where this program is.
std::vector<std::filesystem::path> case_folders();

/// Every bundled case file by name; of two with one name the first folder's counts.
std::vector<std::filesystem::path> bundled_cases();

/// Those that have a tag; all of them where it is empty.
/// \throws CaseError  with the nearest tag for one that no case has.
std::vector<std::filesystem::path> bundled_cases(const std::string& tag);

/// The same, read.
std::vector<CaseFile> tagged_cases(const std::string& tag);

/// The case file that a user means: a path (with `/` or ending in `.toml`), `-` for standard input,
/// or the name of a bundled case.
/// \throws CaseError  with the nearest names if there is none.
CaseFile load_case(const std::string& argument);

/// The model of a case file; its maps may lead to the phase spaces of bundled cases.
/// \throws CaseError
Model model_of(const CaseFile& file, const ParameterValues& fixed = {});

}  // namespace casimir::tools

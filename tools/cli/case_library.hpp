#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/case_file.hpp"
#include "symbolic/discrete/map_model.hpp"
#include "symbolic/model.hpp"

namespace casimir::tools {

/// Has bundled cases looked for in this folder too, after those of CASIMIR_CASES.
void add_case_folder(const std::filesystem::path& folder);

/// The folders that hold bundled cases: those of CASIMIR_CASES (a list like PATH), the installed
/// ones and those of the build tree, both found from where this program is.
std::vector<std::filesystem::path> case_folders();

/// Every bundled case file by name, those of maps too, which stand in folders `maps`; of two with
/// one name the first folder's counts.
std::vector<std::filesystem::path> bundled_cases();

/// Those that have a tag; all of them where it is empty.
/// \throws CaseError  with the nearest tag for one that no case has.
/// \param limits  under which the files are read, as in the functions below
std::vector<std::filesystem::path> bundled_cases(const std::string& tag, const Limits& limits);

/// The same without the cases of maps.
std::vector<std::filesystem::path> bundled_flows(const std::string& tag, const Limits& limits);

/// What `--all` and `list` mean: the flows where no tag is given, else all that have it. Maps are
/// asked for by their tag.
std::vector<std::filesystem::path> listed_cases(const std::string& tag, const Limits& limits);

/// The bundled maps.
std::vector<std::filesystem::path> bundled_maps(const Limits& limits);

/// The bundled flows with a tag, or all of them, read.
/// \throws CaseError  for a tag that no case has, or maps only.
std::vector<CaseFile> tagged_cases(const std::string& tag, const Limits& limits);

/// The case file that a user means: a path (with `/` or ending in `.toml`), `-` for standard input,
/// or the name of a bundled case.
/// \throws CaseError  with the nearest names if there is none; and for the case of a map.
CaseFile load_case(const std::string& argument, const Limits& limits);

/// The same where the case of a map is welcome.
AnyCaseFile load_any_case(const std::string& argument, const Limits& limits);

/// The model of a case file; its maps may lead to the phase spaces of bundled cases, which are read
/// under the limits of the file.
/// \throws CaseError
Model model_of(const CaseFile& file, const ParameterValues& fixed = {});

/// The same for the case of a map.
MapModel map_model_of(const MapCaseFile& file, const ParameterValues& fixed = {});

}  // namespace casimir::tools

#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace casimir::test {

/// Every bundled case file, sorted by name.
inline std::vector<std::filesystem::path> bundled_cases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(CASIMIR_SOURCE_DIR "/cases"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// One bundled case of each kind that a generator can meet, for tests too dear for all of them:
/// polynomial of two degrees, quadratic of ten variables, with roots, with sines and cosines, with
/// the time in the equations, with fractions.
inline std::vector<std::filesystem::path> cases_of_each_kind() {
  std::vector<std::filesystem::path> files;
  for (const char* name : {"clebsch", "deformable-body", "euler-angles", "euler-e3",
                           "kepler-sphere", "kovalevskaya", "manakov-so5", "neumann", "steklov"})
    files.push_back(CASIMIR_SOURCE_DIR "/cases/" + std::string(name) + ".toml");
  return files;
}

}  // namespace casimir::test

#pragma once

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace casimir::test {

/// A file as the name of a test.
inline std::string test_name_of(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

/// Every case file of that folder, sorted by name.
inline std::vector<std::filesystem::path> case_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  // Paths are slow to compare, part by part, and every test of a program makes these lists.
  std::ranges::sort(files, {}, [](const auto& file) -> decltype(auto) { return file.native(); });
  return files;
}

/// Every bundled case file, sorted by name.
inline std::vector<std::filesystem::path> bundled_cases() {
  return case_files(CASIMIR_SOURCE_DIR "/cases");
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

/// Whether tests that go through the cases go through every one, as they do in tools/check.
inline bool wants_every_case() { return std::getenv("CASIMIR_EVERY_CASE") != nullptr; }

/// Those of each kind, and where not `wants_every_case()` a part of them.
inline std::vector<std::filesystem::path> kinds_to_go_through() {
  std::vector<std::filesystem::path> files = cases_of_each_kind();
  if (wants_every_case()) return files;
  std::size_t place = 0;
  std::erase_if(files, [&](const std::filesystem::path&) { return place++ % 2 == 1; });
  return files;
}

/// What a test that is dear goes through, where it is about every case: those of each kind, and of
/// the others every ninth; all where `wants_every_case()`. The suite of such a test is called
/// EveryCase, by which tools/check finds it.
inline std::vector<std::filesystem::path> cases_to_go_through() {
  std::vector<std::filesystem::path> files = bundled_cases();
  if (wants_every_case()) return files;
  const std::vector<std::filesystem::path> kinds = cases_of_each_kind();
  std::size_t place = 0;
  std::erase_if(files, [&](const std::filesystem::path& file) {
    return place++ % 9 != 0 && std::ranges::find(kinds, file) == kinds.end();
  });
  return files;
}

}  // namespace casimir::test

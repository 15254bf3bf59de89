#include "tools/cli/case_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace casimir::tools {
namespace fs = std::filesystem;

namespace {

std::vector<fs::path>& added_folders() {
  static std::vector<fs::path> folders;
  return folders;
}

}  // namespace

void add_case_folder(const fs::path& folder) { added_folders().push_back(folder); }

std::vector<fs::path> case_folders() {
  std::vector<fs::path> folders;
  if (const char* list = std::getenv("CASIMIR_CASES")) {
    std::istringstream stream(list);
    for (std::string folder; std::getline(stream, folder, ':');) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  folders.insert(folders.end(), added_folders().begin(), added_folders().end());
  std::error_code problem;
  const fs::path program = fs::read_symlink("/proc/self/exe", problem);
  if (!problem) {
    folders.push_back(program.parent_path() / ".." / "share" / "casimir" / "cases");
    folders.push_back(program.parent_path() / "cases");
  }
  for (std::size_t i = 0; i < folders.size(); i += 2)
    folders.insert(folders.begin() + static_cast<std::ptrdiff_t>(i) + 1, folders[i] / "maps");
  return folders;
}

std::vector<fs::path> bundled_cases() {
  std::map<std::string, fs::path> found;
  for (const fs::path& folder : case_folders()) {
    std::error_code problem;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem)) {
      if (entry.path().extension() == ".toml")
        found.try_emplace(entry.path().stem().string(), entry.path());
    }
  }
  std::vector<fs::path> result;
  for (const auto& [name, path] : found) result.push_back(path);
  return result;
}

std::vector<fs::path> bundled_cases(const std::string& tag, const Limits& limits) {
  if (tag.empty()) return bundled_cases();
  std::vector<fs::path> result;
  std::set<std::string> known;
  for (const fs::path& path : bundled_cases()) {
    const std::vector<std::string> tags = common_part(read_any_case(path, limits)).tags;
    known.insert(tags.begin(), tags.end());
    if (std::ranges::find(tags, tag) != tags.end()) result.push_back(path);
  }
  if (!result.empty()) return result;
  throw CaseError({"--tag"}, fmt::format("no bundled case has the tag '{}'", printable(tag)), {},
                  suggest_or_list(tag, {known.begin(), known.end()}));
}

static bool is_map(const fs::path& path, const Limits& limits) {
  return std::holds_alternative<MapCaseFile>(read_any_case(path, limits));
}

[[noreturn]] static void refuse_maps(const std::string& tag) {
  throw CaseError({"--tag"}, fmt::format("all cases with the tag '{}' are maps, and flows are "
                                         "needed here",
                                         printable(tag)));
}

std::vector<fs::path> bundled_flows(const std::string& tag, const Limits& limits) {
  std::vector<fs::path> result = bundled_cases(tag, limits);
  std::erase_if(result, [&](const fs::path& path) { return is_map(path, limits); });
  if (result.empty() && !tag.empty()) refuse_maps(tag);
  return result;
}

std::vector<fs::path> bundled_maps(const Limits& limits) {
  std::vector<fs::path> result = bundled_cases();
  std::erase_if(result, [&](const fs::path& path) { return !is_map(path, limits); });
  return result;
}

std::vector<fs::path> listed_cases(const std::string& tag, const Limits& limits) {
  return tag.empty() ? bundled_flows({}, limits) : bundled_cases(tag, limits);
}

std::vector<CaseFile> tagged_cases(const std::string& tag, const Limits& limits) {
  std::vector<CaseFile> result;
  for (const fs::path& path : bundled_cases(tag, limits)) {
    AnyCaseFile file = read_any_case(path, limits);
    if (auto* flow = std::get_if<CaseFile>(&file)) result.push_back(std::move(*flow));
  }
  if (result.empty() && !tag.empty()) refuse_maps(tag);
  return result;
}

/// A path that leads nowhere: perhaps a bundled case was meant, or a file beside it.
[[noreturn]] static void no_such_file(const fs::path& path) {
  std::string hint;
  for (const fs::path& bundled : bundled_cases()) {
    if (path == bundled.filename())
      hint = fmt::format("the bundled case is called '{}', without the ending",
                         printable(bundled.stem().string()));
  }
  std::vector<std::string> beside;
  std::error_code problem;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".toml") beside.push_back(entry.path().filename().string());
  }
  std::sort(beside.begin(), beside.end());
  if (hint.empty()) hint = suggest(path.filename().string(), beside);
  throw CaseError({path.string()}, "the case file does not exist or cannot be read", {}, hint);
}

CaseFile load_case(const std::string& argument, const Limits& limits) {
  AnyCaseFile any = load_any_case(argument, limits);
  if (const auto* map = std::get_if<MapCaseFile>(&any)) throw map->not_a_flow();
  return std::get<CaseFile>(std::move(any));
}

AnyCaseFile load_any_case(const std::string& argument, const Limits& limits) {
  if (argument == "-") {
    const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
    return parse_any_case(text, "<standard input>", limits);
  }
  std::vector<std::string> names;
  if (argument.find('/') != std::string::npos || argument.ends_with(".toml")) {
    std::error_code ignored;
    if (!fs::exists(argument, ignored)) no_such_file(argument);
    return read_any_case(argument, limits);
  }
  for (const fs::path& path : bundled_cases()) {
    if (path.stem() == argument) return read_any_case(path, limits);
    names.push_back(path.stem().string());
  }
  std::string hint = suggest(argument, names);
  if (hint.empty())
    hint = "'casimir list' shows the bundled cases; a path needs a '/' or ends in '.toml'";
  throw CaseError({argument}, "there is no bundled case of this name", {}, hint);
}

/// Finds the bundled cases that the maps of a case lead to.
static FindCase bundled_flow(const Limits& limits) {
  return [limits](const std::string& name) -> std::optional<CaseFile> {
    for (const fs::path& path : bundled_cases()) {
      if (path.stem() == name) return read_case(path, limits);
    }
    return std::nullopt;
  };
}

Model model_of(const CaseFile& file, const ParameterValues& fixed) {
  return build_model(file, fixed, bundled_flow(file.limits));
}

MapModel map_model_of(const MapCaseFile& file, const ParameterValues& fixed) {
  return build_map_model(file, fixed, bundled_flow(file.file.limits));
}

}  // namespace casimir::tools

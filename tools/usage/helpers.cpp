#include "tools/usage/helpers.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/usage/completion.hpp"
#include "tools/usage/manual.hpp"

namespace casimir::tools {

std::optional<int> run_helper(const CLI::App& program, const std::vector<std::string>& words,
                              const std::string& version) {
  if (!words.empty() && words[0] == "complete") {
    for (const std::string& line : completions(program, {words.begin() + 1, words.end()}))
      std::cout << line << '\n';
    return kDone;
  }
  if (words.size() == 3 && words[0] == "manual") {
    for (const auto& [name, text] : manual_pages(program, version, words[2])) {
      OutputFile file(std::filesystem::path(words[1]) / name);
      file.stream() << text;
      file.commit();
    }
    return kDone;
  }
  return std::nullopt;
}

}  // namespace casimir::tools

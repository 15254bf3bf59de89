// Every command that the README shows is run, and what it shows of the output is what comes out.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

struct Shown {
  std::vector<std::string> arguments;
  std::vector<std::string> output;
};

/// Splits at spaces, with double quotes around words that contain some.
std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> result;
  static const std::regex kWord(R"re("([^"]*)"|(\S+))re");
  for (std::sregex_iterator it(line.begin(), line.end(), kWord), end; it != end; ++it) {
    result.push_back((*it)[1].matched ? (*it)[1].str() : (*it)[2].str());
  }
  return result;
}

/// The ```console blocks: "$ build/casimir .." and the lines below it.
std::vector<Shown> shown_commands(const std::string& readme) {
  std::vector<Shown> commands;
  std::istringstream lines(readme);
  bool inside = false;
  const std::string prompt = "$ build/casimir ";
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = line == "```console";
    } else if (inside && line.starts_with(prompt)) {
      commands.push_back({words(line.substr(prompt.size())), {}});
    } else if (inside && !line.starts_with("$ ") && !commands.empty()) {
      commands.back().output.push_back(line);
    }
  }
  return commands;
}

/// The ```csv NAME blocks: files that the commands read.
void write_files(const std::string& readme, const Folder& folder) {
  const std::string fence = "```csv ";
  std::istringstream lines(readme);
  std::ofstream file;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(fence))
      file.open(folder.path() / line.substr(fence.size()));
    else if (line == "```" && file.is_open())
      file.close();
    else if (file.is_open())
      file << line << '\n';
  }
}

/// Times differ from run to run, and with them the spaces before them; the steps of an enclosure
/// with the processor, whose wide registers round in other places.
std::string without_numbers_that_vary(const std::string& text) {
  static const std::regex kTime(R"( *(\d+(\.\d+)? ?(us|ms|s)\b))"), kSteps(R"(\b\d+ steps\b)");
  return std::regex_replace(std::regex_replace(text, kTime, " TIME"), kSteps, "N steps");
}

class Readme : public testing::TestWithParam<const char*> {};

TEST_P(Readme, EveryCommandPrintsWhatIsShown) {
  const std::string readme = file_text(CASIMIR_SOURCE_DIR "/" + std::string(GetParam()));
  const std::vector<Shown> commands = shown_commands(readme);
  ASSERT_GE(commands.size(), 4U);
  const Folder folder;
  write_files(readme, folder);
  for (const Shown& command : commands) {
    const Outcome outcome = run_in(folder, command.arguments);
    EXPECT_LE(outcome.status, 1) << outcome.err;
    const std::string all = without_numbers_that_vary(outcome.out);
    for (const std::string& line : command.output) {
      if (line.empty() || line == "...") continue;
      EXPECT_NE(all.find(without_numbers_that_vary(line)), std::string::npos)
          << line << "\nnot in\n"
          << outcome.out;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, Readme,
                         testing::Values("README.md", "tools/README.md", "symbolic/README.md",
                                         "runtime/README.md"));

}  // namespace
}  // namespace casimir::test

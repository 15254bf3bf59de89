// Any lines as the arguments of casimir, which are read and not carried out.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fuzz/target.hpp"
#include "tools/cli/command_line.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/options/search_options.hpp"

namespace {

using namespace casimir;
using namespace casimir::tools;

/// What the commands make of the values of options before they look at a case; one kind for each
/// input.
void read_values(const std::vector<std::string>& words) {
  try {
    if (words.size() % 3 == 0) {
      Common common;
      common.params = words;
      common.parameter_values();
    } else if (words.size() % 3 == 1) {
      limits_of({words, {}});
    } else {
      weights_of(words);
    }
  } catch (const UsageError&) {
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static CommandLine line;  // CLI11 forgets what it has read before it reads again
  const casimir::test::OneSecond limit;
  std::vector<std::string> words{"casimir"};
  std::istringstream stream({reinterpret_cast<const char*>(data), size});
  // A word of a command line has no character 0.
  for (std::string word; std::getline(stream, word);) words.emplace_back(word.c_str());
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  const int count = static_cast<int>(arguments.size());
  try {
    line.read(count, arguments.data());
  } catch (const CLI::Success&) {
  } catch (const CLI::ParseError& problem) {
    line.usage_message(problem, count, arguments.data());
  } catch (const UsageError&) {
  }
  read_values(words);
  return 0;
}

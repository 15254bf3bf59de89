#include "tools/text/files/marked_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"

namespace casimir::tools {
namespace {

/// Where lines that are exactly `mark` start.
std::vector<std::size_t> lines_that_are(const std::string& text, const std::string& mark) {
  std::vector<std::size_t> found;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string line = text.substr(start, end - start);
    if (line.ends_with('\r')) line.pop_back();
    if (line == mark) found.push_back(start);
    start = end + 1;
  }
  return found;
}

std::string read_whole(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path))
    throw UsageError(fmt::format("'{}' cannot be read", printable(path, 200)));
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

MarkedFile::MarkedFile(std::string path, std::string name) : path_(std::move(path)) {
  const std::string open = fmt::format("<!-- {} -->", name);
  const std::string close = fmt::format("<!-- /{} -->", name);
  if (!std::filesystem::exists(path_)) {
    before_ = open + "\n";
    after_ = close + "\n";
    return;
  }
  const std::string text = read_whole(path_);
  const std::vector<std::size_t> first = lines_that_are(text, open);
  const std::vector<std::size_t> last = lines_that_are(text, close);
  if (first.size() != 1 || last.size() != 1 || last[0] < first[0]) {
    throw UsageError(
        fmt::format("'{}' exists and would lose its text: what is replaced has to stand between "
                    "one line '{}' and one line '{}'",
                    printable(path_, 200), open, close));
  }
  before_ = text.substr(0, text.find('\n', first[0]) + 1);
  after_ = text.substr(last[0]);
}

void MarkedFile::write(const std::string& part) const {
  OutputFile file(path_);
  file.stream() << before_ << "\n" << part << "\n" << after_;
  file.commit();
}

}  // namespace casimir::tools

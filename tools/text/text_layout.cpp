#include "tools/text/text_layout.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

namespace casimir::tools {
namespace {

/// The words of a text, where "g3 = -5/2" counts as one.
std::vector<std::string> unbroken(std::istream& stream) {
  std::vector<std::string> words;
  bool glue = false;
  for (std::string word; stream >> word;) {
    const bool relation = word == "=" || word == "!=";
    if ((relation || glue) && !words.empty())
      words.back() += ' ' + word;
    else
      words.push_back(word);
    glue = relation;
  }
  return words;
}

}  // namespace

std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(const std::string& text, std::size_t width, bool right_aligned) {
  const std::size_t own = display_width(text);
  const std::string space(own < width ? width - own : 0, ' ');
  return right_aligned ? space + text : text + space;
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word : unbroken(words)) {
    if (!lines.empty() && display_width(lines.back()) + 1 + display_width(word) <= width) {
      lines.back() += ' ' + word;
      continue;
    }
    while (word.size() > width && display_width(word) == word.size()) {  // cut only ASCII
      lines.push_back(word.substr(0, width));
      word.erase(0, width);
    }
    lines.push_back(word);
  }
  if (lines.empty()) lines.emplace_back();
  return lines;
}

std::size_t output_width() {
  constexpr std::size_t kDefault = 100;
  constexpr std::size_t kLeast = 60;
  winsize size = {};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return kDefault;
  return size.ws_col == 0 ? kDefault : std::max<std::size_t>(size.ws_col, kLeast);
}

}  // namespace casimir::tools

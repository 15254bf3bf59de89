#include "tools/usage/roff.hpp"

#include <fmt/format.h>

#include <sstream>

namespace casimir::tools::roff {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

std::string paragraph(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line.front() == '.' || line.front() == '\'') result += "\\&";
    result += escaped(line) + "\n";
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string capitals(const std::string& text) {
  std::string upper;
  for (const char c : text) upper += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return upper;
}

std::string heading(const std::string& name, const std::string& title, int section,
                    const std::string& version, const std::string& date) {
  return fmt::format(
      ".\\\" Made from what the program says of itself: do not edit.\n"
      ".TH {} {} \"{}\" \"casimir {}\" \"{}\"\n.SH NAME\n{} \\- {}\n",
      escaped(capitals(name)), section, date, version,
      section == 1 ? "User Commands" : "File Formats", escaped(name), escaped(title));
}

}  // namespace casimir::tools::roff

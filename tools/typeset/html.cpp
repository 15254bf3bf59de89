#include "tools/typeset/html.hpp"

#include <fmt/format.h>

#include <sstream>

#include "symbolic/error.hpp"

namespace casimir::tools::html {

std::string text(const std::string& stranger, std::size_t limit) {
  std::string result;
  for (const char c : printable(stranger, limit)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string lines(const std::string& stranger) {
  std::string result;
  std::istringstream stream(stranger);
  constexpr std::size_t kLongLine = 1 << 20;
  for (std::string line; std::getline(stream, line);) {
    if (line.ends_with('\r')) line.pop_back();
    for (char& c : line)
      if (c == '\t') c = ' ';
    result += text(line, kLongLine) + '\n';
  }
  return result;
}

std::string paragraph(const std::string& stranger) { return "<p>" + text(stranger) + "</p>\n"; }

std::string row(const std::vector<std::string>& cells, const char* tag, const std::string& style) {
  std::string result = style.empty() ? "<tr>" : "<tr class=\"" + style + "\">";
  for (const std::string& cell : cells) result += fmt::format("<{0}>{1}</{0}>", tag, cell);
  return result + "</tr>\n";
}

std::string table(const std::string& rows) {
  return "<div class=\"scroll\"><table>\n" + rows + "</table></div>\n";
}

}  // namespace casimir::tools::html

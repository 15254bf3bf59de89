#include "tools/usage/case_page.hpp"

#include <sstream>
#include <vector>

#include "tools/usage/roff.hpp"

namespace casimir::tools {
namespace {

/// A line of Markdown: what stands between backquotes is bold.
std::string inline_text(const std::string& line) {
  std::string result, part;
  bool code = false;
  for (const char c : line + '`') {
    if (c != '`') {
      part += c;
      continue;
    }
    result += code && !part.empty() ? roff::bold(part) : roff::escaped(part);
    part.clear();
    code = !code;
  }
  const bool request = result.starts_with('.') || result.starts_with('\'');
  return (request ? "\\&" : "") + result;
}

/// The cells of a row of a table: a bar between backquotes divides nothing.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::string cell;
  bool code = false;
  for (const char c : row.substr(1)) {
    if (c == '`') code = !code;
    if (c != '|' || code) {
      cell += c;
      continue;
    }
    const std::size_t begin = cell.find_first_not_of(' ');
    cells.push_back(begin == std::string::npos
                        ? std::string{}
                        : cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin));
    cell.clear();
  }
  return cells;
}

/// Turns the page line by line.
class CasePage {
 public:
  void read(const std::string& line) {
    if (line.starts_with("```")) {
      text_ += in_code_ ? ".fi\n.RE\n" : begin_of_section_ ? ".RS 4\n.nf\n" : ".PP\n.RS 4\n.nf\n";
      in_code_ = !in_code_;
      begin_of_section_ = false;
      gap_ = true;
    } else if (in_code_) {
      text_ += line.empty() ? ".sp\n" : roff::paragraph(line);
    } else if (line.empty()) {
      gap_ = !begin_of_section_;
      rows_ = 0;
    } else if (line.starts_with('|')) {
      row(cells_of(line));
    } else if (line.starts_with('#')) {
      section(line.substr(line.find(' ') + 1), line.starts_with("# "));
    } else {
      if (gap_) text_ += ".PP\n";
      gap_ = begin_of_section_ = false;
      text_ += inline_text(line) + '\n';
    }
  }

  const std::string& text() const { return text_; }

 private:
  void section(const std::string& title, bool first) {
    text_ += ".SH " + (first ? "DESCRIPTION" : roff::capitals(roff::escaped(title))) + '\n';
    gap_ = false;
    begin_of_section_ = true;
  }

  /// The first two rows are the head and the line below it.
  void row(const std::vector<std::string>& cells) {
    if (++rows_ <= 2 || cells.size() != 2) return;
    text_ += ".TP\n" + inline_text(cells[0]) + '\n' + inline_text(cells[1]) + '\n';
    gap_ = true;
    begin_of_section_ = false;
  }

  std::string text_;
  bool in_code_ = false;
  bool begin_of_section_ = false;
  bool gap_ = false;  ///< what follows is another paragraph
  int rows_ = 0;      ///< of the table so far
};

}  // namespace

std::string case_page(const std::string& markdown, const std::string& version,
                      const std::string& date) {
  CasePage page;
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) page.read(line);
  return roff::heading("casimir-case", "the files that describe a system to casimir", 5, version,
                       date) +
         page.text() +
         ".SH SEE ALSO\n\\fBcasimir\\fR(1),\n\\fBcasimir\\-new\\fR(1),\n"
         "\\fBcasimir\\-show\\fR(1)\n";
}

}  // namespace casimir::tools

#include "tools/stress/picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/cli/output.hpp"
#include "tools/plot/gnuplot.hpp"

namespace casimir::tools {
namespace {

/// What a cell looks like. The shades differ in lightness, and the words say it all.
struct Look {
  std::string text;
  const char* fill;
  const char* ink = "#000000";
};

Look look_of(const StressCell& cell) {
  switch (cell.verdict) {
    case Judgement::right: {
      // More digits are darker.
      constexpr const char* kGreens[] = {"#e5f5e0", "#c7e9c0", "#a1d99b", "#74c476"};
      const int digits = right_digits(cell);
      return {std::to_string(digits), kGreens[std::clamp((digits - 3) / 3, 0, 3)]};
    }
    case Judgement::warned:
      return {"warned", "#fee08b"};
    case Judgement::refused:
      switch (cell.refusal) {
        case Refusal::not_applicable:
          return {refusal_word(cell.refusal), "#ffffff", "#808080"};
        case Refusal::failed:
          return {refusal_word(cell.refusal), "#d9d9d9"};
        default:
          return {refusal_word(cell.refusal), "#e5f5e0", "#405040"};
      }
    case Judgement::inaccurate:
      return {"coarse", "#fdae61"};
    case Judgement::wrong:
      return {"WRONG", "#b2182b", "#ffffff"};
    default:
      return {"?", "#ffffff"};
  }
}

constexpr std::size_t kRowHeight = 22, kColumnWidth = 70;
constexpr double kLetters = 12;

/// The cell in column x and row y, as an object and a label.
std::string cell_commands(const StressCell& cell, double x, double y, bool fastest,
                          const Sheet& sheet, double letters) {
  const Look look = look_of(cell);
  constexpr double kHalf = 0.47;
  return fmt::format(
      "set object rect from {:g},{:g} to {:g},{:g} fc rgb '{}' fs solid 1 border lc rgb '{}' lw "
      "{}\n"
      "set label {} at {:g},{:g} center tc rgb '{}' font ',{:.3g}'\n",
      x - kHalf, y - kHalf, x + kHalf, y + kHalf, ink(sheet.print, look.fill),
      fastest ? "#000000" : "#ffffff", fastest ? "2.5" : "1", quoted(look.text, sheet), x, y,
      look.ink, 0.9 * letters);
}

std::string tics(const std::vector<std::string>& names, const Sheet& sheet) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += fmt::format("{}{} {}", i == 0 ? "" : ", ", quoted(names[i], sheet), i + 1);
  return "(" + list + ")";
}

std::string script(const StressMatrix& matrix, const Sheet& sheet, const std::string& output) {
  const std::size_t columns = matrix.columns.size(), rows = matrix.lines.size();
  std::size_t label = 0;
  std::vector<std::string> methods, scenes;
  for (const StressMatrix::Column& column : matrix.columns)
    methods.push_back(column.method + (column.outside ? " *" : ""));
  for (const StressMatrix::Line& line : matrix.lines) {
    scenes.push_back(fmt::format("{} {} ({})", line.case_name, line.scene,
                                 line.extreme.empty() ? "ordinary" : line.extreme));
    label = std::max(label, scenes.back().size());
  }
  const ScreenSize screen{
      static_cast<double>(90 + 9 * label + kColumnWidth * std::max<std::size_t>(columns, 5)),
      static_cast<double>(340 + kRowHeight * rows), kLetters};
  // A matrix grows and shrinks as a whole.
  Sheet scaled = sheet;
  constexpr double kPointsOfMillimetre = 72 / 25.4;
  if (sheet.print.width && !sheet.print.points)
    scaled.print.points = kLetters * *sheet.print.width * kPointsOfMillimetre / screen.width;
  const double letters = letters_of(scaled, screen);
  std::string text = fmt::format("set encoding utf8\nset terminal {}\nset output {}\n",
                                 terminal_of(scaled, screen, false), quoted_path(output));
  text += fmt::format(
      "set label 'Scene by method: the digits that are right, or what became of it instead' at "
      "screen 0.02, screen 1 left offset 0,-1.2 font ',{:.3g}'\n"
      "set label 'heavy frame: the fastest right answer    coarse: ok with few digits' at screen "
      "0.02, screen 0 left offset 0,3.4\n"
      "set label 'WRONG: ok, and it is not    *: of another library' at screen 0.02, screen 0 left "
      "offset 0,2.2\n"
      "set label 'refused: there is no end, as it says    failed: there is one    n/a: not such a "
      "method' at screen 0.02, screen 0 left offset 0,1\n"
      "unset key\nunset border\nset tics scale 0\nset tmargin 9\nset bmargin 10\n",
      1.2 * letters);
  text += fmt::format("set xrange [0.5:{}.5]\nset x2range [0.5:{}.5]\nset yrange [{}.5:0.5]\n",
                      columns, columns, rows);
  text += fmt::format("set xtics rotate by -35 {}\nset x2tics rotate by 35 {}\nset ytics {}\n",
                      tics(methods, sheet), tics(methods, sheet), tics(scenes, sheet));
  std::string framed;  // over its neighbours
  for (std::size_t y = 0; y < rows; ++y) {
    const StressMatrix::Line& line = matrix.lines[y];
    const int fastest = StressMatrix::fastest(line);
    for (std::size_t x = 0; x < line.cells.size(); ++x) {
      const bool first = static_cast<int>(x) == fastest;
      (first ? framed : text) += cell_commands(line.cells[x], static_cast<double>(x + 1),
                                               static_cast<double>(y + 1), first, sheet, letters);
    }
  }
  return text + framed + "plot 1/0\n";
}

}  // namespace

void draw_matrix(const StressMatrix& matrix, const Sheet& sheet) {
  draw_sheet(sheet, [&](const std::string& output) { return script(matrix, sheet, output); });
}

}  // namespace casimir::tools

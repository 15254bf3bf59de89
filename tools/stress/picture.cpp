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
      return {"refused", "#f0f0f0", "#606060"};
    case Judgement::inaccurate:
      return {"coarse", "#fdae61"};
    case Judgement::wrong:
      return {"WRONG", "#b2182b", "#ffffff"};
    default:
      return {"?", "#ffffff"};
  }
}

constexpr int kRowHeight = 22, kColumnWidth = 70;

/// The cell in column x and row y, as an object and a label.
std::string cell_commands(const StressCell& cell, double x, double y, bool fastest) {
  const Look look = look_of(cell);
  constexpr double kHalf = 0.47;
  return fmt::format(
      "set object rect from {:g},{:g} to {:g},{:g} fc rgb '{}' fs solid 1 border lc rgb '{}' lw "
      "{}\n"
      "set label {} at {:g},{:g} center tc rgb '{}' font ',11'\n",
      x - kHalf, y - kHalf, x + kHalf, y + kHalf, look.fill, fastest ? "#000000" : "#ffffff",
      fastest ? "2.5" : "1", quoted(look.text), x, y, look.ink);
}

std::string tics(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += fmt::format("{}{} {}", i == 0 ? "" : ", ", quoted(names[i]), i + 1);
  return "(" + list + ")";
}

std::string script(const StressMatrix& matrix, const std::string& path, const std::string& output) {
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
  const std::size_t width = 90 + 9 * label + kColumnWidth * std::max<std::size_t>(columns, 5);
  const std::size_t height = 340 + kRowHeight * rows;
  std::string text = fmt::format(
      "set encoding utf8\nset terminal {} size {},{} background rgb 'white' font 'sans,12' "
      "noenhanced\nset output {}\n",
      path.ends_with(".svg") ? "svg dynamic" : "pngcairo", width, height, quoted_path(output));
  text +=
      "set label 'Scene by method: the digits that are right, or what became of it instead' at "
      "screen 0.02, screen 1 left offset 0,-1.2 font ',14'\n"
      "set label 'heavy frame: the fastest right answer    coarse: ok with few digits' at screen "
      "0.02, screen 0 left offset 0,3.4\n"
      "set label 'WRONG: ok, and it is not    *: of another library' at screen 0.02, screen 0 left "
      "offset 0,2.2\n"
      "set label 'in brackets: the kind of scene' at screen 0.02, screen 0 left offset 0,1\n"
      "unset key\nunset border\nset tics scale 0\nset tmargin 9\nset bmargin 10\n";
  text += fmt::format("set xrange [0.5:{}.5]\nset x2range [0.5:{}.5]\nset yrange [{}.5:0.5]\n",
                      columns, columns, rows);
  text += fmt::format("set xtics rotate by -35 {}\nset x2tics rotate by 35 {}\nset ytics {}\n",
                      tics(methods), tics(methods), tics(scenes));
  std::string framed;  // over its neighbours
  for (std::size_t y = 0; y < rows; ++y) {
    const StressMatrix::Line& line = matrix.lines[y];
    const int fastest = StressMatrix::fastest(line);
    for (std::size_t x = 0; x < line.cells.size(); ++x) {
      const bool first = static_cast<int>(x) == fastest;
      (first ? framed : text) += cell_commands(line.cells[x], static_cast<double>(x + 1),
                                               static_cast<double>(y + 1), first);
    }
  }
  return text + framed + "plot 1/0\n";
}

}  // namespace

void draw_matrix(const StressMatrix& matrix, const std::string& path) {
  check_plot_name(path);
  OutputFile picture(path);
  draw_script(script(matrix, path, picture.temporary().string()), picture);
  picture.commit();
}

}  // namespace casimir::tools

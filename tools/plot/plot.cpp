#include "tools/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tools/cli/output.hpp"
#include "tools/plot/gnuplot.hpp"
#include "tools/plot/thinned.hpp"

namespace casimir::tools {
namespace {

/// Okabe and Ito's colours, which differ in lightness too, and further ones apart from them.
constexpr const char* kCurveColours[] = {"#0072b2", "#d55e00", "#009e73", "#e69f00",
                                         "#cc79a7", "#000000", "#882255", "#56b4e9",
                                         "#808080", "#117733", "#332288", "#999933"};
/// The same on a dark page: as far from it as those are from white.
constexpr const char* kDarkColours[] = {"#4db2f0", "#ff8a3d", "#2fd6a4", "#ffc14d",
                                        "#f0a0cc", "#f0f0f0", "#e0709f", "#8fd3ff",
                                        "#a8a8a8", "#5fc97f", "#a89cf5", "#d6d66a"};
constexpr const char* kGrid = "#d8d8d8";
constexpr const char* kGuide = "#b0b0b0";

/// gnuplot's numbers of marks that have an open and a filled form: with them, curves can be told
/// apart without colour.
struct Mark {
  int open, filled;
};
constexpr Mark kMarks[] = {{4, 5}, {6, 7}, {8, 9}, {10, 11}, {12, 13}, {14, 15}};

/// Patterns of lines without a mark at every point, for the same reason.
constexpr const char* kDashes[] = {"solid", "(14,5)", "(5,4)", "(14,4,3,4)", "(24,6)", "(3,5)"};

bool drawn(const Plot& plot, const std::pair<double, double>& point) {
  const auto [x, y] = point;
  return std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0) && (!plot.log_y || y > 0);
}

/// So that a long line has a few marks, which do not lie above those of the others.
std::size_t marked_every(const Curve& curve, std::size_t group) {
  constexpr std::size_t kMarksOfLine = 8, kStagger = 9;
  const std::size_t points = curve.points.size();
  return std::max<std::size_t>(1, points / kMarksOfLine + group % 6 * points / (kStagger * 12));
}

std::string style_of(const Curve& curve, std::size_t group, const Print& print) {
  const Mark mark = kMarks[group % std::size(kMarks)];
  // Curves in grey would be hard to tell apart, and to see.
  const std::string colour =
      print.monochrome ? "#000000" : kCurveColours[group % std::size(kCurveColours)];
  switch (curve.style) {
    case Curve::Style::line:
      return fmt::format("linespoints lw 1.6 dt {} pt {} ps 0.9 pi {} lc rgb '{}'",
                         kDashes[group % std::size(kDashes)], mark.filled,
                         marked_every(curve, group), colour);
    case Curve::Style::path:
      return fmt::format("lines lw 1.2 lc rgb '{}'", colour);
    case Curve::Style::mark:
      return fmt::format("points lw 1.6 pt {} ps 1.3 lc rgb '{}'", kMarks[1].filled, colour);
    case Curve::Style::far_mark:
      return fmt::format("points lw 1.6 pt {} ps 1.3 lc rgb '{}'", kMarks[1].open, colour);
    case Curve::Style::guide:
      return fmt::format("lines lw 0.8 lc rgb '{}'", kGuide);
    case Curve::Style::faint:
      return fmt::format("lines lw 1.0 dt (2,4) lc rgb '{}'", colour);
    case Curve::Style::variant:
      return fmt::format("points lw 1.2 pt {} ps 1.8 lc rgb '{}'", mark.open, colour);
    case Curve::Style::outside:
      return fmt::format("linespoints lw 1.6 dt (8,4) pt {} ps 1.1 lc rgb '{}'", mark.open, colour);
    default:
      return fmt::format("linespoints lw 2 pt {} ps 1.0 lc rgb '{}'", mark.filled, colour);
  }
}

bool in_legend(const Curve& curve) {
  return curve.style != Curve::Style::guide && curve.style != Curve::Style::faint &&
         !curve.name.empty() && !curve.points.empty();
}

/// Points that are not drawn interrupt their curve.
std::string data_of(const Plot& plot, const Curve& curve) {
  std::string points;
  bool gap = false;
  for (const auto& point : curve.points) {
    if (drawn(plot, point)) {
      if (gap && !points.empty() && !plot.log_x && !plot.log_y) points += '\n';
      points += fmt::format("{:.9g} {:.9g}\n", point.first, point.second);
    }
    gap = !drawn(plot, point);
  }
  return points;
}

std::string axes(const Plot& plot, const Sheet& sheet) {
  const Print& print = sheet.print;
  std::string text;
  if (!plot.title.empty() && print.title)
    text += fmt::format("set title {} noenhanced\n",
                        quoted_lines(plot.title, letters_across(print, 0.9), sheet));
  if (plot.square) {
    text += "set size ratio -1\nunset border\nunset tics\nset lmargin 2\nset rmargin 2\n";
  } else {
    text += fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\n",
                        quoted_lines(plot.x_label, letters_across(print, 0.8), sheet),
                        quoted_lines(plot.y_label, letters_across(print, 0.5), sheet));
    text +=
        fmt::format("set grid lt 1 lw 0.8 lc rgb '{}'\nset tics nomirror\nset border 3\n", kGrid);
  }
  const char* power = sheet.latex() ? "'$10^{%T}$'" : "'10^{%T}'";
  if (plot.log_x) text += fmt::format("set logscale x\nunset mxtics\nset format x {}\n", power);
  if (plot.log_y) text += fmt::format("set logscale y\nset format y {}\n", power);
  if (!plot.y_unit.empty())
    text += fmt::format("set micro\nset format y {}\n", quoted("%.0s %c" + plot.y_unit, {".svg"}));
  return text;
}

std::string script(const Plot& plot, const Sheet& sheet, const std::string& terminal,
                   const std::string& key, const std::string& output) {
  std::string text = fmt::format("set encoding utf8\nset terminal {}\nset output {}\n{}", terminal,
                                 quoted_path(output), axes(plot, sheet));
  const bool legend = std::ranges::any_of(plot.curves, in_legend);
  text += legend ? "set key " + key + "\n" : "unset key\n";
  std::string commands;
  std::size_t group = 0;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    const std::string points = data_of(plot, curve);
    if (!points.empty()) {
      text += fmt::format("$curve{} << EOD\n{}EOD\n", i, points);
      commands +=
          fmt::format("{}$curve{} using 1:2 with {} {}", commands.empty() ? "plot " : ", \\\n     ",
                      i, style_of(curve, group, sheet.print),
                      in_legend(curve) ? "title " + quoted(curve.name, sheet) + " noenhanced"
                                       : std::string("notitle"));
    }
    const bool next_has_it =
        curve.style == Curve::Style::guide || curve.style == Curve::Style::faint ||
        (i + 1 < plot.curves.size() && plot.curves[i + 1].style == Curve::Style::variant);
    if (!next_has_it) ++group;
  }
  // gnuplot refuses a plot of nothing.
  if (commands.empty()) {
    text += "unset key\nset xrange [1e-3:1]\nset yrange [1e-3:1]\n";
    commands = "plot 1/0";
  }
  return text + commands + "\n";
}

constexpr const char* kKeyBeside = "outside right top Left reverse";

ScreenSize screen_size(const Plot& plot) {
  return plot.square ? ScreenSize{720, 760, 13} : ScreenSize{1000, 600, 13};
}

/// A legend below the curves: as many columns as the longest name allows, where gnuplot itself
/// would take one.
struct KeyBelow {
  std::size_t lines = 0;
  std::string key;
};

/// \param width  of the picture, and `sample` of what stands before a name, in letters
KeyBelow key_below(const Plot& plot, double width, double sample) {
  std::size_t entries = 0, longest = 0;
  for (const Curve& curve : plot.curves) {
    if (!in_legend(curve)) continue;
    ++entries;
    longest = std::max(longest, curve.name.size());
  }
  const double columns =
      std::clamp(std::floor(width / (sample + static_cast<double>(longest))), 1., 4.);
  const auto lines = static_cast<std::size_t>(std::ceil(static_cast<double>(entries) / columns));
  return {lines, fmt::format("below center vertical maxrows {} Left reverse spacing 1.15", lines)};
}

std::string sheet_script(const Plot& plot, const Sheet& sheet, const std::string& output) {
  const ScreenSize screen = screen_size(plot);
  if (!is_narrow(sheet.print))
    return script(plot, sheet, terminal_of(sheet, screen), kKeyBeside, output);
  // In a column the legend stands below, and makes the figure higher.
  constexpr double kSample = 9, kMillimetresOfLine = 3.6;
  const auto [lines, key] =
      key_below(plot, static_cast<double>(letters_across(sheet.print, 1)), kSample);
  Sheet higher = sheet;
  if (!higher.print.height)
    higher.print.height =
        height_in_print(sheet.print, screen) + kMillimetresOfLine * static_cast<double>(lines);
  return script(plot, sheet, terminal_of(higher, screen),
                key + (sheet.latex() ? "\nset xlabel offset 0,0.6" : "\nset xlabel offset 0,0.4"),
                output);
}

/// The element in what gnuplot wrote, with `name` before every identifier.
std::string element_of(const OutputFile& picture, const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(picture.temporary(), std::ios::binary).rdbuf();
  std::string svg = text.str();
  svg.erase(0, std::min(svg.find("<svg"), svg.size()));
  for (const std::string before : {"id='", "id=\"", "href='#", "href=\"#", "url(#"}) {
    for (std::size_t at = svg.find(before); at != std::string::npos;
         at = svg.find(before, at + before.size()))
      svg.insert(at + before.size(), name + "-");
  }
  return svg;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// As gnuplot writes a colour into SVG: "rgb(  0, 114, 178)", without the spaces.
std::string rgb(const std::string& hex) {
  const auto part = [&](std::size_t at) { return std::stoi(hex.substr(at, 2), nullptr, 16); };
  return fmt::format("rgb({},{},{})", part(1), part(3), part(5));
}

/// Colours become variables of the page.
void use_variables(std::string& svg) {
  for (std::size_t at = svg.find("rgb("); at != std::string::npos; at = svg.find("rgb(", at + 4)) {
    const std::size_t end = svg.find(')', at);
    if (end == std::string::npos) break;
    std::string colour = svg.substr(at, end - at);
    std::erase(colour, ' ');
    svg.replace(at, end - at, colour);
  }
  for (std::size_t i = 0; i < std::size(kCurveColours); ++i)
    replace_all(svg, rgb(kCurveColours[i]), fmt::format("var(--plot-{})", i + 1));
  replace_all(svg, rgb(kGrid), "var(--plot-grid)");
  replace_all(svg, rgb(kGuide), "var(--plot-guide)");
  for (const char* name : {"black", "#ffffff", "#FFFFFF", "white"}) {
    const char* variable = name[0] == 'b' ? "var(--plot-ink)" : "var(--plot-paper)";
    for (const char quote : {'"', '\''}) {
      for (const char* key : {"fill=", "stroke=", "color="})
        replace_all(svg, fmt::format("{}{}{}{}", key, quote, name, quote),
                    fmt::format("{}{}{}{}", key, quote, variable, quote));
    }
  }
}

/// Makes gnuplot write down, behind the picture, where the frame is and what stands there.
std::string axes_script(const Plot& plot, const std::string& file) {
  return fmt::format(
      "set print {}\nif (exists('GPVAL_TERM_XMIN') && exists('GPVAL_X_MIN')) print sprintf('%.8g "
      "%.8g %.8g %.8g %.12g %.12g %.12g %.12g {} {}', GPVAL_TERM_XMIN, GPVAL_TERM_XMAX, "
      "GPVAL_TERM_YMIN, GPVAL_TERM_YMAX, GPVAL_X_MIN, GPVAL_X_MAX, GPVAL_Y_MIN, GPVAL_Y_MAX)\n"
      "unset print\n",
      quoted_path(file), plot.log_x ? 1 : 0, plot.log_y ? 1 : 0);
}

/// What it wrote, if these are ten numbers.
std::string axes_known(const std::string& file) {
  std::ifstream stream(file);
  std::string text;
  int count = 0;
  for (double number = 0; stream >> number; ++count)
    text += fmt::format("{}{}", text.empty() ? "" : " ", number);
  return count == 10 ? text : "";
}

}  // namespace

void draw(const Plot& plot, const Sheet& sheet) {
  draw_sheet(sheet, [&](const std::string& output) { return sheet_script(plot, sheet, output); });
}

std::string svg_element(const Plot& plot, const std::string& name, const std::string& beside) {
  OutputFile picture(beside + "." + name + ".svg");
  draw_script(sheet_script(plot, {".svg"}, picture.temporary().string()), picture.temporary());
  return element_of(picture, name);
}

std::string page_svg(const Plot& plot, const std::string& name, const std::string& beside) {
  // As wide as a telephone shows it, about: letters stay legible there.
  constexpr std::size_t kWidth = 480, kHeight = 350, kLine = 21;
  constexpr double kLetter = 7.4, kSample = 60, kApart = 0.15;
  const std::size_t width = plot.square ? kHeight : kWidth;
  const auto [lines, below] =
      key_below(plot, static_cast<double>(width) / kLetter, kSample / kLetter);
  const std::string terminal =
      fmt::format("svg size {},{} dynamic background rgb 'white' font 'sans,13.5' enhanced", width,
                  kHeight + kLine * lines);
  const std::string key = below + " font ',12.5'\nset xlabel offset 0,0.8";
  OutputFile picture(beside + "." + name + ".svg");
  OutputFile axes(beside + "." + name + ".axes");
  const std::string values = axes.temporary().string();
  draw_script(script(plot, {".svg"}, terminal, key, picture.temporary().string()) +
                  (plot.square ? "" : axes_script(plot, values)),
              picture.temporary());
  std::string svg = with_thinned_paths(element_of(picture, name), kApart);
  use_variables(svg);
  const std::string known = axes_known(values);
  if (!known.empty()) svg.insert(4, " data-axes=\"" + known + "\"");
  return svg;
}

std::string plot_variables(bool dark) {
  std::string text = dark ? "--plot-ink:#e6e6e6;--plot-paper:#16181c;--plot-grid:#3a3d44;"
                            "--plot-guide:#5c6068;"
                          : "--plot-ink:#000;--plot-paper:#fff;--plot-grid:#d8d8d8;"
                            "--plot-guide:#b0b0b0;";
  for (std::size_t i = 0; i < std::size(kCurveColours); ++i)
    text += fmt::format("--plot-{}:{};", i + 1, dark ? kDarkColours[i] : kCurveColours[i]);
  return text;
}

}  // namespace casimir::tools

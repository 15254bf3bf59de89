#include "tools/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tools/gnuplot.hpp"
#include "tools/output.hpp"

namespace casimir::tools {
namespace {

/// Okabe and Ito's colours, which differ in lightness too, and further ones apart from them.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#e69f00",
                                    "#cc79a7", "#000000", "#882255", "#56b4e9",
                                    "#808080", "#117733", "#332288", "#999933"};

/// gnuplot's numbers of marks that have an open and a filled form: with them, curves can be told
/// apart without colour.
struct Mark {
  int open, filled;
};
constexpr Mark kMarks[] = {{4, 5}, {6, 7}, {8, 9}, {10, 11}, {12, 13}, {14, 15}};

constexpr const char* kSvg = "svg size 1000,600 dynamic background rgb 'white' font 'sans,13'";

bool drawn(const Plot& plot, const std::pair<double, double>& point) {
  const auto [x, y] = point;
  return std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0) && (!plot.log_y || y > 0);
}

std::string style_of(const Curve& curve, std::size_t group) {
  const Mark mark = kMarks[group % std::size(kMarks)];
  const char* colour = kColours[group % std::size(kColours)];
  switch (curve.style) {
    case Curve::Style::line:
      return fmt::format("lines lw 1.6 lc rgb '{}'", colour);
    case Curve::Style::variant:
      return fmt::format("points lw 1.2 pt {} ps 1.8 lc rgb '{}'", mark.open, colour);
    case Curve::Style::outside:
      return fmt::format("linespoints lw 1.6 dt (8,4) pt {} ps 1.1 lc rgb '{}'", mark.open, colour);
    default:
      return fmt::format("linespoints lw 2 pt {} ps 1.0 lc rgb '{}'", mark.filled, colour);
  }
}

std::string script(const Plot& plot, const std::string& terminal, const std::string& output) {
  std::string text = fmt::format("set encoding utf8\nset terminal {} noenhanced\nset output {}\n",
                                 terminal, quoted(output));
  if (!plot.title.empty()) text += fmt::format("set title {}\n", quoted(plot.title));
  text += fmt::format("set xlabel {}\nset ylabel {}\n", quoted(plot.x_label), quoted(plot.y_label));
  text +=
      "set grid lt 1 lw 0.8 lc rgb '#d8d8d8'\nset key outside right top Left reverse\nset tics "
      "nomirror\nset border 3\n";
  if (plot.log_x) text += "set logscale x\nunset mxtics\nset format x '1e%T'\n";
  if (plot.log_y) text += "set logscale y\nset format y '1e%T'\n";
  if (!plot.y_unit.empty())
    text += fmt::format("set format y {}\n", quoted("%.0s %c" + plot.y_unit));
  std::string commands;
  std::size_t group = 0;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    if (i > 0 && curve.style != Curve::Style::variant) ++group;
    std::string points;
    for (const auto& point : curve.points)
      if (drawn(plot, point)) points += fmt::format("{:.9g} {:.9g}\n", point.first, point.second);
    if (points.empty()) continue;
    text += fmt::format("$curve{} << EOD\n{}EOD\n", i, points);
    commands += fmt::format("{}$curve{} using 1:2 with {} title {}",
                            commands.empty() ? "plot " : ", \\\n     ", i, style_of(curve, group),
                            quoted(curve.name));
  }
  // gnuplot refuses a plot of nothing.
  if (commands.empty()) {
    text += "unset key\nset xrange [1e-3:1]\nset yrange [1e-3:1]\n";
    commands = "plot 1/0";
  }
  return text + commands + "\n";
}

}  // namespace

void draw(const Plot& plot, const std::string& path) {
  check_plot_name(path);
  const std::string terminal = path.ends_with(".svg")
                                   ? kSvg
                                   : "pngcairo size 1300,780 font 'sans,13' background rgb 'white'";
  OutputFile picture(path);
  draw_script(script(plot, terminal, picture.temporary().string()), picture);
  picture.commit();
}

std::string svg_element(const Plot& plot, const std::string& name, const std::string& beside) {
  OutputFile picture(beside + "." + name + ".svg");
  draw_script(script(plot, kSvg, picture.temporary().string()), picture);
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

}  // namespace casimir::tools

#include "tools/section/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "tools/gnuplot.hpp"
#include "tools/output.hpp"

namespace casimir::tools {
namespace {

/// Okabe and Ito's colours that are dark enough beside the grey of chaos.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#882255", "#000000", "#b07000"};
constexpr const char* kChaos = "#9c9c9c";
const double kPi = std::acos(-1.);

bool is_angle(const PlottedFunction& function) { return function.period > 0; }

std::string label_of(const PlottedFunction& function) {
  if (!is_angle(function)) return function.label;
  const bool plain = std::ranges::all_of(
      function.label, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  return (plain ? function.label : "(" + function.label + ")") + " / pi";
}

std::string axis(const PlottedFunction& function, char name) {
  std::string text = fmt::format("set {}label {}\n", name, quoted(label_of(function)));
  if (is_angle(function))
    text += fmt::format("set {}range [0:{:.9g}]\nset {}tics 0.25*{:.9g}\n", name,
                        function.period / kPi, name, function.period / kPi);
  return text;
}

std::string point_text(const SectionProblem& problem, const std::array<double, 2>& place) {
  const auto value = [&](std::size_t k) {
    return is_angle(problem.plotted[k]) ? place[k] / kPi : place[k];
  };
  return fmt::format("{:.7g} {:.7g}\n", value(0), value(1));
}

class Drawing {
 public:
  explicit Drawing(const SectionProblem& problem) : problem_(problem) {}

  void add(const std::string& points, const std::string& style, const std::string& name) {
    if (points.empty()) return;
    blocks_ += fmt::format("$set{} << EOD\n{}EOD\n", count_, points);
    plots_ += fmt::format("{}$set{} using 1:2 with points {} {}", plots_.empty() ? "plot " : ", \\\n     ",
                          count_++, style, name.empty() ? "notitle" : "title " + quoted(name));
  }

  /// An entry of the legend, with a mark of its own: those in the picture are too small.
  void explain(const std::string& style, const std::string& name) {
    plots_ += fmt::format("{}1/0 with points {} title {}", plots_.empty() ? "plot " : ", \\\n     ",
                          style, quoted(name));
  }

  std::string places(const std::vector<std::array<double, 2>>& places) const {
    std::string text;
    for (const auto& place : places)
      if (std::isfinite(place[0]) && std::isfinite(place[1])) text += point_text(problem_, place);
    return text;
  }

  /// A little more than the points take; an angle has its period.
  std::string range(std::size_t k, const std::vector<OrbitReport>& orbits) const {
    if (is_angle(problem_.plotted[k])) return {};
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (const OrbitReport& orbit : orbits) {
      for (const auto& place : orbit.places) {
        least = std::min(least, place[k]);
        largest = std::max(largest, place[k]);
      }
    }
    if (!(least < largest) || !std::isfinite(largest - least)) return {};
    const double margin = 0.03 * (largest - least);
    return fmt::format("set {}range [{:.9g}:{:.9g}]\n", k == 0 ? 'x' : 'y', least - margin,
                       largest + margin);
  }

  void bound(const std::vector<OrbitReport>& orbits) { ranges_ = range(0, orbits) + range(1, orbits); }

  std::string script(const std::string& title, const std::string& terminal,
                     const std::string& output) const {
    std::string text = fmt::format(
        "set encoding utf8\nset terminal {} noenhanced\nset output {}\nset title {}\n", terminal,
        quoted(output), quoted(title));
    text += axis(problem_.plotted[0], 'x') + axis(problem_.plotted[1], 'y') + ranges_;
    text += "set key outside top center horizontal samplen 1\nset border 15 lw 1\n"
            "set tics out nomirror\n";
    if (plots_.empty()) return text + "set xrange [0:1]\nset yrange [0:1]\nplot 1/0 notitle\n";
    return text + blocks_ + plots_ + "\n";
  }

 private:
  const SectionProblem& problem_;
  std::string blocks_, plots_, ranges_;
  int count_ = 0;
};

void add_orbits(Drawing& drawing, const std::vector<OrbitReport>& orbits) {
  std::size_t total = 0;
  for (const OrbitReport& orbit : orbits) total += orbit.places.size();
  const double size = std::clamp(0.5 * std::sqrt(12000. / static_cast<double>(total + 1)), 0.16, 0.5);
  std::string chaos;
  bool regular = false;
  for (const OrbitReport& orbit : orbits)
    if (orbit.chaotic) chaos += drawing.places(orbit.places);
  drawing.add(chaos, fmt::format("pt 7 ps {:.3f} lc rgb '{}'", 0.6 * size, kChaos), "");
  std::size_t colour = 0;
  for (const OrbitReport& orbit : orbits) {
    if (orbit.chaotic) continue;
    regular = true;
    drawing.add(drawing.places(orbit.places),
                fmt::format("pt 7 ps {:.3f} lc rgb '{}'", size,
                            kColours[colour++ % std::size(kColours)]),
                "");
  }
  if (regular) drawing.explain(fmt::format("pt 7 ps 0.8 lc rgb '{}'", kColours[0]), "regular orbits");
  if (!chaos.empty()) drawing.explain(fmt::format("pt 7 ps 0.8 lc rgb '{}'", kChaos), "chaotic orbits");
}

void add_cycles(Drawing& drawing, const std::vector<Cycle>& cycles) {
  for (const bool stable : {true, false}) {
    std::string points;
    for (const Cycle& cycle : cycles) {
      if (cycle.stable() != stable) continue;
      std::vector<std::array<double, 2>> places;
      for (const PlacedPoint& point : cycle.points) places.push_back(point.place);
      points += drawing.places(places);
    }
    drawing.add(points, stable ? "pt 6 ps 1.3 lw 1.5 lc rgb '#000000'" : "pt 2 ps 1.3 lw 1.5 lc rgb '#000000'",
                stable ? "stable cycles" : "unstable cycles");
  }
}

}  // namespace

void draw_section(const SectionProblem& problem, const std::string& title,
                  const std::vector<OrbitReport>& orbits, const std::vector<Cycle>& cycles,
                  const std::string& path) {
  check_plot_name(path);
  Drawing drawing(problem);
  drawing.bound(orbits);
  add_orbits(drawing, orbits);
  add_cycles(drawing, cycles);
  const std::string terminal =
      path.ends_with(".svg") ? "svg size 1000,700 dynamic background rgb 'white' font 'sans,14'"
                             : "pngcairo size 1500,1050 font 'sans,17' background rgb 'white'";
  OutputFile picture(path);
  draw_script(drawing.script(title, terminal, picture.temporary().string()), picture);
  picture.commit();
}

}  // namespace casimir::tools

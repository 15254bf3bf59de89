#include "tools/section/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "tools/cli/output.hpp"
#include "tools/plot/gnuplot.hpp"
#include "tools/plot/thinned.hpp"
#include "tools/typeset/printed_names.hpp"

namespace casimir::tools {
namespace {

/// Okabe and Ito's colours that are dark enough beside the grey of chaos.
constexpr const char* kInks[] = {"#0072b2", "#d55e00", "#009e73", "#882255", "#000000", "#b07000"};
constexpr const char* kChaos = "#909090";
/// Open circles, which can be told from grey dots.
constexpr const char* kUnknown = "pt 6 ps 0.7 lc rgb '#707070'";
const double kPi = std::acos(-1.);

bool is_angle(const PlottedFunction& function) { return function.period > 0; }

std::string axis_label(const PlottedFunction& function) {
  const std::string label = printed_names(function.label);
  if (!is_angle(function)) return label;
  const bool plain = std::ranges::all_of(
      function.label, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  return (plain ? label : "(" + label + ")") + "/π";
}

/// An axis of the picture: which part of it is shown.
struct PictureAxis {
  double from = 0, to = 0;  ///< nothing to show where they are equal
  double period = 0;

  double at(double value) const {
    return period > 0 ? from + std::fmod(value - from + 2 * period, period) : value;
  }
};

/// An angle that does not take all values is cut open where none are.
PictureAxis cut_open(std::vector<double> values, double period) {
  std::ranges::sort(values);
  double widest = values.front() + period - values.back();
  double from = values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] - values[i - 1] <= widest) continue;
    widest = values[i] - values[i - 1];
    from = values[i] - period;
  }
  constexpr double kGap = 0.1;
  if (widest < kGap * period) return {0, period, period};
  const double margin = 0.03 * (period - widest);
  return {from - margin, from + period - widest + margin, period};
}

/// A little more than the values take.
PictureAxis axis_of(const PlottedFunction& function, std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {0, is_angle(function) ? function.period : 1, function.period};
  if (is_angle(function)) return cut_open(std::move(values), function.period);
  const auto [least, largest] = std::ranges::minmax(values);
  const double margin = largest > least ? 0.03 * (largest - least) : 1;
  return {least - margin, largest + margin, 0};
}

double axis_unit(const PlottedFunction& function) { return is_angle(function) ? kPi : 1; }

class Drawing {
 public:
  Drawing(const std::array<PlottedFunction, 2>& plotted, const Sheet& sheet)
      : plotted_(plotted), sheet_(sheet) {}

  void add(const std::string& points, const std::string& style, const std::string& name) {
    if (points.empty()) return;
    blocks_ += fmt::format("$set{} << EOD\n{}EOD\n", count_, points);
    plots_ += fmt::format(
        "{}$set{} using 1:2 with points {} {}", plots_.empty() ? "plot " : ", \\\n     ", count_++,
        style, name.empty() ? "notitle" : "title " + quoted(name, sheet_) + " noenhanced");
  }

  /// Points with a value each, which their colours show.
  void add_coloured(const std::string& points, const std::string& style) {
    if (points.empty()) return;
    blocks_ += fmt::format("$set{} << EOD\n{}EOD\n", count_, points);
    plots_ += fmt::format("{}$set{} using 1:2:3 with points {} lc palette notitle",
                          plots_.empty() ? "plot " : ", \\\n     ", count_++, style);
  }

  /// The scale beside the picture.
  void scale(const std::string& label) {
    scale_ = fmt::format(
        "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#e0c516')\n"
        "set cblabel {} noenhanced\n",
        quoted(label, sheet_));
  }

  /// An entry of the legend, with a mark of its own: those in the picture are too small.
  void explain(const std::string& style, const std::string& name) {
    plots_ += fmt::format("{}1/0 with points {} title {}", plots_.empty() ? "plot " : ", \\\n     ",
                          style, quoted(name, sheet_));
  }

  std::string places(const std::vector<std::array<double, 2>>& places,
                     const std::string& behind = {}) const {
    std::string text;
    for (const auto& place : places) {
      if (!std::isfinite(place[0]) || !std::isfinite(place[1])) continue;
      text += fmt::format("{:.7g} {:.7g}{}\n", axes_[0].at(place[0]) / axis_unit(plotted_[0]),
                          axes_[1].at(place[1]) / axis_unit(plotted_[1]), behind);
    }
    return text;
  }

  void bound(const std::vector<OrbitReport>& orbits) {
    for (std::size_t k = 0; k < 2; ++k) {
      std::vector<double> values;
      for (const OrbitReport& orbit : orbits)
        for (const auto& place : orbit.places) values.push_back(place[k]);
      axes_[k] = axis_of(plotted_[k], std::move(values));
    }
  }

  std::string script(const std::string& title, const std::string& terminal,
                     const std::string& output) const {
    std::string text = fmt::format("set encoding utf8\nset terminal {}\nset output {}\n", terminal,
                                   quoted_path(output));
    if (sheet_.print.title)
      text += fmt::format("set title {} noenhanced\n",
                          quoted_lines(title, letters_across(sheet_.print, 0.9), sheet_));
    for (std::size_t k = 0; k < 2; ++k) {
      const double unit = axis_unit(plotted_[k]);
      text += fmt::format("set {0}label {1} noenhanced\nset {0}range [{2:.9g}:{3:.9g}]\n",
                          k == 0 ? 'x' : 'y', quoted(axis_label(plotted_[k]), sheet_),
                          axes_[k].from / unit, axes_[k].to / unit);
    }
    text +=
        "set key outside bottom center horizontal samplen 1\nset border 15 lw 1\n"
        "set tics out nomirror\nset xlabel offset 0,0.3\n";
    text += scale_;
    if (plots_.empty()) return text + "plot 1/0 notitle\n";
    return text + blocks_ + plots_ + "\n";
  }

 private:
  const std::array<PlottedFunction, 2>& plotted_;
  const Sheet& sheet_;
  std::array<PictureAxis, 2> axes_;
  std::string blocks_, plots_, scale_;
  int count_ = 0;
};

double point_size(const std::vector<OrbitReport>& orbits) {
  std::size_t total = 0;
  for (const OrbitReport& orbit : orbits) total += orbit.places.size();
  return std::clamp(0.5 * std::sqrt(12000. / static_cast<double>(total + 1)), 0.16, 0.5);
}

void add_coloured_orbits(Drawing& drawing, const std::vector<OrbitReport>& orbits,
                         const OrbitColours& colours) {
  const std::string style = fmt::format("pt 7 ps {:.3f}", point_size(orbits));
  std::string grey, coloured;
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    const double value = colours.values[i];
    if (std::isfinite(value))
      coloured += drawing.places(orbits[i].places, fmt::format(" {:.7g}", value));
    else
      grey += drawing.places(orbits[i].places);
  }
  drawing.add(grey, fmt::format("{} lc rgb '{}'", style, kChaos), "");
  drawing.add_coloured(coloured, style);
  if (!coloured.empty()) drawing.scale(colours.what);
  if (!grey.empty()) drawing.explain(fmt::format("pt 7 ps 0.8 lc rgb '{}'", kChaos), "not known");
}

void add_orbits(Drawing& drawing, const std::vector<OrbitReport>& orbits, const Print& print) {
  const double size = point_size(orbits);
  std::string chaos, unknown;
  for (const OrbitReport& orbit : orbits) {
    if (!orbit.judged)
      unknown += drawing.places(orbit.places);
    else if (orbit.chaotic)
      chaos += drawing.places(orbit.places);
  }
  drawing.add(unknown, kUnknown, "");
  drawing.add(chaos, fmt::format("pt 7 ps {:.3f} lc rgb '{}'", 0.75 * size, kChaos), "");
  std::size_t colour = 0;
  for (const OrbitReport& orbit : orbits) {
    if (orbit.chaotic || !orbit.judged) continue;
    drawing.add(drawing.places(orbit.places),
                fmt::format("pt 7 ps {:.3f} lc rgb '{}'", size,
                            ink(print, kInks[colour++ % std::size(kInks)])),
                "");
  }
  const auto dot = [](const std::string& ink_of) {
    return fmt::format("pt 7 ps 0.8 lc rgb '{}'", ink_of);
  };
  if (colour > 0) drawing.explain(dot(ink(print, kInks[0])), "regular orbits");
  if (!chaos.empty()) drawing.explain(dot(kChaos), "chaotic orbits");
  if (!unknown.empty()) drawing.explain(kUnknown, "not known");
}

void add_cycles(Drawing& drawing, const std::vector<Cycle>& cycles) {
  for (const bool elliptic : {true, false}) {
    std::string points;
    for (const Cycle& cycle : cycles) {
      if ((cycle.stability() == SpectralStability::stable) != elliptic) continue;
      std::vector<std::array<double, 2>> places;
      for (const PlacedPoint& point : cycle.points) places.push_back(point.place);
      points += drawing.places(places);
    }
    drawing.add(
        points,
        elliptic ? "pt 6 ps 1.3 lw 1.5 lc rgb '#000000'" : "pt 2 ps 1.3 lw 1.5 lc rgb '#000000'",
        elliptic ? "elliptic cycles" : "other cycles");
  }
}

/// A hundred thousand marks would be ten megabytes.
void join_marks(const std::filesystem::path& svg) {
  std::ostringstream text;
  text << std::ifstream(svg, std::ios::binary).rdbuf();
  std::ofstream(svg, std::ios::binary) << with_joined_marks(text.str());
}

}  // namespace

OrbitColours colours_by(const std::string& what, const std::vector<OrbitReport>& orbits,
                        const std::vector<Rotation>& rotations) {
  if (what.empty()) return {};
  OrbitColours colours{what == "megno"      ? "MEGNO, at most 6"
                       : what == "exponent" ? "Lyapunov exponent"
                                            : "rotation number",
                       {}};
  constexpr double kMostMegno = 6;  // beyond it is chaos, and how far depends on the time
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (what == "rotation") {
      if (rotations[i].kind != Rotation::Kind::none) value = rotations[i].number;
    } else if (orbits[i].judged) {
      value = what == "megno" ? std::min(orbits[i].megno, kMostMegno) : orbits[i].exponent;
    }
    colours.values.push_back(value);
  }
  return colours;
}

void draw_section(const std::array<PlottedFunction, 2>& plotted, const std::string& title,
                  const std::vector<OrbitReport>& orbits, const std::vector<Cycle>& cycles,
                  const Sheet& sheet, const OrbitColours& colours) {
  Drawing drawing(plotted, sheet);
  drawing.bound(orbits);
  if (colours.what.empty())
    add_orbits(drawing, orbits, sheet.print);
  else
    add_coloured_orbits(drawing, orbits, colours);
  add_cycles(drawing, cycles);
  const auto script = [&](const std::string& output) {
    return drawing.script(title, terminal_of(sheet, {1000, 700, 14}), output);
  };
  const bool svg = sheet.path.ends_with(".svg");
  draw_sheet(sheet, script, svg ? join_marks : std::function<void(const std::filesystem::path&)>());
}

}  // namespace casimir::tools

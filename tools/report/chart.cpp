#include "tools/report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tools/plot/thinned.hpp"
#include "tools/typeset/html.hpp"

namespace casimir::tools {
namespace {

constexpr int kColours = 12;

/// The frame of a picture and the values along its sides.
struct ChartFrame {
  double left, right, top, bottom;
  std::array<double, 2> x, y;

  std::pair<double, double> at(const std::pair<double, double>& point) const {
    return {left + (point.first - x[0]) / (x[1] - x[0]) * (right - left),
            bottom - (point.second - y[0]) / (y[1] - y[0]) * (bottom - top)};
  }
};

bool is_finite(const std::pair<double, double>& point) {
  return std::isfinite(point.first) && std::isfinite(point.second);
}

/// What the points take, and a little more.
std::array<double, 2> range_of(const Chart& chart, bool of_x, double margin) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Chart::Curve& curve : chart.curves) {
    for (const auto& point : curve.points) {
      if (!is_finite(point)) continue;
      low = std::min(low, of_x ? point.first : point.second);
      high = std::max(high, of_x ? point.first : point.second);
    }
  }
  if (low > high) return {0, 1};
  const double more = high > low ? margin * (high - low) : std::max(0.1 * std::abs(high), 1e-3);
  return {low - more, high + more};
}

/// A line through few points.
std::string line_path(const ChartFrame& frame, const Chart::Curve& curve) {
  constexpr double kApart = 0.12;
  std::string path;
  PicturePoints part;
  const auto finish = [&] {
    const char* command = "M";
    for (const auto& [x, y] : thinned(part, kApart)) {
      path += fmt::format("{}{:.1f},{:.1f}", command, x, y);
      command = "L";
    }
    part.clear();
  };
  for (const auto& point : curve.points) {
    if (is_finite(point))
      part.push_back(frame.at(point));
    else
      finish();
  }
  finish();
  return path;
}

/// Points, each place once.
std::string dots_path(const ChartFrame& frame, const Chart::Curve& curve, double raster) {
  std::set<std::pair<long, long>> taken;
  std::string path;
  for (const auto& point : curve.points) {
    if (!is_finite(point)) continue;
    const auto place = frame.at(point);
    if (taken.emplace(std::lround(place.first / raster), std::lround(place.second / raster)).second)
      path += fmt::format("M{:.1f},{:.1f}h0", place.first, place.second);
  }
  return path;
}

std::string colour_of(const Chart::Curve& curve, std::size_t i) {
  if (curve.colour < 0) return "var(--plot-guide)";
  return fmt::format("var(--plot-{})",
                     curve.colour > 0 ? curve.colour : static_cast<int>(i % kColours) + 1);
}

std::string number_text(double value) {
  std::string text = fmt::format("{:.6g}", std::abs(value) < 1e-300 ? 0. : value);
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

/// gnuplot's pictures have their ticks so too: a path and, beside it, a group with the words.
std::string ticks(const ChartFrame& frame) {
  std::string text;
  const auto tick = [&](const std::string& path, double x, double y, const char* anchor,
                        double value) {
    text += fmt::format(
        "<g><path stroke=\"var(--plot-grid)\" d=\"{}\"/><g><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"{}\">{}</text></g></g>\n",
        path, x, y, anchor, number_text(value));
  };
  for (const double value : round_values(frame.x[0], frame.x[1])) {
    const double x = frame.at({value, frame.y[0]}).first;
    tick(fmt::format("M{:.1f},{:.1f}V{:.1f}", x, frame.bottom, frame.top), x, frame.bottom + 16,
         "middle", value);
  }
  for (const double value : round_values(frame.y[0], frame.y[1])) {
    const double y = frame.at({frame.x[0], value}).second;
    tick(fmt::format("M{:.1f},{:.1f}H{:.1f}", frame.left, y, frame.right), frame.left - 6, y + 4.5,
         "end", value);
  }
  return text;
}

/// \param named  with identifiers and titles
std::string curves(const Chart& chart, const ChartFrame& frame, double stroke, double raster,
                   bool named) {
  std::string text;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Chart::Curve& curve = chart.curves[i];
    const std::string path = chart.dots ? dots_path(frame, curve, raster) : line_path(frame, curve);
    if (path.empty()) continue;
    if (named)
      text += fmt::format("<g id=\"{}-gnuplot_plot_{}\"><title>{}</title>", chart.name, i + 1,
                          html::text(curve.name));
    text += fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{} d=\"{}\"/>{}\n",
                        colour_of(curve, i), stroke, chart.dots ? " stroke-linecap=\"round\"" : "",
                        path, named ? "</g>" : "");
  }
  return text;
}

/// The names of the curves behind their colours, in lines; and how many lines these are.
std::pair<std::string, int> legend(const Chart& chart, double left) {
  if (!chart.legend) return {"", 0};
  constexpr double kLetter = 8.2, kGap = 16, kLine = 17, kSample = 16, kSpace = 5;
  std::string text;
  double x = left;
  int lines = 1;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const std::string& name = chart.curves[i].name;
    const double width = kSample + kSpace + kLetter * static_cast<double>(name.size());
    if (x + width > kChartWidth && x > left) {
      x = left;
      ++lines;
    }
    text += fmt::format(
        "<path stroke=\"{}\" stroke-width=\"3\" d=\"M{:.1f},{}h{}\"/><text x=\"{:.1f}\" "
        "y=\"{}\">{}</text>\n",
        colour_of(chart.curves[i], i), x, kLine * lines - 8, kSample, x + kSample + kSpace,
        kLine * lines - 4, html::text(name));
    x += width + kGap;
  }
  return {text, lines};
}

}  // namespace

std::vector<double> round_values(double from, double to) {
  const double rough = (to - from) / 5;
  if (!(rough > 0) || !std::isfinite(rough)) return {};
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5., 2., 1.})
    if (factor * power >= rough) step = factor * power;
  std::vector<double> values;
  for (double k = std::ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k)
    values.push_back(k * step);
  return values;
}

std::string chart_svg(const Chart& chart) {
  constexpr double kMargin = 10, kLine = 17;
  const double left = chart.y_label.empty() ? 52 : 70;
  const auto [names, lines] = legend(chart, left);
  const double top = kLine * lines + 6, bottom = top + chart.height;
  const double height = bottom + (chart.x_label.empty() ? 24 : 42);
  const ChartFrame frame{
      left,
      kChartWidth - kMargin,
      top,
      bottom,
      chart.x_range ? *chart.x_range : range_of(chart, true, chart.dots ? 0.03 : 0),
      chart.y_range ? *chart.y_range : range_of(chart, false, 0.05)};
  std::string text = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" font-family=\"sans-serif\" font-size=\"{}\" "
      "fill=\"var(--plot-ink)\" data-axes=\"{} {} {} {} {} {} {} {} 0 0\">\n<title>{}</title>\n",
      kChartWidth, height, kChartLetters, frame.left, frame.right, height - bottom, height - top,
      frame.x[0], frame.x[1], frame.y[0], frame.y[1], html::text(chart.title));
  text += "<g>" + ticks(frame) + names;
  if (!chart.x_label.empty())
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                        (frame.left + frame.right) / 2, height - 5, html::text(chart.x_label));
  if (!chart.y_label.empty())
    text += fmt::format(
        "<text transform=\"translate(14,{:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (top + bottom) / 2, html::text(chart.y_label));
  text += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
      "stroke=\"var(--plot-ink)\"/></g>\n",
      frame.left, top, frame.right - frame.left, chart.height);
  const double stroke = chart.dots ? 1.7 : 1.4;
  return text + curves(chart, frame, stroke, 0.5, true) + "</svg>\n";
}

std::string thumbnail_svg(const Chart& chart) {
  constexpr double kWidth = 120, kHeight = 90, kMargin = 4, kRaster = 1.6;
  const ChartFrame frame{kMargin,
                         kWidth - kMargin,
                         kMargin,
                         kHeight - kMargin,
                         chart.x_range ? *chart.x_range : range_of(chart, true, 0.02),
                         chart.y_range ? *chart.y_range : range_of(chart, false, 0.02)};
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", kWidth,
                     kHeight, html::text(chart.title)) +
         curves(chart, frame, chart.dots ? 1.3 : 0.9, kRaster, false) + "</svg>\n";
}

}  // namespace casimir::tools

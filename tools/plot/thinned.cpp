#include "tools/plot/thinned.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>

namespace casimir::tools {
namespace {

using Point = std::pair<double, double>;

double distance(const Point& point, const Point& from, const Point& to) {
  const double x = to.first - from.first, y = to.second - from.second;
  const double a = point.first - from.first, b = point.second - from.second;
  const double length = x * x + y * y;
  if (length == 0) return std::hypot(a, b);
  const double share = std::min(1., std::max(0., (a * x + b * y) / length));
  return std::hypot(a - share * x, b - share * y);
}

/// Whether the line from one point to another one stands for all between them.
bool stands_for(const PicturePoints& points, std::size_t from, std::size_t to, double apart) {
  for (std::size_t i = from + 1; i < to; ++i)
    if (distance(points[i], points[from], points[to]) > apart) return false;
  return true;
}

std::string path_text(const PicturePoints& points) {
  std::string text;
  for (const auto& [x, y] : points)
    text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "M" : "L", x, y);
  return text;
}

/// A path of absolute moves and lines. What is none of these stays as it is.
std::string thinned_path(const std::string& path, double apart) {
  std::string result;
  PicturePoints part;
  const auto finish = [&] {
    if (!part.empty()) result += path_text(thinned(part, apart));
    part.clear();
  };
  const char* at = path.c_str();
  for (;;) {
    while (*at == ' ' || *at == '\n' || *at == '\t') ++at;
    const char command = *at;
    if (command == '\0') break;
    if (command != 'M' && command != 'L') {
      if (command != 'Z' && command != 'z') return path;
      finish();
      result += 'Z';
      ++at;
      continue;
    }
    char* end = nullptr;
    const double x = std::strtod(at + 1, &end);
    if (end == at + 1 || (*end != ',' && *end != ' ')) return path;
    at = end + 1;
    const double y = std::strtod(at, &end);
    if (end == at) return path;
    at = end;
    if (command == 'M') finish();
    part.emplace_back(x, y);
  }
  finish();
  return result;
}

/// Marks of one colour and size that stand in a row in gnuplot's picture.
class MarkRun {
 public:
  /// Whether the line is such a mark, of this run or the first of a new one.
  bool take(const std::string& line) {
    static const std::string kBefore = "<use xlink:href='#gpPt6' transform='translate(";
    const std::size_t at = line.find(kBefore);
    if (at == std::string::npos) return false;
    double x = 0, y = 0, scale = 0;
    int length = 0;
    const char* rest = line.c_str() + at + kBefore.size();
    if (std::sscanf(rest, "%lf,%lf) scale(%lf)%n", &x, &y, &scale, &length) != 3) return false;
    const std::string look = rest + length;  // the colour, up to the end of the line
    if (!lines_.empty() && (look != look_ || scale != scale_)) return false;
    look_ = look;
    scale_ = scale;
    lines_ += line + '\n';
    ++count_;
    places_.emplace(std::lround(2 * y), std::lround(2 * x));
    return true;
  }

  /// The run as text; it is empty then.
  std::string end() {
    constexpr std::size_t kFew = 100;
    const std::size_t from = look_.find("color='"), to = look_.find('\'', from + 7);
    std::string text = lines_;
    if (count_ > kFew && from != std::string::npos && to != std::string::npos) {
      text = fmt::format(
          "<path transform='scale(0.5)' fill='none' stroke='{}' stroke-width='{:.2f}' "
          "stroke-linecap='round' d='M0,0",
          look_.substr(from + 7, to - from - 7), 4 * scale_);
      long x = 0, y = 0;
      for (const auto& [row, column] : places_) {
        text += fmt::format("m{},{}h0", column - x, row - y);
        x = column;
        y = row;
      }
      text += "'/>\n";
    }
    *this = {};
    return text;
  }

 private:
  std::string look_, lines_;
  double scale_ = 0;
  std::size_t count_ = 0;
  std::set<std::pair<long, long>> places_;
};

}  // namespace

PicturePoints thinned(const PicturePoints& points, double apart) {
  constexpr std::size_t kFarthest = 60;  // points that one line stands for
  PicturePoints result;
  for (std::size_t i = 0; i < points.size();) {
    result.push_back(points[i]);
    std::size_t next = i + 1;
    while (next + 1 < points.size() && next - i < kFarthest &&
           stands_for(points, i, next + 1, apart))
      ++next;
    i = next;
  }
  return result;
}

std::string with_thinned_paths(const std::string& svg, double apart) {
  std::string result;
  std::size_t at = 0;
  for (;;) {
    const std::size_t begin = svg.find(" d='", at);
    if (begin == std::string::npos) break;
    const std::size_t from = begin + 4, end = svg.find('\'', from);
    if (end == std::string::npos) break;
    result += svg.substr(at, from - at) + thinned_path(svg.substr(from, end - from), apart);
    at = end;
  }
  return result + svg.substr(at);
}

std::string with_joined_marks(const std::string& svg) {
  std::string result;
  MarkRun run;
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);) {
    if (run.take(line)) continue;
    result += run.end();
    if (!run.take(line)) result += line + '\n';
  }
  return result + run.end();
}

}  // namespace casimir::tools

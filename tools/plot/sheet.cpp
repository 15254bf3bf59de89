#include "tools/plot/sheet.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

constexpr double kMillimetresOfInch = 25.4;
/// Pixels of an inch: what SVG means by one, and what journals ask for in bitmaps.
constexpr double kSvgDensity = 96, kPngDensity = 300;
constexpr double kPointsOfInch = 72;
/// Of letters in print where nothing is said.
constexpr double kPrintedPoints = 8;
/// Lines of screens are too heavy beside letters of that size.
constexpr double kPrintedLines = 0.6;

constexpr std::array kEndings = std::to_array<std::string_view>({".svg", ".png", ".pdf", ".tex"});

std::string svg(const Sheet& sheet, const ScreenSize& screen) {
  const Print& print = sheet.print;
  if (!print.width)
    return fmt::format("svg size {},{} dynamic background rgb 'white' font '{},{}'", screen.width,
                       screen.height, print.font, letters_of(sheet, screen));
  const double scale = kSvgDensity / kMillimetresOfInch;
  return fmt::format(
      "svg size {:.0f},{:.0f} fixed background rgb 'white' font '{},{:.3g}' linewidth {}",
      *print.width * scale, height_in_print(print, screen) * scale, print.font,
      letters_of(sheet, screen), kPrintedLines);
}

std::string png(const Sheet& sheet, const ScreenSize& screen) {
  const Print& print = sheet.print;
  // On screens pictures are a little larger than in pages.
  constexpr double kLarger = 1.3;
  if (!print.width)
    return fmt::format("pngcairo size {:.0f},{:.0f} font '{},{}' background rgb 'white'",
                       kLarger * screen.width, kLarger * screen.height, print.font,
                       letters_of(sheet, screen));
  const double scale = kPngDensity / kMillimetresOfInch;
  const double larger = kPngDensity / kSvgDensity;
  return fmt::format(
      "pngcairo size {:.0f},{:.0f} font '{},{:.3g}' background rgb 'white' linewidth {:.3g} "
      "pointscale {:.3g}",
      *print.width * scale, height_in_print(print, screen) * scale, print.font,
      letters_of(sheet, screen), kPrintedLines * larger, kPrintedLines * larger);
}

/// In inches.
struct PageSize {
  double width, height;
};

PageSize page_size(const Print& print, const ScreenSize& screen) {
  if (!print.width) return {screen.width / kSvgDensity, screen.height / kSvgDensity};
  return {*print.width / kMillimetresOfInch, height_in_print(print, screen) / kMillimetresOfInch};
}

std::string pdf(const Sheet& sheet, const ScreenSize& screen) {
  const Print& print = sheet.print;
  const auto [width, height] = page_size(print, screen);
  const double lines = print.width ? kPrintedLines : 1;
  // gnuplot's letters are those of a screen, of 96 pixels an inch, in a page of 72 points an inch.
  constexpr double kFontScale = 0.75;
  return fmt::format(
      "pdfcairo size {:.4f}in,{:.4f}in font '{},{:.3g}' fontscale {} linewidth {:.3g} pointscale "
      "{:.3g} "
      "background rgb 'white'",
      width, height, print.font, letters_of(sheet, screen), kFontScale, lines, lines);
}

/// Letters are those of the paper, of the size that is around the figure.
std::string latex(const Sheet& sheet, const ScreenSize& screen) {
  const auto [width, height] = page_size(sheet.print, screen);
  const double lines = sheet.print.width ? kPrintedLines : 1;
  return fmt::format(
      "cairolatex pdf input colortext size {:.4f}in,{:.4f}in linewidth {:.3g} pointscale {:.3g}",
      width, height, lines, lines);
}

/// Letters, digits, spaces and hyphens: nothing that gnuplot would take for more than a name.
bool is_font(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' ||
           c == '-';
  });
}

[[noreturn]] void fail_at(const std::string& path, const toml::node& node,
                          const std::string& what) {
  throw UsageError(fmt::format("{}:{}: {}", printable(path, 200), node.source().begin.line, what));
}

double length_of(const std::string& path, const std::string& key, const toml::node& node) {
  const auto text = node.value<std::string>();
  if (!node.is_string() || !text) fail_at(path, node, key + ": expected a length such as \"86mm\"");
  return millimetres(*text,
                     fmt::format("{}:{}: {}", printable(path, 200), node.source().begin.line, key));
}

bool flag_of(const std::string& path, const std::string& key, const toml::node& node) {
  const auto flag = node.value<bool>();
  if (!node.is_boolean() || !flag) fail_at(path, node, key + ": expected true or false");
  return *flag;
}

double size_of(const std::string& path, const toml::node& node) {
  constexpr double kSmallest = 4, kLargest = 72;
  const auto size = node.value<double>();
  if (!size || *size < kSmallest || *size > kLargest)
    fail_at(path, node, "size: expected the height of the letters in points, 4 to 72");
  return *size;
}

void take(Print& print, const std::string& path, const std::string& key, const toml::node& node) {
  static const std::vector<std::string> kKeys = {"width", "height",     "font",
                                                 "size",  "monochrome", "title"};
  if (key == "width") {
    print.width = length_of(path, key, node);
  } else if (key == "height") {
    print.height = length_of(path, key, node);
  } else if (key == "font") {
    print.font = node.value_or(std::string());
    if (!is_font(print.font)) fail_at(path, node, "font: expected a name such as \"Times\"");
  } else if (key == "size") {
    print.points = size_of(path, node);
  } else if (key == "monochrome") {
    print.monochrome = flag_of(path, key, node);
  } else if (key == "title") {
    print.title = flag_of(path, key, node);
  } else {
    fail_at(path, node,
            fmt::format("unknown key '{}'; {}", printable(key), suggest_or_list(key, kKeys)));
  }
}

}  // namespace

double height_in_print(const Print& print, const ScreenSize& screen) {
  // Letters take more of a small figure than of a large one.
  constexpr double kLeast = 0.75;
  return print.height.value_or(*print.width * std::max(screen.height / screen.width, kLeast));
}

const char* const kPictureNames = ".svg, .png, .pdf or .tex";

bool is_picture_name(const std::string& path) {
  return std::ranges::any_of(kEndings,
                             [&](std::string_view ending) { return path.ends_with(ending); });
}

void check_plot_name(const std::string& path) {
  if (!is_picture_name(path))
    throw UsageError(
        fmt::format("'{}': a plot's name must end in {}", printable(path, 200), kPictureNames));
}

std::string terminal_of(const Sheet& sheet, const ScreenSize& screen, bool enhanced) {
  if (sheet.latex()) return latex(sheet, screen);
  const char* texts = enhanced ? " enhanced" : " noenhanced";
  if (sheet.path.ends_with(".svg")) return svg(sheet, screen) + texts;
  return (sheet.path.ends_with(".pdf") ? pdf(sheet, screen) : png(sheet, screen)) + texts;
}

double letters_of(const Sheet& sheet, const ScreenSize& screen) {
  const Print& print = sheet.print;
  const bool pdf = sheet.path.ends_with(".pdf") || sheet.latex();
  if (!print.width)
    return print.points.value_or(pdf ? screen.letters * kPointsOfInch / kSvgDensity
                                     : screen.letters);
  // SVG's letters are measured in its pixels, those of PNG in points of a screen.
  const double unit = pdf                            ? 1
                      : sheet.path.ends_with(".svg") ? kSvgDensity / kPointsOfInch
                                                     : kPngDensity / kSvgDensity;
  return print.points.value_or(kPrintedPoints) * unit;
}

std::size_t letters_across(const Print& print, double share) {
  if (!is_narrow(print)) return 1000;
  constexpr double kMean = 0.55;  // the width of a letter, of its size
  const double letter =
      kMean * print.points.value_or(kPrintedPoints) * kMillimetresOfInch / kPointsOfInch;
  return static_cast<std::size_t>(std::max(10., share * *print.width / letter));
}

bool is_narrow(const Print& print) {
  constexpr double kColumn = 130;
  return print.width && *print.width < kColumn;
}

std::string ink(const Print& print, const std::string& colour) {
  if (!print.monochrome) return colour;
  const auto part = [&](std::size_t at) {
    int value = 0;
    std::from_chars(colour.data() + at, colour.data() + at + 2, value, 16);
    return value;
  };
  // How light the eye takes it to be (ITU-R BT.601).
  const double grey = 0.299 * part(1) + 0.587 * part(3) + 0.114 * part(5);
  return fmt::format("#{0:02x}{0:02x}{0:02x}", std::lround(grey));
}

double millimetres(const std::string& text, const std::string& option) {
  static constexpr std::array kUnits = std::to_array<std::pair<std::string_view, double>>(
      {{"mm", 1},
       {"cm", 10},
       {"in", kMillimetresOfInch},
       {"pt", kMillimetresOfInch / kPointsOfInch}});
  constexpr double kNarrowest = 20, kWidest = 2000;
  for (const auto& [unit, size] : kUnits) {
    if (!text.ends_with(unit)) continue;
    double number = 0;
    const char* end = text.data() + text.size() - unit.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    if (problem != std::errc() || stop != end) break;
    if (!(number * size >= kNarrowest && number * size <= kWidest))
      throw UsageError(fmt::format("{} '{}': expected 20mm to 2m", option, printable(text)));
    return number * size;
  }
  throw UsageError(
      fmt::format("{} '{}': expected a length with its unit, such as 86mm, 8.6cm, 3.4in or 244pt",
                  option, printable(text)));
}

Print read_style(const std::string& path) {
  Print print;
  try {
    const toml::table style = toml::parse_file(path);
    for (const auto& [key, node] : style) take(print, path, std::string(key.str()), node);
  } catch (const toml::parse_error& error) {
    throw UsageError(fmt::format("{}:{}: {}", printable(path, 200), error.source().begin.line,
                                 error.description()));
  }
  if (print.height && !print.width)
    throw UsageError(printable(path, 200) + ": a height needs a width");
  return print;
}

}  // namespace casimir::tools

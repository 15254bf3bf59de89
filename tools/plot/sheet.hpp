#pragma once

#include <optional>
#include <string>

namespace casimir::tools {

/// How a figure is printed. What is not said is as it suits a screen.
struct Print {
  std::optional<double> width, height;  ///< in millimetres
  std::string font = "sans";
  std::optional<double> points;  ///< the size of the letters
  bool monochrome = false;       ///< black and grey: curves differ by their dashes and marks
  bool title = true;             ///< a paper has a caption instead
};

/// What a picture is drawn on.
struct Sheet {
  std::string path;  ///< ends in .svg, .png, .pdf or .tex
  Print print = {};

  /// Whether LaTeX sets its letters: lines are then in a PDF beside it, which it includes.
  bool latex() const { return path.ends_with(".tex"); }
};

/// The size of a picture on a screen, in pixels.
struct ScreenSize {
  double width, height;
  double letters;  ///< their height
};

/// The endings of the names of pictures, as people read them: ".svg, .png, .pdf or .tex".
extern const char* const kPictureNames;

bool is_picture_name(const std::string& path);

/// Throws UsageError unless the name is a picture's: before any work is done for it.
void check_plot_name(const std::string& path);

/// gnuplot's terminal for a sheet: with a width, of that size in print; else as `screen` says.
/// \param enhanced  whether gnuplot's own marks for powers and letters mean something in texts
std::string terminal_of(const Sheet& sheet, const ScreenSize& screen, bool enhanced = true);

/// The size of letters that `terminal_of` sets, in the units of that terminal's fonts.
double letters_of(const Sheet& sheet, const ScreenSize& screen);

/// How many letters stand beside each other on this share of a narrow figure's width; very many on
/// others.
std::size_t letters_across(const Print& print, double share);

/// The height of a printed figure, in millimetres. It needs a width.
double height_in_print(const Print& print, const ScreenSize& screen);

/// Whether there is no room for a legend beside the curves.
bool is_narrow(const Print& print);

/// The colour, or in a monochrome figure the grey that is as light.
std::string ink(const Print& print, const std::string& colour);

/// "86mm", "8.6cm", "3.4in" or "244pt" in millimetres.
/// \throws UsageError  naming `option`
double millimetres(const std::string& text, const std::string& option);

/// A style file, in TOML: width, height, font, size, monochrome, title.
/// \throws UsageError  for what it cannot read or does not know, with the line
Print read_style(const std::string& path);

}  // namespace casimir::tools

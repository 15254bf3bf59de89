#include "tools/cli/options/picture_options.hpp"

#include <CLI/CLI.hpp>

#include "tools/cli/errors.hpp"

namespace casimir::tools {

void PictureOptions::add_to(CLI::App& command) {
  command
      .add_option("--width", width_,
                  "Of a picture in print, as 86mm, 8.6cm, 3.4in or 244pt: letters and lines are "
                  "as a journal's column has them")
      ->type_name("LENGTH");
  command.add_flag("--monochrome", monochrome_, "A picture in black and grey");
  command
      .add_option("--style", style_,
                  "How pictures look: a TOML file with width, height, font, size (of letters, in "
                  "points), monochrome and title (true or false)")
      ->type_name("FILE.toml");
}

void PictureOptions::check(bool drawn) const {
  if (!drawn && !(width_.empty() && style_.empty() && !monochrome_))
    throw UsageError(
        std::string("--width, --monochrome and --style are of a picture: name one that ends in ") +
        kPictureNames);
  print();
}

Print PictureOptions::print() const {
  Print print = style_.empty() ? Print{} : read_style(style_);
  if (!width_.empty()) {
    print.width = millimetres(width_, "--width");
    print.height.reset();
  }
  print.monochrome = print.monochrome || monochrome_;
  return print;
}

}  // namespace casimir::tools

#pragma once

#include <string>

#include "tools/cli/cli_names.hpp"
#include "tools/plot/sheet.hpp"

namespace casimir::tools {

/// How pictures are printed: --width, --monochrome, --style. Every command that draws has them.
class PictureOptions {
 public:
  void add_to(CLI::App& command);

  /// \param drawn  whether a picture is asked for
  /// \throws UsageError  for what cannot be read, and for options without a picture
  void check(bool drawn) const;

  /// \throws UsageError  for a style file that cannot be read any more
  Sheet sheet(const std::string& path) const { return {path, print()}; }

 private:
  Print print() const;

  std::string width_, style_;
  bool monochrome_ = false;
};

}  // namespace casimir::tools

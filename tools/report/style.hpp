#pragma once

#include <string>

namespace casimir::tools {

/// The style sheet of all pages: light and dark, narrow and wide, screen and paper.
std::string page_style();

}  // namespace casimir::tools

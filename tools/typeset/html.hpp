#pragma once

#include <string>
#include <vector>

namespace casimir::tools::html {

/// Text that a stranger wrote, as part of a page: no markup, no control characters.
/// \param limit  longer text is cut.
std::string text(const std::string& stranger, std::size_t limit = 1000);

/// The same for several lines, which stay lines.
std::string lines(const std::string& stranger);

std::string paragraph(const std::string& stranger);

/// A table row of cells that are markup already.
/// \param style  its class, or empty
std::string row(const std::vector<std::string>& cells, const char* tag = "td",
                const std::string& style = {});

/// A table that scrolls by itself where the page is too narrow for it.
std::string table(const std::string& rows);

}  // namespace casimir::tools::html

#pragma once

#include <string>

namespace casimir::tools::roff {

/// Text as roff prints it literally; a hyphen-minus stays one, for those who copy it.
std::string escaped(const std::string& text);
/// The same as lines of their own: a dot or an apostrophe at the beginning is no request.
std::string paragraph(const std::string& text);
/// Text in bold letters.
std::string bold(const std::string& text);
/// Text in italics.
std::string italic(const std::string& text);
/// In capital letters, as the titles of pages and sections stand.
std::string capitals(const std::string& text);

/// What a page begins with. \param name  as "casimir-verify"  \param title  a line on what it is
/// \param section  1 for commands, 5 for files  \param date  of the release
std::string heading(const std::string& name, const std::string& title, int section,
                    const std::string& version, const std::string& date);

}  // namespace casimir::tools::roff

#pragma once

#include <string>

namespace casimir::tools {

/// Whether a case of section `a` stands before one of section `b`: "2.4" before "2.10", both before
/// an appendix such as "G" or "G.1", and all of them before "", which is not in the book.
bool before_in_book(const std::string& a, const std::string& b);

/// "Sec. 2.4", "App. G", or empty.
std::string book_text(const std::string& book);

}  // namespace casimir::tools

#include "tools/show/book_order.hpp"

#include <algorithm>
#include <cctype>
#include <compare>
#include <sstream>
#include <tuple>
#include <vector>

namespace casimir::tools {
namespace {

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// One part of "2.4": numbers by their size and before letters.
struct BookPart {
  bool letters = false;
  std::size_t length = 0;  ///< of a number without leading zeros; the longer one is larger
  std::string text;
  auto operator<=>(const BookPart&) const = default;
};

std::vector<BookPart> parts_of(const std::string& book) {
  std::vector<BookPart> parts;
  std::istringstream stream(book);
  for (std::string text; std::getline(stream, text, '.');) {
    if (is_number(text)) {
      text.erase(0, std::min(text.find_first_not_of('0'), text.size() - 1));
      parts.push_back({false, text.size(), text});
    } else {
      parts.push_back({true, 0, text});
    }
  }
  return parts;
}

}  // namespace

bool before_in_book(const std::string& a, const std::string& b) {
  return std::tuple(a.empty(), parts_of(a)) < std::tuple(b.empty(), parts_of(b));
}

std::string book_text(const std::string& book) {
  if (book.empty()) return {};
  const bool section = std::isdigit(static_cast<unsigned char>(book[0])) != 0;
  return (section ? "Sec. " : "App. ") + book;
}

}  // namespace casimir::tools

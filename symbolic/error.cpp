#include "symbolic/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>

#include "symbolic/case/limits.hpp"

namespace casimir {
namespace {

std::string message(const Location& where, const std::string& text, const std::string& excerpt,
                    const std::string& hint) {
  std::string result = printable(where.file, 200);
  if (where.line > 0) result += fmt::format(":{}:{}", where.line, std::max(where.column, 1));
  result += ": error: " + text;
  if (!excerpt.empty() && where.column > 0) {
    // A long line is shown around its place only.
    constexpr std::size_t kWidth = 72;
    const std::size_t at = std::min<std::size_t>(where.column - 1, excerpt.size());
    const std::size_t from = at > kWidth / 2 && excerpt.size() > kWidth ? at - kWidth / 2 : 0;
    const std::string head = printable(excerpt.substr(from, at - from), kWidth);
    const std::string tail =
        printable(excerpt.substr(at), kWidth - std::min(kWidth, head.size()) + 3);
    const char* const cut = from > 0 ? "..." : "";
    result += fmt::format("\n  {}{}{}\n  {:>{}}", cut, head, tail, '^',
                          head.size() + std::strlen(cut) + 1);
  }
  if (!hint.empty()) result += "\n  hint: " + hint;
  return result;
}

/// Letters changed, added, left out, or swapped with their neighbours.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({change, d[i][j - 1] + 1, d[i - 1][j] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// Length of the valid UTF-8 sequence that starts at `i`, 0 if there is none.
std::size_t utf8_length(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char lead = byte(i);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0) != 0x80) return 0;
  }
  return length;
}

/// What drives a terminal, hides, or makes text read otherwise than it stands.
bool is_deceptive(char32_t c) {
  const auto within = [c](char32_t first, char32_t last) { return c >= first && c <= last; };
  return c < 0x20 || within(0x7F, 0x9F) || c == 0xAD || c == 0x61C || within(0x200B, 0x200F) ||
         within(0x2028, 0x202E) || within(0x2060, 0x206F) || c == 0xFEFF ||
         within(0xE0000, 0xE007F);
}

/// The character of a valid UTF-8 sequence.
char32_t decoded(std::string_view sequence) {
  const auto lead = static_cast<unsigned char>(sequence[0]);
  if (sequence.size() == 1) return lead;
  char32_t c = lead & (0x7FU >> sequence.size());
  for (const char next : sequence.substr(1))
    c = c << 6 | (static_cast<unsigned char>(next) & 0x3FU);
  return c;
}

/// In lower case, without what joins words.
std::string folded(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (c != '_' && c != '-')
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

std::string did_you_mean(const std::string& name) {
  return fmt::format("did you mean '{}'?", printable(name));
}

}  // namespace

CaseError::CaseError(Location where, std::string text, std::string excerpt, std::string hint,
                     double Limits::*limit)
    : std::runtime_error(message(where, text, excerpt, hint)),
      where_(std::move(where)),
      text_(std::move(text)),
      hint_(std::move(hint)),
      limit_(limit) {}

TooLarge::TooLarge(const std::string& text, const Limits& limits, double Limits::*limit)
    : ModelError(fmt::format("{}; {}", text, limits.hint(limit))), limit_(limit) {}

std::string same_but_for_case(const std::string& name, const std::vector<std::string>& known) {
  const std::string wanted = folded(name);
  const auto same = std::find_if(known.begin(), known.end(), [&](const std::string& candidate) {
    return !wanted.empty() && folded(candidate) == wanted;
  });
  return same == known.end() ? std::string{} : did_you_mean(*same);
}

std::string suggest(const std::string& name, const std::vector<std::string>& known) {
  if (name.size() > 100) return {};
  if (std::string same = same_but_for_case(name, known); !same.empty()) return same;
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t lengths[] = {name.size(), candidate.size()};
    const auto [shorter, longer] = std::minmax(lengths[0], lengths[1]);
    // One letter is not misspelt as another one.
    if (longer - shorter >= best_distance || longer == 1) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best.empty() ? std::string{} : did_you_mean(best);
}

std::string suggest_or_list(const std::string& name, const std::vector<std::string>& known,
                            const std::string& what) {
  if (std::string near = suggest(name, known); !near.empty() || known.empty()) return near;
  constexpr std::size_t kMost = 24;
  std::string list;
  for (std::size_t i = 0; i < std::min(known.size(), kMost); ++i)
    list += (i == 0 ? "" : ", ") + printable(known[i]);
  if (known.size() > kMost) list += fmt::format(" and {} more", known.size() - kMost);
  return fmt::format("{}: {}", what, list);
}

std::string printable(const std::string& text, std::size_t limit) {
  std::string result;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < text.size(); ++shown) {
    if (shown == limit) return result + "...";
    const std::size_t length = utf8_length(text, i);
    const std::string_view sequence =
        std::string_view(text).substr(i, std::max<std::size_t>(length, 1));
    if (length > 0 && !is_deceptive(decoded(sequence))) {
      result += sequence;
    } else {
      for (const char byte : sequence)
        result += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    }
    i += sequence.size();
  }
  return result;
}

std::string flat(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c >= '\t' && c <= '\r'; }, ' ');
  return text;
}

std::string one_line(const std::string& text) { return printable(flat(text), text.size()); }

}  // namespace casimir

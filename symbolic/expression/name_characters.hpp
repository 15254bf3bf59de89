#pragma once

#include <cctype>

namespace casimir {

/// Whether a name may begin with this character, in any locale: a letter of ASCII or '_'.
inline bool is_name_start(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}

/// Whether a name may go on with it: one of those or a digit.
inline bool is_name_part(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace casimir

#include "symbolic/expression/read_decimal.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {
namespace {

std::string digits_at(std::string_view text, std::size_t& at) {
  const std::size_t start = at;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
  return std::string(text.substr(start, at - start));
}

/// The exponent of ten behind the `e` at `read.end`.
void read_exponent(std::string_view text, Decimal& read) {
  ++read.end;
  const bool sign = read.end < text.size() && (text[read.end] == '-' || text[read.end] == '+');
  const bool negative = sign && text[read.end] == '-';
  if (sign) ++read.end;
  const std::string value = digits_at(text, read.end);
  constexpr std::size_t kMostDigits = 6;
  if (value.empty()) {
    read.problem = "a number with an empty exponent";
  } else if (value.size() > kMostDigits) {
    read.bits = HUGE_VAL;
  } else {
    read.exponent += (negative ? -1 : 1) * std::stol(value);
  }
}

}  // namespace

GiNaC::numeric Decimal::value() const {
  return GiNaC::numeric(digits.c_str()) * GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(exponent));
}

Decimal read_decimal(std::string_view text, std::size_t at) {
  Decimal read;
  read.end = at;
  read.digits = digits_at(text, read.end);
  if (read.end < text.size() && text[read.end] == '.') {
    ++read.end;
    const std::string fraction = digits_at(text, read.end);
    read.exponent = -static_cast<long>(fraction.size());
    read.digits += fraction;
  }
  if (read.digits.empty()) {
    read.problem = "a decimal point without digits";
    return read;
  }
  if (read.end < text.size() && (text[read.end] == 'e' || text[read.end] == 'E'))
    read_exponent(text, read);
  constexpr double kBitsOfDigit = 3.33;
  const double digits =
      static_cast<double>(read.digits.size()) + std::abs(static_cast<double>(read.exponent));
  read.bits = std::max(read.bits, digits * kBitsOfDigit);
  return read;
}

}  // namespace casimir

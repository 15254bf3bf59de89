#include "runtime/certificate/hex_float.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "runtime/run_trace.hpp"
#include "runtime/validated/rational_ends.hpp"

namespace casimir {
namespace {

/// Of the digits of a number, and of its exponent: beyond what any run writes.
constexpr std::size_t kMostDigits = 3000;
constexpr long kMostExponent = 100000;

/// Sign, digits in base 16 and exponent of a text.
struct HexParts {
  bool negative = false;
  std::string digits;
  long exponent = 0;
};

bool split(const std::string& text, HexParts& parts) {
  if (text == "0") {
    parts.digits = "0";
    return true;
  }
  std::size_t at = 0;
  parts.negative = text.starts_with("-");
  if (parts.negative) ++at;
  if (text.compare(at, 2, "0x") != 0) return false;
  at += 2;
  const std::size_t mark = text.find('p', at);
  if (mark == std::string::npos || mark == at || mark - at > kMostDigits) return false;
  parts.digits = text.substr(at, mark - at);
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (!std::ranges::all_of(parts.digits, is_digit)) return false;
  const char *const first = text.data() + mark + 1, *const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, parts.exponent);
  return error == std::errc() && end == last && parts.exponent >= -kMostExponent &&
         parts.exponent <= kMostExponent;
}

}  // namespace

bool is_traced_number(const std::string& text) {
  HexParts parts;
  return split(text, parts);
}

namespace certificate {
namespace {

std::string arf_text(const arf_t number) {
  if (arf_is_zero(number) != 0) return "0";
  fmpz_t mantissa, exponent;
  fmpz_init(mantissa);
  fmpz_init(exponent);
  arf_get_fmpz_2exp(mantissa, exponent, number);
  const bool negative = fmpz_sgn(mantissa) < 0;
  fmpz_abs(mantissa, mantissa);
  char* const digits = fmpz_get_str(nullptr, 16, mantissa);
  std::string text =
      (negative ? "-0x" : "0x") + std::string(digits) + "p" + std::to_string(fmpz_get_si(exponent));
  flint_free(digits);
  fmpz_clear(mantissa);
  fmpz_clear(exponent);
  return text;
}

}  // namespace

std::string middle_text(const ArbBall& ball) { return arf_text(arb_midref(ball.raw())); }

std::string size_text(const ArbBall& ball) {
  mag_t size;
  arf_t exact;
  mag_init(size);
  arf_init(exact);
  arb_get_mag(size, ball.raw());
  arf_set_mag(exact, size);
  std::string text = arf_text(exact);
  arf_clear(exact);
  mag_clear(size);
  return text;
}

std::string double_text(const arf_t number, bool upwards) {
  arf_t rounded;
  arf_init(rounded);
  arf_set_round(rounded, number, 53, upwards ? ARF_RND_CEIL : ARF_RND_FLOOR);
  std::string text = arf_text(rounded);
  arf_clear(rounded);
  return text;
}

ArbBall number_of(const std::string& text) {
  HexParts parts;
  if (!split(text, parts)) throw std::invalid_argument("'" + text.substr(0, 40) + "' is no number");
  fmpz_t mantissa;
  fmpz_init(mantissa);
  fmpz_set_str(mantissa, parts.digits.c_str(), 16);
  if (parts.negative) fmpz_neg(mantissa, mantissa);
  ArbBall result;
  arb_set_fmpz(result.raw(), mantissa);
  arb_mul_2exp_si(result.raw(), result.raw(), parts.exponent);
  fmpz_clear(mantissa);
  return result;
}

}  // namespace certificate

cln::cl_RA traced_number(const std::string& text) {
  return validated::ends_of(certificate::number_of(text)).low;
}

std::string traced_text(double value) {
  return certificate::middle_text(validated::ArbBall(value));
}

}  // namespace casimir

#include "codegen/emit/number_literal.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational_io.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "runtime/program/exact_number.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"

namespace casimir::codegen {

namespace {

constexpr int kShortDigits = 8;
constexpr int kLargestBinaryExponent = 40'000;  // binary; beyond every type here

/// The exact value in a message, without pages of digits.
std::string brief(const cln::cl_RA& value) { return printable(rational_text(value)); }

/// value * 2^-shift, rounded to an integer, ties to even.
cln::cl_I scaled_integer(const cln::cl_RA& value, long shift) {
  const cln::cl_RA scaled = shift < 0 ? value * cln::ash(1, -shift) : value / cln::ash(1, shift);
  return cln::round1(scaled);
}

/// The exponent e with 2^(e-1) <= value < 2^e, for a positive value.
long binary_exponent(const cln::cl_RA& value) {
  long guess = static_cast<long>(cln::integer_length(cln::numerator(value))) -
               static_cast<long>(cln::integer_length(cln::denominator(value)));
  const cln::cl_RA bound = guess < 0 ? cln::cl_RA(1) / cln::ash(1, -guess) : cln::ash(1, guess);
  return value >= bound ? guess + 1 : guess;
}

template <class Real>
std::string shortest(Real value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  std::string text(buffer, end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

const char* suffix(Scalar scalar) {
  if (scalar == Scalar::real32) return "f";
  return scalar == Scalar::long_double ? "L" : "";
}

std::string shortest(const cln::cl_RA& value, Scalar scalar) {
  switch (scalar) {
    case Scalar::real32:
      return shortest(nearest<float>(value)) + suffix(scalar);
    case Scalar::long_double:
      return shortest(nearest<long double>(value)) + suffix(scalar);
    default:
      return shortest(nearest<double>(value));
  }
}

/// The exact value of a decimal such as "-1.25e-7".
cln::cl_RA decimal_value(const std::string& text) {
  cln::cl_I digits = 0;
  long exponent = 0;
  bool after_point = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '.') after_point = true;
    if (text[i] == 'e') {
      exponent += std::strtol(text.c_str() + i + 1, nullptr, 10);
      break;
    }
    if (text[i] < '0' || text[i] > '9') continue;
    digits = digits * 10 + (text[i] - '0');
    exponent -= after_point ? 1 : 0;
  }
  const cln::cl_RA size = exponent < 0
                              ? digits / cln::expt(cln::cl_RA(10), static_cast<int>(-exponent))
                              : digits * cln::expt(cln::cl_RA(10), static_cast<int>(exponent));
  return text.starts_with('-') ? -size : size;
}

long digits_in(const std::string& text) {
  long result = 0;
  for (const char c : text.substr(0, text.find('e'))) result += c >= '0' && c <= '9' ? 1 : 0;
  return result;
}

bool fits(const cln::cl_I& integer, int bits) {
  return cln::integer_length(integer) <= static_cast<unsigned long>(bits);
}

/// Three doubles whose sum has more bits than any type here.
std::string sum_of_doubles(cln::cl_RA value, const std::string& type) {
  const cln::cl_RA least = exact_number(std::numeric_limits<double>::min());
  std::string text;
  for (int i = 0; i < 3 && value != 0; ++i) {
    if (i > 0 && cln::abs(value) < least) break;  // no double has these bits
    const double part = nearest<double>(value);
    if (!text.empty()) text += " + ";
    text += (text.empty() ? type : "") + "(" + shortest(part) + ")";
    value = value - exact_number(part);
  }
  return text;
}

NumberText wide_text(const cln::cl_RA& value, Scalar scalar) {
  const std::string type = scalar == Scalar::float128 ? "real" : "Real";
  const cln::cl_I above = cln::numerator(value);
  const cln::cl_I below = cln::denominator(value);
  if (fits(above, 62) && fits(below, 31)) {
    const std::string number = rational_text(above) + (fits(above, 31) ? "" : "LL");
    return {below == 1 ? type + "(" + number + ")"
                       : type + "(" + number + ") / " + rational_text(below),
            false, ""};
  }
  return {sum_of_doubles(value, type), false, brief(value)};
}

}  // namespace

template <class Real>
Real nearest(const cln::cl_RA& value) {
  using Limits = std::numeric_limits<Real>;
  if (value == 0) return 0;
  const cln::cl_RA size = cln::abs(value);
  const long exponent = binary_exponent(size);
  if (exponent > kLargestBinaryExponent || exponent < -kLargestBinaryExponent) {
    throw ModelError("the number " + brief(value) + " is outside the range of the number type");
  }
  const long shift =
      std::max<long>(exponent - Limits::digits, Limits::min_exponent - Limits::digits);
  const cln::cl_I mantissa = scaled_integer(size, shift);
  std::uint64_t bits = 0;
  for (int i = 0; i < 65; ++i) {
    if (cln::logbitp(static_cast<unsigned long>(i), mantissa))
      bits |= i < 64 ? std::uint64_t{1} << i : 0;
  }
  // Rounding up may reach 2^digits, which for 64 digits does not fit the machine word.
  const bool carried = cln::logbitp(64, mantissa);
  const Real result = carried ? std::ldexp(Real(1), static_cast<int>(shift) + 64)
                              : std::ldexp(static_cast<Real>(bits), static_cast<int>(shift));
  if (std::isinf(result) || result == 0) {
    throw ModelError("the number " + brief(value) + " is outside the range of the number type");
  }
  return cln::minusp(value) ? -result : result;
}

template float nearest<float>(const cln::cl_RA&);
template double nearest<double>(const cln::cl_RA&);
template long double nearest<long double>(const cln::cl_RA&);

NumberText number_text(const cln::cl_RA& value, Scalar scalar, const std::string& comment) {
  const bool integer = cln::denominator(value) == 1;
  const int plain_bits = scalar == Scalar::real32 ? 24 : 31;
  if (integer && fits(cln::numerator(value), plain_bits)) return {rational_text(value), true, ""};
  if (scalar == Scalar::float128 || scalar == Scalar::templated) {
    NumberText result = wide_text(value, scalar);
    if (!comment.empty())
      result = {sum_of_doubles(value, scalar == Scalar::float128 ? "real" : "Real"), false,
                comment};
    return result;
  }
  const std::string text = shortest(value, scalar);
  std::string digits = text;
  if (const std::string end = suffix(scalar); !end.empty()) digits.pop_back();
  const bool exact = comment.empty() && decimal_value(digits) == value;
  const bool plain = exact && digits_in(digits) <= kShortDigits;
  return {text, plain, plain ? "" : comment.empty() ? brief(value) : comment};
}

}  // namespace casimir::codegen

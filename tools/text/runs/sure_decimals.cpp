#include "tools/text/runs/sure_decimals.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "runtime/digits/agreed_run.hpp"

namespace casimir::tools {
namespace {

/// The digits of round(|x| 10^shift): exactly, or, where x is so large or small that its digits
/// would fill the memory, with so many guard digits that a last one is seldom another.
std::string scaled_digits(const cln::cl_F& x, int digits, long shift) {
  constexpr long kExact = 5000;
  constexpr int kGuardDigits = 40;
  const cln::cl_I ten = 10, size = std::abs(shift);
  cln::cl_I whole;
  if (size <= kExact) {
    const cln::cl_RA power = cln::expt(cln::cl_RA(ten), cln::cl_I(shift));
    whole = cln::round1(cln::abs(cln::rational(x)) * power);
  } else {
    const cln::float_format_t format = cln::float_format(static_cast<uintE>(digits) + kGuardDigits);
    const cln::cl_R power = cln::expt(cln::cl_float(ten, format), size);
    const cln::cl_R own = cln::abs(cln::cl_float(x, format));
    whole = cln::round1(shift > 0 ? own * power : own / power);
  }
  std::ostringstream text;
  text << whole;
  return text.str();
}

/// Mantissa digits and a decimal exponent in the style of printf's %g.
std::string laid_out(std::string digits, long exponent, long most) {
  digits.erase(std::max<std::size_t>(digits.find_last_not_of('0') + 1, 1));
  if (exponent < -5 || exponent >= most) {
    if (digits.size() > 1) digits.insert(1, ".");
    return fmt::format("{}e{}{:02}", digits, exponent < 0 ? '-' : '+', std::abs(exponent));
  }
  if (exponent < 0)
    return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (digits.size() <= whole) return digits + std::string(whole - digits.size(), '0');
  return digits.insert(whole, ".");
}

}  // namespace

std::string decimal_text(const cln::cl_F& value, int digits) {
  if (cln::zerop(value)) return "0";
  const cln::decoded_float parts = cln::decode_float(value);
  constexpr double kLog10Of2 = 0.30102999566398120;
  auto exponent = static_cast<long>(
      std::floor(kLog10Of2 * static_cast<double>(cln::cl_I_to_long(parts.exponent)) +
                 std::log10(cln::double_approx(parts.mantissa))));
  std::string text = scaled_digits(value, digits, digits - 1 - exponent);
  // The logarithm may be off beside a power of ten, and rounding may reach one.
  for (; static_cast<int>(text.size()) > digits;
       text = scaled_digits(value, digits, digits - 1 - exponent))
    ++exponent;
  for (; static_cast<int>(text.size()) < digits;
       text = scaled_digits(value, digits, digits - 1 - exponent))
    --exponent;
  return (cln::minusp(value) ? "-" : "") + laid_out(text, exponent, digits);
}

std::string sure_text(const cln::cl_F& value, const cln::cl_F& check, int most) {
  const int digits = agreed_digits(check, value, most);
  return digits == 0 ? "0" : decimal_text(value, digits);
}

std::vector<std::string> sure_texts(const std::vector<cln::cl_F>& values,
                                    const std::vector<cln::cl_F>* check, int most) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < values.size(); ++i)
    texts.push_back(check ? sure_text(values[i], (*check)[i], most)
                          : decimal_text(values[i], most));
  return texts;
}

}  // namespace casimir::tools

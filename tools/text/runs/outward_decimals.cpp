#include "tools/text/runs/outward_decimals.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace casimir::tools {
namespace {

/// Digits that are shown beyond those asked for, where an interval is as narrow.
constexpr long kMore = 8;

cln::cl_RA power_of_ten(long exponent) {
  if (exponent == 0) return 1;
  const cln::cl_I power = cln::expt_pos(cln::cl_I(10), cln::cl_I(std::abs(exponent)));
  return exponent > 0 ? cln::cl_RA(power) : 1 / cln::cl_RA(power);
}

/// The largest e with 10^e <= x, for x > 0.
long decimal_exponent(const cln::cl_RA& x) {
  const long bits = static_cast<long>(cln::integer_length(cln::numerator(x))) -
                    static_cast<long>(cln::integer_length(cln::denominator(x)));
  auto e = static_cast<long>(std::floor(0.30102999566398120 * static_cast<double>(bits)));
  while (power_of_ten(e) > x) --e;
  while (power_of_ten(e + 1) <= x) ++e;
  return e;
}

/// digits * 10^exponent, as %g would show it.
std::string decimal_text(const cln::cl_I& digits, long exponent) {
  if (cln::zerop(digits)) return "0";
  std::ostringstream stream;
  stream << (cln::minusp(digits) ? cln::cl_I(-digits) : digits);
  std::string text = stream.str();
  while (text.size() > 1 && text.back() == '0') {
    text.pop_back();
    ++exponent;
  }
  const long leading = exponent + static_cast<long>(text.size()) - 1;
  const std::string sign = cln::minusp(digits) ? "-" : "";
  if (leading < -5 || leading > 20) {
    if (text.size() > 1) text.insert(1, ".");
    return fmt::format("{}{}e{}{:02}", sign, text, leading < 0 ? '-' : '+', std::abs(leading));
  }
  if (leading < 0)
    return sign + "0." + std::string(static_cast<std::size_t>(-leading - 1), '0') + text;
  if (exponent >= 0) return sign + text + std::string(static_cast<std::size_t>(exponent), '0');
  return sign + text.insert(static_cast<std::size_t>(leading) + 1, ".");
}

std::string rounded_down(const cln::cl_RA& value, long exponent) {
  return decimal_text(cln::floor1(value / power_of_ten(exponent)), exponent);
}
std::string rounded_up(const cln::cl_RA& value, long exponent) {
  return decimal_text(cln::ceiling1(value / power_of_ten(exponent)), exponent);
}

}  // namespace

std::pair<std::string, std::string> decimal_ends(const RationalInterval& interval, int least) {
  const cln::cl_RA width = interval.high - interval.low;
  const cln::cl_RA size = std::max(cln::abs(interval.low), cln::abs(interval.high));
  if (cln::zerop(size)) return {"0", "0"};
  // Not finer than some digits more than those asked for, though the interval may be.
  long exponent = decimal_exponent(size) - least + 1;
  if (cln::plusp(width)) exponent = std::max(exponent - kMore, decimal_exponent(width) - 2);
  return {rounded_down(interval.low, exponent), rounded_up(interval.high, exponent)};
}

std::string decimal_above(const cln::cl_RA& value) {
  if (cln::zerop(value)) return "0";
  return rounded_up(value, decimal_exponent(value) - 2);
}

std::string decimal_below(const cln::cl_RA& value) {
  constexpr long kPlaces = 6;
  const cln::cl_I scale = cln::expt_pos(cln::cl_I(10), kPlaces);
  const cln::cl_I units = cln::floor1(value * scale);
  return fmt::format("{:.6f}", cln::double_approx(units) / cln::double_approx(scale));
}

std::string power_of_ten_above(const cln::cl_RA& value) {
  if (cln::zerop(value)) return "0";
  const long below = decimal_exponent(value);
  return fmt::format("1e{:+03}", power_of_ten(below) == value ? below : below + 1);
}

std::string middle_text(const RationalInterval& x, int digits) {
  const cln::cl_RA middle = (x.low + x.high) / 2;
  if (cln::zerop(middle)) return "0";
  const long exponent = decimal_exponent(cln::abs(middle)) - digits + 1;
  return decimal_text(cln::round1(middle / power_of_ten(exponent)), exponent);
}

std::string decimal_towards_zero(const cln::cl_RA& value, int digits) {
  if (cln::zerop(value)) return "0";
  const long exponent = decimal_exponent(cln::abs(value)) - digits + 1;
  return decimal_text(cln::truncate1(value / power_of_ten(exponent)), exponent);
}

}  // namespace casimir::tools

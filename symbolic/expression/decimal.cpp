#include "symbolic/expression/decimal.hpp"

#include <cln/complex.h>
#include <cln/float.h>
#include <cln/real.h>

#include <cmath>
#include <exception>
#include <set>
#include <string>

#include "symbolic/algebra/where_defined.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

struct NoDecimal {};

/// The binary exponent of the larger of the two parts; 0 for zero.
double size_of(const numeric& number) {
  const cln::cl_N value = number.to_cl_N();
  double size = 0;
  for (const cln::cl_R& part : {cln::realpart(value), cln::imagpart(value)}) {
    if (cln::zerop(part)) continue;
    const auto exponent = static_cast<double>(cln::float_exponent(cln::cl_float(part)));
    if (std::abs(exponent) > std::abs(size)) size = exponent;
  }
  return size;
}

/// CLN loses the digits of asin(10^50 + 10^50*I), and never returns from that of 10^25 + 10^25*I.
void check_inverse(const std::string& function, const GiNaC::exvector& arguments) {
  static const std::set<std::string> inverse = {"asin",  "acos",  "atan", "atan2",
                                                "asinh", "acosh", "atanh"};
  if (!inverse.contains(function)) return;
  for (const ex& argument : arguments) {
    if (!GiNaC::ex_to<numeric>(argument).is_real()) throw NoDecimal{};
  }
}

/// Evaluates step by step, so that no number on the way has more bits than are allowed.
class Evaluation {
 public:
  explicit Evaluation(double bits) : bits_(bits) {}
  numeric operator()(const ex& e) const;

 private:
  numeric checked(const numeric& number) const {
    if (std::abs(size_of(number)) > bits_) throw NoDecimal{};
    return number;
  }
  numeric number_of(const ex& value) const {
    if (!GiNaC::is_a<numeric>(value)) throw NoDecimal{};
    return checked(GiNaC::ex_to<numeric>(value));
  }
  numeric power(const ex& e) const;

  double bits_;
};

numeric Evaluation::power(const ex& e) const {
  const numeric base = (*this)(e.op(0));
  // A whole exponent stays exact: the power of a negative number is real.
  const numeric exponent =
      GiNaC::is_a<numeric>(e.op(1)) && GiNaC::ex_to<numeric>(e.op(1)).is_integer()
          ? GiNaC::ex_to<numeric>(e.op(1))
          : (*this)(e.op(1));
  const double growth =
      std::abs(exponent.is_real() ? exponent.to_double() : GiNaC::abs(exponent).to_double());
  if (!(growth * std::max(1.0, std::abs(size_of(base))) <= bits_)) throw NoDecimal{};
  return checked(base.power(exponent));
}

numeric Evaluation::operator()(const ex& e) const {
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    numeric result = (*this)(e.op(0));
    for (std::size_t i = 1; i < e.nops(); ++i) {
      const numeric next = (*this)(e.op(i));
      result = checked(GiNaC::is_a<GiNaC::add>(e) ? result.add(next) : result.mul(next));
    }
    return result;
  }
  if (GiNaC::is_a<GiNaC::power>(e)) return power(e);
  if (GiNaC::is_a<GiNaC::function>(e)) {
    GiNaC::exvector arguments;
    for (std::size_t i = 0; i < e.nops(); ++i) arguments.push_back((*this)(e.op(i)));
    const GiNaC::function& f = GiNaC::ex_to<GiNaC::function>(e);
    check_inverse(f.get_name(), arguments);
    static const std::set<std::string> exponential = {"exp", "sinh", "cosh", "tanh"};
    if (exponential.contains(f.get_name()) &&
        size_of(GiNaC::ex_to<numeric>(arguments[0])) > 2 + std::log2(bits_))
      throw NoDecimal{};
    return number_of(ex(GiNaC::function(f.get_serial(), arguments)).evalf());
  }
  return number_of(e.evalf());
}

}  // namespace

std::optional<numeric> decimal(const ex& value, double bits) {
  try {
    return where_defined([&] { return Evaluation(bits)(value); });
  } catch (const NoDecimal&) {
    return std::nullopt;
  }
}

std::optional<numeric> real_decimal(const ex& value, double bits) {
  const std::optional<numeric> number = decimal(value, bits);
  return number && number->is_real() ? number : std::nullopt;
}

}  // namespace casimir

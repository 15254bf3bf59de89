#include "symbolic/obstruction/equation/singularities.hpp"

#include <fmt/format.h>

namespace casimir::obstruction {

std::optional<cln::cl_RA> Singularity::rational_difference() const {
  if (!regular() || !difference_squared.is_constant()) return std::nullopt;
  return square_root(difference_squared.coefficient(0));
}

namespace {

std::string place(const Singularity& s, const std::string& variable) {
  if (s.at_infinity()) return variable + " = infinity";
  if (s.at.degree() == 1)
    return fmt::format("{} = {}", variable, Univariate(-s.at.coefficient(0)).text(variable));
  return s.at.text(variable) + " = 0";
}

}  // namespace

std::string Singularity::text(const std::string& variable) const {
  const std::string where = place(*this, variable);
  if (!regular()) return fmt::format("{}: irregular, order {}", where, order);
  if (const auto difference = rational_difference())
    return fmt::format("{}: difference of exponents {}", where,
                       Univariate(*difference).text(variable));
  return fmt::format("{}: difference of exponents sqrt({})", where,
                     difference_squared.text(variable));
}

Univariate leading_coefficient(const RationalFunction& r, const Univariate& f, long order) {
  const auto power = static_cast<unsigned long>(order);
  const Univariate rest = r.denominator().divided(f.pow(power)).first;
  const Univariate below = (rest * f.derivative().pow(power)).remainder(f);
  return (r.numerator() * below.inverse(f)).remainder(f);
}

std::vector<Singularity> singularities(const RationalFunction& r) {
  std::vector<Singularity> result;
  for (const auto& [factor, exponent] : r.denominator().factors()) {
    Singularity s;
    s.at = factor;
    s.order = static_cast<long>(exponent);
    s.difference_squared = Univariate(1);
    if (s.order == 2)
      s.difference_squared += Univariate(4) * leading_coefficient(r, factor, s.order);
    result.push_back(std::move(s));
  }
  Singularity infinity;
  infinity.at = Univariate(1);
  infinity.order = r.denominator().degree() - r.numerator().degree();
  if (r.is_zero()) infinity.order = 4;
  infinity.difference_squared = Univariate(1);
  if (infinity.order == 2) infinity.difference_squared += Univariate(4 * r.numerator().leading());
  result.push_back(std::move(infinity));
  return result;
}

}  // namespace casimir::obstruction

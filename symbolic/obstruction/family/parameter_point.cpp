#include "symbolic/obstruction/family/parameter_point.hpp"

#include <fmt/format.h>

namespace casimir::obstruction {

using F = ParametricFunction;

ParameterPoint::Residue ParameterPoint::product(const Residue& x, const Residue& y) const {
  const F bb = x.b * y.b;
  return {x.a * y.a - bb * t, x.a * y.b + x.b * y.a - bb * s};
}

ParameterPoint::Residue ParameterPoint::inverse(const Residue& x) const {
  const F norm = x.a * x.a - x.a * x.b * s + x.b * x.b * t;
  return {(x.a - x.b * s) / norm, -x.b / norm};
}

ParameterPoint::Residue ParameterPoint::value(const Polynomial& f) const {
  const Residue z = degree == 1 ? Residue{-t, F()} : Residue{F(), F(1)};
  Residue result;
  const std::vector<F> coefficients = variable_coefficients(f);
  for (std::size_t i = coefficients.size(); i-- > 0;) {
    result = product(result, z);
    result.a = result.a + coefficients[i];
  }
  return result;
}

std::string ParameterPoint::text(const CurveNames& names) const {
  if (degree == 1) return fmt::format("{} = {}", names.z, written(-t, names));
  const F z = F::variable();
  return written(z * z + s * z + t, names) + " = 0";
}

ParameterPoint parameter_point(const Polynomial& polynomial) {
  const std::vector<F> c = variable_coefficients(polynomial);
  const F& leading = c.back();
  ParameterPoint result{polynomial, static_cast<long>(c.size()) - 1, F(), c[0] / leading};
  if (result.degree == 2) result.s = c[1] / leading;
  return result;
}

}  // namespace casimir::obstruction

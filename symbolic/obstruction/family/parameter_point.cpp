#include "symbolic/obstruction/family/parameter_point.hpp"

#include <fmt/format.h>

namespace casimir::obstruction {

ParameterPoint::Residue ParameterPoint::product(const Residue& x, const Residue& y) const {
  const ParametricFunction bb = x.b * y.b;
  return {x.a * y.a - bb * t, x.a * y.b + x.b * y.a - bb * s};
}

ParameterPoint::Residue ParameterPoint::inverse(const Residue& x) const {
  const ParametricFunction norm = x.a * x.a - x.a * x.b * s + x.b * x.b * t;
  return {(x.a - x.b * s) / norm, -x.b / norm};
}

ParameterPoint::Residue ParameterPoint::value(const Polynomial& f) const {
  const Residue z = degree == 1 ? Residue{-t, ParametricFunction()}
                                : Residue{ParametricFunction(), ParametricFunction(1)};
  Residue result;
  const std::vector<ParametricFunction> coefficients = variable_coefficients(f);
  for (std::size_t i = coefficients.size(); i-- > 0;) {
    result = product(result, z);
    result.a = result.a + coefficients[i];
  }
  return result;
}

std::string ParameterPoint::text(const CurveNames& names) const {
  if (degree == 1) return fmt::format("{} = {}", names.z, written(-t, names));
  const ParametricFunction z = ParametricFunction::variable();
  return written(z * z + s * z + t, names) + " = 0";
}

ParameterPoint parameter_point(const Polynomial& polynomial) {
  const std::vector<ParametricFunction> c = variable_coefficients(polynomial);
  const ParametricFunction& leading = c.back();
  ParameterPoint result{polynomial, static_cast<long>(c.size()) - 1, ParametricFunction(),
                        c[0] / leading};
  if (result.degree == 2) result.s = c[1] / leading;
  return result;
}

}  // namespace casimir::obstruction

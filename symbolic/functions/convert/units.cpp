#include "symbolic/functions/convert/units.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>

namespace casimir::functions {

std::pair<Polynomial, cln::cl_I> Units::unit_of(const std::vector<unsigned long>& monomial,
                                                const cln::cl_RA& coefficient) {
  Polynomial m = table_.ring().constant(1);
  for (std::size_t i = 0; i < monomial.size(); ++i) {
    if (monomial[i] > 0) m *= table_.ring().variable(i).pow(monomial[i]);
  }
  const GiNaC::ex key = table_.expression(m);
  auto it = std::find_if(units_.begin(), units_.end(),
                         [&](const auto& unit) { return unit.first.is_equal(key); });
  if (it == units_.end()) {
    units_.emplace_back(key, cln::denominator(coefficient));
    it = units_.end() - 1;
  }
  const cln::cl_I finer = cln::lcm(it->second, cln::denominator(coefficient));
  if (finer != it->second) {
    it->second = finer;
    throw Full{};
  }
  const cln::cl_RA times = coefficient * finer;
  return {m.scaled(1 / cln::cl_RA(finer)), cln::numerator(times)};
}

}  // namespace casimir::functions

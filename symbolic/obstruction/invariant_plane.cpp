#include "symbolic/obstruction/invariant_plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// Most variables for which all coordinate planes are tried: 2^n of them.
constexpr std::size_t kMostVariablesOfPlanes = 10;

GiNaC::ex substituted(const GiNaC::ex& expression, const GiNaC::exmap& values) {
  try {
    return expression.subs(values);
  } catch (const std::domain_error&) {
    throw NotDecided("the equations have no value on the surface");
  }
}

/// The same in lowest terms. A denominator that is zero only when it is multiplied out is an
/// overflow to GiNaC.
GiNaC::ex normal_on_surface(const GiNaC::ex& expression, const GiNaC::exmap& values) {
  try {
    return substituted(expression, values).normal();
  } catch (const std::overflow_error&) {
    throw NotDecided("the equations have no value on the surface");
  } catch (const std::domain_error&) {
    throw NotDecided("the equations have no value on the surface");
  }
}

InvariantPlane with_values(const HamiltonianSystem& system, GiNaC::exmap values) {
  InvariantPlane result;
  for (std::size_t i = 0; i < system.variables.size(); ++i) {
    const auto place = values.find(system.variables[i]);
    if (place == values.end())
      result.along.push_back(i);
    else
      result.normal.emplace_back(i, place->second);
  }
  result.values = std::move(values);
  return result;
}

/// A variable that the equation f = 0 gives as a polynomial in the others, and that polynomial.
std::pair<GiNaC::symbol, GiNaC::ex> solved(const HamiltonianSystem& system, const GiNaC::ex& f) {
  const GiNaC::ex above = f.numer().expand();
  for (const GiNaC::symbol& x : system.variables) {
    if (!above.is_polynomial(x) || above.degree(x) != 1) continue;
    const GiNaC::ex slope = above.coeff(x, 1);
    if (GiNaC::is_a<GiNaC::numeric>(slope)) return {x, (-above.coeff(x, 0) / slope).expand()};
  }
  throw NotDecided(fmt::format("{} = 0 gives no variable as a polynomial in the others",
                               expression_text(f).substr(0, 60)));
}

/// One more value, put into those that there are.
void add(const HamiltonianSystem& system, const GiNaC::ex& f, GiNaC::exmap& values) {
  const auto [x, value] = solved(system, f);
  for (auto& [other, own] : values) own = own.subs(x == value).expand();
  values[x] = value;
}

/// The rate on the surface of a normal variable less its value there.
GiNaC::ex defect(const HamiltonianSystem& system, const GiNaC::exmap& values, const GiNaC::ex& x,
                 const GiNaC::ex& value) {
  GiNaC::ex rate = system.rates[system.index(x)];
  for (std::size_t i = 0; i < system.variables.size(); ++i)
    rate -= value.diff(system.variables[i]) * system.rates[i];
  return normal_on_surface(rate, values);
}

bool is_invariant(const HamiltonianSystem& system, const GiNaC::exmap& values) {
  return std::all_of(values.begin(), values.end(), [&](const auto& pair) {
    return defect(system, values, pair.first, pair.second).is_zero();
  });
}

/// Closes the values under the motion.
InvariantPlane closed(const HamiltonianSystem& system, GiNaC::exmap values) {
  for (std::size_t round = 0; round <= system.variables.size(); ++round) {
    GiNaC::ex further;
    for (const auto& [x, value] : values) {
      further = defect(system, values, x, value);
      if (!further.is_zero()) break;
    }
    if (further.is_zero()) return with_values(system, std::move(values));
    add(system, further, values);
  }
  throw NotDecided("no invariant surface follows from the equations given");
}

/// Whether a plane of the list has the same equations.
bool known(const std::vector<InvariantPlane>& list, const InvariantPlane& plane) {
  return std::any_of(list.begin(), list.end(), [&](const InvariantPlane& other) {
    return other.normal.size() == plane.normal.size() &&
           std::equal(other.normal.begin(), other.normal.end(), plane.normal.begin(),
                      [](const auto& a, const auto& b) {
                        return a.first == b.first && a.second.is_equal(b.second);
                      });
  });
}

/// Adds the surface on which the functions vanish, where there is one with a motion on it.
void add_surface(const HamiltonianSystem& system, const std::vector<GiNaC::ex>& functions,
                 std::vector<InvariantPlane>& result) {
  try {
    InvariantPlane plane = invariant_plane(system, functions);
    if (plane.along.size() >= 2 && !known(result, plane)) result.push_back(std::move(plane));
  } catch (const NotDecided&) {
  } catch (const std::invalid_argument&) {
    // GiNaC's, of what is no rational function.
  }
}

void add_pairs(const HamiltonianSystem& system, std::vector<InvariantPlane>& result) {
  const std::size_t n = system.variables.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (const int sign : {1, -1})
        add_surface(system, {system.variables[i] - sign * system.variables[j]}, result);
    }
  }
}

}  // namespace

GiNaC::ex InvariantPlane::on(const GiNaC::ex& expression) const {
  return substituted(expression, values);
}

std::string InvariantPlane::text(const HamiltonianSystem& system) const {
  std::string result;
  for (const auto& [i, value] : normal) {
    result += fmt::format("{}{} = {}", result.empty() ? "" : ", ", system.variables[i].get_name(),
                          expression_text(value));
  }
  return result;
}

InvariantPlane invariant_plane(const HamiltonianSystem& system,
                               const std::vector<GiNaC::ex>& functions) {
  GiNaC::exmap values;
  for (const GiNaC::ex& f : functions) {
    const GiNaC::ex own = normal_on_surface(f, values);
    if (!own.is_zero()) add(system, own, values);
  }
  return closed(system, std::move(values));
}

std::vector<InvariantPlane> invariant_planes(const HamiltonianSystem& system,
                                             const std::vector<std::vector<GiNaC::ex>>& relations) {
  std::vector<InvariantPlane> result;
  const std::size_t n = system.variables.size();
  if (n > kMostVariablesOfPlanes)
    throw NotDecided("more than ten variables: planes are not looked for, one has to be given");
  // With one degree of freedom left there are two more variables than Casimir functions at most.
  const std::size_t along = system.casimirs.size() + 2;
  for (std::size_t size = n > along ? n - along : 1; size + 2 <= n; ++size) {
    for (unsigned set = 1; set < 1U << n; ++set) {
      if (static_cast<std::size_t>(__builtin_popcount(set)) != size) continue;
      GiNaC::exmap values;
      for (std::size_t i = 0; i < n; ++i)
        if ((set >> i & 1U) != 0) values[system.variables[i]] = 0;
      try {
        if (is_invariant(system, values)) result.push_back(with_values(system, std::move(values)));
      } catch (const NotDecided&) {
      }
    }
  }
  if (n <= 6) add_pairs(system, result);
  for (const auto& functions : relations) add_surface(system, functions, result);
  return result;
}

}  // namespace casimir::obstruction

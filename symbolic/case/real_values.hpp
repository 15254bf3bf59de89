#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir {

/// What has to hold for an expression to have a real value. For every power and function in it: u
/// != 0 for 1/u, u > 0 for log(u) and u^n with a symbol n, u >= 0 for roots, |u| <= 1 for asin(u)
/// and acos(u), cos(u) != 0 for tan(u), and atan2 not of two zeros. Where complex numbers are
/// allowed, what is then defined has none.
std::vector<Assumption> conditions_for_values(const GiNaC::ex& expression, bool complex);

/// What has a real value only where the condition holds; nothing for an equation and for numbers,
/// of which the condition itself has to be asked.
std::optional<GiNaC::ex> real_only_where(const Assumption& condition);

}  // namespace casimir

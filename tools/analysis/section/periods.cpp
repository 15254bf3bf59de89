#include "tools/analysis/section/periods.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {
namespace {

using GiNaC::ex;

bool is_function(const ex& e, const char* name) {
  return GiNaC::is_a<GiNaC::function>(e) && GiNaC::ex_to<GiNaC::function>(e).get_name() == name;
}

/// The different atan2(..) in an expression.
void collect_angles(const ex& e, std::vector<ex>& found) {
  if (is_function(e, "atan2") &&
      std::ranges::none_of(found, [&](const ex& other) { return other.is_equal(e); }))
    found.push_back(e);
  for (std::size_t i = 0; i < e.nops(); ++i) collect_angles(e.op(i), found);
}

/// Whether q enters by sin, cos and tan of an integer times q plus what is free of it.
bool periodic_in(const ex& e, const GiNaC::symbol& q) {
  if (!e.has(q)) return true;
  if (is_function(e, "sin") || is_function(e, "cos") || is_function(e, "tan"))
    return e.op(0).diff(q).info(GiNaC::info_flags::integer) || periodic_in(e.op(0), q);
  if (e.is_equal(q)) return false;
  for (std::size_t i = 0; i < e.nops(); ++i)
    if (!periodic_in(e.op(i), q)) return false;
  return true;
}

GiNaC::numeric common_divisor(const GiNaC::numeric& a, const GiNaC::numeric& b) {
  const GiNaC::numeric denominator = GiNaC::lcm(a.denom(), b.denom());
  return GiNaC::gcd((a * denominator).numer(), (b * denominator).numer()) / denominator;
}

}  // namespace

double period_of(const ex& function, const std::vector<GiNaC::symbol>& angles) {
  std::vector<ex> found;
  collect_angles(function, found);
  GiNaC::exmap names;
  std::vector<GiNaC::symbol> unknowns = angles;
  for (const ex& angle : found) {
    unknowns.emplace_back("angle");
    names[angle] = unknowns.back();
  }
  const ex plain = function.subs(names);
  GiNaC::numeric divisor = 0;
  for (const GiNaC::symbol& angle : unknowns) {
    if (!plain.has(angle) || periodic_in(plain, angle)) continue;
    const ex factor = plain.expand().diff(angle);
    if (!GiNaC::is_a<GiNaC::numeric>(factor) || !GiNaC::ex_to<GiNaC::numeric>(factor).is_rational())
      return 0;
    const GiNaC::numeric size = GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(factor));
    divisor = divisor.is_zero() ? size : common_divisor(divisor, size);
  }
  return 2 * std::acos(-1.) * divisor.to_double();
}

std::vector<bool> angles_among(const std::vector<GiNaC::symbol>& variables,
                               const std::vector<ex>& functions) {
  std::vector<bool> angles, absent;
  for (const GiNaC::symbol& q : variables) {
    const auto enters = [&](const ex& f) { return f.has(q); };
    const auto periodic = [&](const ex& f) { return periodic_in(f, q); };
    absent.push_back(std::ranges::none_of(functions, enters));
    angles.push_back(!absent.back() && std::ranges::all_of(functions, periodic));
  }
  if (std::ranges::count(angles, true) > 0)
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = angles[i] || absent[i];
  return angles;
}

}  // namespace casimir

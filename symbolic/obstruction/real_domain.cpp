#include "symbolic/obstruction/real_domain.hpp"

#include <algorithm>
#include <random>

#include "symbolic/algebra/ball_evaluator.hpp"

namespace casimir::obstruction {
namespace {

using GiNaC::ex;

std::vector<ex> functions_of(const HamiltonianSystem& system) {
  std::vector<ex> functions{system.hamiltonian};
  for (const auto& row : system.poisson) functions.insert(functions.end(), row.begin(), row.end());
  for (const ex& part : system.lost) functions.push_back(part.subs(system.numbers));
  return functions;
}

std::vector<GiNaC::symbol> symbols_of(const HamiltonianSystem& system) {
  std::vector<GiNaC::symbol> symbols = system.variables;
  if (system.free) symbols.push_back(*system.free);
  symbols.insert(symbols.end(), system.further.begin(), system.further.end());
  return symbols;
}

long between(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// Of many sizes, from a millionth to a million: functions may be real far from 0 alone, or close
/// to it.
ex draw_size(std::mt19937& random) {
  const long k = between(random, -5, 5);
  return GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(k));
}

/// Small fractions, by turns of either sign, positive ones, and ones below 1.
ex draw(std::mt19937& random, int way) {
  if (way == 1) return GiNaC::numeric(between(random, 1, 19), between(random, 1, 4));
  if (way == 2) return GiNaC::numeric(between(random, -29, 29), 30);
  return GiNaC::numeric(between(random, -19, 19), between(random, 1, 4));
}

}  // namespace

bool has_inner_points(const HamiltonianSystem& system) {
  const std::vector<ex> functions = functions_of(system);
  std::vector<Assumption> assumptions = system.domain;
  assumptions.insert(assumptions.end(), system.of_free.begin(), system.of_free.end());
  const auto is_rational = [](const ex& f) { return f.info(GiNaC::info_flags::rational_function); };
  if (assumptions.empty() && std::all_of(functions.begin(), functions.end(), is_rational))
    return true;
  const std::vector<GiNaC::symbol> symbols = symbols_of(system);
  const auto is_inside = [&](const GiNaC::exmap& point) {
    constexpr long kBits = 128;
    try {
      BallEvaluator at(BallEvaluator::Numbers::real, kBits);
      for (const GiNaC::symbol& x : symbols) at.set(x, point.at(x));
      for (const Assumption& assumption : assumptions) {
        const std::optional<int> sign = at.sign(assumption.difference);
        if (!sign || *sign == 0 || !holds(assumption.comparison, *sign)) return false;
      }
      for (const ex& f : functions) at.require(f);
      return at.smooth();
    } catch (const NotCertified&) {
      return false;
    }
  };
  const auto has = [&](const GiNaC::symbol& x) { return system.start.count(x) != 0; };
  if (std::all_of(symbols.begin(), symbols.end(), has) && is_inside(system.start)) return true;
  std::mt19937 random(20190105);
  constexpr int kSmall = 600, kTries = 2000, kWays = 3;
  for (int k = 0; k < kTries; ++k) {
    GiNaC::exmap point;
    const ex size = draw_size(random);  // of all, at every second point of each by itself
    for (const GiNaC::symbol& x : symbols) {
      point[x] = draw(random, k % kWays);
      if (k >= kSmall) point[x] *= k % 2 == 0 ? size : draw_size(random);
    }
    if (is_inside(point)) return true;
  }
  return false;
}

}  // namespace casimir::obstruction

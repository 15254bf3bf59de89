// A list of polynomials is taken apart, one f after the other, by these rules:
//
//   (graph)   f is linear in v and the coefficient of v is a number that is not zero, or has
//             parameters only, and is not zero for generic ones: v is put into the others, which
//             changes neither the ring modulo the ideal nor the real points.
//   (bundle)  f = a_1 v_1 + a_2 v_2 + .. + b, where no other function has any of the v_i, and 1 is
//             in the ideal of the a_i and the other functions. The zeros are a bundle of affine
//             spaces over those of the others: if these make a real prime ideal, so do all.
//   (last)    Only f is left, and is irreducible over Q. If it is linear in some variable, it is
//             irreducible over C too, and changes its sign there. If it has no parameters and a
//             smooth rational point, it is irreducible over C too, as the factors would be
//             conjugate and meet in that point; and an irreducible polynomial with a smooth real
//             point generates a real ideal (Bochnak, Coste, Roy, Real Algebraic Geometry, 4.5.1).
#include "symbolic/search/conditions/real_ideal.hpp"

#include <algorithm>
#include <optional>
#include <random>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/search/polynomial_system.hpp"

namespace casimir::search {
namespace {

using Places = std::vector<std::size_t>;

bool uses_any(const Polynomial& p, const Places& places) {
  return std::any_of(places.begin(), places.end(), [&](std::size_t v) { return p.uses(v); });
}

bool take_graph(std::vector<Polynomial>& functions, const Places& variables) {
  for (std::size_t i = 0; i < functions.size(); ++i) {
    for (const std::size_t v : variables) {
      if (functions[i].degree(v) != 1) continue;
      const std::vector<Polynomial> parts = functions[i].coefficients(v);
      if (uses_any(parts[1], variables)) continue;
      functions.erase(functions.begin() + static_cast<std::ptrdiff_t>(i));
      for (Polynomial& f : functions) f = substituted(f, v, -parts[0], parts[1]);
      return true;
    }
  }
  return false;
}

/// The coefficients of those variables that the other functions do not have, if it is linear in
/// them.
std::vector<Polynomial> own_coefficients(const Polynomial& f, const std::vector<Polynomial>& others,
                                         const Places& variables) {
  Places own;
  for (const std::size_t v : variables) {
    const bool shared = std::any_of(others.begin(), others.end(),
                                    [&](const Polynomial& other) { return other.uses(v); });
    if (!shared && f.uses(v)) own.push_back(v);
  }
  std::vector<Polynomial> result;
  for (const std::size_t v : own) {
    if (f.degree(v) != 1) continue;
    Polynomial coefficient = f.coefficients(v)[1];
    // Of a product of two of them, one is a coefficient.
    if (!uses_any(coefficient, own)) result.push_back(std::move(coefficient));
  }
  return result;
}

bool take_bundle(std::vector<Polynomial>& functions, const Places& variables) {
  constexpr GroebnerLimits kLimits{.reductions = 500, .elements = 60, .terms = 500};
  for (std::size_t i = 0; i < functions.size(); ++i) {
    std::vector<Polynomial> others = functions;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    std::vector<Polynomial> ideal = own_coefficients(functions[i], others, variables);
    if (ideal.empty()) continue;
    ideal.insert(ideal.end(), others.begin(), others.end());
    const std::vector<Polynomial> basis = groebner_basis(ideal, kLimits);
    const bool whole = std::any_of(basis.begin(), basis.end(), [&](const Polynomial& p) {
      return !p.is_zero() && !uses_any(p, variables);
    });
    if (!whole) continue;
    functions = std::move(others);
    return true;
  }
  return false;
}

bool has_parameters(const Polynomial& f, const Places& variables) {
  for (std::size_t i = 0; i < f.ring().size(); ++i)
    if (f.uses(i) && std::find(variables.begin(), variables.end(), i) == variables.end())
      return true;
  return false;
}

bool has_smooth_rational_point(const Polynomial& f, const Places& variables) {
  constexpr int kTries = 300;
  std::mt19937 random(17);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::vector<cln::cl_RA> point(f.ring().size(), 0);
    for (const std::size_t v : variables) point[v] = static_cast<int>(random() % 7) - 3;
    for (const std::size_t v : variables) {
      if (!f.uses(v)) continue;
      // f along the line through the point in the direction of v.
      Polynomial line(f.ring()), power = f.ring().constant(1);
      for (const Polynomial& c : f.coefficients(v)) {
        line += power.scaled(c.evaluate(point));
        power *= f.ring().variable(v);
      }
      if (line.is_zero()) continue;
      for (const auto& [factor, exponent] : line.factors()) {
        if (factor.degree(v) != 1 || exponent != 1) continue;
        return true;  // a simple root: the derivative along v is not zero
      }
    }
  }
  return false;
}

bool is_last(const Polynomial& f, const Places& variables) {
  const auto factors = f.factors();
  std::size_t moving = 0;
  for (const auto& [factor, exponent] : factors) {
    if (!uses_any(factor, variables)) continue;
    moving += exponent;
  }
  if (moving != 1) return false;
  if (std::any_of(variables.begin(), variables.end(),
                  [&](std::size_t v) { return f.degree(v) == 1; }))
    return true;
  return !has_parameters(f, variables) && has_smooth_rational_point(f, variables);
}

}  // namespace

bool is_shown_real_and_prime(std::vector<Polynomial> functions, const Places& variables) {
  for (;;) {
    std::erase_if(functions, [](const Polynomial& f) { return f.is_zero(); });
    if (functions.empty()) return true;
    if (std::any_of(functions.begin(), functions.end(),
                    [&](const Polynomial& f) { return !uses_any(f, variables); }))
      return false;  // no points at all
    if (take_graph(functions, variables)) continue;
    if (functions.size() == 1) return is_last(functions[0], variables);
    if (!take_bundle(functions, variables)) return false;
  }
}

}  // namespace casimir::search

#include "symbolic/discrete/free_body.hpp"

#include <fmt/format.h>

#include "symbolic/error.hpp"

namespace casimir::discrete {
namespace {

struct Fraction {
  Polynomial top, bottom;
};

/// s of {m_i, m_j} = s m_k, the same for all three.
cln::cl_RA bracket_sign(const Model& flow) {
  if (!flow.poisson || !flow.hamiltonian)
    refuse_free_body("the case has no bracket with a Hamiltonian");
  if (flow.variables.size() != 3)
    refuse_free_body(fmt::format("the case has {} variables, not 3", flow.variables.size()));
  const GiNaC::ex sign = (*flow.poisson)(0, 1).diff(flow.variables[2]).expand();
  if (!GiNaC::is_a<GiNaC::numeric>(sign) || sign.is_zero() ||
      !GiNaC::ex_to<GiNaC::numeric>(sign).is_rational())
    refuse_free_body("the bracket is not that of so(3)");
  for (std::size_t i = 0; i < 3; ++i) {
    const GiNaC::ex defect = (*flow.poisson)(i, (i + 1) % 3) - sign * flow.variables[(i + 2) % 3];
    if (!defect.expand().is_zero()) refuse_free_body("the bracket is not that of so(3)");
  }
  return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(sign).to_cl_N());
}

/// a_i of H = (a_1 m_1^2 + ..)/2, H as a fraction whose denominator is free of the m_i.
Fraction coefficient(const Model& flow, const FunctionRing& ring, const Polynomial& energy,
                     std::size_t i) {
  const Polynomial slope = ring.derivative(energy, i);
  const Polynomial twice = ring.derivative(slope, i);
  const auto vanishes = [&](const Polynomial& p) { return ring.numerator(p).is_zero(); };
  const std::string name = flow.variables[i].get_name();
  if (!vanishes(slope - ring.checked_product(twice, ring.ring().variable(i))))
    refuse_free_body("the Hamiltonian is no sum of squares in " + name);
  auto [top, bottom] = ring.lowest_terms(twice);
  if (ring.depends_on_first(top, 3) || ring.depends_on_first(bottom, 3))
    refuse_free_body("the Hamiltonian is no sum of squares in " + name);
  if (top.is_zero()) refuse_free_body(fmt::format("the coefficient of {}^2 is 0", name));
  const cln::cl_RA content = top.content();
  return {top.scaled(1 / content), bottom.scaled(1 / content)};
}

/// The least common multiple as polynomials of the ring.
Polynomial common_multiple(const std::vector<Fraction>& a, const FunctionRing& ring) {
  Polynomial result = ring.ring().constant(1);
  for (const Fraction& one : a) {
    Polynomial rest(ring.ring());
    one.top.divide(Polynomial::gcd(result, one.top), &rest);
    result = ring.checked_product(result, rest);
  }
  return result;
}

}  // namespace

FreeBody free_body(const Model& flow, FunctionRing& ring) {
  FreeBody body{{}, ring.ring().constant(1), bracket_sign(flow), {}};
  if (flow.time) refuse_free_body("the equations depend on time");
  const Polynomial& energy = ring.convert(*flow.hamiltonian);
  std::vector<Fraction> a;
  for (std::size_t i = 0; i < 3; ++i) {
    a.push_back(coefficient(flow, ring, energy, i));
    if (!a[i].top.is_constant()) body.nonzero.push_back(a[i].top);
  }
  body.scale = common_multiple(a, ring);
  std::vector<Polynomial> moments;
  for (const Fraction& one : a) {
    Polynomial factor(ring.ring());
    body.scale.divide(one.top, &factor);
    moments.push_back(ring.reduced(ring.checked_product(factor, one.bottom)));
  }
  for (std::size_t i = 0; i < 3; ++i)
    body.tensor.push_back(
        (moments[(i + 1) % 3] + moments[(i + 2) % 3] - moments[i]).scaled(cln::cl_RA(1) / 2));
  return body;
}

void refuse_free_body(const std::string& missing) {
  throw ModelError(
      missing +
      ": Moser's and Veselov's map is that of a free rigid body, with the bracket of so(3) in "
      "three variables and a Hamiltonian that is a sum of their squares with coefficients other "
      "than 0");
}

}  // namespace casimir::discrete

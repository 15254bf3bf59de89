// Invariant measures: the density rho satisfies div(rho f) + d(rho)/dt = 0 for the flow f, or for
// the flow of every Hamiltonian, which for rho = 1 is the unimodularity of a Lie algebra
// (Borisov & Mamaev, Sec. 1.2). A density is a real function that is not zero everywhere: of the
// zero function the equation would say nothing.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/density.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/claims/ranks.hpp"
#include "symbolic/proof/generic_rank.hpp"

namespace casimir {
namespace {

Residual divergence_of_flow(Prover& prover, const NamedExpression& density) {
  const Polynomial rho = prover.convert(density.value);
  return {fmt::format("the divergence of ({}) * dx/dt", density.name),
          prover.rate(rho) + rho * prover.divergence(), [&prover, density] {
            const Model& model = prover.model();
            GiNaC::ex sum = model.rate(density.value);
            for (std::size_t i = 0; i < model.variables.size(); ++i)
              sum += density.value * model.field[i].diff(model.variables[i]);
            return sum;
          }};
}

/// sum_i d(rho J_ij)/dx_i for each j: what multiplies dH/dx_j in the divergence.
std::vector<Residual> modular_field(Prover& prover, const NamedExpression& density) {
  const Polynomial rho = prover.convert(density.value);
  std::vector<Residual> residuals;
  for (std::size_t j = 0; j < prover.dimension(); ++j) {
    Polynomial sum(prover.ring().ring());
    for (std::size_t i = 0; i < prover.dimension(); ++i)
      sum += prover.ring().derivative(rho * prover.bracket_entry(i, j), i);
    residuals.push_back({fmt::format("the divergence of ({}) * dx/dt for H = {}", density.name,
                                     prover.model().variables[j].get_name()),
                         std::move(sum), [&prover, density, j] {
                           const Model& model = prover.model();
                           GiNaC::ex total = 0;
                           for (std::size_t i = 0; i < model.variables.size(); ++i)
                             total +=
                                 (density.value * (*model.poisson)(i, j)).diff(model.variables[i]);
                           return total;
                         }});
  }
  return residuals;
}

bool has_imaginary_number(const GiNaC::ex& e) {
  for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
    if (GiNaC::is_a<GiNaC::numeric>(*part) && !GiNaC::ex_to<GiNaC::numeric>(*part).is_real())
      return true;
  }
  return false;
}

/// The signs of a density at the points that are looked at.
struct Signs {
  bool positive = false, negative = false;
  bool both = false;  ///< at different states, and the same values of the parameters

  void add(std::optional<int> sign) {
    positive = positive || sign == 1;
    negative = negative || sign == -1;
  }
};

/// Whether it has both signs at the parameters of a point: at states near to 0 and far from it.
bool has_both_signs_beside(RealPoints& points, const std::vector<GiNaC::ex>& domain,
                           const GiNaC::ex& density, RealPoint base, std::size_t variables) {
  constexpr int kPoints = 40;
  Signs signs;
  signs.add(base.evaluator().sign(density));
  for (int i = 0; i < kPoints && !(signs.positive && signs.negative); ++i) {
    try {
      std::vector<GiNaC::ex> coordinates = i % 2 == 0 ? points.draw_wide() : points.draw();
      std::copy(base.coordinates().begin() + static_cast<long>(variables), base.coordinates().end(),
                coordinates.begin() + static_cast<long>(variables));
      RealPoint point = points.at(std::move(coordinates));
      if (points.admits(point, domain)) signs.add(point.evaluator().sign(density));
    } catch (const NotCertified&) {
      continue;
    }
  }
  return signs.positive && signs.negative;
}

Signs signs_in_space(Prover& prover, const GiNaC::ex& density) {
  // An arbitrary function has either sign, and no value at a point.
  if (highest_derivative(density)) return {true, true, true};
  std::vector<GiNaC::ex> domain = prover.domain();
  std::erase_if(domain, [](const GiNaC::ex& e) { return highest_derivative(e).has_value(); });
  constexpr int kPoints = 6;
  Signs signs;
  std::vector<RealPoint> seen;
  for (int i = 0; i < kPoints && !(signs.positive && signs.negative); ++i) {
    auto point = prover.real_points().random(domain);
    if (!point) break;
    signs.add(point->evaluator().sign(density));
    seen.push_back(std::move(*point));
  }
  // Drawn by themselves, so that the points of other claims stay what they are.
  RealPoints own = prover.real_points();
  constexpr std::size_t kMostBases = 3;
  for (std::size_t i = 0; i < std::min(seen.size(), kMostBases) && !signs.both; ++i)
    signs.both = has_both_signs_beside(own, domain, density, seen[i], prover.dimension());
  return signs;
}

bool is_nowhere_zero(Prover& prover, const GiNaC::ex& density) {
  const FunctionRing& ring = prover.ring();
  return ring.is_nowhere_zero(ring.lowest_terms(prover.convert(density)).first);
}

/// Why the function is not known to be a density; empty where it is one.
/// \param signs  of it, where they were looked for
std::string doubt_about(Prover& prover, const GiNaC::ex& density, Signs* signs,
                        std::vector<std::string>* where) {
  if (prover.ring().numerator(prover.convert(density)).is_zero())
    return "the density is identically zero, which is no measure";
  if (has_imaginary_number(density) && has_imaginary_number(density.expand()))
    return "the density is not shown to be real";
  if (GiNaC::is_a<GiNaC::numeric>(density)) return {};  // not 0, by the first line
  *signs = signs_in_space(prover, density);
  const bool nowhere_zero = is_nowhere_zero(prover, density);
  if (!signs->positive && !signs->negative && !nowhere_zero)
    return "no point was found at which the density has a real value that is not zero";
  if (nowhere_zero) return {};
  const auto found = rank_with_conditions(prover, {{prover.convert(density)}});
  if (!found || !found->uneven.empty() || found->rank == 0)
    return "the density is not shown to differ from zero on every piece of the domain";
  *where = found->nonzero;
  if (!found->where.empty()) where->push_back(found->where);
  return {};
}

/// Whether it has both signs where the case says something. An arbitrary function that is nowhere
/// zero, as 1 + U^2, is not told to.
std::string note_of(Prover& prover, const GiNaC::ex& density, const Signs& signs) {
  if (!signs.both || (highest_derivative(density) && is_nowhere_zero(prover, density))) return {};
  const bool on_constraints = !prover.model().constraints.empty() && !highest_derivative(density);
  if (on_constraints && !(prover.is_positive_somewhere_on_constraints(density) &&
                          prover.is_positive_somewhere_on_constraints(-density)))
    return {};
  return "the density has both signs: it is a measure only on parts of the domain";
}

/// Whether the trace of K, of rates dc_i/dt = sum K_ij c_j of the constraints, vanishes on these,
/// where polynomial division finds such K.
bool has_no_trace(Prover& prover, const std::vector<Polynomial>& constraints) {
  const FunctionRing& ring = prover.ring();
  const Polynomial zero = ring.ring().constant(0);
  Polynomial top = zero, bottom = ring.ring().constant(1);  // of the trace
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const auto [rate, below] = ring.lowest_terms(prover.rate(constraints[i]));
    std::vector<Polynomial> cofactors(constraints.size(), zero);
    if (!rate.is_zero() && !rate.remainder(constraints, &cofactors).is_zero()) return false;
    top = top * below + cofactors[i] * bottom;
    bottom = bottom * below;
  }
  std::vector<Polynomial> unused(constraints.size(), zero);
  return top.is_zero() || top.remainder(constraints, &unused).is_zero();
}

/// Whether the flow, or every flow, keeps the volume across the constraints: dc_1 .. dc_k changes
/// on their zero level at the rate tr K. Then a density of all variables, divided by that, is one
/// on the constraints. Else it is none: x' = x, z' = -z keeps dx dz, and on z = 0 not dx.
bool keeps_constraints(Prover& prover, bool every) {
  const std::vector<NamedExpression>& constraints = prover.model().constraints;
  if (constraints.empty()) return true;
  if (every)
    return std::ranges::all_of(constraints,
                               [&](const NamedExpression& c) { return is_casimir(prover, c); });
  std::vector<Polynomial> functions;
  for (const NamedExpression& c : constraints) {
    functions.push_back(prover.ring().numerator(prover.convert(c.value)));
    if (functions.back().is_zero()) return false;
  }
  return has_no_trace(prover, functions);
}

/// What is not zero around the phase space may be zero all over it.
void require_nonzero_on_constraints(Prover& prover, Proof& proof, const GiNaC::ex& density) {
  if (prover.model().constraints.empty() || GiNaC::is_a<GiNaC::numeric>(density)) return;
  const Polynomial rho = prover.convert(density), top = prover.ring().numerator(rho);
  if (prover.ring().is_nowhere_zero(top) || prover.is_nowhere_zero_on_constraints(top)) return;
  Proof at_exact_point = proof;
  require_on_constraints(prover, at_exact_point, {{{{rho}}, 1}});
  if (at_exact_point.verdict == Verdict::proved) {
    proof = std::move(at_exact_point);
  } else if (prover.is_nonzero_somewhere_on_constraints(density)) {
    proof.where.emplace_back(
        "on parts of the constraints where the density is not zero throughout");
  } else {
    proof.verdict = Verdict::undecided;
    proof.evidence.clear();
    proof.where.clear();
    proof.reason = "no point of the constraints was found at which the density is not zero";
  }
}

/// Whether the gradient of an irreducible function is not zero all over a piece of its zeros: that
/// of an irreducible polynomial is not where these are a surface, and of 1 - sin(x) it is.
/// \param slopes  its gradient
bool is_simple(Prover& prover, const Polynomial& u, const std::vector<Polynomial>& slopes) {
  const FunctionRing& ring = prover.ring();
  if (!prover.model().constraints.empty()) return false;  // on z = x^2 that of z is zero with z
  bool polynomial = true;
  for (std::size_t place = ring.symbols().size(); place < ring.end_of_generators(); ++place)
    polynomial = polynomial && !u.uses(place);
  return polynomial || std::ranges::any_of(slopes, [&](const Polynomial& slope) {
           return !prover.may_meet(ring.numerator(slope), u);
         });
}

/// Poles of the equations at which all motions of a measure may meet, since its density becomes
/// infinite there: those of x' = -1, y' = -2*y/x keep x^2/(x^4 + y^2) and come to y = 0 with x.
std::vector<Polynomial> foci(Prover& prover, const Polynomial& rho) {
  const FunctionRing& ring = prover.ring();
  std::vector<Polynomial> infinite = ring.pole_factors(rho);
  const std::vector<Polynomial> rough = ring.radicand_factors(rho);
  // Of x/|x| no pole is seen, and none is there.
  std::erase_if(infinite, [&](const Polynomial& d) {
    return std::ranges::count(rough, d) > 0 && !ring.pole_coefficient(rho, d);
  });
  std::vector<Polynomial> places = prover.passed_poles();
  std::erase_if(places, [&](const Polynomial& f) {
    return std::ranges::none_of(infinite,
                                [&](const Polynomial& d) { return prover.may_meet(d, f); });
  });
  return places;
}

/// The places that motions pass and where the measure need not be kept.
///
/// Theorem: where the continuity equation holds on both sides of a surface u = 0, it holds across
/// it if the flux through it, rho*du/dt, is continuous there: p' = -sign(q) keeps dp dq, and
/// x' = 2 + sign(x) makes one unit of dx into three. Assumed: the gradient of u is not zero all
/// over a piece of the surface (`is_simple`), and the density is bounded where the equations have
/// poles (`foci`): then what is of less dimension is passed by almost no motion.
/// \param every  of the flows of all Hamiltonians
std::vector<Polynomial> leaks(Prover& prover, const Polynomial& rho, bool every) {
  const std::size_t n = prover.dimension();
  std::vector<Polynomial> places;
  const auto jumps_of = [&](const Polynomial& p) { return prover.passed_jumps(p, true, every); };
  const auto add = [&](const Polynomial& p) {
    for (Polynomial& u : jumps_of(p))
      if (std::find(places.begin(), places.end(), u) == places.end())
        places.push_back(std::move(u));
  };
  add(rho);
  for (std::size_t i = 0; i < n; ++i) {
    if (!every) add(rho * prover.field()[i]);
    for (std::size_t j = 0; every && j < i; ++j) add(rho * prover.bracket_entry(i, j));
  }
  std::erase_if(places, [&](const Polynomial& u) {
    const std::vector<Polynomial> slopes = prover.gradient(u);
    if (!is_simple(prover, u, slopes)) return false;
    const std::vector<Polynomial> rates =
        every ? prover.flow_of(slopes) : std::vector{prover.rate(u)};
    return std::ranges::none_of(rates, [&](const Polynomial& rate) {
      return std::ranges::any_of(jumps_of(rho * rate), [&](const Polynomial& v) {
        return !prover.is_nonzero_somewhere(v, u) || !prover.is_nonzero_somewhere(u, v);
      });
    });
  });
  for (Polynomial& f : every ? std::vector<Polynomial>{} : foci(prover, rho))
    if (std::find(places.begin(), places.end(), f) == places.end()) places.push_back(std::move(f));
  return places;
}

void decide_measure(Prover& prover, Proof& proof, const NamedExpression& density, bool every) {
  if (!keeps_constraints(prover, every)) {
    proof.reason = kNoMeasureOnConstraints;
    return;
  }
  prover.decide(
      proof,
      every ? modular_field(prover, density) : std::vector{divergence_of_flow(prover, density)},
      {});
  judge_density(prover, proof, density.value);
  if (proof.verdict != Verdict::proved) return;
  std::vector<std::string> where;
  for (const Polynomial& f : leaks(prover, prover.convert(density.value), every))
    where.push_back(fmt::format("on motions that do not cross {} = 0", prover.ring().text(f)));
  say_where(proof, "", where);
}

}  // namespace

void judge_density(Prover& prover, Proof& proof, const GiNaC::ex& density) {
  // x (1 + y^2) = 0 is the line x = 0 as well, on which dx dy leaves dy/(1 + y^2) then.
  constexpr const char* kOnThem =
      "on the constraints c, as they are written, the measure is density*dx/dc";
  if (proof.verdict == Verdict::refuted && !prover.model().constraints.empty())
    proof.reason += fmt::format("; {}", kOnThem);
  if (proof.verdict != Verdict::proved) return;
  Signs signs;
  proof.reason = doubt_about(prover, density, &signs, &proof.where);
  if (!proof.reason.empty()) {
    proof.verdict = Verdict::undecided;
    return;
  }
  if (!prover.model().constraints.empty()) {
    proof.evidence = kOnThem;
    require_nonzero_on_constraints(prover, proof, density);
    if (proof.verdict != Verdict::proved) return;
  }
  if (const std::string note = note_of(prover, density, signs); !note.empty())
    proof.evidence = note + (proof.evidence.empty() ? "" : "; ") + proof.evidence;
}

std::string note_on_signs(Prover& prover, const GiNaC::ex& density) {
  if (GiNaC::is_a<GiNaC::numeric>(density)) return {};
  return note_of(prover, density, signs_in_space(prover, density));
}

std::vector<Claim> measure_claims(const Model& model) {
  std::vector<Claim> claims;
  for (const Measure& measure : model.measures) {
    const NamedExpression density = measure.density;
    const bool every = measure.every_hamiltonian;
    claims.push_back({ClaimKind::measure,
                      density.name + (every ? ", every Hamiltonian" : ""),
                      false,
                      [density, every](Prover& prover, Proof& proof) {
                        decide_measure(prover, proof, density, every);
                      },
                      {},
                      values_of(model.constraints, density),
                      false,
                      every ? Subject::bracket : Subject::motion});
  }
  return claims;
}

std::vector<Claim> unimodularity_notes(const Model& model) {
  if (!model.linear_bracket) return {};
  Claim note{ClaimKind::measure, "unimodular algebra", false, [](Prover& prover, Proof& proof) {
               prover.decide(proof, modular_field(prover, {"1", 1, {}}), {});
               if (proof.verdict == Verdict::proved)
                 proof.evidence = "the flow of every Hamiltonian keeps the volume";
             }};
  note.note = true;
  note.subject = Subject::bracket;
  return {note};
}

}  // namespace casimir

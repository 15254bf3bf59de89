#include "symbolic/obstruction/higher/higher_variation.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/higher/binary_form.hpp"
#include "symbolic/obstruction/higher/elliptic_motion.hpp"
#include "symbolic/obstruction/higher/jet.hpp"
#include "symbolic/obstruction/higher/local_solutions.hpp"

namespace casimir::obstruction {
namespace {

using GiNaC::ex;

constexpr long kPoles = 12;  ///< highest order of a pole of the solutions that is tried
constexpr long kLast = 30;   ///< the last coefficient of the solutions
constexpr long kTerms = 60;  ///< of the motion
constexpr std::size_t kTangent = 2, kConstants = 4;

/// The equations in coordinates that vanish on the plane, and those along it: first the latter.
struct AdaptedSystem {
  std::vector<GiNaC::symbol> symbols;
  std::vector<ex> rates;
  std::vector<std::size_t> variables;  ///< of the system
};

/// {f, g}, where it is a number; else zero.
ex constant_bracket(const HamiltonianSystem& system, const ex& f, const ex& g) {
  ex result = 0;
  for (std::size_t i = 0; i < system.variables.size(); ++i)
    for (std::size_t j = 0; j < system.variables.size(); ++j)
      result += f.diff(system.variables[i]) * system.poisson[i][j] * g.diff(system.variables[j]);
  result = result.expand();
  return GiNaC::is_a<GiNaC::numeric>(result) ? result : ex(0);
}

/// m for which the brackets of a + m nu with the functions nu, which vanish on the plane, are zero:
/// the coordinates that belong to the plane's complement by the bracket, where all is linear.
GiNaC::matrix complement(const HamiltonianSystem& system, const InvariantPlane& plane) {
  GiNaC::matrix along(kTangent, kTangent), normal(kTangent, kTangent);
  std::vector<ex> nu;
  for (const auto& [i, own] : plane.normal) nu.push_back(system.variables[i] - own);
  for (unsigned i = 0; i < kTangent; ++i)
    for (unsigned j = 0; j < kTangent; ++j) {
      along(i, j) = -constant_bracket(system, system.variables[plane.along[i]], nu[j]);
      normal(i, j) = constant_bracket(system, nu[i], nu[j]);
    }
  if (normal.determinant().is_zero()) return {kTangent, kTangent};
  return along.mul(normal.inverse());
}

/// The equations of motion with nu = x - (its value on the plane) for each normal variable x, and
/// with a + m nu for those along the plane. What is asked of them is checked by `blocks`.
AdaptedSystem adapted(const HamiltonianSystem& system, const InvariantPlane& plane) {
  const GiNaC::matrix m = complement(system, plane);
  AdaptedSystem result;
  GiNaC::exmap moved;
  for (unsigned t = 0; t < kTangent; ++t) {
    ex own = system.variables[plane.along[t]];
    for (unsigned i = 0; i < kTangent; ++i)
      own -= m(t, i) * system.variables[plane.normal[i].first];
    moved[system.variables[plane.along[t]]] = own;
  }
  for (const auto& [i, own] : plane.normal)
    moved[system.variables[i]] = system.variables[i] + own.subs(moved);
  std::vector<ex> normal_rates;
  for (const auto& [i, own] : plane.normal) {
    ex rate = system.rates[i];
    for (const std::size_t t : plane.along) rate -= own.diff(system.variables[t]) * system.rates[t];
    normal_rates.push_back(rate);
  }
  for (unsigned t = 0; t < kTangent; ++t) {
    ex rate = system.rates[plane.along[t]];
    for (unsigned i = 0; i < kTangent; ++i) rate += m(t, i) * normal_rates[i];
    result.symbols.push_back(system.variables[plane.along[t]]);
    result.rates.push_back(rate.subs(moved).expand());
    result.variables.push_back(plane.along[t]);
  }
  for (std::size_t i = 0; i < kTangent; ++i) {
    result.symbols.push_back(system.variables[plane.normal[i].first]);
    result.rates.push_back(normal_rates[i].subs(moved).expand());
    result.variables.push_back(plane.normal[i].first);
  }
  return result;
}

/// The coefficients of the variational equations, as polynomials on the plane: two blocks, each
/// with trace zero. \throws NotDecided  where they are not
std::vector<std::vector<ex>> blocks(const AdaptedSystem& system) {
  GiNaC::exmap on_plane;
  for (std::size_t i = kTangent; i < kConstants; ++i) on_plane[system.symbols[i]] = 0;
  std::vector<std::vector<ex>> result(kConstants);
  GiNaC::lst all;
  for (const GiNaC::symbol& x : system.symbols) all.append(x);
  for (std::size_t i = 0; i < kConstants; ++i) {
    if (!system.rates[i].is_polynomial(all)) throw NotDecided("the equations are no polynomials");
    for (std::size_t j = 0; j < kConstants; ++j) {
      result[i].push_back(system.rates[i].diff(system.symbols[j]).subs(on_plane).expand());
      if ((i < kTangent) != (j < kTangent) && !result[i][j].is_zero())
        throw NotDecided("the variational equations along and normal to the plane are not apart");
    }
  }
  for (const std::size_t i : {std::size_t{0}, kTangent})
    if (!(result[i][i] + result[i + 1][i + 1]).expand().is_zero())
      throw NotDecided("the variational equations do not keep areas");
  return result;
}

/// exp(-2 integral of p) for a p with simple poles and halves of integers as residues.
RationalFunction squared_wronskian(const RationalFunction& p) {
  const RationalFunction twice = RationalFunction(-2) * p;
  RationalFunction result(1), rest = twice;
  for (const auto& [factor, exponent] : twice.denominator().factors()) {
    const Univariate below =
        (twice.denominator().divided(factor).first * factor.derivative()).remainder(factor);
    if (exponent > 1) throw NotDecided("the determinant of two solutions is no function");
    const Univariate residue = (twice.numerator() * below.inverse(factor)).remainder(factor);
    const cln::cl_RA number = residue.coefficient(0);
    if (!residue.is_constant() || cln::denominator(number) != 1 || cln::abs(number) > 100)
      throw NotDecided("the determinant of two solutions is no function");
    result = result * RationalFunction(factor).pow(cln::cl_I_to_long(cln::numerator(number)));
    rest = rest - RationalFunction(residue * factor.derivative(), factor);
  }
  if (!rest.is_zero()) throw NotDecided("the determinant of two solutions is no function");
  return result;
}

/// A function g of z and z' that is y1 y2 up to a number, as a series at t = 0. The group permutes
/// the lines of y1 and y2, and its identity component leaves them invariant.
LaurentSeries product_of_solutions(const NormalEquation<RationalFunction>& equation,
                                   const EllipticMotion& motion, const std::string& z,
                                   const std::function<void()>& tick) {
  const std::vector<Singularity> singular = singularities(equation.reduced);
  RationalFunction square = squared_wronskian(equation.p);
  if (const auto two = rational_invariant(equation.reduced, singular, 2, tick, z); two.invariant)
    square = square * *two.invariant * *two.invariant;
  else if (const auto four = rational_invariant(equation.reduced, singular, 4, tick, z);
           four.invariant)
    square = square * *four.invariant;
  else
    throw NotDecided("no product of two solutions is known");
  square = square / RationalFunction(square.numerator().leading());
  if (const auto root = square.square_root()) return at_series(*root, motion.z);
  // z'^2 up to a number.
  const auto root = (square / RationalFunction(motion.cubic.monic())).square_root();
  if (!root) throw NotDecided("the product of two solutions is no function on the curve");
  return at_series(*root, motion.z) * motion.speed;
}

/// Whether a local monodromy of the equation has two eigenvalues whose quotient is no root of
/// unity.
bool is_infinite(const NormalEquation<RationalFunction>& equation) {
  const std::vector<Singularity> singular = singularities(equation.reduced);
  const auto all_regular = [](const Singularity& s) { return s.regular(); };
  return std::all_of(singular.begin(), singular.end(), all_regular) &&
         std::any_of(singular.begin(), singular.end(),
                     [](const Singularity& s) { return !s.rational_difference(); });
}

/// q with q11 u1^2 + q12 u1 u2 + q22 u2^2 = g, which is known to exist.
ProductOfSolutions in_basis(const LaurentSeries& u1, const LaurentSeries& u2,
                            const LaurentSeries& g) {
  std::array<LaurentSeries, 3> products{u1 * u1, u1 * u2, u2 * u2};
  LaurentSeries rest = g;
  ProductOfSolutions result{0, 0, 0};
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return products[a].valuation() < products[b].valuation();
  });
  for (const std::size_t i : order) {
    const long first = products[i].valuation();
    result[i] = rest.coefficient(first) / products[i].coefficient(first);
    rest = rest - LaurentSeries(result[i]) * products[i];
  }
  if (!rest.vanishes()) throw NotDecided("the product of two solutions was not found");
  return result;
}

/// The solutions of the variational equations of order 1, 2, .. at t = 0.
class LocalExpansion {
 public:
  LocalExpansion(const AdaptedSystem& system, const EllipticMotion& motion) : system_(system) {
    for (const std::size_t i : system.variables) motion_.push_back(motion.values[i]);
    for (std::size_t i = kTangent; i < kConstants; ++i) motion_[i] = LaurentSeries();
    const auto entries = blocks(system);
    std::vector<Jet> values;
    for (const LaurentSeries& own : motion_) values.emplace_back(kConstants, own);
    phi_.assign(kConstants, std::vector<LaurentSeries>(kConstants));
    for (const std::size_t first : {std::size_t{0}, kTangent}) {
      SeriesMatrix a(2, std::vector<LaurentSeries>(2));
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          a[i][j] = value(entries[first + i][first + j], system.symbols, values, kConstants, 0)
                        .terms()
                        .begin()
                        ->second;
      const auto own = laurent_solutions(a, kPoles, kLast);
      if (!own)
        throw NotDecided(
            "the variational equation of order 1 has a logarithm, or a pole "
            "of its solutions has an order above 12");
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) phi_[first + i][first + j] = (*own)[i][j];
    }
    inverse_ = inverse(phi_);
    for (std::size_t i = 0; i < kConstants; ++i)
      u_.push_back(Jet::constant(kConstants, i, LaurentSeries(cln::cl_RA(1))));
  }

  const LaurentSeries& solution(std::size_t row, std::size_t column) const {
    return phi_[row][column];
  }

  /// The residues of order k, after those of all lower orders were zero: u' = Phi^(-1) f with x =
  /// motion + Phi u.
  std::vector<ConstantPolynomial> residues(unsigned k) {
    std::vector<Jet> values;
    for (std::size_t i = 0; i < kConstants; ++i) {
      Jet own(kConstants, motion_[i]);
      for (std::size_t j = 0; j < kConstants; ++j)
        for (const auto& [monomial, series] : u_[j].terms()) own.add(monomial, phi_[i][j] * series);
      values.push_back(std::move(own));
    }
    std::vector<Jet> force;
    for (const ex& rate : system_.rates)
      force.push_back(value(rate, system_.symbols, values, kConstants, k).of_degree(k));
    std::vector<ConstantPolynomial> result(kConstants);
    slopes_.assign(kConstants, Jet());
    for (std::size_t i = 0; i < kConstants; ++i)
      for (std::size_t j = 0; j < kConstants; ++j)
        for (const auto& [monomial, series] : force[j].terms())
          slopes_[i].add(monomial, inverse_[i][j] * series);
    for (std::size_t i = 0; i < kConstants; ++i)
      for (const auto& [monomial, series] : slopes_[i].terms())
        if (const cln::cl_RA own = series.coefficient(-1); !cln::zerop(own))
          result[i][monomial] = own;
    return result;
  }

  /// Adds the solution of the order whose residues were zero.
  void integrate() {
    for (std::size_t i = 0; i < kConstants; ++i)
      for (const auto& [monomial, series] : slopes_[i].terms())
        u_[i].add(monomial, series.integral());
  }

 private:
  const AdaptedSystem& system_;
  std::vector<LaurentSeries> motion_;
  SeriesMatrix phi_, inverse_;
  std::vector<Jet> u_, slopes_;
};

std::string residue_text(const std::vector<ConstantPolynomial>& field) {
  std::string text;
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (field[i].empty()) continue;
    text += fmt::format("{}c{}: ", text.empty() ? "" : "; ", i + 1);
    bool first = true;
    for (const auto& [monomial, value] : field[i]) {
      text += first ? (cln::minusp(value) ? "-" : "") : cln::minusp(value) ? " - " : " + ";
      text += rational_text(cln::abs(value));
      first = false;
      for (std::size_t j = 0; j < monomial.size(); ++j) {
        if (monomial[j] == 0) continue;
        text += fmt::format("*c{}", j + 1);
        if (monomial[j] > 1) text += fmt::format("^{}", monomial[j]);
      }
    }
  }
  return text;
}

}  // namespace

HigherVariation examine_higher(const HamiltonianSystem& system, const InvariantPlane& plane,
                               const ParticularCurve<RationalFunction>& curve,
                               const NormalEquation<RationalFunction>& equation,
                               unsigned highest_order, const std::function<void()>& tick) {
  if (system.variables.size() != kConstants || !system.casimirs.empty() ||
      plane.along.size() != kTangent)
    throw NotDecided(
        "orders above the first are examined for four variables without Casimir "
        "functions only");
  const EllipticMotion motion = elliptic_motion(curve, kTerms);
  const AdaptedSystem own = adapted(system, plane);
  LocalExpansion local(own, motion);
  std::size_t row = kTangent;
  if (system.variables[own.variables[row]].get_name() != equation.unknowns.front()) ++row;
  const ProductOfSolutions product =
      in_basis(local.solution(row, kTangent), local.solution(row, kTangent + 1),
               product_of_solutions(equation, motion, curve.names.z, tick));
  HigherVariation result;
  for (unsigned k = 2; k <= highest_order; ++k) {
    tick();
    result.order = k;
    const std::vector<ConstantPolynomial> residues = local.residues(k);
    if (std::all_of(residues.begin(), residues.end(), [](const auto& r) { return r.empty(); })) {
      local.integrate();
      continue;
    }
    const std::vector<BinaryForm> forms = forms_of(residues);
    const auto any = [&](const auto& has_part) {
      return std::any_of(forms.begin(), forms.end(),
                         [&](const BinaryForm& form) { return has_part(form, product); });
    };
    const bool invariant = !motion.degenerate && any(has_invariant_part);
    const bool other = is_infinite(equation) && any(has_other_part);
    result.decisive = invariant || other;
    result.residue = residue_text(residues);
    result.outcome = fmt::format(
        "a logarithm in order {}{}", k,
        invariant ? ", which the semisimple part of the group leaves alone, at the only point at "
                    "infinity of an elliptic curve: the identity component is not abelian"
        : other   ? ", which an infinite torus in the group does not leave alone: the identity "
                    "component is not abelian"
                  : " of a kind that does not decide");
    return result;
  }
  result.outcome = fmt::format("no logarithm up to order {}", highest_order);
  return result;
}

}  // namespace casimir::obstruction

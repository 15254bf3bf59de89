#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "symbolic/obstruction/certificate/no_polynomial.hpp"
#include "symbolic/obstruction/equation/singularities.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// Why a part of the decision has no answer; never thrown where a guess would do.
class NotDecided : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The differential Galois group over C(z) of y'' = r y, as Kovacic tells them apart.
enum class GaloisCase {
  reducible,    ///< case 1: w = y'/y of degree 1
  imprimitive,  ///< case 2: w of degree 2
  finite,       ///< case 3: tetrahedral, octahedral or icosahedral
  sl2,          ///< case 4: SL(2, C), no Liouvillian solution
  undecided,
};

/// What became of one possibility.
struct Attempt {
  std::string what;                      ///< as "case 2: invariants of degree 4"
  std::string outcome;                   ///< why there is none, or that there is one
  std::vector<NoPolynomial> steps = {};  ///< the linear algebra that shows that there is none
};

/// The answer for y'' = r y with r in Q(z).
struct LiouvillianResult {
  GaloisCase galois = GaloisCase::undecided;
  std::vector<Singularity> singular;
  /// Coefficients of degree 0, 1, .. in w (the last is 1) of a polynomial that w = y'/y obeys for a
  /// solution y; empty in case 4. It was put into w' + w^2 = r.
  std::vector<RationalFunction> solution;
  std::vector<Attempt> attempts;
  /// In case 1: the identity component is not abelian, though solvable.
  bool borel = false;
  std::string reason;  ///< of undecided
};

/// Decides whether y'' = r y has a Liouvillian solution (Kovacic 1986), by invariants of the
/// symmetric powers (Ulmer and Weil 1996), which need no algebraic numbers. The group G, a subgroup
/// of SL(2, C), is not SL(2, C) if and only if
///   (1) w' + w^2 = r has a solution in Q(z), or
///   (2) the products of m solutions, for some m in 2, 4, 6, 8, 12, have a combination in Q(z).
/// "If": SL(2) leaves no line invariant, and no form of positive degree. "Only if": the proper
/// algebraic subgroups leave lines invariant, or are imprimitive, or finite. One line: its w is
/// unique, so that the automorphisms of C over Q fix its coefficients, and (1) holds. Two lines:
/// the product y1 y2 is a form of degree 2. All lines: G is in {1, -1}, and y1^2 is one.
/// Imprimitive: (y1 y2)^2, of degree 4. The tetrahedral, octahedral and icosahedral groups have
/// invariants of degree 6, 8 and 12. The rational solutions of a linear equation over Q(z) have a
/// basis over Q.
/// \param tick  is called now and then, and may throw
/// \param z     the name of the variable, for the reasons
LiouvillianResult decide_liouvillian(
    const RationalFunction& r, const std::function<void()>& tick = [] {},
    const std::string& z = "z");

/// r of the equation y'' + p y' + q y = 0 with y = exp(-integral of p/2) times the new unknown,
/// which changes no quotient of solutions and so not whether G's identity component is solvable.
RationalFunction reduced_form(const RationalFunction& p, const RationalFunction& q);

/// A solution w in Q(z) of w' + w^2 = r.
struct RiccatiSearch {
  std::optional<RationalFunction> solution;
  std::string why_not;
  std::vector<NoPolynomial> steps = {};
};

/// Finds one, or shows that there is none. \throws NotDecided  where a pole of order 4 or more that
/// is no rational number would need series over a number field
RiccatiSearch rational_riccati(const RationalFunction& r, const std::vector<Singularity>& singular,
                               const std::function<void()>& tick, const std::string& z);

/// A combination in Q(z) of products of m solutions of y'' = r y.
struct InvariantSearch {
  std::optional<RationalFunction> invariant;
  std::string why_not;
  std::vector<NoPolynomial> steps = {};
};

/// Finds one, or shows that there is none: the exponents bound poles and degree, and linear algebra
/// decides. \throws NotDecided  where the bound is too large to be tried
InvariantSearch rational_invariant(const RationalFunction& r,
                                   const std::vector<Singularity>& singular, long m,
                                   const std::function<void()>& tick, const std::string& z);

/// The image of a polynomial under the recursion for the symmetric power of degree m.
/// \param coefficients  G, G', G W'/W and G^2 r
Univariate symmetric_power_image(const std::vector<Univariate>& coefficients, long m,
                                 const Univariate& polynomial);

/// The polynomial in w, of degree m and monic, whose roots are the y'/y of the factors y of the
/// form of degree m with logarithmic derivative phi; empty where phi belongs to no such form.
std::vector<RationalFunction> form_polynomial(const RationalFunction& r,
                                              const RationalFunction& phi, long m);

/// Whether every root w of the monic polynomial obeys w' + w^2 = r: its derivative along that
/// equation has to be a multiple of it.
bool solves_riccati(const std::vector<RationalFunction>& polynomial, const RationalFunction& r);

}  // namespace casimir::obstruction

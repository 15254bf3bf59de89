#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// A place where a function may jump.
struct JumpPlace {
  Polynomial zero;                 ///< vanishes there
  std::optional<Polynomial> with;  ///< and so does this one, under a root or an absolute value
};

/// Knows the places where functions are not differentiable, or not analytic.
class FunctionPieces {
 public:
  FunctionPieces(const GeneratorTable& table, const SignTable& signs)
      : table_(table), signs_(signs) {}

  /// The irreducible factors of what stands under the roots and absolute values that `p` contains,
  /// also within other functions. Where none of them vanishes, `p` is differentiable.
  /// \param cuts  with what has to vanish for atan2 to jump, and for arguments to become infinite,
  ///              which does not concern derivatives
  std::vector<Polynomial> radicand_factors(const Polynomial& p, bool cuts = false) const;

  /// The irreducible factors of what `p` divides by as it is written, and what it contains, and of
  /// what logarithms are taken of: where none of them vanishes, it is bounded.
  std::vector<Polynomial> pole_factors(const Polynomial& p) const;

  /// Of p = c/d^k + .., where d is the only thing with the factor `f` that it divides by, and k the
  /// highest power: c. Nothing where there are several such.
  std::optional<Polynomial> leading_divided_by(const Polynomial& p, const Polynomial& f) const;

  /// Places such that `p`, where it has values, is continuous at all others: where it divides by
  /// zero, inside of roots, absolute values and inverse functions or beside them, and what stands
  /// under one of its roots is zero, too, as of |s|/s; and the cuts of atan2. Of a quotient of
  /// functions that are analytic there are none: what is constant along a motion has no pole there.
  /// Whether the two zeros of a place have a point in common is not looked at: in x + 1 - 2*r and
  /// r - 1, with r = sqrt(x), that is not written.
  /// \param cuts  with those of atan2; poles of arguments, as of tanh(1/x), count always
  /// \param more  what may be zero where the functions in `p` are not analytic along a motion,
  ///              beside what stands under its roots
  std::vector<JumpPlace> jump_factors(const Polynomial& p, bool cuts = true,
                                      const std::vector<Polynomial>& more = {}) const;

  /// Of quotients N/D within other functions: log(N/D) has become log(N) - log(D), of which both
  /// are infinite where N/D jumps, and atan2(N/D, 3) is atan2(N, 3*D), the angle of the origin
  /// there. That these have no value where the factor vanishes does not keep the motion from it.
  std::vector<JumpPlace> split_jump_factors(const Polynomial& p) const;

  /// Whether `p` is zero wherever the irreducible `f` is, and with it the roots of its multiples.
  bool vanishes_with(const Polynomial& p, const Polynomial& f) const;

  /// Of a function that is like c*f^(-s), s > 0, where the irreducible `f` vanishes, one that is
  /// zero where c is. Nothing where this is not seen.
  std::optional<Polynomial> pole_coefficient(const Polynomial& p, const Polynomial& f) const;

  /// Whether `p` is seen to grow without bound towards the origin of the variables of `f`, a form
  /// in them, as 1/(x^2 + y^2) does and x/sqrt(x^2 + y^2) does not: by the lowest degrees of
  /// numerator and denominator, of roots too, along a line that both do not vanish on.
  bool grows_towards_zero(const Polynomial& p, const Polynomial& f) const;

  /// Whether `p` is differentiable all the same where one of its radicands has the factor `f` that
  /// vanishes, as y*|y| and x^(3/2) are.
  bool is_smooth_across(const Polynomial& p, const Polynomial& f) const;

  /// Whether `p` has the factor `f` under its roots in |f| alone, and no inverse function: then it
  /// is differentiable along a curve on which f keeps its sign, or stays zero.
  bool is_rough_in_absolute_value_alone(const Polynomial& p, const Polynomial& f) const;

  /// How functions hang together beyond the part of the domain where a point lies.
  struct Pieces {
    /// What absolute values are taken of: on the set where each keeps its sign, the functions are
    /// restrictions of meromorphic or algebraic ones that are the same all over that set.
    std::vector<Polynomial> switches;
    /// False where this is not shown: what holds at a point is then known to hold at almost all
    /// points of the connected part of the domain around it, and no more.
    bool rigid = true;
  };
  Pieces pieces(const std::vector<Polynomial>& functions) const;

 private:
  /// Where factors under roots in the list are zero and two of its members are, or may be.
  std::vector<JumpPlace> common_zeros(const std::vector<Polynomial>& list) const;
  /// Where logarithms in `p` become infinite.
  std::vector<Polynomial> ends_of_logarithms(const Polynomial& p) const;
  std::vector<Polynomial> ends_of_powers(const Polynomial& p) const;
  const std::vector<Polynomial>& factors_of_radicand(std::size_t g) const;
  std::vector<Polynomial> zeros_of(const Polynomial& f) const;
  /// p like c*f^order.
  struct Leading {
    cln::cl_RA order;
    Polynomial coefficient;
  };
  std::optional<Leading> leading_at(const Polynomial& p, const Polynomial& f) const;
  double lowest_degree(const Polynomial& p, const Polynomial& f) const;

  const GeneratorTable& table_;
  const SignTable& signs_;
  mutable std::unordered_map<std::size_t, std::vector<Polynomial>> radicands_;
};

}  // namespace casimir::functions

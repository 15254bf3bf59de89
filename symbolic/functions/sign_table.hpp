#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/functions/function_factors.hpp"
#include "symbolic/functions/generator_table.hpp"
#include "symbolic/model.hpp"

namespace casimir::functions {

/// Makes a polynomial of an expression, and keeps it.
using Convert = std::function<const Polynomial&(const GiNaC::ex&)>;

/// What roots and logarithms imply where they are real, beyond the assumptions.
struct Implied {
  /// Not negative; with each whether it is not zero either, as what a logarithm is taken of.
  std::vector<std::pair<Polynomial, bool>> positive;
  std::vector<Polynomial> nonzero;  ///< irreducible
  bool empty() const { return positive.empty() && nonzero.empty(); }
};

/// The signs that are known of the polynomials of a table: from assumptions, and since roots and
/// logarithms are real.
class SignTable {
 public:
  SignTable(const GeneratorTable& table, std::vector<Assumption> assumptions)
      : table_(table), assumptions_(std::move(assumptions)) {}

  /// Forgets the polynomials, but not the expressions that were implied: the table starts again.
  void restart() {
    signs_.clear();
    nonzero_.clear();
    radicands_.clear();
    at_edge_.reset();
  }
  /// Ends the building of the ring: what is converted from then on says no more of signs.
  void finish() { built_ = true; }

  /// Reads the assumptions, and what was implied before the last restart.
  void read(const Convert& convert);
  /// How many expressions roots and logarithms have implied so far.
  struct Implications {
    std::size_t signs, products;
  };
  Implications implications() const { return {implied_.size(), products_.size()}; }
  /// Whether what was implied since `before` may give a meaning to what is assumed, or to each
  /// other, so that everything has to be converted once more.
  bool wants_another_build(const Implications& before, const Convert& convert);

  /// The sign that an irreducible polynomial has wherever it does not vanish, or 0.
  int known_sign(const Polynomial& p) const;
  /// Whether an irreducible polynomial is known not to vanish.
  bool known_nonzero(const Polynomial& p) const;
  /// The sign of a number other than zero, certified by balls; empty for what is not a number.
  std::optional<int> sign_of_number(const Polynomial& p) const;
  /// 1 where `p` is not negative anywhere, -1 where it is not positive, 0 where neither is known:
  /// by the signs of its factors.
  int sign_of(const Polynomial& p) const;
  /// See FunctionRing, as for the next four.
  bool is_nowhere_zero(const Polynomial& p) const;
  /// What is known at the edge of where roots and logarithms have values, too: what they imply to
  /// be positive may be zero there.
  const SignTable& at_edge() const;
  /// The same also at the edge of where roots and logarithms have values, of an irreducible one:
  /// what they imply to be positive may be zero there.
  bool is_assumed_nonzero(const Polynomial& p) const;
  bool is_assumed_positive(const Polynomial& p) const;
  std::vector<Polynomial> real_zeros(const Polynomial& p) const;
  Implied implied_by_values() const;
  bool rests_on_what_was_converted() const;

  /// Learns from the radicand of an even root that it is not negative where the root is real.
  /// \param strict  it is not zero either, as what a logarithm is taken of
  void imply_radicand(const Factors& factors, bool strict);
  /// Learns that asin(v) and acos(v) are real for -1 <= v <= 1 only.
  void imply_between(const Polynomial& v);
  /// Learns that a radicand with this denominator has no value where that vanishes.
  void imply_divisor(const Polynomial& bottom);

 private:
  enum class Reading { first, second };
  struct Sign {
    Polynomial of;
    int sign;
    bool implied;  ///< by a root or a logarithm, else assumed
    bool strict;   ///< it does not vanish
  };
  struct Product {
    GiNaC::ex value;  ///< not negative where the roots and logarithms are real
    bool strict;      ///< nor zero
  };
  struct Nonzero {
    Polynomial of;  ///< irreducible
    bool implied;   ///< by a root or a logarithm, else assumed
  };
  struct Radicand {
    Factors factors;
    bool strict;  ///< it is not zero either
  };
  static constexpr int kSignsInSum = 3;  ///< known signs that are added up to find another

  void read_all(Reading reading, const Convert& convert);
  bool tell_more(const Convert& convert);
  void read_assumption(const Assumption& assumption, Reading reading, const Convert& convert);
  void read_sign(const Polynomial& p, int sign, Reading reading, bool implied, bool strict);
  void add_sign(const Polynomial& f, int sign, bool implied, bool strict);
  void imply_sign(const Polynomial& f, int sign, bool strict);
  void keep_product(const Factors& factors, bool strict);
  bool may_vanish(const Polynomial& f) const;
  bool is_sum_of_squares(const Polynomial& p) const;
  bool is_never_negative(std::size_t place) const;
  bool is_never_zero(std::size_t place) const;
  int sign_of_variable(std::size_t place) const;
  int sign_of_term(const cln::cl_RA& coefficient,
                   const std::vector<unsigned long>& exponents) const;
  std::optional<bool> not_negative_by_terms(
      const Polynomial& p, std::pair<cln::cl_RA, std::vector<unsigned long>>* bad) const;
  std::optional<std::vector<Polynomial>> squares_of_quadratic(Polynomial p) const;
  std::optional<bool> is_not_negative(const Polynomial& p, int depth = kSignsInSum) const;
  Polynomial zeros_of_variable(std::size_t place) const;
  std::vector<Polynomial> zeros_of_terms(const Polynomial& p) const;
  bool is_listed_nonzero(const Polynomial& f) const;
  bool is_nonzero_by_form(const Polynomial& f) const;
  bool is_nonzero_unless_listed(const Polynomial& f) const;
  void add_nonzero(const Polynomial& f, bool implied) { nonzero_.push_back({f, implied}); }
  void add_conditions(const Radicand& radicand, Implied& conditions) const;
  static bool keep(std::vector<Product>& list, const GiNaC::ex& value, bool strict);

  const GeneratorTable& table_;
  std::vector<Assumption> assumptions_;
  bool built_ = false;
  std::vector<Sign> signs_;
  std::vector<Nonzero> nonzero_;
  std::vector<Product> implied_;
  std::vector<GiNaC::ex> divisors_;  ///< of radicands, irreducible: where one vanishes is no value
  std::vector<Product> products_;    ///< the same, where no single sign followed when it was met
  std::vector<Radicand> radicands_;  ///< all that were met since the last restart
  mutable std::shared_ptr<const SignTable> at_edge_;  ///< made when it is asked for
};

}  // namespace casimir::functions

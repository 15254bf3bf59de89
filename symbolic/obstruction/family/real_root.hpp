#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// An interval of real numbers with rational ends.
struct RationalInterval {
  cln::cl_RA low, high;
};

/// A real algebraic number: one of the real roots of an irreducible polynomial over Q.
class RealRoot {
 public:
  explicit RealRoot(const cln::cl_RA& value);

  const Univariate& polynomial() const { return polynomial_; }  ///< monic and irreducible
  /// The number, where it is rational.
  std::optional<cln::cl_RA> rational() const;
  /// Contains the number; its ends are not the number unless it is rational.
  RationalInterval interval() const { return interval_; }
  /// Halves the interval.
  void refine();

  friend bool operator==(const RealRoot& a, const RealRoot& b) {
    return a.polynomial_ == b.polynomial_ && a.place_ == b.place_;
  }
  friend bool operator<(const RealRoot& a, const RealRoot& b);

  /// Whether a polynomial vanishes there.
  bool is_root_of(const Univariate& polynomial) const;
  /// Contains the value of a function there and is at most as long as `length`.
  /// \throws std::domain_error  where the function has a pole there
  RationalInterval value(const RationalFunction& f, const cln::cl_RA& length) const;

  /// As "3/4", or as "the root of c^2 - 2 near 1.41421".
  std::string text(const std::string& name) const;

 private:
  friend std::vector<RealRoot> real_roots(const Univariate& polynomial);
  RealRoot(Univariate polynomial, std::size_t place, RationalInterval interval)
      : polynomial_(std::move(polynomial)), place_(place), interval_(std::move(interval)) {}

  Univariate polynomial_;
  std::size_t place_;  ///< among its real roots
  RationalInterval interval_;
};

/// All real roots of a polynomial that is not zero, each once, in order; Arb isolates them.
std::vector<RealRoot> real_roots(const Univariate& polynomial);

}  // namespace casimir::obstruction

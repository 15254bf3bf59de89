#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/model.hpp"

namespace casimir {

using PolynomialRows = std::vector<std::vector<Polynomial>>;

/// The rank of a matrix is at least this: so many pivots are certainly not zero.
/// \param matrix  rows of one size
std::size_t least_rank(std::vector<std::vector<Ball>> matrix, long bits);

/// A point with exact coordinates at which functions of a ring are evaluated in ball arithmetic:
/// what is not zero there is not zero, whether or not the ring knows all relations of its
/// generators.
class RealPoint {
 public:
  /// \param coordinates  exact constants, one for each symbol of the ring
  /// \param shown  how many of the symbols `text` speaks of.
  /// \throws NotCertified
  RealPoint(const FunctionRing& ring, std::vector<GiNaC::ex> coordinates, long bits,
            std::size_t shown);

  /// \throws NotCertified
  Ball value(const Polynomial& p);

  /// The rank of the matrix is at least this: so many pivots are certainly not zero.
  /// \throws NotCertified
  std::size_t rank(const PolynomialRows& rows);

  /// The values of a vector: rational numbers where the point has such and the ring has polynomials
  /// only, else balls.
  struct Values {
    std::vector<cln::cl_RA> exact{};
    std::vector<Ball> balls{};
  };
  /// \throws NotCertified
  Values values(const std::vector<Polynomial>& vector);

  /// False where the product of two vectors with these values is certainly not zero.
  bool may_be_orthogonal(const Values& a, const Values& b) const;

  BallEvaluator& evaluator() { return evaluator_; }
  const std::vector<GiNaC::ex>& coordinates() const { return coordinates_; }

  /// "M1 = 2, M2 = 1/3, ..", to be printed as evidence.
  std::string text() const;

 private:
  const Ball& variable(std::size_t place);
  std::vector<std::vector<Ball>> values(const PolynomialRows& rows);

  const FunctionRing* ring_;
  std::vector<GiNaC::ex> coordinates_;
  std::size_t shown_;
  BallEvaluator evaluator_;
  std::vector<std::optional<Ball>> variables_;
  /// The coordinates, where the ring has only polynomials and they are rational.
  std::vector<cln::cl_RA> exact_;
};

/// Points of a case at which all assumptions certainly hold. Deterministic: the numbers come from a
/// fixed seed.
/// The variables, the parameters and the time, which come first in the ring of a case.
std::size_t own_symbols(const Model& model);

class RealPoints {
 public:
  /// Of the balls at first.
  static constexpr long kBits = 128;

  /// Borrows both.
  RealPoints(const Model& model, const FunctionRing& ring) : model_(model), ring_(ring) {}

  /// A point of the ring.
  /// \throws NotCertified
  RealPoint at(std::vector<GiNaC::ex> coordinates, long bits = kBits) const;

  /// A random point at which, too, every expression certainly has a value, a real one unless the
  /// ring has complex numbers; empty if none was found.
  /// \param differentiable  so that the expressions are, too, at the point
  std::optional<RealPoint> random(const std::vector<GiNaC::ex>& expressions,
                                  bool differentiable = false);

  /// The same, the k-th of a sequence of points whose coordinates have a denominator of their own
  /// each: small fractions are zero or equal to each other more often than chance points of a
  /// continuum are. The expressions are those of the first call.
  std::optional<RealPoint> generic(const std::vector<GiNaC::ex>& expressions, std::size_t k);

  /// The same; the initial states of the case's scenes are tried first.
  /// \param differentiable  so that the expressions are, too, at the point
  std::optional<RealPoint> any(const std::vector<GiNaC::ex>& expressions,
                               bool differentiable = false);

  /// Whether the point is inside every assumption, and the expressions have values there.
  bool admits(RealPoint& point, const std::vector<GiNaC::ex>& expressions) const;
  bool admits(BallEvaluator& at, const std::vector<GiNaC::ex>& expressions) const;

  /// Whether a point was found around which the expressions have values, and the assumptions hold,
  /// none of them with equality. The scenes are tried first.
  bool has_inner_point(const std::vector<GiNaC::ex>& expressions);

  /// The initial states of the case's scenes, with their parameters.
  std::vector<std::vector<GiNaC::ex>> scenes();

  /// Coordinates for the ring's symbols, without a look at the assumptions.
  std::vector<GiNaC::ex> draw();
  /// The same, from a millionth to a million, by turns all of one size and each of its own: for
  /// functions that have values far from 0 alone, or close to it.
  std::vector<GiNaC::ex> draw_wide();
  /// The same; many are 0, 1 or -1, or parts of Pi if these are asked for.
  std::vector<GiNaC::ex> draw_simple(bool parts_of_pi = false);

  /// How the ring's functions are to be evaluated.
  BallEvaluator::Numbers numbers() const;
  /// What is computed of the points is held to these.
  const Limits& limits() const { return ring_.limits(); }

 private:
  std::vector<GiNaC::ex> draw_generic();
  /// Whether all functions of the ring have real values there, as far as doubles tell.
  /// \param coordinates  rational numbers
  bool seems_to_have_values(const std::vector<GiNaC::ex>& coordinates) const;

  const Model& model_;
  const FunctionRing& ring_;
  std::mt19937 random_{20190103};
  int draws_ = 0;
  std::vector<RealPoint> generic_;
};

}  // namespace casimir

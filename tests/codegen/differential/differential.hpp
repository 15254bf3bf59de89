#pragma once

#include <string>
#include <vector>

#include "codegen/emit_cpp.hpp"
#include "tests/codegen/differential/random_system.hpp"
#include "tests/codegen/run/exact_series.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::testing {

/// Where a system is evaluated: state, deviation and time, exact in every number type.
struct Place {
  std::vector<double> state, deviation;
  double time = 0;
};

/// One number that generated code has to come to.
struct Expected {
  std::string what;  ///< "jacobian[3]"
  Sized exact;
  double operations = 1;  ///< about how many of them go into it
};

/// A random system, what is generated from it, and places where it has values.
class RandomSystem {
 public:
  static constexpr int kOrder = 6;  ///< of the Taylor coefficients
  static constexpr int kPlaces = 3;

  /// \param bound  all parameters are replaced by their values, and the time of all places is 0:
  ///               what integrates begins there.
  explicit RandomSystem(std::uint64_t seed, bool bound = false);

  const std::string& text() const { return text_; }
  const Model& model() const { return model_; }
  const Specialisation& specialisation() const { return specialisation_; }
  Scalar scalar() const { return scalar_; }
  const std::vector<Place>& places() const { return places_; }

  /// Everything that the header computes, in this order: rhs, invariants, gradients, jacobian,
  /// jacobian_entries spread out, both outputs of variational, taylor up to kOrder.
  std::vector<Expected> expected(const Place& place) const;

  /// The Taylor coefficients of each state.
  std::vector<Series> coefficients(const Place& place, std::size_t order) const;
  /// About how many rounding errors add up in a right-hand side.
  double operations() const { return operations_; }

 private:
  SeriesEvaluator evaluator(const Place& place, std::size_t order) const;

  std::string text_;
  Model model_;
  Specialisation specialisation_;
  Scalar scalar_;
  std::vector<GiNaC::ex> field_, invariants_;
  /// Of the parameters. They are not put in: GiNaC would know that sin(Pi*a) is no rounding error.
  std::map<GiNaC::ex, cln::cl_R, GiNaC::ex_is_less> values_;
  double operations_ = 0;
  std::vector<Place> places_;
};

/// Relative rounding error, the largest number and the least normal one of the type in which a
/// system is computed.
struct Precision {
  double epsilon, largest, least;
};
Precision precision_of(Scalar scalar);

/// A program that reads places and writes what all systems come to there.
std::string driver(const std::vector<RandomSystem>& systems);

}  // namespace casimir::testing

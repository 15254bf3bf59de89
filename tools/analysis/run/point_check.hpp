#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/specialise.hpp"
#include "runtime/program.hpp"
#include "runtime/program/term_size.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// What is wrong with a state and parameters in double.
struct PointFault {
  bool constraint = false;  ///< the state is not on the constraints
  std::string text;         ///< "the constraint g2 is 0.64 instead of 0"
};

/// The constraints, domains and assumptions of a case, at states and parameters in double: what a
/// scene is checked for exactly, to rounding.
class PointCheck {
 public:
  /// \param scene  for what is not given at a point.
  /// \param s      whose states and parameters points have.
  PointCheck(const Model& model, const Scene& scene, const Specialisation& s);

  /// Empty: nothing is wrong.
  std::optional<PointFault> operator()(const std::vector<double>& state,
                                       const std::vector<double>& parameters);

 private:
  std::vector<std::string> constraints_;  ///< their names
  std::vector<Assumption> assumptions_;   ///< then those of `implied_by_parameters`
  std::size_t implied_ = 0;               ///< from here on
  /// Their values in this order; then x dc/dx for each constraint c and each x in it.
  Program program_;
  std::vector<std::size_t> slopes_;  ///< of which constraint each of these is
  std::vector<SizedNumber> inputs_;  ///< variables and parameters: the scene's, then the point's
  std::vector<std::size_t> states_, parameters_;  ///< where those of the points are among them
};

}  // namespace casimir

#pragma once

#include <limits>
#include <string>
#include <vector>

#include "runtime/program.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// Functions of the state and the time, to be evaluated along a run.
class Quantities {
 public:
  /// \param functions  over the variables of the model, its time, and parameters, which have the
  ///                   values of the scene.
  /// \param states  those that a run has, in its order.
  /// \throws RequestError  for a function of a state that the run does not have, which is named.
  Quantities(const Model& model, const Scene& scene, const std::vector<GiNaC::ex>& functions,
             const std::vector<std::string>& states);

  /// One number for each function; not a number where it has no value.
  std::vector<double> operator()(double t, const std::vector<double>& state) const;

 private:
  Program program_;
  std::vector<std::size_t> places_;  ///< of the run's states among the inputs
  std::size_t inputs_ = 0;
};

}  // namespace casimir

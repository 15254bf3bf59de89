#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/coordinates.hpp"

namespace casimir {

/// What other variables say of a state.
struct ConvertedState {
  std::vector<double> state;
  /// The largest sum of absolute derivatives of a new variable by the old ones: about so much
  /// larger is the error of the new ones. No number where a derivative has no value.
  double growth = 1;
  /// New variables that the old ones do not determine, since the map from the new ones to the old
  /// ones forgets them, as (M, g) the precession of a top: theirs is one value of many, and what
  /// comes of a motion is no solution in the new variables.
  std::vector<std::string> undetermined;
};

/// States of a case in other variables, in double.
class Conversion {
 public:
  /// \param atlas  sets of variables and the maps between them.
  /// \throws ModelError  for an unknown set, or one that no maps lead to.
  Conversion(const Model& model, Atlas atlas, const std::string& set);

  Conversion(const Conversion&) = delete;
  Conversion& operator=(const Conversion&) = delete;

  /// Names of the new variables.
  const std::vector<std::string>& names() const { return names_; }

  /// \param state  one number for each variable of the case
  /// \throws SingularPoint  where the variables are singular, or the state has no image: a state
  ///                        that does not come back when it is mapped back is refused
  std::vector<double> operator()(std::vector<double> state) const;
  /// The same with what is to be said of it, by the derivatives of the maps there.
  ConvertedState assessed(std::vector<double> state) const;

  /// The initial state of a scene, exactly.
  /// \throws SingularPoint
  std::vector<GiNaC::ex> exact(const Scene& scene) const;

 private:
  struct Branch {
    Program values, conditions;
    std::vector<Assumption> domain;
  };
  struct Step {
    const CoordinateChange* change;
    std::vector<Branch> branches;
    Program there;  ///< the differences of the domain of the new variables
    std::vector<Assumption> there_domain;
    std::optional<Program> back;  ///< of an inverse: the map
  };
  /// \param used  the branch that was taken
  std::vector<double> apply(const Step& step, const std::vector<double>& state,
                            const Branch** used = nullptr) const;

  Limits limits_;
  Atlas atlas_;
  std::vector<Step> steps_;
  std::vector<std::string> names_;
};

}  // namespace casimir

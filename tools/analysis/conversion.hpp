#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/coordinates.hpp"

namespace casimir {

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
  std::vector<double> apply(const Step& step, const std::vector<double>& state) const;

  Limits limits_;
  Atlas atlas_;
  std::vector<Step> steps_;
  std::vector<std::string> names_;
};

}  // namespace casimir

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/validated/flow_map.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"

namespace casimir {

/// Why a cycle is not proved: a sentence.
struct NotProved {
  std::string reason;
};

/// Parameters with the interval of each.
using Intervals = std::vector<std::pair<GiNaC::symbol, RationalInterval>>;

/// Where a box of starts and times is after its time, with the derivatives of that.
struct BoxImage {
  BallMatrix state;        ///< phi_T(x)
  BallMatrix derivatives;  ///< by x (where they are wanted) and T
};

/// The flow of a scene to a time, with its derivatives.
class FlowToTime {
 public:
  /// \param scene   with the symbols of the parameters that have ranges: further states, at rest.
  /// \param levels  functions that are proved to be constant, by their names.
  FlowToTime(const Model& model, const Scene& scene, const std::vector<NamedExpression>& levels,
             const Intervals& ranges);

  /// \param box  a column: x, and then T.
  /// \param with_derivatives  whether these are wanted.
  /// \throws NotProved  also where a function of the level may jump on the way
  BoxImage operator()(const BallMatrix& box, bool with_derivatives, double seconds) const;

 private:
  std::size_t n_;
  Intervals ranges_;
  validated::FlowProgram flow_;
  std::vector<validated::Integral> integrals_;
};

}  // namespace casimir

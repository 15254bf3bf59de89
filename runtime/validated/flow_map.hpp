#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/validated/lohner.hpp"

namespace casimir::validated {

/// Where the solutions from a box are at times of an interval.
struct FlowImage {
  std::vector<MidRad> states;  ///< contain those of every solution at every of the times
  Matrix<MidRad> derivatives;  ///< of the states by the start, the same; where it is wanted
  std::vector<MidRad> rates;   ///< the rates over `states`: the derivatives by the time
  /// An integral of which it is not certain that the states have the value that they began with.
  std::optional<std::string> not_kept;
};

/// What an image is made with.
struct FlowMapSettings {
  int order = 22;
  int log2_error = -56;  ///< of a step, in units of the state
  int max_steps = 100000;
  std::function<bool()> give_up = {};  ///< asked before each step; true ends it
};

/// The flow of an autonomous system to a time, with its derivatives, as a theorem: for every start
/// in a box the solution exists up to the last of the times, and its state and its derivatives are
/// within what is said. The states are those of the system itself, each step carrying their
/// derivatives (see FlowPiece::enclose_derivatives): no variational equations are joined to them.
class FlowMap {
 public:
  /// The flow and the integrals must outlive this; the flow must not depend on the time.
  /// \param integrals  constant along solutions, which makes states and derivatives narrower.
  FlowMap(const FlowProgram& flow, const std::vector<Integral>& integrals,
          const FlowMapSettings& settings)
      : flow_(flow), integrals_(integrals), settings_(settings), rates_(flow.rates) {}

  /// \param start  the middle of the box of starts, to more digits than balls have.
  /// \param wide   by how much each state may be off that.
  /// \param time   all of it above zero.
  /// \param derivatives  whether these are wanted.
  /// \return  whether it is proved; else `reason` says why not.
  bool find(const std::vector<ArbBall>& start, const std::vector<MidRad>& wide, const MidRad& time,
            bool derivatives);

  const FlowImage& result() const { return result_; }
  const std::string& reason() const { return reason_; }

 private:
  bool go(Lohner<MidRad>& lohner, const MidRad& time);
  double enclosed_step(Lohner<MidRad>& lohner, double proposed, double last) const;
  bool fail(std::string reason);

  const FlowProgram& flow_;
  const std::vector<Integral>& integrals_;
  FlowMapSettings settings_;
  BallFunction<MidRad> rates_;
  FlowImage result_;
  std::string reason_;
  double grid_ = 1;  ///< steps are multiples of it, so that times are sums without rounding
};

}  // namespace casimir::validated

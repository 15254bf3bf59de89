#include "tools/analysis/section/flow_to_time.hpp"

#include <fmt/format.h>

#include "codegen/optimise/differentiate.hpp"
#include "codegen/optimise/lower.hpp"
#include "codegen/specialise.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {
namespace {

void split_ball(arb_srcptr ball, std::vector<validated::ArbBall>& start,
                std::vector<validated::MidRad>& wide) {
  validated::ArbBall middle, off;
  arb_get_mid_arb(middle.raw(), ball);
  arb_get_rad_arb(off.raw(), ball);
  start.push_back(middle);
  const bool is_point = arb_is_zero(off.raw()) != 0;
  wide.push_back(is_point ? validated::MidRad() : validated::symmetric(validated::outwards(off)));
}
void set_ball(arb_ptr ball, const validated::MidRad& value) {
  const validated::ArbBall exact(value);
  arb_set(ball, exact.raw());
}

}  // namespace

FlowToTime::FlowToTime(const Model& model, const Scene& scene,
                       const std::vector<NamedExpression>& levels, const Intervals& ranges)
    : n_(model.variables.size()), ranges_(ranges) {
  Model extended;
  extended.limits = model.limits;
  extended.name = model.name;
  extended.phase_space = "equations";
  extended.variables = model.variables;
  for (const GiNaC::ex& rate : model.field)
    extended.field.push_back(model.at_parameters(rate, scene));
  for (const auto& [symbol, interval] : ranges_) {
    extended.variables.push_back(symbol);
    extended.field.emplace_back(0);
  }
  extended.integrals = levels;
  Scene scene_of_zeros;
  scene_of_zeros.name = "cycle";
  scene_of_zeros.initial.assign(extended.variables.size(), 0);
  scene_of_zeros.duration = 1;
  SpecialiseOptions what;
  what.observe = std::vector<std::string>{};
  what.jacobian = false;
  const Specialisation s = specialise(extended, scene_of_zeros, what);
  const std::size_t states = extended.variables.size();
  const SparseProgram jacobian = codegen::jacobian(s.rhs, states);
  flow_ = validated::joined(s.rhs, jacobian.program, jacobian.entries);
  for (std::size_t k = 0; k < s.invariant_names.size(); ++k) {
    const Program value = codegen::single_output(s.invariants, k);
    const SparseProgram gradient = codegen::gradients(value, states);
    validated::Integral integral{s.invariant_names[k], value, gradient.program, {}};
    for (const auto& [state, output] : gradient.entries) integral.states.push_back(state);
    integrals_.push_back(std::move(integral));
  }
}

BoxImage FlowToTime::operator()(const BallMatrix& box, bool with_derivatives,
                                double seconds) const {
  std::vector<validated::ArbBall> start;
  std::vector<validated::MidRad> wide;
  for (std::size_t i = 0; i < n_; ++i) split_ball(box.at(i), start, wide);
  BallMatrix range(1, 1);
  for (const auto& [symbol, interval] : ranges_) {
    set_interval(range.at(0), interval);
    split_ball(range.at(0), start, wide);
  }
  validated::ArbBall time;
  arb_set(time.raw(), box.at(n_));
  validated::FlowMapSettings settings;
  settings.give_up = time_limit(seconds);
  validated::FlowMap map(flow_, integrals_, settings);
  if (!map.find(start, wide, validated::outwards(time), with_derivatives))
    throw NotProved{fmt::format("its orbit is not enclosed to the end: {}", map.reason())};
  // Else that start and end are on one level would be nothing to conclude from.
  if (map.result().not_kept)
    throw NotProved{
        "a function of the level is not certain to be smooth along its orbit: its value may "
        "jump"};
  BoxImage image{BallMatrix(n_, 1), BallMatrix(n_, n_ + 1)};
  for (std::size_t i = 0; i < n_; ++i) {
    set_ball(image.state.at(i), map.result().states[i]);
    for (std::size_t j = 0; j < n_ && with_derivatives; ++j)
      set_ball(image.derivatives.at(i, j), map.result().derivatives(i, j));
    set_ball(image.derivatives.at(i, n_), map.result().rates[i]);
  }
  return image;
}

}  // namespace casimir

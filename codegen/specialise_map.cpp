#include "codegen/specialise_map.hpp"

#include "symbolic/error.hpp"

namespace casimir {

Program without_signs_of_zero(const Program& step) {
  Program result = step;
  result.code.clear();
  std::vector<int> places;
  const auto moved = [&](int operand) {
    return operand < 0 ? operand : places[static_cast<std::size_t>(operand)];
  };
  for (Instruction c : step.code) {
    if (c.op != Op::input && c.op != Op::constant) {
      c.a = moved(c.a);
      c.b = moved(c.b);
    }
    if (c.op == Op::sign) {
      result.code.push_back({Op::abs, c.a});
      c = {Op::div, c.a, static_cast<int>(result.code.size()) - 1};
    }
    places.push_back(static_cast<int>(result.code.size()));
    result.code.push_back(c);
  }
  for (int& output : result.outputs) output = moved(output);
  return result;
}

Specialisation specialise_map(const MapModel& map, const Scene& scene,
                              const SpecialiseOptions& options,
                              const std::optional<std::vector<GiNaC::ex>>& inverse) {
  if (options.taylor)
    throw ModelError("a map has no Taylor coefficients: its time is whole numbers");
  Specialisation result = specialise(map.as_field(), scene, options);
  result.of_map = true;
  result.rhs = without_signs_of_zero(result.rhs);
  result.variational = without_signs_of_zero(result.variational);
  for (std::size_t i = 0; i < result.states.size(); ++i)
    result.rhs.output_names[i] = result.states[i] + "'";
  if (!inverse) return result;
  Model back = map.as_field();
  if (result.states.size() < back.variables.size())
    throw ModelError(
        "the inverse of a map needs all variables, and what is observed does not: leave one of "
        "them out");
  back.field = *inverse;
  SpecialiseOptions alone = options;
  alone.observe = std::vector<std::string>{};
  alone.invariants = alone.gradients = alone.jacobian = alone.variational = false;
  result.inverse = without_signs_of_zero(specialise(back, scene, alone).rhs);
  result.inverse.output_names = result.states;
  result.has_inverse = true;
  return result;
}

}  // namespace casimir

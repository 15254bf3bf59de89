#include "codegen/specialise_map.hpp"

#include "symbolic/error.hpp"

namespace casimir {

Specialisation specialise_map(const MapModel& map, const Scene& scene,
                              const SpecialiseOptions& options,
                              const std::optional<std::vector<GiNaC::ex>>& inverse) {
  if (options.taylor)
    throw ModelError("a map has no Taylor coefficients: its time is whole numbers");
  Specialisation result = specialise(map.as_field(), scene, options);
  result.of_map = true;
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
  result.inverse = specialise(back, scene, alone).rhs;
  result.inverse.output_names = result.states;
  result.has_inverse = true;
  return result;
}

}  // namespace casimir

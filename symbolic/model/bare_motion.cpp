#include "symbolic/model/bare_motion.hpp"

namespace casimir {

Model bare_motion(const Model& model) {
  Model result;
  result.limits = model.limits;
  result.name = model.name;
  result.file = model.file;
  result.phase_space = "equations";
  result.complex_numbers = model.complex_numbers;
  result.variables = model.variables;
  result.parameters = model.parameters;
  result.assumptions = model.assumptions;
  result.field = model.field;
  result.domain = model.domain;
  return result;
}

}  // namespace casimir

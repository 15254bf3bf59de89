#include "codegen/program_of.hpp"

#include <fmt/format.h>

#include <string>

#include "codegen/optimise/lower.hpp"
#include "codegen/optimise/terms.hpp"

namespace casimir {

Program program_of(const std::vector<GiNaC::ex>& functions,
                   const std::vector<GiNaC::symbol>& inputs) {
  codegen::Dag dag(inputs, inputs.size());
  std::vector<codegen::Scaled> outputs;
  std::vector<std::string> names, labels;
  for (const GiNaC::symbol& input : inputs) names.push_back(input.get_name());
  for (const GiNaC::ex& f : functions) {
    outputs.push_back(dag.convert(f));
    labels.push_back(fmt::format("f{}", labels.size()));
  }
  return codegen::lowered(codegen::system_of(dag, inputs.size(), outputs), names, labels);
}

}  // namespace casimir

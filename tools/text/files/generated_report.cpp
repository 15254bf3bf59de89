#include "tools/text/files/generated_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "codegen/emit_cpp.hpp"

namespace casimir::tools {

nlohmann::ordered_json to_json(const OperationCount& count) {
  return {{"mul", count.mul}, {"add", count.add}, {"div", count.div}, {"calls", count.calls}};
}

namespace {

/// A generated function, and the matrix that it writes if it does.
struct Generated {
  std::string name;
  OperationCount operations;
  const SparseProgram* matrix = nullptr;
  std::size_t size = 0;  ///< entries of the matrix, with the zeros
};

std::vector<Generated> functions_of(const Specialisation& s) {
  std::vector<Generated> result{{s.of_map ? "step" : "rhs", s.specialised}};
  const std::size_t n = s.states.size();
  if (s.has_inverse) result.push_back({"inverse", count_operations(s.inverse)});
  if (!s.invariant_names.empty()) result.push_back({"invariants", count_operations(s.invariants)});
  if (s.has_gradients && !s.invariant_names.empty())
    result.push_back({"gradients", count_operations(s.gradients.program), &s.gradients,
                      n * s.invariant_names.size()});
  if (s.has_jacobian)
    result.push_back({"jacobian", count_operations(s.jacobian.program), &s.jacobian, n * n});
  if (s.has_variational)
    result.push_back({s.of_map ? "tangent" : "variational", count_operations(s.variational)});
  return result;
}

}  // namespace

nlohmann::ordered_json functions_json(const Specialisation& specialisation) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Generated& function : functions_of(specialisation)) {
    json[function.name] = to_json(function.operations);
    if (function.matrix) json[function.name]["entries"] = function.matrix->entries.size();
  }
  return json;
}

nlohmann::ordered_json left_out_json(const Specialisation& specialisation) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const LeftOut& item : specialisation.left_out) {
    list.push_back({{"kind", item.kind}, {"name", item.name}, {"reason", item.reason}});
  }
  return list;
}

std::string generated_text(const Specialisation& specialisation) {
  std::string text = fmt::format("  scene      {}\n  states     {}\n", specialisation.scene,
                                 fmt::join(specialisation.states, " "));
  if (!specialisation.parameters.empty())
    text +=
        fmt::format("  parameters {}, at run time\n", fmt::join(specialisation.parameters, " "));
  const char* const one = specialisation.of_map ? "one step" : "one right-hand side";
  text += fmt::format("  {:<33} {}\n", fmt::format("{}, general", one),
                      cost_text(specialisation.general));
  text += fmt::format("  {:<33} {}\n", fmt::format("{}, specialised", one),
                      cost_text(specialisation.specialised));
  for (const Generated& function : functions_of(specialisation)) {
    if (function.name == "rhs" || function.name == "step") continue;
    text += fmt::format("  {:<33} {}", function.name, cost_text(function.operations));
    if (function.matrix)
      text += fmt::format("; {} of {} entries", function.matrix->entries.size(), function.size);
    text += '\n';
  }
  text += specialisation.left_out.empty() ? "  nothing was left out\n" : "  left out\n";
  for (const LeftOut& item : specialisation.left_out) {
    text += fmt::format("    {:<10} {:<16} {}\n", item.kind, item.name, item.reason);
  }
  return text;
}

}  // namespace casimir::tools

// Compiled code for what steps are watched for.
#include "codegen/emit_watched.hpp"

#include <vector>

#include "codegen/emit/identifiers.hpp"
#include "codegen/emit/statements.hpp"

namespace casimir {

std::string emit_watched(const Specialisation& spec, const Program& watched) {
  if (watched.outputs.empty()) return {};
  codegen::StatementStyle style;
  style.limits = spec.limits;
  style.call_prefix = "__builtin_";
  codegen::Names unique;
  std::vector<std::string> sources, names, targets;
  const std::size_t states = spec.states.size();
  for (std::size_t i = 0; i + 1 < watched.inputs.size(); ++i) {
    sources.push_back(i < states ? "x[" + std::to_string(i) + "]"
                                 : "p[" + std::to_string(i - states) + "]");
    names.push_back(unique.unique(watched.inputs[i]));
  }
  sources.emplace_back("t");
  names.emplace_back("t");
  for (std::size_t k = 0; k < watched.outputs.size(); ++k)
    targets.push_back("values[" + std::to_string(k) + "]");
  return "\nextern \"C\" {\n\nint casimir_watched_count(void) { return " +
         std::to_string(targets.size()) +
         "; }\n"
         "void casimir_watched([[maybe_unused]] double t, [[maybe_unused]] const double* x,\n"
         "                     [[maybe_unused]] const double* p, double* values) {\n" +
         codegen::statements(watched, sources, names, targets, style) + "}\n\n}  // extern \"C\"\n";
}

}  // namespace casimir

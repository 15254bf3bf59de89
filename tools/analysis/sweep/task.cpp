#include "tools/analysis/sweep/task.hpp"

#include <fmt/format.h>

#include "codegen/emit_cpp.hpp"
#include "tools/analysis/proof/exact_text.hpp"

namespace casimir {

std::string run_fingerprint(const PreparedScene& run, const Method& method,
                            const Settings& settings) {
  std::string text = fmt::format("{} {} rtol {} atol {} step {} duration {} max {}\n", method.name,
                                 CASIMIR_VERSION, exact_text(settings.rtol),
                                 exact_text(settings.atol), exact_text(settings.fixed_step),
                                 exact_text(settings.duration), settings.max_steps);
  text += emit_module(run.specialisation);
  for (const double x : run.initial) text += exact_text(x) + " ";
  for (const double p : run.parameters) text += exact_text(p) + " ";
  return text;
}

}  // namespace casimir

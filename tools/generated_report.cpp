#include "tools/generated_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "codegen/emit_cpp.hpp"

namespace casimir::tools {

nlohmann::ordered_json to_json(const OperationCount& count) {
  return {{"mul", count.mul}, {"add", count.add}, {"div", count.div}, {"calls", count.calls}};
}

nlohmann::ordered_json left_out_json(const Specialisation& specialisation) {
  nlohmann::ordered_json list = nlohmann::json::array();
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
  text +=
      fmt::format("  one right-hand side, general      {}\n", cost_text(specialisation.general));
  text += fmt::format("  one right-hand side, specialised  {}\n",
                      cost_text(specialisation.specialised));
  text += specialisation.left_out.empty() ? "  nothing was left out\n" : "  left out\n";
  for (const LeftOut& item : specialisation.left_out) {
    text += fmt::format("    {:<10} {:<16} {}\n", item.kind, item.name, item.reason);
  }
  return text;
}

}  // namespace casimir::tools

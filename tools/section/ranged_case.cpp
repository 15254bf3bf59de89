#include "tools/section/ranged_case.hpp"

#include <fmt/format.h>

#include "tools/cli/errors.hpp"
#include "tools/runs/enclosed_run.hpp"

namespace casimir::tools {

RangedCase::RangedCase(CaseFile given, const Common& common, bool may_be_ranges)
    : file(std::move(given)) {
  for (const std::string& word : common.params)
    if (is_range(word) && !may_be_ranges)
      throw UsageError("--param with a range of values needs --validated --cycles N");
  values = without_ranges(common.parameter_values(), file, ranges);
}

SectionRequest RangedCase::request(const Model& model, const SectionOptions& options) const {
  SectionRequest request = section_request(file, model, options);
  for (const GiNaC::symbol& parameter : model.parameters)
    for (const auto& [name, radius] : ranges)
      if (parameter.get_name() == name && request.plane && request.plane->function.has(parameter))
        throw UsageError(fmt::format(
            "the plane depends on {}: with a range of it, it has to be fixed by --plane",
            printable(name)));
  return request;
}

}  // namespace casimir::tools

// The kernels for ensembles: those of this program, by instruction set, and those of shared
// objects.
#include <dlfcn.h>

#include <algorithm>
#include <stdexcept>

#include "runtime/ensemble/lane_kernel.hpp"
#include "runtime/step/step_watch.hpp"
#include "runtime/taylor/quadratic_targets.hpp"

using Kernel = void(const casimir_lane_tables*, const casimir_ensemble*);
using Width = int(void);
extern "C" {
#ifdef CASIMIR_X86_KERNELS
Kernel casimir_ensemble_avx512, casimir_ensemble_avx2;
Width casimir_lanes_avx512, casimir_lanes_avx2;
#endif
Kernel casimir_ensemble_baseline;
Width casimir_lanes_baseline;
}

namespace casimir {
namespace {

struct Target {
  const char* name;
  Kernel* kernel;
  Width* lanes;
};

constexpr Target kTargets[] = {
#ifdef CASIMIR_X86_KERNELS
    {"avx512", casimir_ensemble_avx512, casimir_lanes_avx512},
    {"avx2", casimir_ensemble_avx2, casimir_lanes_avx2},
#endif
    {"baseline", casimir_ensemble_baseline, casimir_lanes_baseline},
};

}  // namespace

// Built for the same instruction sets as the kernels for one trajectory.
std::vector<std::string> lane_targets() { return quadratic_targets(); }

LaneKernel table_driven_lanes(LaneForm form, const std::string& target) {
  const std::vector<std::string> here = lane_targets();
  const std::string name = target.empty() ? here.front() : target;
  if (std::find(here.begin(), here.end(), name) == here.end())
    throw std::invalid_argument("this processor does not run kernels for " + name);
  const Target& found = *std::find_if(std::begin(kTargets), std::end(kTargets),
                                      [&](const Target& t) { return name == t.name; });
  LaneKernel result;
  result.instruction_set = name;
  result.lanes = found.lanes();
  result.numbers = form.numbers;
  result.run = [kernel = found.kernel, form = std::move(form)](const casimir_ensemble* run) {
    const casimir_lane_tables tables = form.tables();
    kernel(&tables, run);
  };
  return result;
}

void LaneKernel::watch_steps_of(const Program& rhs) {
  auto made = std::make_shared<const StepWatch>(rhs);
  watch = made->empty() ? nullptr : std::move(made);
}

LaneKernel loaded_lanes(const std::string& path) {
  const std::shared_ptr<void> handle(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL), [](void* open) {
    if (open) dlclose(open);
  });
  const auto entry = [&](const char* name) {
    void* const found = handle ? dlsym(handle.get(), name) : nullptr;
    if (!found) throw std::runtime_error(path + ": the module cannot be loaded or lacks " + name);
    return found;
  };
  const auto number = [&](const char* name) { return reinterpret_cast<Width*>(entry(name))(); };
  if (number("casimir_abi_version") != CASIMIR_ABI_VERSION)
    throw std::runtime_error(path + ": the module has another version of the interface");
  LaneKernel result;
  result.lanes = number("casimir_lanes");
  result.instruction_set = result.lanes == 8 ? "avx512" : result.lanes == 4 ? "avx2" : "baseline";
  using Run = void(const casimir_ensemble*);
  auto* const run = reinterpret_cast<Run*>(entry("casimir_integrate_lanes"));
  result.run = [handle, run](const casimir_ensemble* request) { run(request); };
  return result;
}

}  // namespace casimir

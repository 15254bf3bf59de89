// Which table-driven kernel this processor can run.
#include <algorithm>
#include <stdexcept>

#include "runtime/uncompiled.hpp"

using Kernel = void(const casimir_quadratic*, const casimir_run*, double*, casimir_outcome*);
extern "C" {
#ifdef CASIMIR_X86_KERNELS
Kernel casimir_quadratic_avx512, casimir_quadratic_avx2;
#endif
Kernel casimir_quadratic_baseline;
}

namespace casimir {
namespace {

struct Target {
  const char* name;
  Kernel* kernel;
};

/// Those that this processor runs, best first.
const std::vector<Target>& targets() {
  static const std::vector<Target> known = [] {
    std::vector<Target> result;
#ifdef CASIMIR_X86_KERNELS
    __builtin_cpu_init();
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
      result.push_back({"avx512", casimir_quadratic_avx512});
    }
    if (avx2) result.push_back({"avx2", casimir_quadratic_avx2});
#endif
    result.push_back({"baseline", casimir_quadratic_baseline});
    return result;
  }();
  return known;
}

}  // namespace

std::vector<std::string> quadratic_targets() {
  std::vector<std::string> names;
  for (const Target& target : targets()) names.emplace_back(target.name);
  return names;
}

void integrate_quadratic(const std::string& target, const casimir_quadratic& tables,
                         const casimir_run* run, double* x, casimir_outcome* out) {
  for (const Target& known : targets()) {
    if (known.name == target) return known.kernel(&tables, run, x, out);
  }
  throw std::invalid_argument("this processor does not run kernels for " + target);
}

}  // namespace casimir

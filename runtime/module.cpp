#include "runtime/module.hpp"

#include <dlfcn.h>

#include <new>
#include <stdexcept>
#include <utility>

#include "runtime/step/step_watch.hpp"
#include "runtime/taylor/program_leading.hpp"
#include "runtime/taylor/quadratic_targets.hpp"

namespace casimir {
namespace {

/// The function of that name, or null.
template <class Function>
Function* find(void* handle, const char* name) {
  return reinterpret_cast<Function*>(dlsym(handle, name));
}

int number(void* handle, const std::string& path, const char* name) {
  auto* const function = find<int(void)>(handle, name);
  if (!function) throw std::runtime_error(path + ": the module lacks " + name);
  return function();
}

/// The integration along series whose recurrences the shared object has.
std::function<ModuleFunctions::Integration> along_series(void* handle, const std::string& path,
                                                         int states) {
  casimir_series series = {};
  series.states = states;
  series.start = find<void(void*, int, const double*)>(handle, "casimir_series_start");
  series.begin = find<void(void*, double, const double*)>(handle, "casimir_series_begin");
  series.expand = find<void(void*, double)>(handle, "casimir_series_expand");
  auto* const size = find<unsigned long(void)>(handle, "casimir_series_size");
  if (!size) return {};
  if (!series.start || !series.begin || !series.expand)
    throw std::runtime_error(path + ": the module lacks a function of its series");
  series.smooth = number(handle, path, "casimir_series_smooth");
  const int width = number(handle, path, "casimir_series_width");
  return [series, width, bytes = size()](const casimir_run* run, double* x, casimir_outcome* out) {
    constexpr std::align_val_t kAligned{64};
    const auto release = [](void* memory) { operator delete(memory, kAligned); };
    const std::unique_ptr<void, decltype(release)> memory(operator new(bytes, kAligned), release);
    casimir_series mine = series;
    mine.object = memory.get();
    mine.rows = static_cast<double*>(memory.get());
    integrate_series(mine, width, run, x, out);
  };
}

}  // namespace

void Module::Close::operator()(void* handle) const { dlclose(handle); }

Module Module::from_functions(const ModuleFunctions& functions) {
  if (functions.dimension <= 0 || functions.parameter_count < 0 || functions.invariant_count < 0)
    throw std::invalid_argument("module: dimension " + std::to_string(functions.dimension) + ", " +
                                std::to_string(functions.parameter_count) + " parameters, " +
                                std::to_string(functions.invariant_count) + " invariants");
  if (!functions.rhs) throw std::invalid_argument("module: no right-hand side");
  if (functions.invariant_count > 0 && !functions.invariants)
    throw std::invalid_argument("module: no function for its invariants");
  Module module;
  module.functions_ = functions;
  return module;
}

void Module::know_equations(const Program& rhs) {
  exact_rates_ = ProgramLeading::serves(rhs) ? std::make_shared<const Program>(rhs) : nullptr;
  auto watch = std::make_shared<StepWatch>(rhs);
  if (handle_) watch->take_compiled(handle_.get());
  watch_ = watch->empty() ? nullptr : std::move(watch);
}

Module Module::load(const std::string& path) {
  // A name without a slash would be searched for in the system's folders.
  const std::string name = path.find('/') == std::string::npos ? "./" + path : path;
  std::unique_ptr<void, Close> handle(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (!handle) {
    const char* reason = dlerror();
    throw std::runtime_error(
        path + ": the module cannot be loaded: " + (reason ? reason : "unknown reason"));
  }
  const int version = number(handle.get(), path, "casimir_abi_version");
  if (version != CASIMIR_ABI_VERSION)
    throw std::runtime_error(path + ": the module has interface version " +
                             std::to_string(version) + ", expected " +
                             std::to_string(CASIMIR_ABI_VERSION));
  ModuleFunctions functions;
  functions.dimension = number(handle.get(), path, "casimir_dimension");
  functions.parameter_count = number(handle.get(), path, "casimir_parameter_count");
  functions.invariant_count = number(handle.get(), path, "casimir_invariant_count");
  functions.rhs = find<ModuleFunctions::Evaluation>(handle.get(), "casimir_rhs");
  functions.jacobian = find<ModuleFunctions::Evaluation>(handle.get(), "casimir_jacobian");
  functions.invariants = find<ModuleFunctions::Evaluation>(handle.get(), "casimir_invariants");
  functions.integrate = find<ModuleFunctions::Integration>(handle.get(), "casimir_integrate");
  if (!functions.rhs) throw std::runtime_error(path + ": the module lacks casimir_rhs");
  if (!functions.integrate)
    functions.integrate = along_series(handle.get(), path, functions.dimension);
  Module module = from_functions(functions);
  module.handle_ = std::move(handle);
  return module;
}

}  // namespace casimir

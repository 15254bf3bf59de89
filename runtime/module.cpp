#include "runtime/module.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace casimir {
namespace {

template <class Function>
Function* entry(void* handle, const char* name, bool required = true) {
  void* address = dlsym(handle, name);
  if (address == nullptr && required) throw std::runtime_error(std::string("the module has no ") + name);
  return reinterpret_cast<Function*>(address);
}

}  // namespace

Module Module::load(const std::filesystem::path& shared_object) {
  Module module;
  module.handle_ = std::shared_ptr<void>(dlopen(shared_object.c_str(), RTLD_NOW | RTLD_LOCAL), [](void* handle) {
    if (handle != nullptr) dlclose(handle);
  });
  void* const handle = module.handle_.get();
  if (handle == nullptr) throw std::runtime_error(std::string("cannot load a compiled module: ") + dlerror());
  const int version = entry<int()>(handle, "casimir_abi_version")();
  if (version != CASIMIR_ABI_VERSION) {
    throw std::runtime_error("the module has interface " + std::to_string(version) + ", this program has " + std::to_string(CASIMIR_ABI_VERSION));
  }
  ModuleFunctions& f = module.functions_;
  f.dimension = entry<int()>(handle, "casimir_dimension")();
  f.parameter_count = entry<int()>(handle, "casimir_parameter_count")();
  f.invariant_count = entry<int()>(handle, "casimir_invariant_count")();
  f.rhs = entry<void(double, const double*, const double*, double*)>(handle, "casimir_rhs");
  f.invariants = entry<void(double, const double*, const double*, double*)>(handle, "casimir_invariants");
  f.jacobian = entry<void(double, const double*, const double*, double*)>(handle, "casimir_jacobian", false);
  f.integrate = entry<void(const casimir_run*, double*, casimir_outcome*)>(handle, "casimir_integrate", false);
  return module;
}

Module Module::from_functions(const ModuleFunctions& functions) {
  Module module;
  module.functions_ = functions;
  return module;
}

}  // namespace casimir

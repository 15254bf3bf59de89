#include "tools/analysis/run/taylor_path.hpp"

#include <utility>

#include "codegen/expansion_loss.hpp"
#include "codegen/quadratic.hpp"
#include "runtime/taylor/quadratic_targets.hpp"
#include "runtime/uncompiled.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {

TaylorChoice choose_taylor_path(const Program& rhs, const Limits& limits,
                                const std::vector<double>& parameters, bool may_compile) {
  if (auto form = quadratic_form(rhs, limits, parameters);
      form && has_quadratic_kernel(*form) && !expansion_loses_digits(rhs))
    return {TaylorPath::tables, std::move(form)};
  return {may_compile ? TaylorPath::compiled : TaylorPath::interpreted, std::nullopt};
}

Module taylor_module_without_compiler(const Program& rhs, const Limits& limits,
                                      const Program& invariants,
                                      const std::vector<double>& parameters) {
  return uncompiled_module(rhs, invariants, choose_taylor_path(rhs, limits, parameters, false).form,
                           parameters);
}

}  // namespace casimir

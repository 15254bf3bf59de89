// Which precompiled kernel this processor can run, and which one suits a system.
#include "runtime/taylor/quadratic_targets.hpp"

#include <optional>
#include <stdexcept>
#include <type_traits>

#include "runtime/instruction_set.hpp"
#include "runtime/taylor/leading_layout.hpp"
#include "runtime/taylor/program_leading.hpp"
#include "runtime/taylor/quadratic_layout.hpp"

using NarrowKernel = void(const casimir_quadratic*, const casimir_run*, double*, casimir_outcome*);
using WideKernel = void(const casimir_wide*, const casimir_run*, double*, casimir_outcome*);
using LeadingKernel = std::remove_pointer_t<decltype(casimir_leading::add)>;
using SeriesKernel = void(const casimir_series*, const casimir_run*, double*, casimir_outcome*);
extern "C" {
#ifdef CASIMIR_X86_KERNELS
NarrowKernel casimir_quadratic_avx512, casimir_quadratic_avx2;
WideKernel casimir_wide_avx512, casimir_wide_avx2;
SeriesKernel casimir_series_avx512, casimir_series_avx2;
LeadingKernel casimir_leading_avx512, casimir_leading_avx2;
#endif
WideKernel casimir_wide_baseline;
SeriesKernel casimir_series_baseline;
LeadingKernel casimir_leading_baseline;
}

namespace casimir {
namespace {

struct Target {
  const char* name;
  int width;             ///< numbers in a register
  NarrowKernel* narrow;  ///< for systems whose states fill one register, or null
  WideKernel* wide;
  SeriesKernel* series;
  LeadingKernel* leading;
};

Target target_of(InstructionSet set) {
#ifdef CASIMIR_X86_KERNELS
  if (set == InstructionSet::avx512)
    return {"avx512",
            8,
            casimir_quadratic_avx512,
            casimir_wide_avx512,
            casimir_series_avx512,
            casimir_leading_avx512};
  if (set == InstructionSet::avx2)
    return {"avx2",
            4,
            casimir_quadratic_avx2,
            casimir_wide_avx2,
            casimir_series_avx2,
            casimir_leading_avx2};
#endif
  return {"baseline",
          2,
          nullptr,
          casimir_wide_baseline,
          casimir_series_baseline,
          casimir_leading_baseline};
}

/// Those that this processor runs, best first, from the one that was asked for.
const std::vector<Target>& targets() {
  static const std::vector<Target> known = [] {
    const InstructionSet widest = chosen_instruction_set();
    std::vector<Target> result;
    for (const InstructionSet set : instruction_sets_here())
      if (set <= widest) result.push_back(target_of(set));
    return result;
  }();
  return known;
}

const Target& target_named(const std::string& name) {
  if (name.empty()) return targets().front();
  for (const Target& known : targets()) {
    if (known.name == name) return known;
  }
  throw std::invalid_argument("this processor does not run kernels for " + name);
}

}  // namespace

std::vector<std::string> quadratic_targets() {
  std::vector<std::string> names;
  for (const Target& target : targets()) names.emplace_back(target.name);
  return names;
}

bool has_quadratic_kernel(const QuadraticForm& form) {
  return form.states > 0 && form.states <= CASIMIR_WIDE_STATES &&
         form.products.size() <= CASIMIR_WIDE_PRODUCTS;
}

struct QuadraticKernel::Tables {
  Target target;
  std::optional<casimir_quadratic> narrow;
  std::optional<WideTables> wide;
  std::optional<LeadingTables> leading;
};

QuadraticKernel::QuadraticKernel(const QuadraticForm& form, const std::string& target) {
  Tables tables{target_named(target), std::nullopt, std::nullopt, std::nullopt};
  if (tables.target.narrow && form.states <= tables.target.width)
    tables.narrow = narrow_tables(form);
  if (!tables.narrow) tables.wide.emplace(form, tables.target.width);
  const bool half = tables.target.width == 8 && form.states <= 4;
  tables.leading.emplace(form, half ? 4 : tables.target.width);
  tables_ = std::make_shared<const Tables>(std::move(tables));
}

void QuadraticKernel::integrate(const casimir_run* asked, double* x, casimir_outcome* out) const {
  const casimir_leading_tables leading_tables = tables_->leading->view();
  const casimir_leading leading = {&leading_tables, 0, tables_->target.leading};
  casimir_run careful = *asked;
  careful.leading = &leading;
  const casimir_run* const run =
      asked->rtol > 0 && asked->rtol <= kRoundingShows ? &careful : asked;
  if (tables_->narrow) return tables_->target.narrow(&*tables_->narrow, run, x, out);
  const casimir_wide view = tables_->wide->view();
  tables_->target.wide(&view, run, x, out);
}

int series_width() { return targets().front().width; }

void integrate_series(const casimir_series& series, int width, const casimir_run* run, double* x,
                      casimir_outcome* out) {
  for (const Target& known : targets()) {
    if (known.width == width) return known.series(&series, run, x, out);
  }
  throw std::invalid_argument("this processor has no registers of " + std::to_string(width) +
                              " numbers");
}

}  // namespace casimir

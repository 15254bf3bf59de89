// The texts of modules for ensembles.
#include "codegen/emit/emit_series.hpp"
#include "codegen/emit/identifiers.hpp"
#include "codegen/emit/statements.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/lane_form.hpp"

namespace casimir {
namespace {

std::string array(const std::string& declaration, const std::vector<std::string>& entries) {
  std::string text = "  static constexpr " + declaration + "[] = {";
  for (std::size_t i = 0; i < entries.size(); ++i) text += (i == 0 ? "" : ", ") + entries[i];
  return codegen::wrapped(text + (entries.empty() ? "0};" : "};")) + "\n";
}

std::string array(const std::string& name, const std::vector<int>& entries) {
  std::vector<std::string> texts;
  for (const int entry : entries) texts.push_back(std::to_string(entry));
  return array("int " + name, texts);
}

std::string tables(const LaneForm& form) {
  std::vector<std::string> products;
  for (const casimir_lane_product& p : form.products)
    products.push_back("{" + std::to_string(p.left) + ", " + std::to_string(p.right) + "}");
  if (products.empty()) products.emplace_back("{0, 0}");
  return "// The system: see casimir_lane_tables.\nstruct Tables {\n"
         "  static constexpr bool known = true;\n  static constexpr int most_sums = " +
         std::to_string(form.sums()) + ", most_states = " + std::to_string(form.states) +
         ", states = most_states;\n" + array("copied", form.copied) + array("first", form.first) +
         array("negative", form.negative) + array("casimir_lane_product product", products) +
         array("shared", form.shared) + array("shared_sum", form.shared_sum) +
         array("linear", form.linear) + array("linear_state", form.linear_state) +
         codegen::wrapped("  static constexpr casimir_lane_tables tables = {" +
                          std::to_string(form.states) + ", " + std::to_string(form.copied.size()) +
                          ", " + std::to_string(form.sums()) +
                          ", copied, first, negative, product, shared, shared_sum, linear, "
                          "linear_state};") +
         "\n};\n";
}

}  // namespace

std::string emit_lane_module(const LaneForm& form, const std::string& kernel_source) {
  return kernel_source + "\nnamespace {\n\n" + tables(form) + R"(
constexpr int kLanes = casimir_kernel::kNativeWidth, kStride = 25;
using Series = casimir_kernel::lanes::Quadratic<Tables, kLanes>;

}  // namespace

extern "C" {

int casimir_abi_version(void) { return CASIMIR_ABI_VERSION; }
int casimir_dimension(void) { return Tables::tables.states; }
int casimir_lanes(void) { return kLanes; }
void casimir_integrate_lanes(const struct casimir_ensemble* run) {
  Series::V rows[Series::count_of_rows(Tables::tables) * kStride] = {};
  Series::V sums[4 * Tables::tables.sums], numbers[Series::count_of_numbers(Tables::tables)] = {};
  const int order = casimir_kernel::lanes::order_of(run);
  Series series({}, order, kStride, {rows, sums, numbers, nullptr});
  casimir_kernel::lanes::March<Series>(run, series).go();
}

}  // extern "C"
)";
}

std::string emit_series_lanes(const Specialisation& spec, const std::string& kernel_source) {
  codegen::Names unique;
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 1 < spec.rhs.inputs.size(); ++i)
    names.push_back(unique.unique(spec.rhs.inputs[i]));
  names.emplace_back("t");
  return codegen::head_comment(spec, false) + "\n" + kernel_source +
         "\nnamespace {\n\nstruct System {\n  " +
         codegen::lane_series_struct(spec.rhs, names, spec.limits) +
         R"(};

}  // namespace

extern "C" {

int casimir_abi_version(void) { return CASIMIR_ABI_VERSION; }
int casimir_dimension(void) { return System::Series::states; }
int casimir_lanes(void) { return casimir_kernel::kNativeWidth; }
void casimir_integrate_lanes(const struct casimir_ensemble* run) {
  System::Series series;
  series.order = casimir_kernel::lanes::order_of(run);
  casimir_kernel::lanes::March<System::Series>(run, series).go();
}

}  // extern "C"
)";
}

}  // namespace casimir

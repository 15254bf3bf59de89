#include "tools/report/live_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "codegen/optimise/lower.hpp"
#include "codegen/optimise/terms.hpp"
#include "symbolic/error.hpp"
#include "symbolic/model/given_functions.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir::tools {
namespace {

/// Collects the functions that a page evaluates, and makes programs of them.
class LiveFunctions {
 public:
  explicit LiveFunctions(const Model& model) : symbols_(model.symbols()) {
    states_ = model.variables.size();
    symbols_.push_back(model.time ? *model.time : GiNaC::symbol("t"));
    for (const GiNaC::symbol& symbol : symbols_) inputs_.push_back(symbol.get_name());
  }

  /// Its place among the functions.
  std::size_t add(const std::string& name, const GiNaC::ex& function) {
    names_.push_back(name);
    functions_.push_back(function);
    return names_.size() - 1;
  }

  const std::vector<std::string>& names() const { return names_; }
  Program all() const { return program(functions_, names_); }
  Program alone(std::size_t i) const { return program({functions_[i]}, {names_[i]}); }

 private:
  Program program(const std::vector<GiNaC::ex>& functions,
                  const std::vector<std::string>& names) const {
    codegen::Dag dag(symbols_, states_);
    std::vector<codegen::Scaled> outputs;
    for (std::size_t i = 0; i < functions.size(); ++i) {
      try {
        outputs.push_back(dag.convert(functions[i]));
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const std::exception& problem) {  // GiNaC's, of poles and of what it cannot write
        throw RequestError(
            fmt::format("{} cannot be computed: {}", printable(names[i], 200), problem.what()));
      }
    }
    return codegen::lowered(codegen::system_of(dag, symbols_.size(), outputs), inputs_, names);
  }

  std::vector<GiNaC::symbol> symbols_;
  std::size_t states_ = 0;
  std::vector<std::string> inputs_, names_;
  std::vector<GiNaC::ex> functions_;
};

void add_invariants(const Model& model, LiveFunctions& functions, LiveSystem& live) {
  std::vector<std::string> known;
  const auto add = [&](const std::string& name, const GiNaC::ex& value) {
    if (std::ranges::count(known, name) > 0) return;
    known.push_back(name);
    functions.add(name, value);
  };
  if (model.hamiltonian && !(model.time && model.hamiltonian->has(*model.time)))
    add("H", *model.hamiltonian);
  for (const NamedExpression& casimir : model.casimirs) add(casimir.name, casimir.value);
  live.levels = known.size();
  for (const NamedExpression& integral : model.integrals) add(integral.name, integral.value);
  live.invariants = known.size();
}

void add_conditions(const Model& model, LiveFunctions& functions, LiveSystem& live) {
  for (const Assumption& one : model.assumptions)
    live.conditions.push_back({one.text, functions.add(one.text, one.difference), one.comparison});
  for (const NamedExpression& one : model.constraints)
    live.constraints.push_back({one.name, functions.add(one.name, one.value), Comparison::equal});
}

/// The level that the page keeps to is that of all the functions that it shows as level functions.
bool can_be_cut(const Model& model, const LiveFunctions& functions, const LiveSystem& live,
                const DrawnSection& drawn) {
  const std::vector<std::string> names(
      functions.names().begin(),
      functions.names().begin() + static_cast<std::ptrdiff_t>(live.levels));
  return model.section && model.section->plot.size() == 2 && !model.time && !drawn.of_angle &&
         !drawn.seeds.empty() && names == drawn.level_names;
}

void take_start(const Specialisation& code, LiveSystem& live) {
  const std::vector<cln::cl_F> start = start_values(code, kConstantDigits);
  const std::size_t n = code.states.size(), m = code.parameters.size();
  for (std::size_t i = 0; i < n; ++i) live.initial.push_back(rounded(start[i]));
  for (std::size_t i = 0; i < m; ++i) live.values.push_back(rounded(start[n + i]));
  live.duration = rounded(start[n + m]);
  live.states = code.states;
  live.parameters = code.parameters;
}

}  // namespace

LiveSystem live_system(const Model& any, const Scene& any_scene,
                       const std::optional<DrawnSection>& drawn) {
  constexpr std::size_t kMostStates = 60;
  constexpr int kOrder = 24;
  if (!any_scene.duration) throw RequestError("the scene has no duration");
  // With the functions that the scene gives in place of arbitrary ones.
  const auto [model, scene] =
      has_arbitrary_functions(any) ? in_scene(any, any_scene) : std::pair{any, any_scene};
  if (model.variables.size() > kMostStates)
    throw RequestError(fmt::format("{} states are too many for a page", model.variables.size()));
  SpecialiseOptions open;
  open.fold_parameters = false;
  open.observe = std::vector<std::string>{};
  open.invariants = open.jacobian = false;
  const Specialisation code = specialise(model, scene, open);
  LiveSystem live;
  take_start(code, live);
  LiveFunctions functions(model);
  add_invariants(model, functions, live);
  add_conditions(model, functions, live);
  Program flow = code.rhs;
  if (drawn && can_be_cut(model, functions, live, *drawn)) {
    const std::size_t plane = functions.add("plane", model.section->function);
    const std::size_t u = functions.add("u", model.section->plot[0]);
    live.section = {plane, {u, functions.add("v", model.section->plot[1])}, *drawn};
    flow = side_by_side(flow, functions.alone(plane));
  }
  live.functions = functions.names();
  live.series = emit_wasm(flow, code.states.size(), functions.all(), kOrder, code.limits);
  return live;
}

}  // namespace casimir::tools

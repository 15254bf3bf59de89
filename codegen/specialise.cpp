#include "codegen/specialise.hpp"

#include "codegen/add_jacobian.hpp"

#include <cln/exception.h>

#include <algorithm>
#include <exception>
#include <set>
#include <utility>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/dag/vanishing.hpp"
#include "codegen/optimise/optimise.hpp"
#include "codegen/optimise/terms.hpp"
#include "codegen/real_constants.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/model/given_functions.hpp"

namespace casimir {

namespace {

using codegen::Dag;
using codegen::Scaled;

/// An equation of more terms is taken to depend on all that is in it.
constexpr double kMostTermsOfEquation = 1e5;

std::string joined(const std::vector<std::string>& names) {
  std::string result;
  for (const std::string& name : names) result += (result.empty() ? "" : ", ") + name;
  return result;
}

bool depends(const GiNaC::ex& expression, const GiNaC::symbol& symbol) {
  return expression.has(symbol);
}

class Specialiser {
 public:
  Specialiser(const Model& model, const Scene& scene, const SpecialiseOptions& options)
      : model_(model),
        scene_(scene),
        options_(options),
        binding_(scene),
        general_dag_(general_symbols(), n()) {}

  Specialisation run() {
    select_parameters();
    describe();
    bind();
    select_states();
    select_invariants();
    write_programs();
    note_vanishing_terms();
    return std::move(result_);
  }

 private:
  std::size_t n() const { return model_.variables.size(); }

  std::vector<GiNaC::symbol> general_symbols() const {
    std::vector<GiNaC::symbol> symbols = model_.symbols();
    if (model_.time) symbols.push_back(*model_.time);
    return symbols;
  }

  void select_parameters() {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < model_.parameters.size(); ++i) {
      known.push_back(model_.parameters[i].get_name());
      if (options_.fold_parameters && !std::ranges::count(options_.keep_parameters, known.back()))
        continue;
      parameter_indices_.push_back(i);
      result_.parameters.push_back(known.back());
      binding_.parameters.at(i) = model_.parameters[i];
    }
    for (const std::string& name : options_.keep_parameters) {
      if (!std::ranges::count(known, name)) throw unknown("keep", name, "parameter", known);
    }
  }

  static ModelError unknown(const std::string& verb, const std::string& name,
                            const std::string& kind, const std::vector<std::string>& known) {
    const std::string hint = suggest_or_list(name, known);
    return ModelError("cannot " + verb + " '" + printable(name) + "': no " + kind +
                      " has that name" + (hint.empty() ? "" : "; " + hint));
  }

  bool folds_some() const { return parameter_indices_.size() < model_.parameters.size(); }

  void describe() {
    result_.case_name = model_.name;
    result_.file = model_.file;
    result_.scene = scene_.name;
    result_.limits = model_.limits;
    result_.title = model_.title;
    result_.taylor = options_.taylor;
    result_.source = model_.source;
    if (model_.time) result_.time = model_.time->get_name();
    if (model_.hamiltonian) {
      result_.hamiltonian =
          within("H", [&] { return general_dag_.text(general_dag_.convert(*model_.hamiltonian)); });
    }
    for (std::size_t i = 0; i < model_.parameters.size(); ++i) {
      const std::string name = model_.parameters[i].get_name();
      const std::string value = within(
          name, [&] { return general_dag_.text(general_dag_.convert(scene_.parameters.at(i))); });
      result_.values.emplace_back(name, value);
      if (!std::ranges::count(result_.parameters, name))
        leave_out("parameter", name, "folded to " + value);
    }
  }

  void leave_out(std::string kind, std::string name, std::string reason) {
    result_.left_out.push_back({std::move(kind), std::move(name), std::move(reason)});
  }

  /// Runs an algebraic step and says where it failed.
  template <class Step>
  auto within(const std::string& what, const Step& step) -> decltype(step()) {
    try {
      return step();
    } catch (const NoAngle& problem) {
      throw failed(what, problem.what());
    } catch (const GiNaC::pole_error&) {
      throw failed(what, "division by zero");
    } catch (const std::overflow_error&) {  // GiNaC's, of numbers
      throw failed(what, "division by zero");
    } catch (const cln::division_by_0_exception&) {
      throw failed(what, "division by zero");
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      throw failed(what, e.what());
    }
  }

  ModelError failed(const std::string& what, const std::string& reason) const {
    std::string values;
    for (const auto& [name, value] : result_.values) {
      values += (values.empty() ? "" : ", ") + name + " = " + value;
    }
    return ModelError("scene \"" + printable(scene_.name) + "\"" +
                      (values.empty() ? "" : " (" + values + ")") + ": " + what +
                      " cannot be computed: " + reason);
  }

  GiNaC::ex bound(const std::string& what, const GiNaC::ex& expression) {
    return within(what, [&] {
      codegen::require_real_constants(model_, expression, binding_);
      return model_.at_parameters(expression, binding_);
    });
  }

  /// Whether a run-time parameter occurs in it.
  bool stays_open(const GiNaC::ex& expression) const {
    return std::ranges::any_of(parameter_indices_, [&](std::size_t i) {
      return depends(expression, model_.parameters[i]);
    });
  }

  /// Whether it is positive wherever it has a value, by the assumptions of the case. False says
  /// nothing.
  bool is_positive(const GiNaC::ex& expression) const {
    try {
      FunctionRing ring(general_symbols(), model_.assumptions, {expression}, model_.limits);
      return ring.is_assumed_positive(ring.convert(expression));
    } catch (const ModelError&) {  // the ring has no such function
      return false;
    }
  }

  /// q^n is computed as exp(n*log(q)) where n stays open, which has a value for positive q only:
  /// the scene itself, with n = 4, may be about any q.
  void note_powers_left_out(const GiNaC::ex& expression) {
    for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part) {
      if (!GiNaC::is_a<GiNaC::power>(*part) || !stays_open(part->op(1)) || is_positive(part->op(0)))
        continue;
      const auto text = [&](const GiNaC::ex& e) {
        return general_dag_.text(general_dag_.convert(e));
      };
      const std::string base = text(part->op(0)) + " <= 0";
      const auto same = [&](const LeftOut& item) { return item.name == base; };
      if (std::ranges::none_of(result_.left_out, same))
        leave_out("values", base, "the code computes " + text(*part));
    }
  }

  /// What the code can compute for other values of its run-time parameters it must be able to
  /// compute for those of the scene too.
  void check_at_scene(const std::string& what, const GiNaC::ex& expression) {
    if (parameter_indices_.empty()) return;
    within(what, [&] { note_powers_left_out(expression); });
    within(what, [&] { return general_dag_.convert(model_.at_parameters(expression, scene_)); });
  }

  void bind() {
    for (std::size_t i = 0; i < n(); ++i) {
      field_.push_back(bound(derivative_name(i), model_.field.at(i)));
    }
    const auto add = [this](const std::string& name, const GiNaC::ex& value) {
      const auto same_name = [&](const auto& known) { return known.first == name; };
      if (std::ranges::none_of(invariants_, same_name)) {
        invariants_.emplace_back(name, bound(name, value));
      }
    };
    const bool conserved = model_.hamiltonian && !(model_.time && depends_on_time());
    if (conserved) add("H", *model_.hamiltonian);
    for (const NamedExpression& casimir : model_.casimirs) add(casimir.name, casimir.value);
    for (const NamedExpression& integral : model_.integrals) add(integral.name, integral.value);
  }

  bool depends_on_time() { return depends(bound("H", *model_.hamiltonian), *model_.time); }

  std::string derivative_name(std::size_t i) const { return "d" + model_.variables[i].get_name(); }

  // --- which states are needed

  void select_states() {
    const std::vector<std::string> observed = options_.observe.value_or(scene_.observe);
    std::vector<bool> needed(n(), observed.empty());
    for (const std::string& name : observed) mark(name, needed);
    close_under_dependence(needed);
    for (std::size_t i = 0; i < n(); ++i) {
      const std::string name = model_.variables[i].get_name();
      if (needed[i]) {
        result_.states.push_back(name);
        result_.state_indices.push_back(static_cast<int>(i));
      } else {
        leave_out("state", name, "not needed for " + joined(observed));
      }
    }
  }

  void mark(const std::string& name, std::vector<bool>& needed) {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < n(); ++i) {
      known.push_back(model_.variables[i].get_name());
      if (known.back() == name) {
        needed[i] = true;
        return;
      }
    }
    for (const auto& [invariant, value] : invariants_) {
      known.push_back(invariant);
      if (invariant != name) continue;
      for (std::size_t i = 0; i < n(); ++i) {
        if (depends(value, model_.variables[i])) needed[i] = true;
      }
      return;
    }
    throw unknown("observe", name, "variable or invariant", known);
  }

  void close_under_dependence(std::vector<bool>& needed) {
    const bool everything = std::ranges::all_of(needed, [](bool one) { return one; });
    for (bool grown = !everything; grown;) {
      grown = false;
      for (std::size_t i = 0; i < n(); ++i) {
        if (!needed[i]) continue;
        for (std::size_t j = 0; j < n(); ++j) {
          if (needed[j] || !really_depends(i, j)) continue;
          needed[j] = true;
          grown = true;
        }
      }
    }
  }

  /// Whether dx_i/dt depends on x_j; (x + y)*z - y*z does not depend on y.
  bool really_depends(std::size_t i, std::size_t j) {
    if (!depends(field_[i], model_.variables[j])) return false;
    const GiNaC::ex expanded = expanded_within(field_[i], kMostTermsOfEquation);
    if (depends(expanded, model_.variables[j])) return true;
    field_[i] = expanded;
    return false;
  }

  bool is_kept(std::size_t variable) const {
    return std::ranges::find(result_.state_indices, static_cast<int>(variable)) !=
           result_.state_indices.end();
  }

  void select_invariants() {
    if (!options_.invariants) invariants_.clear();
    std::erase_if(invariants_, [this](const auto& invariant) {
      std::vector<std::string> missing;
      bool varies = false;
      for (std::size_t i = 0; i < n(); ++i) {
        if (!depends(invariant.second, model_.variables[i])) continue;
        varies = true;
        if (!is_kept(i)) missing.push_back(model_.variables[i].get_name());
      }
      if (!missing.empty()) {
        leave_out("invariant", invariant.first, "needs " + joined(missing));
      } else if (!varies) {
        leave_out("invariant", invariant.first, "a constant for these parameters");
      }
      return !missing.empty() || !varies;
    });
    for (const auto& invariant : invariants_) result_.invariant_names.push_back(invariant.first);
  }

  // --- programs

  /// The inputs of the generated programs, as symbols; the time comes last.
  std::vector<GiNaC::symbol> kept_symbols() const {
    std::vector<GiNaC::symbol> symbols;
    for (const int i : result_.state_indices) {
      symbols.push_back(model_.variables[static_cast<std::size_t>(i)]);
    }
    for (const std::size_t i : parameter_indices_) symbols.push_back(model_.parameters[i]);
    symbols.push_back(model_.time ? *model_.time : GiNaC::symbol("t"));
    return symbols;
  }

  void write_programs() {
    const std::vector<GiNaC::symbol> symbols = kept_symbols();
    Dag dag(symbols, result_.states.size());
    std::vector<std::string> inputs;
    for (const GiNaC::symbol& symbol : symbols) inputs.push_back(symbol.get_name());

    std::vector<Scaled> field;
    std::vector<std::string> names;
    for (const int i : result_.state_indices) {
      const auto index = static_cast<std::size_t>(i);
      names.push_back(derivative_name(index));
      field.push_back(within(names.back(), [&] { return dag.convert(field_[index]); }));
      check_at_scene(names.back(), field_[index]);
    }
    const Program plain_field = plain(dag, field, inputs, names);
    result_.rhs = codegen::optimised(dag, field, inputs, names);
    result_.specialised = count_operations(result_.rhs);

    std::vector<Scaled> invariants;
    for (const auto& [name, invariant] : invariants_) {
      const GiNaC::ex& value = invariant;  // clang 14 cannot capture a structured binding
      invariants.push_back(within(name, [&] { return dag.convert(value); }));
      check_at_scene(name, value);
    }
    result_.invariants = codegen::optimised(dag, invariants, inputs, result_.invariant_names);
    note_time(dag, field, invariants);
    write_start();

    const std::size_t n = result_.states.size();
    if (options_.jacobian) {
      result_.jacobian = within("the Jacobian", [&] {
        return codegen::optimised(
            dag, {codegen::jacobian(plain_field, n), codegen::jacobian(result_.rhs, n)});
      });
      result_.has_jacobian = true;
    } else {
      result_.jacobian = codegen::jacobian(plain_field, n);  // for `add_jacobian`
    }
    if (options_.gradients) {
      const Program plain_invariants = plain(dag, invariants, inputs, result_.invariant_names);
      result_.gradients = within("the gradients", [&] {
        return codegen::optimised(dag, {codegen::gradients(plain_invariants, n),
                                        codegen::gradients(result_.invariants, n)});
      });
      result_.has_gradients = true;
    }
    if (options_.variational) write_variational(symbols, plain_field);
  }

  /// The expressions as they are structured, without any search for a shorter form.
  static Program plain(const Dag& dag, const std::vector<Scaled>& expressions,
                       const std::vector<std::string>& inputs,
                       const std::vector<std::string>& outputs) {
    return codegen::lowered(codegen::system_of(dag, inputs.size(), expressions), inputs, outputs);
  }

  void write_variational(std::vector<GiNaC::symbol> symbols, const Program& plain_field) {
    const std::size_t n = result_.states.size();
    for (std::size_t i = 0; i < n; ++i) {
      symbols.insert(symbols.begin() + static_cast<std::ptrdiff_t>(n + i),
                     GiNaC::symbol("delta_" + result_.states[i]));
    }
    Dag dag(symbols, 2 * n);
    result_.variational = within("the variational equations", [&] {
      return codegen::optimised(
          dag, std::vector<Program>{codegen::variational(plain_field, n),
                                    codegen::variational_by_columns(plain_field, n),
                                    codegen::variational(result_.rhs, n)});
    });
    result_.has_variational = true;
  }

  void note_time(const Dag& dag, const std::vector<Scaled>& field,
                 const std::vector<Scaled>& invariants) {
    const auto time = static_cast<int>(result_.states.size() + result_.parameters.size());
    const auto uses = [&](const Scaled& e) { return dag.contains(e, time); };
    result_.uses_time = std::ranges::any_of(field, uses) || std::ranges::any_of(invariants, uses);
    if (model_.time && !result_.uses_time) {
      leave_out("time", result_.time, "the equations do not depend on it");
    }
  }

  void write_start() {
    Dag dag({}, 0);
    std::vector<Scaled> values;
    std::vector<std::string> names;
    const auto add = [&](const std::string& name, const GiNaC::ex& value) {
      values.push_back(within(name, [&] { return dag.convert(value); }));
      names.push_back(name);
    };
    for (std::size_t i = 0; i < result_.states.size(); ++i) {
      const auto index = static_cast<std::size_t>(result_.state_indices[i]);
      add(result_.states[i], scene_.initial.at(index));
    }
    for (const std::size_t i : parameter_indices_) {
      add(model_.parameters[i].get_name(), scene_.parameters.at(i));
    }
    result_.has_duration = scene_.duration.has_value();
    add("duration", scene_.duration.value_or(0));
    result_.start = codegen::lowered(codegen::system_of(dag, 0, values), {}, names);
  }

  // --- what the specialisation saves

  void note_vanishing_terms() {
    if (!folds_some() && result_.states.size() == n()) {
      result_.general = result_.specialised;
      return;
    }
    std::vector<Scaled> general;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < n(); ++i) {
      names.push_back(derivative_name(i));
      general.push_back(
          within(names.back(), [&] { return general_dag_.convert(model_.field[i]); }));
    }
    std::vector<std::string> inputs;
    for (const GiNaC::symbol& symbol : general_symbols()) inputs.push_back(symbol.get_name());
    result_.general = count_operations(codegen::optimised(general_dag_, general, inputs, names));
    if (!folds_some()) return;
    for (const int i : result_.state_indices) {
      const auto index = static_cast<std::size_t>(i);
      const Scaled folded =
          within(names[index], [&] { return general_dag_.convert(field_[index]); });
      for (const codegen::VanishingTerm& term :
           codegen::vanishing_terms(general_dag_, general[index], folded, n(), inputs.size())) {
        leave_out("term", term.product + " in " + names[index],
                  "vanishes: coefficient " + term.coefficient + " = 0");
      }
    }
  }

  const Model& model_;
  const Scene& scene_;
  const SpecialiseOptions& options_;
  Scene binding_;  ///< the scene, with the run-time parameters standing for themselves
  std::vector<std::size_t> parameter_indices_;  ///< of the run-time parameters
  Dag general_dag_;
  std::vector<GiNaC::ex> field_;
  std::vector<std::pair<std::string, GiNaC::ex>> invariants_;
  Specialisation result_;
};

}  // namespace

Specialisation specialise(const Model& model, const Scene& scene,
                          const SpecialiseOptions& options) {
  if (!has_arbitrary_functions(model)) return Specialiser(model, scene, options).run();
  const auto [own, own_scene] = in_scene(model, scene);
  return Specialiser(own, own_scene, options).run();
}

void add_jacobian(Specialisation& specialisation) {
  if (specialisation.has_jacobian) return;
  const std::size_t n = specialisation.states.size();
  std::vector<GiNaC::symbol> symbols;
  for (const std::string& input : specialisation.rhs.inputs) symbols.emplace_back(input);
  Dag dag(symbols, n);
  specialisation.jacobian =
      codegen::optimised(dag, {specialisation.jacobian, codegen::jacobian(specialisation.rhs, n)});
  specialisation.has_jacobian = true;
}

}  // namespace casimir

#include "tools/analysis/section/problem.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "codegen/specialise.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "runtime/step/dense.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/saltation.hpp"
#include "tools/analysis/section/periods.hpp"
#include "tools/analysis/section/simple_zeros.hpp"

namespace casimir {
namespace {

/// Collects what a problem is made of.
class Maker {
 public:
  Maker(const Model& model, const Scene& scene, const SectionRequest& request)
      : model_(model), scene_(scene), request_(request) {}

  SectionProblem make() {
    const auto start = std::chrono::steady_clock::now();
    require_energy_level(model_);
    require_variables(model_.at_parameters(*model_.hamiltonian, scene_), "the Hamiltonian", "H");
    read_plane();
    read_pair();
    specialise_all();
    find_angles();
    set_levels();
    count_dimensions();
    problem_.run.generate_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(problem_);
  }

 private:
  void read_plane() {
    if (!request_.plane && !model_.section)
      throw RequestError(
          fmt::format("'{}' has no plane for a section, and none is given", model_.name));
    const FunctionText plane =
        request_.plane ? *request_.plane
                       : FunctionText{model_.section->function, "function of [section]"};
    problem_.plane_text = plane.text;
    problem_.plane.upwards = request_.upwards.value_or(request_.plane || model_.section->upwards);
    plane_ = model_.at_parameters(plane.function, scene_);
    problem_.plane_function = plane_;
    require_variables(plane_, "the plane", problem_.plane_text);
  }

  /// What is constant for the values of the scene is left out of the programs, and what stands
  /// behind it would take its place.
  void require_variables(const GiNaC::ex& function, const char* what,
                         const std::string& text) const {
    if (std::ranges::none_of(model_.variables, [&](const auto& x) { return function.has(x); }))
      throw RequestError(
          fmt::format("{} '{}' is the same everywhere in phase space", what, printable(text)));
  }

  void read_pair() {
    std::vector<FunctionText> pair = request_.pair;
    if (pair.empty() && model_.section)
      for (const GiNaC::ex& function : model_.section->plot)
        pair.push_back({function, fmt::format("{}", fmt::streamed(function))});
    if (pair.size() != 2)
      throw RequestError(
          fmt::format("a section is plotted by two functions, and there are {}", pair.size()));
    if (!request_.labels.empty() && request_.labels.size() != 2)
      throw RequestError("a section has two labels, or none");
    for (std::size_t i = 0; i < 2; ++i) {
      pair_.push_back(model_.at_parameters(pair[i].function, scene_));
      require_variables(pair_.back(), "the plotted function", pair[i].text);
      problem_.plotted[i] = {pair[i].text,
                             request_.labels.empty() ? pair[i].text : request_.labels[i], 0};
    }
  }

  /// The programs of the system, its level, the plane and the pair, and of the variational
  /// equations.
  void specialise_all() {
    Model model = model_;
    model.integrals = {{"the plane", with_simple_zeros(plane_, model_.variables), {}},
                       {"the first plotted function", pair_[0], {}},
                       {"the second plotted function", pair_[1], {}}};
    SpecialiseOptions what;
    what.observe = std::vector<std::string>{};
    what.gradients = what.variational = true;
    what.jacobian = false;
    PreparedScene& run = problem_.run;
    run.specialisation = specialise(model, scene_, what);
    Specialisation& s = run.specialisation;
    const std::vector<cln::cl_F> start = start_values(s, kConstantDigits);
    for (std::size_t i = 0; i < s.states.size(); ++i) run.initial.push_back(rounded(start[i]));
    problem_.jumps = Saltation(s.rhs).needed();
    problem_.deviating = run;
    Specialisation& twice = problem_.deviating.specialisation;
    twice.rhs = s.variational;
    twice.invariants = {};
    for (const std::string& name : s.states) twice.states.push_back("delta_" + name);
    problem_.plane.function = s.invariants;
    const std::size_t at = level_count();
    problem_.plane.function.outputs = {s.invariants.outputs.at(at)};
    problem_.plane.function.output_names = {"plane"};
    problem_.plane.function = codegen::without_dead_code(problem_.plane.function);
  }

  /// The Hamiltonian and the Casimir functions, less those that are constants for the values of the
  /// scene: what stands before the plane.
  std::size_t level_count() const {
    const auto& names = problem_.run.specialisation.invariant_names;
    const auto plane = std::ranges::find(names, "the plane");
    if (names.end() - plane != 3)
      throw RequestError("the plane's function, or one that is plotted, is a constant");
    return static_cast<std::size_t>(plane - names.begin());
  }

  void find_angles() {
    std::vector<GiNaC::ex> functions{model_.at_parameters(*model_.hamiltonian, scene_)};
    for (const GiNaC::ex& rate : model_.field)
      functions.push_back(model_.at_parameters(rate, scene_));
    for (const NamedExpression& c : model_.casimirs)
      functions.push_back(model_.at_parameters(c.value, scene_));
    problem_.angles = angles_among(model_.variables, functions);
    std::vector<GiNaC::symbol> angles;
    for (std::size_t i = 0; i < model_.variables.size(); ++i)
      if (problem_.angles[i]) angles.push_back(model_.variables[i]);
    problem_.plane.period = period_of(plane_, angles);
    for (std::size_t i = 0; i < 2; ++i) problem_.plotted[i].period = period_of(pair_[i], angles);
  }

  void set_levels() {
    const Specialisation& s = problem_.run.specialisation;
    // From the exact data: a Casimir function that is zero is not 1e-16.
    const Arithmetic<cln::cl_F> arithmetic(kConstantDigits);
    std::vector<cln::cl_F> inputs = start_values(s, kConstantDigits);
    inputs.resize(s.states.size());
    inputs.push_back(arithmetic.from(cln::cl_RA(0)));
    // The level alone: the plotted pair need not have a value at the initial state.
    Program functions = s.invariants;
    functions.outputs.resize(level_count());
    functions.output_names.resize(functions.outputs.size());
    functions = codegen::without_dead_code(functions);
    problem_.level_names = functions.output_names;
    std::vector<SizedNumber> sized;
    for (const cln::cl_F& input : inputs)
      sized.push_back(Arithmetic<SizedNumber>::plain(cln::double_approx(input)));
    const std::vector<SizedNumber> sizes = evaluate(functions, sized);
    const std::vector<cln::cl_F> exact = evaluate(functions, inputs, arithmetic);
    std::vector<double> values;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      constexpr long double kZero = 1e-50L;
      values.push_back(rounded(exact[i]));
      if (std::abs(values.back()) < kZero * sizes[i].size) values.back() = 0;
    }
    problem_.levels = values;
    if (request_.energy) problem_.levels[0] = *request_.energy;
    for (const auto& [name, value] : request_.casimirs) set_casimir(name, value);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(problem_.levels[i]))
        throw RequestError(
            fmt::format("{} has no finite value on the level", problem_.level_names[i]));
      const double size = std::max(std::abs(values[i]), 1.);
      if (std::abs(problem_.levels[i] - values[i]) > 1e-12 * size) problem_.on_scene = false;
    }
  }

  void set_casimir(const std::string& name, double value) {
    const auto& names = problem_.level_names;
    const auto level = std::find(names.begin() + 1, names.end(), name);  // behind H
    if (level == names.end()) {
      const std::vector<std::string> known = names_of(model_.casimirs);
      if (std::ranges::find(known, name) == known.end())
        throw RequestError(fmt::format("the case names no Casimir function '{}'", printable(name)));
      throw RequestError(fmt::format(
          "the Casimir function '{}' is a constant for the parameters of the scene", name));
    }
    problem_.levels[static_cast<std::size_t>(level - names.begin())] = value;
  }

  /// Rank of the bracket and of the gradients of the Casimir functions, at a point that is no
  /// special one.
  void count_dimensions() {
    const auto n = static_cast<Eigen::Index>(model_.variables.size());
    GiNaC::exmap point;
    for (std::size_t i = 0; i < model_.variables.size(); ++i)
      point[model_.variables[i]] = GiNaC::numeric(problem_.run.initial[i] +
                                                  0.1 * std::sin(1 + 1.7 * static_cast<double>(i)));
    const auto value = [&](const GiNaC::ex& e) {
      const Limits& limits = model_.limits;
      const auto number =
          real_decimal(substituted(model_.at_parameters(e, scene_), point, limits), limits.bits);
      return number ? number->to_double() : 0.;
    };
    Eigen::MatrixXd bracket = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        bracket(i, j) =
            value((*model_.poisson)(static_cast<std::size_t>(i), static_cast<std::size_t>(j)));
        bracket(j, i) = -bracket(i, j);
      }
    }
    Eigen::MatrixXd gradients =
        Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(model_.casimirs.size()));
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < gradients.cols(); ++j)
        gradients(i, j) = value(model_.casimirs[static_cast<std::size_t>(j)].value.diff(
            model_.variables[static_cast<std::size_t>(i)]));
    const auto rank = [](const Eigen::MatrixXd& matrix) -> Eigen::Index {
      return matrix.size() == 0 ? 0 : rank_of(matrix, 1e-9);
    };
    judge_dimensions(rank(bracket), n - rank(bracket), rank(gradients));
  }

  void judge_dimensions(Eigen::Index leaf, Eigen::Index casimirs, Eigen::Index named) {
    problem_.leaf = static_cast<std::size_t>(leaf);
    if (leaf < 4)
      throw RequestError(fmt::format(
          "'{}' has {}: its orbits are themselves the level lines of the energy, and a section of "
          "them is a few points; a section needs two degrees of freedom",
          model_.name, leaf == 0 ? "no degree of freedom" : "one degree of freedom"));
    if (named < casimirs)
      throw RequestError(fmt::format(
          "'{}' has {} independent Casimir functions and names {}: without the others the level is "
          "not fixed; name them in [casimirs] (a search for Casimir functions finds polynomial "
          "ones)",
          model_.name, casimirs, named));
  }

  const Model& model_;
  const Scene& scene_;
  const SectionRequest& request_;
  GiNaC::ex plane_;
  std::vector<GiNaC::ex> pair_;
  SectionProblem problem_;
};

}  // namespace

void require_energy_level(const Model& model) {
  if (!model.hamiltonian || !model.poisson)
    throw RequestError(fmt::format(
        "'{}' is given by its equations: a section lies on a level of the Hamiltonian, and there "
        "is none",
        model.name));
  if (model.time)
    throw RequestError(fmt::format(
        "'{}' depends on the time '{}': its energy changes, and no section lies on one level of "
        "it",
        model.name, model.time->get_name()));
}

std::string SectionProblem::level_text() const {
  std::string text;
  for (std::size_t i = 0; i < levels.size(); ++i)
    text += fmt::format("{}{} = {:.10g}", i == 0 ? "" : ", ", level_names[i], levels[i]);
  return text;
}

std::string SectionProblem::proved_level_text() const {
  std::string text;
  for (std::size_t i = 0; i < levels.size(); ++i)
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", level_names[i], levels[i]);
  return text;
}

void require_derivative_of_return(const SectionProblem& problem) {
  if (problem.jumps)
    throw RequestError(
        "cycles are sought by the derivative of the return, which is not known where the equations "
        "jump, as sign(..) does");
}

SectionProblem section_problem(const Model& model, const Scene& scene,
                               const SectionRequest& request) {
  return Maker(model, scene, request).make();
}

}  // namespace casimir

#include "tools/analysis/section/problem.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "codegen/specialise.hpp"
#include "runtime/dense.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/term_size.hpp"
#include "symbolic/decimal.hpp"
#include "symbolic/expression.hpp"
#include "symbolic/measure.hpp"
#include "tools/analysis/section/periods.hpp"
#include "tools/errors.hpp"

namespace casimir::tools {
namespace {

Text option_text(const std::string& option, const std::string& value) {
  return {value, {option, 1, 1}, value};
}

double real_constant(const Text& text) {
  const std::optional<GiNaC::numeric> value = real_decimal(parse_constant(text));
  if (!value) throw text.error("expected a real number");
  return value->to_double();
}

/// Collects what a problem is made of.
class Maker {
 public:
  Maker(const CaseFile& file, const Model& model, const Scene& scene, const SectionRequest& request)
      : file_(file.section), model_(model), scene_(scene), request_(request) {}

  SectionProblem make() {
    const auto start = std::chrono::steady_clock::now();
    check_system();
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
  void check_system() const {
    if (!model_.hamiltonian || !model_.poisson)
      throw UsageError(fmt::format(
          "'{}' is given by its equations: a section lies on a level of the Hamiltonian, and there "
          "is none",
          model_.name));
    if (model_.time)
      throw UsageError(fmt::format(
          "'{}' depends on the time '{}': its energy changes, and no section lies on one level of "
          "it",
          model_.name, model_.time->get_name()));
  }

  void read_plane() {
    bool upwards = !model_.section || model_.section->upwards;
    if (request_.plane) {
      const Text text = option_text("--plane", *request_.plane);
      problem_.plane_text = text.value;
      if (text.value.find('=') != std::string::npos) {
        const Identity level = model_.parse_identity(text);
        const auto& [left, right] = std::tie(level.left, level.right);
        plane_ = left - right;
      } else {
        plane_ = model_.parse(text);
      }
      upwards = true;
    } else if (model_.section) {
      plane_ = model_.section->function;
      problem_.plane_text = file_ ? file_->function.value : "function of [section]";
    } else {
      throw UsageError(fmt::format(
          "'{}' has no [section]: give the plane by --plane EXPR and what is plotted by --pair U V",
          model_.name));
    }
    if (request_.direction) upwards = *request_.direction == "up";
    problem_.plane.upwards = upwards;
    plane_ = model_.at_parameters(plane_, scene_);
    if (std::ranges::none_of(model_.variables, [&](const auto& x) { return plane_.has(x); }))
      throw UsageError(fmt::format("the plane '{}' is the same everywhere in phase space",
                                   printable(problem_.plane_text)));
  }

  void read_pair() {
    std::vector<std::string> texts = request_.pair;
    if (!texts.empty()) {
      for (const std::string& text : texts)
        pair_.push_back(model_.parse(option_text("--pair", text)));
    } else {
      if (model_.section) pair_ = model_.section->plot;
      if (file_)
        for (const Text& text : file_->plot) texts.push_back(text.value);
    }
    if (pair_.size() != 2) {
      const std::string message =
          fmt::format("a section is plotted by two functions, and there are {}", pair_.size());
      if (request_.pair.empty() && file_ && !file_->plot.empty())
        throw file_->plot.front().error(message);
      throw UsageError(message + ": give them by --pair U V");
    }
    std::vector<std::string> labels = request_.labels;
    if (labels.empty() && request_.pair.empty() && file_)
      for (const Text& text : file_->labels) labels.push_back(text.value);
    if (!labels.empty() && labels.size() != 2) {
      if (request_.labels.empty()) throw file_->labels.front().error("'labels' must be two");
      throw UsageError("--labels needs two");
    }
    for (std::size_t i = 0; i < 2; ++i) {
      pair_[i] = model_.at_parameters(pair_[i], scene_);
      texts.resize(2);
      problem_.plotted[i] = {texts[i], labels.empty() ? texts[i] : labels[i], 0};
    }
  }

  /// The programs of the system, its level, the plane and the pair, and of the variational
  /// equations.
  void specialise_all() {
    Model model = model_;
    model.integrals = {{"the plane", plane_, {}},
                       {"the first plotted function", pair_[0], {}},
                       {"the second plotted function", pair_[1], {}}};
    SpecialiseOptions what;
    what.observe = std::vector<std::string>{};
    what.gradients = what.variational = true;
    what.jacobian = false;
    SceneRun& run = problem_.run;
    run.specialisation = specialise(model, scene_, what);
    Specialisation& s = run.specialisation;
    const std::vector<cln::cl_F> start = start_values(s, kConstantDigits);
    for (std::size_t i = 0; i < s.states.size(); ++i) run.initial.push_back(rounded(start[i]));
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
    if (plane == names.end()) throw UsageError("the plane's function is a constant");
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
    if (request_.energy)
      problem_.levels[0] = real_constant(option_text("--energy", *request_.energy));
    else if (file_ && file_->energy)
      problem_.levels[0] = real_constant(*file_->energy);
    if (file_)
      for (const auto& [name, value] : file_->casimirs) set_casimir(name, real_constant(value));
    for (const std::string& text : request_.casimirs) set_casimir(text);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(problem_.levels[i]))
        throw UsageError(
            fmt::format("{} has no finite value on the level", problem_.level_names[i]));
      const double size = std::max(std::abs(values[i]), 1.);
      if (std::abs(problem_.levels[i] - values[i]) > 1e-12 * size) problem_.on_scene = false;
    }
  }

  void set_casimir(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw UsageError(fmt::format("--casimir '{}': expected NAME=VALUE", printable(text)));
    const Text value{text.substr(equals + 1), {"--casimir", 1, static_cast<int>(equals) + 2}, text};
    set_casimir({text.substr(0, equals), {"--casimir", 1, 1}, text}, real_constant(value));
  }

  void set_casimir(const Text& name, double value) {
    const std::vector<std::string> known = names_of(model_.casimirs);
    const auto found = std::ranges::find(known, name.value);
    if (found == known.end()) {
      throw name.error(
          fmt::format("the case names no Casimir function '{}'", printable(name.value)), 0,
          known.empty() ? "it names none at all" : suggest_or_list(name.value, known));
    }
    problem_.levels[1 + static_cast<std::size_t>(found - known.begin())] = value;
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
      const auto number = real_decimal(substituted(model_.at_parameters(e, scene_), point));
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
      throw UsageError(fmt::format(
          "'{}' has {}: its orbits are themselves the level lines of the energy, and a section of "
          "them is a few points; a section needs two degrees of freedom",
          model_.name, leaf == 0 ? "no degree of freedom" : "one degree of freedom"));
    if (named < casimirs)
      throw UsageError(fmt::format(
          "'{}' has {} independent Casimir functions and names {}: without the others the level is "
          "not fixed; name them in [casimirs] ('casimir search --casimirs' finds polynomial ones)",
          model_.name, casimirs, named));
  }

  const std::optional<SectionText>& file_;
  const Model& model_;
  const Scene& scene_;
  const SectionRequest& request_;
  GiNaC::ex plane_;
  std::vector<GiNaC::ex> pair_;
  SectionProblem problem_;
};

}  // namespace

std::string SectionProblem::level_text() const {
  std::string text;
  for (std::size_t i = 0; i < levels.size(); ++i)
    text += fmt::format("{}{} = {:.10g}", i == 0 ? "" : ", ", level_names[i], levels[i]);
  return text;
}

SectionProblem section_problem(const CaseFile& file, const Model& model, const Scene& scene,
                               const SectionRequest& request) {
  return Maker(file, model, scene, request).make();
}

}  // namespace casimir::tools

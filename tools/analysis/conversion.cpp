#include "tools/analysis/conversion.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "codegen/optimise/differentiate.hpp"
#include "codegen/program_of.hpp"
#include "runtime/evaluate.hpp"

namespace casimir {
namespace {

/// A state that a map and its inverse do not bring back to this, relative to its size, has lost its
/// digits next to a singular point, or was never in the image.
constexpr double kRoundTrip = 1e-7;

std::vector<std::string> names_of(const std::vector<GiNaC::symbol>& symbols) {
  std::vector<std::string> names;
  for (const GiNaC::symbol& s : symbols) names.push_back(s.get_name());
  return names;
}

std::vector<GiNaC::ex> differences(const std::vector<Assumption>& domain) {
  std::vector<GiNaC::ex> result;
  for (const Assumption& a : domain) result.push_back(a.difference);
  return result;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// The first condition that fails; null if all hold.
const Assumption* failing(const Program& program, const std::vector<Assumption>& domain,
                          const std::vector<double>& state) {
  const std::vector<double> values = evaluate(program, state);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int sign = (values[i] > 0) - (values[i] < 0);
    if (std::isnan(values[i]) || !holds(domain[i].comparison, sign)) return &domain[i];
  }
  return nullptr;
}

/// The derivatives of the outputs by the inputs; no numbers where one has no value.
Eigen::MatrixXd jacobian_at(const Program& program, const std::vector<double>& state) {
  const SparseProgram jacobian = codegen::jacobian(program, state.size());
  std::vector<double> entries(jacobian.entries.size(), std::nan(""));
  try {
    entries = evaluate(jacobian.program, state);
  } catch (const std::domain_error&) {
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(program.outputs.size()),
                                                 static_cast<Eigen::Index>(state.size()));
  for (std::size_t e = 0; e < entries.size(); ++e)
    result(jacobian.entries[e].first, jacobian.entries[e].second) = entries[e];
  return result;
}

/// Directions that a matrix makes nothing of, as columns.
Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& matrix) {
  constexpr double kRounding = 1e-10;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(matrix);
  lu.setThreshold(kRounding);
  if (lu.dimensionOfKernel() == 0) return Eigen::MatrixXd(matrix.cols(), 0);
  return lu.kernel();
}

}  // namespace

Conversion::Conversion(const Model& model, Atlas atlas, const std::string& set)
    : limits_(model.limits), atlas_(std::move(atlas)) {
  const std::size_t to = atlas_.named(set);
  const std::size_t from = atlas_.of(model);
  const auto path = atlas_.path(from, to, false);
  if (path.empty() && from != to)
    throw ModelError(fmt::format("no maps lead from the variables of '{}' to '{}'",
                                 printable(model.name), printable(set)));
  names_ = names_of(atlas_.sets[to].variables);
  for (const CoordinateChange* change : path) {
    const auto& variables = atlas_.sets[change->from].variables;
    const Coordinates& there = atlas_.sets[change->to];
    Step step{change, {}, program_of(differences(there.domain), there.variables), there.domain, {}};
    for (const CoordinateChange::Branch& branch : change->branches) {
      step.branches.push_back({program_of(branch.expressions, variables),
                               program_of(differences(branch.domain), variables), branch.domain});
    }
    if (!change->forward) {
      const auto map = std::find_if(
          atlas_.changes.begin(), atlas_.changes.end(), [&](const CoordinateChange& other) {
            return other.forward && other.from == change->to && other.to == change->from;
          });
      step.back = program_of(map->branches[0].expressions, there.variables);
    }
    steps_.push_back(std::move(step));
  }
}

std::vector<double> Conversion::operator()(std::vector<double> state) const {
  for (const Step& step : steps_) state = apply(step, state);
  return state;
}

ConvertedState Conversion::assessed(std::vector<double> state) const {
  const auto size = static_cast<Eigen::Index>(state.size());
  Eigen::MatrixXd total = Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd open(size, 0);  // directions that are not determined, as columns
  for (const Step& step : steps_) {
    const Branch* used = nullptr;
    std::vector<double> next = apply(step, state, &used);
    const Eigen::MatrixXd slopes = jacobian_at(used->values, state);
    total = slopes * total;
    open = slopes * open;
    if (step.back) {
      const Eigen::MatrixXd forgotten = kernel_of(jacobian_at(*step.back, next));
      Eigen::MatrixXd both(open.rows(), open.cols() + forgotten.cols());
      both << open, forgotten;
      open = both;
    }
    state = std::move(next);
  }
  ConvertedState result{.state = std::move(state), .undetermined = {}};
  // The largest of numbers among which one is none is not for Eigen to say.
  result.growth = total.allFinite() ? total.cwiseAbs().rowwise().sum().maxCoeff() : std::nan("");
  // In units of each column, so that rounding makes nothing of nothing.
  constexpr double kRounding = 1e-9;
  for (Eigen::Index i = 0; i < open.rows(); ++i)
    for (Eigen::Index k = 0; k < open.cols(); ++k)
      if (std::abs(open(i, k)) > kRounding * open.col(k).cwiseAbs().maxCoeff()) {
        result.undetermined.push_back(names_[static_cast<std::size_t>(i)]);
        break;
      }
  return result;
}

std::vector<double> Conversion::apply(const Step& step, const std::vector<double>& state,
                                      const Branch** used) const {
  std::string why = "its expressions have no value there";
  for (const Branch& branch : step.branches) {
    try {
      if (const Assumption* condition = failing(branch.conditions, branch.domain, state)) {
        why = fmt::format("{} fails", condition->text);
        continue;
      }
      std::vector<double> result = evaluate(branch.values, state);
      if (!all_finite(result)) continue;
      if (const Assumption* condition = failing(step.there, step.there_domain, result)) {
        why = fmt::format("{} fails", condition->text);
        continue;
      }
      if (step.back) {
        const std::vector<double> again = evaluate(*step.back, result);
        double size = 0, off = 0;
        for (std::size_t i = 0; i < again.size(); ++i) {
          size = std::max(size, std::abs(state[i]));
          off = std::max(off, std::abs(again[i] - state[i]));
        }
        if (!(off <= kRoundTrip * size)) {
          why = fmt::format("mapped back, the state is off by {:.1e}", off);
          continue;
        }
      }
      if (used) *used = &branch;
      return result;
    } catch (const std::domain_error&) {
    }
  }
  const Coordinates& from = atlas_.sets[step.change->from];
  std::string where;
  for (std::size_t i = 0; i < state.size(); ++i)
    where +=
        fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", from.variables[i].get_name(), state[i]);
  throw SingularPoint(fmt::format("the variables of '{}' are singular at {} ({})",
                                  atlas_.sets[step.change->to].name, where, why));
}

std::vector<GiNaC::ex> Conversion::exact(const Scene& scene) const {
  std::vector<GiNaC::ex> state = scene.initial;
  for (const Step& step : steps_) state = image_of(atlas_, *step.change, state, limits_);
  return state;
}

}  // namespace casimir

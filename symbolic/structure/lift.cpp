#include "symbolic/structure/lift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/model/bare_motion.hpp"

namespace casimir::structure {
namespace {

/// The sign of the permutation that puts a list into order; 0 where a number occurs twice.
int sort_sign(std::vector<std::size_t>& list) {
  int sign = 1;
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = i + 1; j < list.size(); ++j) {
      if (list[i] == list[j]) return 0;
      if (list[i] > list[j]) sign = -sign;
    }
  }
  std::sort(list.begin(), list.end());
  return sign;
}

std::map<std::vector<std::size_t>, std::size_t> places_of(
    const std::vector<std::vector<std::size_t>>& indices) {
  std::map<std::vector<std::size_t>, std::size_t> result;
  for (std::size_t i = 0; i < indices.size(); ++i) result.emplace(indices[i], i);
  return result;
}

}  // namespace

std::string name_of(TensorType type) {
  if (type.form) return fmt::format("{}-forms", type.rank);
  if (type.rank == 1) return "fields";
  if (type.rank == 2) return "bivectors";
  return fmt::format("{}-vectors", type.rank);
}

std::vector<std::vector<std::size_t>> skew_indices(std::size_t dimension, int rank) {
  std::vector<std::vector<std::size_t>> result{{}};
  for (int k = 0; k < rank; ++k) {
    std::vector<std::vector<std::size_t>> longer;
    for (const std::vector<std::size_t>& list : result) {
      for (std::size_t i = list.empty() ? 0 : list.back() + 1; i < dimension; ++i) {
        longer.push_back(list);
        longer.back().push_back(i);
      }
    }
    result = std::move(longer);
  }
  return result;
}

std::vector<GiNaC::ex> wedge(std::size_t dimension, const std::vector<GiNaC::ex>& a, int rank_a,
                             const std::vector<GiNaC::ex>& b, int rank_b) {
  const auto first = skew_indices(dimension, rank_a), second = skew_indices(dimension, rank_b);
  const auto indices = skew_indices(dimension, rank_a + rank_b);
  const auto places = places_of(indices);
  std::vector<GiNaC::ex> result(indices.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (a[i].is_zero()) continue;
    for (std::size_t j = 0; j < second.size(); ++j) {
      if (b[j].is_zero()) continue;
      std::vector<std::size_t> list = first[i];
      list.insert(list.end(), second[j].begin(), second[j].end());
      const int sign = sort_sign(list);
      if (sign != 0) result[places.at(list)] += sign * a[i] * b[j];
    }
  }
  return result;
}

Lift::Lift(const Model& model, TensorType type) : type_(type), dimension_(model.variables.size()) {
  constexpr double kMostComponents = 500;
  if (model.time)
    throw ModelError("invariant tensors are searched where no time is in the equations");
  if (type.rank > static_cast<int>(dimension_))
    throw ModelError(
        fmt::format("there are no skew tensors of rank {} in {} variables", type.rank, dimension_));
  double components = 1;
  for (int k = 0; k < type.rank; ++k) {
    components *= static_cast<double>(dimension_ - static_cast<std::size_t>(k)) / (k + 1);
  }
  if (components > kMostComponents)
    throw ModelError(
        fmt::format("a tensor of rank {} has {:.0f} components in {} variables, more "
                    "than the {} that are searched",
                    type.rank, components, dimension_, kMostComponents));
  indices_ = skew_indices(dimension_, type.rank);
  model_ = bare_motion(model);
  for (std::size_t c = 0; c < indices_.size(); ++c) {
    // No name of a case file looks like that.
    model_.variables.emplace_back("<" + label(c) + ">");
  }
  for (Scene scene : model.scenes) {
    scene.initial.resize(model_.variables.size(), 1);
    scene.reference.clear();
    model_.scenes.push_back(std::move(scene));
  }
  add_rates(model);
}

std::string Lift::label(std::size_t component) const {
  std::string result;
  for (const std::size_t i : indices_[component])
    result += (result.empty() ? "" : ",") + model_.variables[i].get_name();
  return result;
}

void Lift::add_rates(const Model& base) {
  const auto places = places_of(indices_);
  // slope[a][i] = dX_a/dx_i
  std::vector<std::vector<GiNaC::ex>> slope(dimension_);
  for (std::size_t a = 0; a < dimension_; ++a) {
    for (std::size_t i = 0; i < dimension_; ++i)
      slope[a].push_back(base.field[a].diff(base.variables[i]));
  }
  for (const std::vector<std::size_t>& list : indices_) {
    GiNaC::ex rate = 0;
    for (std::size_t s = 0; s < list.size(); ++s) {
      for (std::size_t a = 0; a < dimension_; ++a) {
        const GiNaC::ex factor = type_.form ? slope[list[s]][a] : -slope[a][list[s]];
        if (factor.is_zero()) continue;
        std::vector<std::size_t> replaced = list;
        replaced[s] = a;
        const int sign = sort_sign(replaced);
        if (sign != 0) rate += sign * factor * model_.variables[dimension_ + places.at(replaced)];
      }
    }
    model_.field.push_back(rate);
  }
}

GiNaC::ex Lift::function(const std::vector<GiNaC::ex>& components) const {
  GiNaC::ex sum = 0;
  for (std::size_t c = 0; c < components.size(); ++c)
    sum += components[c] * model_.variables[dimension_ + c];
  return sum;
}

}  // namespace casimir::structure

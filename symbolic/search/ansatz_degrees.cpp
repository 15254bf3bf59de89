#include "symbolic/search/ansatz_degrees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "symbolic/search/own_weights.hpp"

namespace casimir::search {
namespace {

constexpr int kHighestSearched = 250;  ///< an exponent is one byte

/// A whole number within bounds.
int number_in(const Text& text, int least, int most, const std::string& what) {
  int value = 0;
  const char* end = text.value.data() + text.value.size();
  const auto [stop, problem] = std::from_chars(text.value.data(), end, value);
  if (problem != std::errc() || stop != end || value < least || value > most)
    throw text.error(fmt::format("{} is a whole number from {} to {}", what, least, most));
  return value;
}

/// Whether the bracket is {q_i, p_j} = 1 where i = j and else 0, of q_1 .. q_n, p_1 .. p_n.
bool is_canonical(const Model& model) {
  if (!model.poisson || model.variables.size() % 2 != 0) return false;
  const std::size_t n = model.variables.size() / 2;
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (std::size_t j = i + 1; j < 2 * n; ++j)
      if (!(*model.poisson)(i, j).is_equal(j == i + n ? 1 : 0)) return false;
  return true;
}

}  // namespace

AnsatzDegrees::AnsatzDegrees(const System& system, const Request& request)
    : system_(system), request_(request) {
  for (const std::size_t atom : system_.atoms()) names_.push_back(system_.name(atom));
  weights_.assign(names_.size(), 1);
  if (request_.own_weights)
    take_own_weights();
  else
    read_weights();
  for (const int weight : weights_) order_.push_back(std::max(weight, 1));
  read_limits();
  const bool positive = std::ranges::all_of(weights_, [](int weight) { return weight > 0; });
  if (!groups_.empty() || !positive) {
    limits_ = groups_;
    if (request_.degree >= 0) limits_.push_back({weights_, request_.degree});
  }
  check();
}

/// A declared function may be written in another way than the ring writes it.
std::size_t AnsatzDegrees::place_of(const Text& name) const {
  if (name.value.empty()) throw name.error("the name of a variable of the ansatz is missing");
  auto place = std::ranges::find(names_, name.value);
  if (place == names_.end() && name.value.find_first_of("()/^*") != std::string::npos)
    place = std::ranges::find(names_, system_.text_of(system_.model().parse(name)));
  if (place == names_.end()) place = std::ranges::find(names_, "(" + name.value + ")");
  if (place == names_.end()) {
    throw name.error(fmt::format("'{}' is not a variable of the ansatz", printable(name.value)), 0,
                     suggest_or_list(name.value, names_));
  }
  return static_cast<std::size_t>(place - names_.begin());
}

void AnsatzDegrees::read_weights() {
  constexpr int kLargest = 1000;
  for (const auto& [name, weight] : request_.weights) {
    const std::size_t place = place_of(name);
    weights_[place] = number_in(weight, -kLargest, kLargest, "a weight");
  }
}

void AnsatzDegrees::take_own_weights() {
  if (!request_.weights.empty())
    throw ModelError("weights are given, or those by which the equations are quasi-homogeneous");
  const std::optional<std::vector<int>> own = own_weights(system_);
  if (!own)
    throw ModelError(
        "there are no weights but 0 by which the equations of motion are quasi-homogeneous");
  weights_ = *own;
}

/// A name of the ansatz comes before the words.
std::vector<std::size_t> AnsatzDegrees::places_named(const std::vector<Text>& names) const {
  std::vector<std::size_t> places;
  const std::size_t half = system_.model().variables.size() / 2;
  for (const Text& name : names) {
    if (name.value == "rest" && std::ranges::find(names_, name.value) == names_.end())
      throw name.error("'rest' stands alone: it is all that no other limit names");
    const bool is_name = std::ranges::find(names_, name.value) != names_.end();
    if (is_name || (name.value != "momenta" && name.value != "coordinates")) {
      places.push_back(place_of(name));
      continue;
    }
    if (!is_canonical(system_.model()))
      throw name.error(
          fmt::format("only a canonical case has '{}': name the variables", name.value));
    for (std::size_t i = 0; i < half; ++i) places.push_back(name.value == "momenta" ? half + i : i);
  }
  return places;
}

void AnsatzDegrees::read_limits() {
  const Text* rest = nullptr;
  std::vector<bool> named(names_.size(), false);
  std::optional<std::size_t> of_rest;
  for (const DegreeIn& own : request_.degree_in) {
    DegreeLimit limit{std::vector<int>(names_.size(), 0),
                      number_in(own.degree, 0, kHighestSearched, "a degree")};
    const bool is_rest = own.names.size() == 1 && own.names[0].value == "rest" &&
                         std::ranges::find(names_, "rest") == names_.end();
    if (is_rest && rest != nullptr) throw own.names[0].error("'rest' is given twice");
    if (is_rest) {
      rest = &own.names[0];
      of_rest = groups_.size();
    } else {
      for (const std::size_t place : places_named(own.names)) {
        limit.weights[place] = 1;
        named[place] = true;
      }
    }
    groups_.push_back(std::move(limit));
  }
  if (!of_rest) return;
  for (std::size_t i = 0; i < named.size(); ++i) groups_[*of_rest].weights[i] = named[i] ? 0 : 1;
}

/// There are infinitely many monomials.
void AnsatzDegrees::refuse_unlimited(std::size_t atom) const {
  const std::string text = fmt::format(
      "the degree in '{}'{} has no limit: one of its own is needed, or of the rest", names_[atom],
      weights_[atom] > 0 ? "" : fmt::format(", of weight {},", weights_[atom]));
  for (const auto& [name, weight] : request_.weights)
    if (weights_[atom] <= 0 && place_of(name) == atom) throw weight.error(text);
  throw ModelError(text);
}

void AnsatzDegrees::check() const {
  if (limits_.empty()) {
    for (const int weight : order_) {
      if (request_.degree / weight > kHighestSearched)
        throw ModelError(fmt::format("the degree {} is beyond {}, the largest that is searched",
                                     request_.degree, kHighestSearched * weight));
    }
    return;
  }
  std::vector<int> highest;
  if (const std::optional<std::size_t> open = unbounded_place(limits_, highest))
    refuse_unlimited(*open);
  const int total = highest_degree_within(limits_, order_, highest);
  if (total > kHighestSearched)
    throw ModelError(
        fmt::format("these limits allow a degree of {}, beyond {}, the largest that "
                    "is searched",
                    total, kHighestSearched));
}

void AnsatzDegrees::set(Problem& problem) const {
  problem.weights.clear();
  problem.degree = request_.degree;
  problem.limits.assign(limits_.size(), {});
  for (std::size_t l = 0; l < limits_.size(); ++l) problem.limits[l].degree = limits_[l].degree;
  for (const std::size_t place : problem.fields.places) {
    const auto atom = static_cast<std::size_t>(std::ranges::find(system_.atoms(), place) -
                                               system_.atoms().begin());
    problem.weights.push_back(order_[atom]);
    for (std::size_t l = 0; l < limits_.size(); ++l)
      problem.limits[l].weights.push_back(limits_[l].weights[atom]);
  }
  if (limits_.empty()) return;
  std::vector<int> highest;
  unbounded_place(problem.limits, highest);
  problem.degree = highest_degree_within(problem.limits, problem.weights, highest);
}

int AnsatzDegrees::degree_of(const Polynomial& p) const {
  return DegreeLimit{weights_, 0}.of(p, system_.atoms());
}

int AnsatzDegrees::order_of(const Polynomial& p) const {
  return DegreeLimit{order_, 0}.of(p, system_.atoms());
}

std::vector<std::pair<std::string, int>> AnsatzDegrees::named_weights() const {
  std::vector<std::pair<std::string, int>> result;
  if (std::ranges::all_of(weights_, [](int weight) { return weight == 1; })) return result;
  for (std::size_t i = 0; i < names_.size(); ++i) result.emplace_back(names_[i], weights_[i]);
  return result;
}

std::vector<std::pair<std::vector<std::string>, int>> AnsatzDegrees::named_limits() const {
  std::vector<std::pair<std::vector<std::string>, int>> result;
  for (const DegreeLimit& limit : groups_) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (limit.weights[i] != 0) names.push_back(names_[i]);
    result.emplace_back(std::move(names), limit.degree);
  }
  return result;
}

}  // namespace casimir::search

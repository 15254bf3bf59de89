#include "symbolic/structure/tensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/search/search.hpp"
#include "symbolic/structure/tensor_space.hpp"

namespace casimir::structure {
namespace {

using Components = std::vector<GiNaC::ex>;

/// The polynomial integrals up to a degree, with the Hamiltonian and the Casimir functions.
std::vector<GiNaC::ex> integrals_of(const Model& model, int degree, const search::Watch& watch) {
  search::Request request;
  request.degree = degree;
  request.casimirs_are_integrals = !model.poisson;
  const search::Report report = search::find_integrals(model, request, watch);
  std::vector<GiNaC::ex> result;
  for (const auto* list : {&report.casimirs, &report.found}) {
    for (const search::Found& found : *list)
      if (found.verdict == Verdict::proved) result.push_back(found.value);
  }
  if (report.hamiltonian) result.push_back(*model.hamiltonian);
  return result;
}

/// The tensors of one kind, rank by rank: those of higher ranks are compared with products of
/// those of lower ones.
class TensorSearch {
 public:
  TensorSearch(const Model& model, TensorType type, int degree, const search::Watch& watch)
      : model_(model),
        type_(type),
        degree_(degree),
        watch_(watch),
        integrals_(integrals_of(model, degree + 1, watch)) {}

  TensorReport run();

 private:
  std::vector<Components> known_of_rank(int rank) const;
  std::vector<Components> vectors() const;
  std::vector<Components> differentials() const;
  Components differential(const Components& form, int rank) const;
  void search_rank(int rank);
  Tensor described(TensorSpace& space, const search::Generator& g) const;

  const Model& model_;
  TensorType type_;
  int degree_;
  const search::Watch& watch_;
  std::vector<GiNaC::ex> integrals_;
  std::map<int, std::vector<Components>> tensors_;  ///< by rank: the known ones, then those found
  std::map<int, std::vector<Components>> found_;
  TensorReport report_;
};

/// The motion and the Hamiltonian fields of the integrals.
std::vector<Components> TensorSearch::vectors() const {
  std::vector<Components> result{model_.field};
  if (!model_.poisson) return result;
  for (const GiNaC::ex& f : integrals_) result.push_back(model_.poisson->flow(f));
  return result;
}

std::vector<Components> TensorSearch::differentials() const {
  std::vector<Components> result;
  for (const GiNaC::ex& f : integrals_) {
    result.emplace_back();
    for (const GiNaC::symbol& x : model_.variables) result.back().push_back(f.diff(x));
  }
  return result;
}

/// The exterior derivative.
Components TensorSearch::differential(const Components& form, int rank) const {
  const std::size_t n = model_.variables.size();
  Components result(skew_indices(n, rank + 1).size());
  for (std::size_t i = 0; i < n; ++i) {
    Components dx(n), slope;
    dx[i] = 1;
    for (const GiNaC::ex& component : form) slope.push_back(component.diff(model_.variables[i]));
    const Components product = wedge(n, dx, 1, slope, rank);
    for (std::size_t c = 0; c < result.size(); ++c) result[c] += product[c];
  }
  return result;
}

std::vector<Components> TensorSearch::known_of_rank(int rank) const {
  std::vector<Components> result;
  if (rank == 1) return type_.form ? differentials() : vectors();
  if (rank == 2 && !type_.form && model_.poisson) {
    result.emplace_back();
    for (const auto& pair : skew_indices(model_.variables.size(), 2))
      result.back().push_back((*model_.poisson)(pair[0], pair[1]));
  }
  for (int k = 1; 2 * k <= rank; ++k) {
    const std::vector<Components>&a = tensors_.at(k), &b = tensors_.at(rank - k);
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 2 * k == rank ? i : 0; j < b.size(); ++j)
        result.push_back(wedge(model_.variables.size(), a[i], k, b[j], rank - k));
    }
  }
  if (type_.form) {
    for (const Components& form : found_.at(rank - 1))
      result.push_back(differential(form, rank - 1));
  }
  return result;
}

Tensor TensorSearch::described(TensorSpace& space, const search::Generator& g) const {
  Tensor tensor;
  tensor.components = space.expressions(g.function);
  tensor.degree = space.degree_of(g.function);
  const std::vector<Polynomial> components = space.components(g.function);
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (!components[c].is_zero())
      tensor.texts.emplace_back(space.lift().label(c),
                                space.system().functions().text(components[c]));
  }
  tensor.verdict = prove_claim(space.lift().model(), ClaimKind::integral,
                               {"L_X T", space.system().expression(g.function), {}})
                       .verdict;
  watch_.tick(1);
  return tensor;
}

void TensorSearch::search_rank(int rank) {
  TensorSpace space(model_, {rank, type_.form});
  for (const GiNaC::ex& f : integrals_) space.add_integral(f);
  for (const Components& known : known_of_rank(rank)) {
    if (space.add_tensor(known)) tensors_[rank].push_back(known);
  }
  space.search_up_to(degree_, watch_);
  tensors_[rank];
  found_[rank];
  for (const search::Generator& g : space.found()) {
    tensors_[rank].push_back(space.expressions(g.function));
    found_[rank].push_back(tensors_[rank].back());
  }
  if (rank < type_.rank) return;
  report_.dimensions = space.dimensions();
  report_.complete = space.complete();
  report_.reason = space.reason();
  report_.generic = space.system().generic_parameters();
  report_.functions = space.system().names_of_functions();
  for (const search::Generator& g : space.found()) report_.found.push_back(described(space, g));
}

TensorReport TensorSearch::run() {
  report_.type = type_;
  report_.degree = degree_;
  for (int rank = 1; rank <= type_.rank; ++rank) search_rank(rank);
  for (const Tensor& tensor : report_.found) {
    if (tensor.verdict == Verdict::proved) continue;
    report_.complete = false;
    report_.reason = "a tensor was found but not proved";
  }
  return report_;
}

}  // namespace

TensorReport find_tensors(const Model& model, TensorType type, int degree,
                          const search::Watch& watch) {
  return TensorSearch(model, type, degree, watch).run();
}

}  // namespace casimir::structure

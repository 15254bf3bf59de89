#include "symbolic/structure/relate/relate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/search/search.hpp"
#include "symbolic/structure/relate/invariants.hpp"
#include "symbolic/structure/relate/matching.hpp"

namespace casimir::structure {
namespace {

using GiNaC::ex;

/// Polynomial Casimir functions up to a degree, with the products of several and the constant 1.
struct CasimirSpace {
  std::vector<ex> basis{1};
  bool complete = false;
};

int degree_in(const Model& model, const ex& f) {
  return static_cast<int>(degree_of(terms_of(model, {f})[0]));
}

CasimirSpace casimirs_of(const Model& model, int degree, const search::Watch& watch) {
  CasimirSpace result;
  search::Request request;
  request.degree = degree;
  request.casimirs = true;
  const search::Report report = search::find_integrals(model, request, watch);
  result.complete = report.complete;
  for (const search::Found& found : report.found) {
    if (found.verdict != Verdict::proved) {
      result.complete = false;
      continue;
    }
    // Times every power: products of degree `degree` at most.
    const int own = degree_in(model, found.value);
    for (std::size_t k = 0; k < result.basis.size(); ++k) {
      const ex next = (result.basis[k] * found.value).expand();
      if (own > 0 && degree_in(model, next) <= degree) result.basis.push_back(next);
    }
  }
  return result;
}

std::vector<Difference> differences(const LinearCase& a, const LinearCase& b) {
  std::vector<Difference> result;
  if (a.dimension != b.dimension)
    return {{"dimension", std::to_string(a.dimension), std::to_string(b.dimension)}};
  std::map<std::string, std::string> of_b;
  for (auto& [name, value] : linear_invariants(b)) of_b.emplace(name, value);
  for (const auto& [name, value] : linear_invariants(a)) {
    const auto other = of_b.find(name);
    if (other != of_b.end() && other->second != value)
      result.push_back({name, value, other->second});
  }
  return result;
}

/// The map over A's symbols.
std::vector<ex> expressions_of(const Model& a, const LinearMap& map) {
  std::vector<ex> result;
  for (const auto& row : map.matrix) {
    ex sum = 0;
    for (std::size_t k = 0; k < row.size(); ++k) sum += row[k] * a.variables[k];
    result.push_back(sum);
  }
  return result;
}

/// The claims about the map, in a copy of A.
Model with_map(const Model& a, const Model& b, const std::vector<ex>& expressions,
               const std::optional<Identity>& hamiltonian) {
  Model model = a;
  model.maps = {{.name = "isomorphism",
                 .where = {},
                 .target = *b.poisson,
                 .expressions = expressions,
                 .on = {},
                 .to = {},
                 .image = {},
                 .inverses = {}}};
  model.identities.clear();
  if (hamiltonian) model.identities.push_back(*hamiltonian);
  return model;
}

Verdict verdict_of(const Model& model, ClaimKind kind, std::string& reason) {
  Candidates candidates;
  candidates.only = kind;
  Verdict worst = Verdict::proved;
  bool any = false;
  for (const Proof& proof : prove(model, candidates)) {
    if (proof.kind != kind) continue;
    any = true;
    if (proof.verdict == Verdict::proved && proof.where.empty()) continue;
    worst = Verdict::undecided;
    reason = fmt::format("a map was found but not proved ({}: {})", proof.name, proof.reason);
  }
  return any ? worst : Verdict::undecided;
}

/// Of the inverse of the map of `b` onto `a`.
std::optional<LinearMap> inverted(const LinearMap& map) {
  LinearMap result;
  const auto n = static_cast<unsigned>(map.matrix.size());
  RationalMatrix matrix(n, std::vector<cln::cl_RA>(n, 0));
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) {
      const ex& entry = map.matrix[i][j];
      if (!entry.info(GiNaC::info_flags::rational)) return std::nullopt;
      matrix[i][j] = cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(entry).to_cl_N());
    }
  }
  for (const auto& row : inverse(matrix)) {
    result.matrix.emplace_back();
    for (const cln::cl_RA& e : row) result.matrix.back().emplace_back(GiNaC::numeric(e));
  }
  return result;
}

class Relating {
 public:
  Relating(const Model& a, const Model& b, bool with_hamiltonian, const search::Watch& watch)
      : a_(a), b_(b), watch_(watch) {
    relation_.with_hamiltonian = with_hamiltonian;
    pair_.a = linear_case(a, with_hamiltonian);
    pair_.b = linear_case(b, with_hamiltonian);
  }

  Relation run() {
    relation_.differences = differences(pair_.a, pair_.b);
    if (!relation_.differences.empty()) {
      relation_.verdict = Verdict::refuted;
      const Difference& d = relation_.differences.front();
      relation_.reason = fmt::format("{}: {} and {}", d.name, d.first, d.second);
      return relation_;
    }
    if (relation_.with_hamiltonian) {
      const auto degree =
          std::max(degree_of(*pair_.a.hamiltonian), degree_of(*pair_.b.hamiltonian));
      casimirs_ = casimirs_of(a_, static_cast<int>(degree), watch_);
      pair_.casimirs = terms_of(a_, casimirs_.basis);
    }
    watch_.begin("linear maps");
    const MapSearch found = match(pair_, watch_);
    if (found.map) {
      describe(*found.map);
    } else if (found.none && (!relation_.with_hamiltonian || casimirs_.complete)) {
      relation_.verdict = Verdict::refuted;
      relation_.reason = "the equations for the map have no solution, even a complex one";
    } else if (!try_other_way()) {
      relation_.reason =
          "no map was found, the numbers that were compared agree, and the equations for all maps "
          "were not solved";
    }
    return relation_;
  }

 private:
  /// A map of B onto A, whose elements may be the simpler ones to search.
  bool try_other_way() {
    if (relation_.with_hamiltonian) return false;
    Pair other;
    other.a = pair_.b;
    other.b = pair_.a;
    const MapSearch found = match(other, watch_);
    if (!found.map) return false;
    const auto map = inverted(*found.map);
    if (!map) return false;
    describe(*map);
    return true;
  }

  void describe(const LinearMap& map) {
    relation_.expressions = expressions_of(a_, map);
    std::optional<Identity> identity;
    ex casimir_part = 0;
    if (relation_.with_hamiltonian) {
      for (std::size_t k = 0; k < map.multiples.size(); ++k)
        casimir_part += map.multiples[k] * casimirs_.basis[k];
      GiNaC::exmap image;
      for (std::size_t i = 0; i < b_.variables.size(); ++i)
        image[b_.variables[i]] = relation_.expressions[i];
      identity.emplace();
      identity->name = "Hamiltonian";
      identity->left = substituted(*b_.hamiltonian, image, a_.limits);
      identity->right = map.factor * *a_.hamiltonian + casimir_part;
    }
    std::vector<ex> all = relation_.expressions;
    all.insert(all.end(), {map.factor, casimir_part});
    FunctionRing ring(a_.symbols(), {}, all, a_.limits);
    for (std::size_t i = 0; i < relation_.expressions.size(); ++i)
      relation_.map.emplace_back(b_.variables[i].get_name(),
                                 ring.text(ring.convert(relation_.expressions[i])));
    if (relation_.with_hamiltonian) {
      relation_.factor = ring.text(ring.convert(map.factor));
      relation_.casimir_part = ring.text(ring.convert(casimir_part));
    }
    const Model model = with_map(a_, b_, relation_.expressions, identity);
    relation_.verdict = verdict_of(model, ClaimKind::map, relation_.reason);
    if (identity && relation_.verdict == Verdict::proved)
      relation_.verdict = verdict_of(model, ClaimKind::identity, relation_.reason);
  }

  const Model& a_;
  const Model& b_;
  const search::Watch& watch_;
  Pair pair_;
  CasimirSpace casimirs_;
  Relation relation_;
};

}  // namespace

Relation relate(const Model& a, const Model& b, bool with_hamiltonian, const search::Watch& watch) {
  if (with_hamiltonian && (!a.hamiltonian || !b.hamiltonian))
    throw ModelError("one of the cases has no Hamiltonian: only their brackets can be compared");
  return Relating(a, b, with_hamiltonian, watch).run();
}

}  // namespace casimir::structure

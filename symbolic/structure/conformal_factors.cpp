#include "symbolic/structure/conformal_factors.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "symbolic/search/modular/span.hpp"
#include "symbolic/structure/pencil_solver.hpp"

namespace casimir::structure {

void Cofactors::add(const Cofactor& cofactor) {
  if (std::ranges::find(found, cofactor) == found.end()) found.push_back(cofactor);
}

void Cofactors::leave_open(const std::string& why) {
  complete = false;
  reason = why;
}

void Cofactors::add_doubts(const Cofactors& others) {
  if (!others.complete) leave_open(others.reason);
  irrational = irrational || others.irrational;
  algebraic.insert(algebraic.end(), others.algebraic.begin(), others.algebraic.end());
}

namespace {

using search::Monomials;
using search::Watch;
using Ansatz = ConformalEquations::Ansatz;
using Motion = ConformalEquations::Motion;
using Powers = std::vector<unsigned long>;

std::vector<long> signed_powers(const Powers& powers) { return {powers.begin(), powers.end()}; }

/// Whether there is no T for it that is not zero.
bool excludes_roots(const ConformalEquations& equations, const Motion& motion,
                    const Monomials& monomials, const AlgebraicCofactor& f) {
  std::vector<Powers> unknown;
  std::vector<std::vector<Polynomial>> roots;
  for (const AlgebraicCofactor::Root& root : f.roots) {
    unknown.push_back(root.monomial);
    roots.push_back(root.coefficients);
  }
  const PolynomialRing larger(equations.system().ring().size() + unknown.size());
  return equations.has_no_solution_at_roots(
      equations.rows({motion, monomials, f.rational, unknown}, larger),
      equations.components() * monomials.size(), roots);
}

/// The factors of one ansatz: coefficients at vertices first, by cases that faces rule out early.
class FactorSearch {
 public:
  /// \param roots  coefficients of f beside those that are known
  FactorSearch(const ConformalEquations& equations, const Ansatz& ansatz, const Watch& watch,
               std::vector<AlgebraicCofactor::Root> roots = {});
  Cofactors run();

 private:
  struct Vertex {
    Powers monomial;
    std::vector<Cofactor> values;  ///< of its coefficient, or it is a root of one of these
    std::vector<AlgebraicCofactor::Root> roots;
  };
  /// A face whose part of f is known as soon as some vertices have values.
  struct Test {
    search::NewtonFaces::Face face;
    Motion motion;
  };
  const PolynomialRing& ring() const { return equations_.system().ring(); }
  std::vector<Cofactor> values_at(const Powers& monomial, const std::vector<Polynomial>& d) const;
  std::optional<Vertex> values_on_a_face(const Powers& monomial) const;
  bool is_excluded_on_faces(std::size_t last, const AlgebraicCofactor& f) const;
  void assign_roots(std::size_t next, const AlgebraicCofactor& f);
  Cofactors unknowns_of(const Motion& motion, const Cofactor& f,
                        const std::vector<Powers>& unknown) const;
  void collect_tests();
  Cofactor part_on(const search::NewtonFaces::Face& face, const Cofactor& f) const;
  bool is_excluded(const Cofactor& f) const;
  void assign(std::size_t next, const Cofactor& f);
  void solve(const Cofactor& f);

  const ConformalEquations& equations_;
  const Ansatz& ansatz_;
  const Watch& watch_;
  std::vector<AlgebraicCofactor::Root> known_roots_;
  search::NewtonFaces faces_;
  std::vector<Powers> allowed_;   ///< monomials of f
  std::vector<Vertex> vertices_;  ///< and what is alone on a face
  std::vector<Powers> others_;
  std::vector<std::vector<Test>> tests_;  ///< by the last vertex on the face
  std::size_t cases_ = 0;                 ///< of roots that were tried
  Cofactors result_;
};

FactorSearch::FactorSearch(const ConformalEquations& equations, const Ansatz& ansatz,
                           const Watch& watch, std::vector<AlgebraicCofactor::Root> roots)
    : equations_(equations),
      ansatz_(ansatz),
      watch_(watch),
      known_roots_(std::move(roots)),
      faces_(ansatz.motion.field, equations.dimension()) {
  for (const Powers& monomial : ansatz.unknown)
    if (faces_.allows(signed_powers(monomial))) allowed_.push_back(monomial);
  for (const Powers& monomial : allowed_) {
    if (const std::vector<Polynomial>* d = faces_.vertex(signed_powers(monomial)))
      vertices_.push_back({monomial, values_at(monomial, *d), {}});
    else if (std::optional<Vertex> own = values_on_a_face(monomial))
      vertices_.push_back(std::move(*own));
    else
      others_.push_back(monomial);
  }
  collect_tests();
}

/// D.b, and less or more a.D: see `NewtonFaces`.
std::vector<Cofactor> FactorSearch::values_at(const Powers& monomial,
                                              const std::vector<Polynomial>& d) const {
  const bool form = equations_.lift().type().form;
  Polynomial step(ring());
  for (std::size_t i = 0; i < d.size(); ++i)
    step += d[i].scaled(static_cast<long>(monomial[i]) * (form ? 1 : -1));
  std::set<std::vector<long>> frames;
  for (const std::vector<std::size_t>& list : equations_.lift().indices()) {
    for (std::size_t m = 0; m < ansatz_.monomials.size(); ++m) {
      std::vector<long> b(ansatz_.monomials[m], ansatz_.monomials[m] + d.size());
      for (const std::size_t i : list) b[i] += form ? 1 : -1;
      frames.insert(std::move(b));
    }
  }
  Cofactors values;
  for (const std::vector<long>& b : frames) {
    Polynomial sum(ring());
    for (std::size_t i = 0; i < d.size(); ++i) sum += d[i].scaled(b[i]);
    values.add({sum, ring().constant(1)});
    values.add({sum + step, ring().constant(1)});
  }
  return values.found;
}

void FactorSearch::collect_tests() {
  tests_.resize(vertices_.size());
  for (const search::NewtonFaces::Face& face : faces_.faces()) {
    const auto on_face = [&](const Powers& m) { return face.contains(signed_powers(m)); };
    if (std::ranges::any_of(others_, on_face)) continue;
    std::size_t last = vertices_.size(), count = 0;
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      if (!on_face(vertices_[v].monomial)) continue;
      last = v;
      ++count;
    }
    if (count > 0) tests_[last].push_back({face, equations_.motion_of(ansatz_.motion, face)});
  }
}

Cofactor FactorSearch::part_on(const search::NewtonFaces::Face& face, const Cofactor& f) const {
  TermCollector collector(ring());
  for (const auto& [number, exponents] : f.top.term_list()) {
    const std::vector<long> own(
        exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(equations_.dimension()));
    if (face.contains(own)) collector.add(number, exponents);
  }
  return {collector.finish(), f.bottom};
}

bool FactorSearch::is_excluded(const Cofactor& f) const {
  const Ansatz own{ansatz_.motion, ansatz_.monomials, f, {}};
  return equations_.has_no_solution(equations_.rows(own, ring()),
                                    equations_.components() * own.monomials.size());
}

void FactorSearch::assign(std::size_t next, const Cofactor& f) {
  watch_.tick(0.5);
  if (next > 0) {
    for (const Test& test : tests_[next - 1]) {
      const Ansatz own{test.motion, ansatz_.monomials, part_on(test.face, f), {}};
      if (equations_.has_no_solution(equations_.rows(own, ring()),
                                     equations_.components() * own.monomials.size()))
        return;
    }
  }
  if (next == vertices_.size()) {
    solve(f);
    return;
  }
  const Polynomial monomial = equations_.monomial(vertices_[next].monomial);
  for (const Cofactor& value : vertices_[next].values)
    assign(next + 1, sum_of(f, {value.top * monomial, value.bottom}));
}

/// Where it is the only unknown of a face, the equations of the face have finitely many values.
std::optional<FactorSearch::Vertex> FactorSearch::values_on_a_face(const Powers& monomial) const {
  for (const search::NewtonFaces::Face& face : faces_.faces()) {
    if (!face.contains(signed_powers(monomial))) continue;
    const auto is_other = [&](const Powers& own) {
      return own != monomial && face.contains(signed_powers(own));
    };
    const auto is_root = [&](const auto& own) { return is_other(own.monomial); };
    if (std::ranges::any_of(allowed_, is_other) || std::ranges::any_of(known_roots_, is_root))
      continue;
    const Cofactor known = part_on(face, ansatz_.known);
    if (!known.is_zero()) continue;
    const Cofactors values =
        unknowns_of(equations_.motion_of(ansatz_.motion, face), known, {monomial});
    if (!values.complete || values.irrational) continue;
    Vertex result{monomial, {}, {}};
    for (Cofactor own : values.found) {
      own.top.divide(equations_.monomial(monomial), &own.top);
      result.values.push_back(std::move(own));
    }
    for (const AlgebraicCofactor& own : values.algebraic) result.roots.push_back(own.roots.front());
    return result;
  }
  return std::nullopt;
}

/// All f = known + sum of unknown coefficients times monomials.
Cofactors FactorSearch::unknowns_of(const Motion& motion, const Cofactor& f,
                                    const std::vector<Powers>& unknown) const {
  Cofactors result;
  const std::size_t first = ring().size();
  const PolynomialRing larger(first + unknown.size());
  const Ansatz own{motion, ansatz_.monomials, f, unknown};
  const std::size_t columns = equations_.components() * own.monomials.size();
  const PencilSolutions values =
      solve_pencil(equations_.rows(own, larger), columns, larger, first, watch_);
  if (!values.complete) result.leave_open(values.reason);
  result.irrational = values.irrational;
  for (const Polynomial& condition : values.roots) {
    AlgebraicCofactor algebraic{f, {{unknown.front(), {}}}};
    for (const Polynomial& coefficient : condition.coefficients(first))
      algebraic.roots[0].coefficients.push_back(in_ring(coefficient, ring()));
    if (!excludes_roots(equations_, motion, ansatz_.monomials, algebraic))
      result.algebraic.push_back(std::move(algebraic));
  }
  for (const std::vector<PencilValue>& found : values.found) {
    Cofactor sum = f;
    for (std::size_t k = 0; k < unknown.size(); ++k) {
      const Polynomial top = in_ring(found[k].top, ring());
      sum = sum_of(sum,
                   lowest(top * equations_.monomial(unknown[k]), in_ring(found[k].bottom, ring())));
    }
    const Ansatz there{motion, ansatz_.monomials, sum, {}};
    if (!equations_.has_no_solution(equations_.rows(there, ring()), columns)) result.add(sum);
  }
  return result;
}

/// By the faces whose part of f is known once this vertex has a value.
bool FactorSearch::is_excluded_on_faces(std::size_t last, const AlgebraicCofactor& f) const {
  return std::ranges::any_of(tests_[last], [&](const Test& test) {
    AlgebraicCofactor own{part_on(test.face, f.rational), {}};
    for (const AlgebraicCofactor::Root& root : f.roots)
      if (test.face.contains(signed_powers(root.monomial))) own.roots.push_back(root);
    return excludes_roots(equations_, test.motion, ansatz_.monomials, own);
  });
}

/// The same with at least one coefficient that is a root; these were not seen to be impossible.
void FactorSearch::assign_roots(std::size_t next, const AlgebraicCofactor& f) {
  constexpr std::size_t kMostCasesOfRoots = 3000;
  if (result_.irrational || ++cases_ > kMostCasesOfRoots) {
    result_.irrational = true;
    return;
  }
  watch_.tick(0.5);
  if (next > 0 && is_excluded_on_faces(next - 1, f)) return;
  if (next < vertices_.size()) {
    const Vertex& own = vertices_[next];
    const bool more =
        std::any_of(vertices_.begin() + static_cast<std::ptrdiff_t>(next) + 1, vertices_.end(),
                    [](const Vertex& v) { return !v.roots.empty(); });
    const Polynomial monomial = equations_.monomial(own.monomial);
    if (more || !f.roots.empty()) {
      for (const Cofactor& value : own.values)
        assign_roots(next + 1, {sum_of(f.rational, {value.top * monomial, value.bottom}), f.roots});
    }
    for (const AlgebraicCofactor::Root& root : own.roots) {
      AlgebraicCofactor there = f;
      there.roots.push_back(root);
      assign_roots(next + 1, there);
    }
    return;
  }
  if (f.roots.empty()) return;
  watch_.tick(0.5);
  if (!others_.empty())
    result_.irrational = true;
  else if (!excludes_roots(equations_, ansatz_.motion, ansatz_.monomials, f))
    result_.algebraic.push_back(f);
}

/// What is no vertex.
void FactorSearch::solve(const Cofactor& f) {
  if (others_.empty()) {
    if (!is_excluded(f)) result_.add(f);
    return;
  }
  const Cofactors own = unknowns_of(ansatz_.motion, f, others_);
  for (const Cofactor& cofactor : own.found) result_.add(cofactor);
  result_.add_doubts(own);
}

Cofactors FactorSearch::run() {
  for (const auto& [number, exponents] : ansatz_.known.top.term_list()) {
    const std::vector<long> own(
        exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(equations_.dimension()));
    if (!faces_.allows(own)) return {};
  }
  for (const AlgebraicCofactor::Root& root : known_roots_)
    if (!faces_.allows(signed_powers(root.monomial))) return {};
  if (known_roots_.empty()) assign(0, ansatz_.known);
  assign_roots(0, {ansatz_.known, known_roots_});
  return std::move(result_);
}

std::vector<Powers> monomials_of(const ConformalEquations& equations, int degree) {
  std::vector<Powers> result;
  if (degree < 0) return result;
  const Monomials all = search::all_monomials(std::vector<int>(equations.dimension(), 1), degree);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all.degree(i) == degree) result.emplace_back(all[i], all[i] + all.variables());
  return result;
}

Cofactor zero_of(const ConformalEquations& equations) {
  const PolynomialRing& ring = equations.system().ring();
  return {Polynomial(ring), ring.constant(1)};
}

/// The parts of the highest or the lowest degree that f can have, by those of the motion.
Cofactors end_factors(const ConformalEquations& equations, int field_degree, int degree,
                      const Watch& watch) {
  Cofactors result;
  const Motion motion = equations.motion_of(field_degree);
  for (int e = 0; e <= degree; ++e) {
    Monomials own(equations.dimension());
    for (const Powers& powers : monomials_of(equations, e))
      own.add({powers.begin(), powers.end()}, e);
    const Ansatz ansatz{motion, own, zero_of(equations), monomials_of(equations, field_degree - 1)};
    const Cofactors part = FactorSearch(equations, ansatz, watch).run();
    for (const Cofactor& cofactor : part.found) result.add(cofactor);
    result.add_doubts(part);
  }
  return result;
}

/// Sums of a part of the highest degree and one of the lowest, of which one has roots at least.
std::vector<AlgebraicCofactor> algebraic_sums(const Cofactors& tops, const Cofactors& bottoms) {
  const auto all = [](const Cofactors& own) {
    std::vector<AlgebraicCofactor> result = own.algebraic;
    for (const Cofactor& cofactor : own.found) result.push_back({cofactor, {}});
    return result;
  };
  std::vector<AlgebraicCofactor> result;
  for (const AlgebraicCofactor& top : all(tops)) {
    for (const AlgebraicCofactor& bottom : all(bottoms)) {
      if (top.roots.empty() && bottom.roots.empty()) continue;
      AlgebraicCofactor sum{sum_of(top.rational, bottom.rational), top.roots};
      sum.roots.insert(sum.roots.end(), bottom.roots.begin(), bottom.roots.end());
      result.push_back(std::move(sum));
    }
  }
  return result;
}

}  // namespace

Cofactors constant_factors(const ConformalEquations& equations, int degree, const Watch& watch) {
  const Ansatz ansatz{equations.motion(), equations.basis(degree).monomials, zero_of(equations),
                      monomials_of(equations, 0)};
  return FactorSearch(equations, ansatz, watch).run();
}

Cofactors conformal_factors(const ConformalEquations& equations, int degree, const Watch& watch) {
  const int highest = equations.field_degree(), lowest = equations.lowest_degree();
  if (highest == 0) return {};  // L_X lowers the degree: f = 0
  const Cofactors tops = end_factors(equations, highest, degree, watch);
  if (lowest == highest) return tops;
  Cofactors bottoms;
  if (lowest > 0)
    bottoms = end_factors(equations, lowest, degree, watch);
  else
    bottoms.add(zero_of(equations));
  std::vector<Powers> between;
  for (int k = lowest; k < highest - 1; ++k)
    for (Powers& own : monomials_of(equations, k)) between.push_back(std::move(own));
  Cofactors result;
  result.add_doubts(tops);
  result.add_doubts(bottoms);
  result.algebraic.clear();  // of parts of f
  const Monomials monomials = equations.basis(degree).monomials;
  for (const Cofactor& top : tops.found) {
    for (const Cofactor& bottom : bottoms.found) {
      const Ansatz ansatz{equations.motion(), monomials, sum_of(top, bottom), between};
      const Cofactors whole = FactorSearch(equations, ansatz, watch).run();
      for (const Cofactor& cofactor : whole.found) result.add(cofactor);
      result.add_doubts(whole);
    }
  }
  for (const AlgebraicCofactor& sum : algebraic_sums(tops, bottoms)) {
    const Ansatz ansatz{equations.motion(), monomials, sum.rational, between};
    result.add_doubts(FactorSearch(equations, ansatz, watch, sum.roots).run());
  }
  return result;
}

}  // namespace casimir::structure

#include "symbolic/structure/relate/matching.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "symbolic/error.hpp"
#include "symbolic/structure/relate/elements.hpp"
#include "symbolic/structure/relate/normal_basis.hpp"

namespace casimir::structure {
namespace {

using cln::cl_RA;
using Vector = Element;

constexpr std::size_t kSolvable = 9;       ///< unknowns of which equations are solved at once
constexpr std::size_t kMostGuesses = 300;  ///< families that are looked at
constexpr std::size_t kMostVectors = 20000;
constexpr std::size_t kMostImages = 100;  ///< of one element

RationalMatrix zeros(std::size_t n) { return RationalMatrix(n, Vector(n, 0)); }

/// The matrix of second derivatives at the origin.
RationalMatrix hessian(const Terms& f, std::size_t n) {
  RationalMatrix result = zeros(n);
  for (const auto& [number, exponents] : of_degree(f, 2)) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < n; ++i)
      for (unsigned long e = 0; e < exponents[i]; ++e) places.push_back(i);
    result[places[0]][places[1]] = result[places[0]][places[1]] + number;
    result[places[1]][places[0]] = result[places[1]][places[0]] + number;
  }
  return result;
}

/// The slope at the origin.
Vector slope(const Terms& f, std::size_t n) {
  Vector result(n, 0);
  for (const auto& [number, exponents] : of_degree(f, 1))
    for (std::size_t i = 0; i < n; ++i)
      if (exponents[i] > 0) result[i] = number;
  return result;
}

bool is_homogeneous(const LinearCase& c, unsigned long degree) {
  return std::all_of(c.upper.begin(), c.upper.end(), [&](const Terms& component) {
    return of_degree(component, degree).size() == component.size();
  });
}

Vector times(const RationalMatrix& m, const Vector& v) {
  Vector result(m.size(), 0);
  for (std::size_t i = 0; i < m.size(); ++i)
    for (std::size_t j = 0; j < v.size(); ++j) result[i] = result[i] + m[i][j] * v[j];
  return result;
}

bool is_null(const Vector& v) {
  return std::all_of(v.begin(), v.end(), [](const cl_RA& e) { return cln::zerop(e); });
}

class Matcher {
 public:
  Matcher(const Pair& pair, const search::Watch& watch)
      : pair_(pair),
        watch_(watch),
        n_(pair.a.dimension),
        a_(pair.a),
        b_(pair.b),
        linear_(is_homogeneous(pair.a, 1) && is_homogeneous(pair.b, 1)),
        constant_(is_homogeneous(pair.a, 0) && is_homogeneous(pair.b, 0)) {}

  MapSearch run();

 private:
  /// What is known of c and the m_k.
  struct Known {
    std::optional<cl_RA> factor;
    std::vector<std::optional<cl_RA>> multiples;
  };
  std::size_t unknown(std::size_t i, std::size_t a) const { return i * n_ + a; }
  void keep_subspaces(LinearFamily& family) const;
  bool take_to(LinearFamily& family, const Vector& v, const Vector& w) const;
  bool intertwine(LinearFamily& family, const RationalMatrix& of_b, const RationalMatrix& of_a,
                  bool transpose) const;
  /// The values that were found, and whether there are no others, even complex ones.
  struct Spectra {
    std::vector<Known> values;
    bool all = true;
  };
  Spectra spectra() const;
  std::vector<Polynomial> equations_of_traces(const PolynomialRing& ring,
                                              const std::vector<std::size_t>& quadratic) const;
  std::optional<Known> known_of(const std::vector<GiNaC::ex>& values,
                                const std::vector<std::size_t>& quadratic) const;
  bool try_spectra(const LinearFamily& family);
  bool bind_hamiltonian(LinearFamily& family, const Known& known) const;
  bool take_all_to(LinearFamily& family, std::vector<std::pair<Vector, Vector>> pairs,
                   const RationalMatrix& of_b, const RationalMatrix& of_a) const;
  RationalMatrix constant_bracket(const LinearCase& c) const;
  RationalMatrix quadratic_of_a(const Known& known) const;
  bool may_be_regular(const LinearFamily& family) const;
  bool search(const LinearFamily& family, const Known& known, std::size_t depth);
  bool solve(const LinearFamily& family, const Known& known);
  const std::vector<Vector>& images_of(const Vector& v);

  const Pair& pair_;
  const search::Watch& watch_;
  std::size_t n_;
  ElementSide a_, b_;
  bool linear_, constant_;
  std::size_t guesses_ = 0;
  std::map<Vector, std::vector<Vector>, ElementLess> images_;
  std::map<cl_RA, std::vector<Vector>, NumberLess> small_;  ///< by the value of the Killing form
  MapSearch result_;
};

/// The image of each characteristic subspace lies in its counterpart.
void Matcher::keep_subspaces(LinearFamily& family) const {
  for (std::size_t s = 0; s < std::min(a_.subspaces().size(), b_.subspaces().size()); ++s) {
    const RationalMatrix& of_a = a_.subspaces()[s];
    if (of_a.size() == n_ || of_a.size() != b_.subspaces()[s].size()) continue;
    const RationalMatrix forms = of_a.empty() ? RationalMatrix{} : null_space(of_a, n_);
    for (const Vector& v : b_.subspaces()[s]) {
      for (const Vector& form : forms) {
        LinearFamily::Row row;
        for (std::size_t i = 0; i < n_; ++i)
          for (std::size_t k = 0; k < n_; ++k)
            if (!cln::zerop(v[i]) && !cln::zerop(form[k])) row[unknown(i, k)] = v[i] * form[k];
        if (!row.empty()) family.add(std::move(row), 0);
      }
    }
  }
}

/// T takes the element v of `b` to w of `a`, and so [v, u] to [w, T u] for all u.
bool Matcher::take_to(LinearFamily& family, const Vector& v, const Vector& w) const {
  for (std::size_t k = 0; k < n_; ++k) {
    LinearFamily::Row row;
    for (std::size_t i = 0; i < n_; ++i)
      if (!cln::zerop(v[i])) row[unknown(i, k)] = v[i];
    if (row.empty() ? !cln::zerop(w[k]) : !family.add(std::move(row), w[k])) return false;
  }
  return intertwine(family, adjoint(b_.constants(), v), adjoint(a_.constants(), w), true);
}

/// T^t B = A T^t, or T A = B T without `transpose`.
bool Matcher::intertwine(LinearFamily& family, const RationalMatrix& of_b,
                         const RationalMatrix& of_a, bool transpose) const {
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = 0; j < n_; ++j) {
      LinearFamily::Row row;
      const auto add = [&](std::size_t place, const cl_RA& number) {
        if (cln::zerop(number)) return;
        cl_RA& sum = row.try_emplace(place, 0).first->second;
        sum = sum + number;
        if (cln::zerop(sum)) row.erase(place);
      };
      for (std::size_t k = 0; k < n_; ++k) {
        if (transpose) {
          add(unknown(k, i), of_b[k][j]);
          add(unknown(j, k), -of_a[i][k]);
        } else {
          add(unknown(i, k), of_a[k][j]);
          add(unknown(k, j), -of_b[i][k]);
        }
      }
      if (!row.empty() && !family.add(std::move(row), 0)) return false;
    }
  }
  return true;
}

RationalMatrix Matcher::constant_bracket(const LinearCase& c) const {
  RationalMatrix result = zeros(n_);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j)
      for (const auto& [number, exponents] : of_degree(c.bracket(i, j), 0)) result[i][j] = number;
  return result;
}

/// The equations for c, the m_k and 1/c, in this order, that the traces of powers are the same.
std::vector<Polynomial> Matcher::equations_of_traces(
    const PolynomialRing& ring, const std::vector<std::size_t>& quadratic) const {
  using Matrix = std::vector<std::vector<Polynomial>>;
  const auto constant = [&](const RationalMatrix& m) {
    Matrix result;
    for (const Vector& row : m) {
      result.emplace_back();
      for (const cl_RA& e : row) result.back().push_back(ring.constant(e));
    }
    return result;
  };
  const auto multiply = [&](const Matrix& p, const Matrix& q) {
    Matrix result(n_, std::vector<Polynomial>(n_, Polynomial(ring)));
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < n_; ++k)
        if (!p[i][k].is_zero())
          for (std::size_t j = 0; j < n_; ++j) result[i][j] += p[i][k] * q[k][j];
    return result;
  };
  const RationalMatrix qa = hessian(*pair_.a.hamiltonian, n_),
                       qb = hessian(*pair_.b.hamiltonian, n_);
  Matrix of_a, of_b;
  if (linear_) {
    Matrix q(n_, std::vector<Polynomial>(n_, Polynomial(ring)));
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        q[i][j] = ring.variable(0).scaled(qa[i][j]);
        for (std::size_t k = 0; k < quadratic.size(); ++k)
          q[i][j] += ring.variable(1 + k).scaled(hessian(pair_.casimirs[quadratic[k]], n_)[i][j]);
      }
    }
    of_a = multiply(q, constant(killing_form(a_.constants())));
    of_b = constant(product(qb, killing_form(b_.constants())));
  } else {
    of_a = constant(product(constant_bracket(pair_.a), qa));
    for (auto& row : of_a)
      for (Polynomial& e : row) e *= ring.variable(0);
    of_b = constant(product(constant_bracket(pair_.b), qb));
  }
  std::vector<Polynomial> equations{ring.variable(0) * ring.variable(ring.size() - 1) -
                                    ring.constant(1)};
  Matrix power_a = of_a, power_b = of_b;
  for (std::size_t m = 1; m <= n_; ++m) {
    Polynomial sum(ring);
    for (std::size_t i = 0; i < n_; ++i) sum += power_a[i][i] - power_b[i][i];
    if (!sum.is_zero()) equations.push_back(sum);
    power_a = multiply(power_a, of_a);
    power_b = multiply(power_b, of_b);
  }
  return equations;
}

/// The factor and the multiples, where they are rational and the factor is not 0.
std::optional<Matcher::Known> Matcher::known_of(const std::vector<GiNaC::ex>& values,
                                                const std::vector<std::size_t>& quadratic) const {
  const auto rational = [](const GiNaC::ex& value) -> std::optional<cl_RA> {
    if (!value.info(GiNaC::info_flags::rational)) return std::nullopt;
    return cln::the<cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
  };
  Known known;
  known.multiples.resize(pair_.casimirs.size());
  known.factor = rational(values[0]);
  if (!known.factor || cln::zerop(*known.factor)) return std::nullopt;
  for (std::size_t k = 0; k < quadratic.size(); ++k) {
    known.multiples[quadratic[k]] = rational(values[1 + k]);
    if (!known.multiples[quadratic[k]]) return std::nullopt;
  }
  return known;
}

/// The values of c and of the multiples of quadratic Casimir functions that the spectra allow.
///
/// Theorem: with Hessians A, B at the origin and A' = c A + sum m_k C_k'', an isomorphism T has
/// T^t B T = A'. For a linear bracket the Killing forms obey K_B = T K_A T^t, so that
/// T^t (B K_B) = (A' K_A) T^t; for a constant bracket Q = T P T^t, so that (Q B) T = T (P A'). So
/// the operators have the same traces of powers. The C_k are all quadratic Casimir functions.
Matcher::Spectra Matcher::spectra() const {
  std::vector<std::size_t> quadratic;
  if (linear_)
    for (std::size_t k = 0; k < pair_.casimirs.size(); ++k)
      if (degree_of(pair_.casimirs[k]) == 2) quadratic.push_back(k);
  const PolynomialRing ring(quadratic.size() + 2);  // c, the multiples, 1/c
  const std::vector<Polynomial> equations = equations_of_traces(ring, quadratic);
  std::vector<std::size_t> unknowns;
  for (std::size_t i = 0; i < ring.size(); ++i) unknowns.push_back(i);
  Spectra spectra;
  std::vector<Known>& result = spectra.values;
  for (const search::Branch& branch : search::solve_system(equations, unknowns, watch_)) {
    spectra.all = spectra.all && branch.decided && branch.rest.empty() &&
                  branch.solved.size() == unknowns.size();
    if (!branch.decided) continue;
    find_real_values(branch, unknowns, ring.size(), [&](const std::vector<GiNaC::ex>& values) {
      const std::optional<Known> known = known_of(values, quadratic);
      if (!known) return false;
      const bool again = std::any_of(result.begin(), result.end(), [&](const Known& other) {
        return other.factor == known->factor && other.multiples == known->multiples;
      });
      if (!again) result.push_back(*known);
      return result.size() > 20;  // several members of each family
    });
  }
  return spectra;
}

/// The quadratic part of c H_A + sum m_k C_k.
RationalMatrix Matcher::quadratic_of_a(const Known& known) const {
  RationalMatrix result = hessian(*pair_.a.hamiltonian, n_);
  for (Vector& row : result)
    for (cl_RA& e : row) e = e * *known.factor;
  for (std::size_t k = 0; k < pair_.casimirs.size(); ++k) {
    if (!known.multiples[k]) continue;
    const RationalMatrix own = hessian(pair_.casimirs[k], n_);
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        result[i][j] = result[i][j] + *known.multiples[k] * own[i][j];
  }
  return result;
}

/// What T does to the quadratic and linear parts of the Hamiltonians.
bool Matcher::bind_hamiltonian(LinearFamily& family, const Known& known) const {
  const RationalMatrix qa = quadratic_of_a(known), qb = hessian(*pair_.b.hamiltonian, n_);
  Vector of_a = slope(*pair_.a.hamiltonian, n_);
  for (cl_RA& e : of_a) e = e * *known.factor;
  const bool linear_casimir = std::any_of(pair_.casimirs.begin(), pair_.casimirs.end(),
                                          [](const Terms& c) { return degree_of(c) == 1; });
  if (constant_) {
    if (!intertwine(family, product(constant_bracket(pair_.b), qb),
                    product(constant_bracket(pair_.a), qa), false))
      return false;
    return linear_casimir || take_to(family, slope(*pair_.b.hamiltonian, n_), of_a);
  }
  const RationalMatrix operator_b = product(qb, killing_form(b_.constants())),
                       operator_a = product(qa, killing_form(a_.constants()));
  if (!intertwine(family, operator_b, operator_a, true)) return false;
  if (linear_casimir) return true;
  return take_all_to(family, {{slope(*pair_.b.hamiltonian, n_), of_a}}, operator_b, operator_a);
}

/// T takes the first of each pair to the second, and what brackets and operators make of them.
bool Matcher::take_all_to(LinearFamily& family, std::vector<std::pair<Vector, Vector>> pairs,
                          const RationalMatrix& of_b, const RationalMatrix& of_a) const {
  RationalMatrix span;
  for (std::size_t p = 0; p < pairs.size() && span.size() < n_; ++p) {
    const auto [v, w] = pairs[p];
    if (is_null(v) && is_null(w)) continue;
    RationalMatrix more = span;
    more.push_back(v);
    if (!take_to(family, v, w)) return false;
    if (rank(more) == span.size()) continue;
    span = std::move(more);
    pairs.emplace_back(times(of_b, v), times(of_a, w));
    for (std::size_t q = 0; q < p; ++q)
      pairs.emplace_back(commutator(b_.constants(), pairs[q].first, v),
                         commutator(a_.constants(), pairs[q].second, w));
  }
  return true;
}

bool Matcher::solve(const LinearFamily& family, const Known& known) {
  const MapSearch own = solve_family(pair_, family, known.factor, known.multiples, watch_);
  if (!own.map) return false;
  result_.map = own.map;
  return true;
}

/// Small elements of `a` that v may be taken to: with the same value of the Killing form, which is
/// soon computed, and of those with the same fingerprint.
const std::vector<Vector>& Matcher::images_of(const Vector& v) {
  static const std::vector<Vector> none;
  if (small_.empty()) {
    int height = 1;
    const auto count = [&](int h) { return std::pow(2.0 * h + 1, static_cast<double>(n_)); };
    while (height < 6 && count(height + 1) <= kMostVectors) ++height;
    if (count(height) > kMostVectors) return none;
    const RationalMatrix form = killing_form(a_.constants());
    for (Vector& w : small_elements(n_, height)) small_[value_of(form, w)].push_back(std::move(w));
  }
  const auto known = images_.find(v);
  if (known != images_.end()) return known->second;
  std::vector<Vector>& images = images_[v];
  const auto alike = small_.find(value_of(killing_form(b_.constants()), v));
  if (alike == small_.end()) return images;
  const Vector wanted = b_.fingerprint(v);
  for (const Vector& w : alike->second) {
    watch_.tick(0.5);
    if (a_.fingerprint(w) == wanted) images.push_back(w);
    if (images.size() >= kMostImages) break;
  }
  return images;
}

/// Whether some member has a determinant that is not zero: one with values in no simple relation.
/// Where it has none by chance, a family is lost, and with it perhaps a map, but no proof.
bool Matcher::may_be_regular(const LinearFamily& family) const {
  RationalMatrix matrix = zeros(n_);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t k = 0; k < n_; ++k) {
      const auto [constant, row] = family.value(unknown(i, k));
      matrix[i][k] = constant;
      for (const auto& [place, number] : row) {
        const auto size = static_cast<long>(place + 2);
        matrix[i][k] = matrix[i][k] + number * cln::cl_RA(size * size * size % 101 + 1);
      }
    }
  }
  return rank(matrix) == n_;
}

/// Elements of `b` one after the other are given images, until the rest can be solved.
bool Matcher::search(const LinearFamily& family, const Known& known, std::size_t depth) {
  watch_.tick(0.5);
  if (++guesses_ > kMostGuesses) return false;
  if (family.free().size() <= kSolvable && solve(family, known)) return true;
  if (constant_ || depth >= n_) return false;
  // The element whose images are the fewest: others follow from it.
  Vector best;
  std::size_t fewest = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    Vector v(n_, 0);
    v[i] = 1;
    const bool fixed = [&] {
      for (std::size_t k = 0; k < n_; ++k)
        if (!family.value(unknown(i, k)).second.empty()) return false;
      return true;
    }();
    const std::size_t count = fixed ? 0 : images_of(v).size();
    if (count == 0 || (fewest > 0 && count >= fewest)) continue;
    best = v;
    fewest = count;
  }
  if (best.empty()) return false;
  constexpr std::size_t kImages = 12;  // of each element: others are their transforms, as a rule
  std::size_t tried = 0;
  for (const Vector& w : images_of(best)) {
    LinearFamily own = family;
    if (!take_to(own, best, w) || !may_be_regular(own)) continue;
    if (search(own, known, depth + 1)) return true;
    if (++tried >= kImages || guesses_ > kMostGuesses) return false;
  }
  return false;
}

/// Whether that settles it: with a map, or with the proof that there is none.
bool Matcher::try_spectra(const LinearFamily& family) {
  const Spectra spectra = this->spectra();
  bool none = spectra.all;
  for (const Known& own : spectra.values) {
    LinearFamily bound = family;
    if (!bind_hamiltonian(bound, own)) continue;  // no map for these values
    guesses_ = 0;
    if (bound.free().size() <= kSolvable) {
      const MapSearch search = solve_family(pair_, bound, own.factor, own.multiples, watch_);
      if (search.map) {
        result_.map = search.map;
        return true;
      }
      if (search.none) continue;
    }
    none = false;
    if (search(bound, own, 0)) return true;
  }
  result_.none = none;
  return none;
}

MapSearch Matcher::run() {
  LinearFamily family(n_ * n_);
  Known known;
  known.multiples.resize(pair_.casimirs.size());
  keep_subspaces(family);
  // Each degree of the Hamiltonians has Casimir functions of its own then.
  const bool homogeneous =
      std::all_of(pair_.casimirs.begin(), pair_.casimirs.end(),
                  [](const Terms& c) { return of_degree(c, degree_of(c)).size() == c.size(); });
  if (pair_.with_hamiltonian() && homogeneous && (linear_ || constant_) && try_spectra(family))
    return result_;
  guesses_ = 0;
  if (constant_ && !pair_.with_hamiltonian()) {
    const RationalMatrix to_a = normal_basis(constant_bracket(pair_.a)),
                         to_b = normal_basis(constant_bracket(pair_.b));
    const RationalMatrix matrix = product(inverse(to_b), to_a);
    result_.map.emplace();
    for (const Vector& row : matrix) {
      result_.map->matrix.emplace_back();
      for (const cl_RA& e : row) result_.map->matrix.back().emplace_back(GiNaC::numeric(e));
    }
    return result_;
  }
  if (search(family, known, 0)) return result_;
  constexpr std::size_t kMost = 16;
  if (family.free().size() <= kMost) return solve_family(pair_, family, {}, {}, watch_);
  return result_;
}

}  // namespace

MapSearch match(const Pair& pair, const search::Watch& watch) { return Matcher(pair, watch).run(); }

}  // namespace casimir::structure

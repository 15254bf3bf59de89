// Polynomial and rational integrals and densities of a rational map: linear algebra modulo a prime
// at random points, functions from it by rational reconstruction, and a proof for each of them.
#include "symbolic/discrete/search_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/discrete/jet_field.hpp"
#include "symbolic/discrete/minors.hpp"
#include "symbolic/discrete/modular_kernel.hpp"
#include "symbolic/discrete/modular_program.hpp"
#include "symbolic/discrete/prove_candidate.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/modular/monomials.hpp"

namespace casimir::discrete {
namespace {

using GiNaC::ex;
using Row = std::vector<Element>;

/// An element of the field with the operators that `maximal_minors` uses.
struct Scalar {
  Element value = 0;
  bool is_zero() const { return value == 0; }
  Scalar operator-() const { return {PrimeField().subtract(0, value)}; }
  Scalar& operator+=(const Scalar& other) {
    value = PrimeField().add(value, other.value);
    return *this;
  }
};

class Search {
 public:
  Search(const MapModel& map, int degree, const search::Watch& watch)
      : map_(map),
        watch_(watch),
        degree_(degree),
        next_(map.base.symbols(), map.next),
        monomials_(search::all_monomials(std::vector<int>(map.base.variables.size(), 1), degree)),
        ring_(map.base.symbols(), {}, {}, map.base.limits) {
    for (const GiNaC::symbol& p : map.base.parameters) {
      result_.generic.push_back(p.get_name());
      parameters_.push_back(field_.random(random_));
    }
  }

  MapSearch find() {
    draw_steps();
    find_polynomials();
    find_fractions();
    find_densities();
    if (!result_.generic.empty() && result_.integrals.empty() &&
        (result_.polynomials > 0 || result_.relations > 0))
      result_.reason =
          "functions with symbolic parameters are not reconstructed: with numbers for all of them "
          "they are shown";
    if (result_.generic.empty() && result_.integrals.empty() && !result_.no_fraction &&
        result_.reason.empty())
      result_.reason =
          "orbits lie on hypersurfaces of this degree, and no quotient of polynomials was found "
          "that is an integral: whether there is one is not decided";
    return std::move(result_);
  }

 private:
  struct Step {
    Row before, after;  ///< the monomials at x and at x'
    Element jacobian;
  };

  /// A random point and where it goes; points without an image are passed over.
  Step random_step() {
    const std::size_t n = map_.base.variables.size();
    constexpr int kTrials = 100;
    for (int trial = 0; trial < kTrials; ++trial) {
      Row x, next;
      std::vector<Jet> arguments;
      for (std::size_t i = 0; i < n; ++i) {
        x.push_back(field_.random(random_));
        arguments.push_back(JetField::variable(x[i], i, n));
      }
      for (const Element p : parameters_) arguments.push_back(JetField::constant(p));
      const auto values = next_.run_over(arguments, JetField());
      if (!values) continue;
      std::vector<std::vector<Scalar>> slopes(n, std::vector<Scalar>(n));
      for (std::size_t i = 0; i < n; ++i) {
        next.push_back((*values)[i].value);
        for (std::size_t j = 0; j < (*values)[i].slopes.size(); ++j)
          slopes[i][j].value = (*values)[i].slopes[j];
      }
      const auto minors = maximal_minors(slopes, Scalar{1}, [&](const Scalar& a, const Scalar& b) {
        return Scalar{field_.multiply(a.value, b.value)};
      });
      const auto all = minors.find((1U << n) - 1);
      return {values_at(x, monomials_), values_at(next, monomials_),
              all == minors.end() ? 0 : all->second.value};
    }
    throw ModelError("the map has no value at random points: a denominator is zero");
  }

  /// A few more steps than there are monomials, for polynomial integrals and for densities.
  void draw_steps() {
    constexpr std::size_t kMore = 12;
    watch_.begin("random steps");
    const std::size_t count = monomials_.size() + kMore;
    while (steps_.size() < count) {
      if (steps_.size() % 16 == 0)
        watch_.tick(static_cast<double>(steps_.size()) / static_cast<double>(count));
      steps_.push_back(random_step());
    }
  }

  /// The null space of a condition of each step.
  std::vector<Row> solutions(const std::function<Row(const Step&)>& condition) const {
    std::vector<Row> rows;
    for (const Step& step : steps_) rows.push_back(condition(step));
    return null_space(rows, monomials_.size());
  }

  /// Many residues of larger fractions are those of small ones as well, which are not proved then.
  void leave_open() {
    result_.reason =
        "functions that seem to exist are not shown: as fractions with numerators and denominators "
        "below 2^30 their coefficients were not found, or not proved";
  }

  /// Empty where the coefficients are not small fractions, which is said.
  std::optional<Polynomial> polynomial_of(const Row& residues) {
    const auto coefficients = rationals_from(residues);
    if (!coefficients) {
      leave_open();
      return std::nullopt;
    }
    TermCollector terms(ring_.ring());
    for (std::size_t m = 0; m < monomials_.size(); ++m) {
      if (cln::zerop((*coefficients)[m])) continue;
      std::vector<unsigned long> exponents(ring_.ring().size(), 0);
      for (std::size_t i = 0; i < map_.base.variables.size(); ++i) exponents[i] = monomials_[m][i];
      terms.add((*coefficients)[m], exponents);
    }
    Polynomial p = terms.finish();
    return p.is_zero() ? p : p.scaled(1 / p.content());
  }

  /// Keeps a function that is proved and, at a random point, independent of those before it.
  void keep_integral(const ex& value, std::string text) {
    std::vector<ex> functions;
    for (const FoundOfMap& f : result_.integrals) functions.push_back(f.value);
    functions.push_back(value);
    std::vector<ex> slopes;
    for (const ex& f : functions) {
      for (const GiNaC::symbol& x : map_.base.variables) slopes.push_back(f.diff(x));
    }
    const std::size_t n = map_.base.variables.size();
    Row point;
    for (std::size_t i = 0; i < n; ++i) point.push_back(field_.random(random_));
    const auto values = ModularProgram(map_.base.variables, slopes).run(point);
    if (!values) return;
    std::vector<Row> gradients;
    for (std::size_t i = 0; i < functions.size(); ++i)
      gradients.emplace_back(values->begin() + long(i * n), values->begin() + long((i + 1) * n));
    if (echelon(gradients, n).size() < functions.size()) return;
    if (prove_integral(map_, {text, value, {}}).verdict == Verdict::proved)
      result_.integrals.push_back({value, std::move(text)});
    else
      leave_open();
  }

  void keep_quotient(const Polynomial& top, const Polynomial& bottom) {
    keep_integral(ring_.expression(top) / ring_.expression(bottom),
                  fmt::format("({})/({})", ring_.text(top), ring_.text(bottom)));
  }

  void find_polynomials() {
    watch_.begin("polynomial integrals");
    const std::size_t m = monomials_.size();
    const std::vector<Row> space = solutions([&](const Step& step) {
      Row row;
      for (std::size_t i = 0; i < m; ++i)
        row.push_back(field_.subtract(step.after[i], step.before[i]));
      return row;
    });
    result_.polynomials = space.size() - 1;  // the constants are always there
    result_.no_polynomial = space.size() == 1;
    if (!result_.generic.empty()) return;
    for (const Row& vector : space) {
      const auto p = polynomial_of(vector);
      if (p && !p->is_constant()) keep_integral(ring_.expression(*p), ring_.text(*p));
    }
  }

  /// The monomials along the orbit of a random point; points whose orbits meet a pole are passed
  /// over.
  std::vector<Row> random_orbit() {
    const std::size_t m = monomials_.size();
    const std::size_t n = map_.base.variables.size();
    constexpr std::size_t kMore = 20;
    constexpr int kTrials = 20;
    for (int trial = 0; trial < kTrials; ++trial) {
      Row arguments;
      for (std::size_t i = 0; i < n; ++i) arguments.push_back(field_.random(random_));
      arguments.insert(arguments.end(), parameters_.begin(), parameters_.end());
      std::vector<Row> rows;
      while (rows.size() < m + kMore) {
        if (rows.size() % 16 == 0)
          watch_.tick(static_cast<double>(rows.size()) / static_cast<double>(m + kMore));
        rows.push_back(values_at({arguments.begin(), arguments.begin() + long(n)}, monomials_));
        const auto values = next_.run(arguments);
        if (!values) break;
        std::copy(values->begin(), values->end(), arguments.begin());
      }
      if (rows.size() == m + kMore) return rows;
    }
    throw ModelError("orbits of random points end at poles of the map");
  }

  /// The combinations of these monomials that vanish on an orbit, over all monomials.
  std::vector<Row> relations(const std::vector<Row>& orbit,
                             const std::vector<std::size_t>& chosen) const {
    std::vector<Row> rows;
    for (const Row& all : orbit) {
      Row& row = rows.emplace_back();
      for (const std::size_t c : chosen) row.push_back(all[c]);
    }
    std::vector<Row> result;
    for (const Row& relation : null_space(rows, chosen.size())) {
      Row& row = result.emplace_back(monomials_.size(), 0);
      for (std::size_t k = 0; k < chosen.size(); ++k) row[chosen[k]] = relation[k];
    }
    return result;
  }

  /// The monomials up to a degree in some of the variables, given as bits.
  std::vector<std::size_t> monomials_in(unsigned variables, int degree) const {
    std::vector<std::size_t> result;
    for (std::size_t m = 0; m < monomials_.size(); ++m) {
      bool inside = true;
      int own = 0;
      for (std::size_t i = 0; i < map_.base.variables.size(); ++i) {
        inside = inside && (monomials_[m][i] == 0 || (variables >> i & 1U) != 0);
        own += static_cast<int>(monomials_[m][i]);
      }
      if (inside && own <= degree) result.push_back(m);
    }
    return result;
  }

  /// Hirota-Kimura bases: of A/B = h the polynomial A - h B vanishes on the orbit. So where nothing
  /// does, no quotient is an integral. Where the relations of many orbits span one dimension more
  /// than those of each, all quotients of functions of the span are integrals: that is looked for
  /// among the monomials of all variables and of some of them, and what it gives is proved. Up to a
  /// higher degree there are the products of A - h B with monomials as well, so that the lower ones
  /// come first.
  void find_fractions() {
    watch_.begin("orbits");
    constexpr int kOrbits = 6;
    constexpr std::size_t kMostVariables = 8;
    const std::size_t n = map_.base.variables.size();
    std::vector<std::vector<Row>> orbits{random_orbit()};
    const unsigned all = (1U << n) - 1;
    result_.relations = relations(orbits.front(), monomials_in(all, degree_)).size();
    result_.no_fraction = result_.relations == 0;
    if (!result_.generic.empty() || result_.no_fraction) return;
    while (orbits.size() < kOrbits) orbits.push_back(random_orbit());
    for (int degree = 1; degree <= degree_; ++degree)
      for (unsigned variables = 1; variables <= all; ++variables)
        if (variables == all || n <= kMostVariables)
          find_fractions(orbits, monomials_in(variables, degree));
  }

  void find_fractions(const std::vector<std::vector<Row>>& orbits,
                      const std::vector<std::size_t>& chosen) {
    std::vector<Row> span;
    std::size_t own = 0;
    for (const auto& orbit : orbits) {
      const std::vector<Row> found = relations(orbit, chosen);
      own = found.size();
      if (own == 0) return;
      span.insert(span.end(), found.begin(), found.end());
    }
    span = echelon(span, monomials_.size());
    if (span.size() == own + 1) try_quotients(span);
  }

  void try_quotients(const std::vector<Row>& basis) {
    std::vector<Polynomial> functions;
    for (const Row& vector : basis) {
      if (auto p = polynomial_of(vector)) functions.push_back(std::move(*p));
    }
    for (std::size_t i = 1; i < functions.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (functions[j].is_constant()) continue;  // among the polynomials
        keep_quotient(functions[i], functions[j]);
      }
    }
  }

  /// P with P(x') = sign * det Dx' * P(x): a measure has no orientation, which the map may reverse.
  std::vector<Row> multiplied_by_jacobian(int sign) {
    return solutions([&](const Step& step) {
      Row row;
      for (std::size_t i = 0; i < monomials_.size(); ++i) {
        const Element image = field_.multiply(step.jacobian, step.before[i]);
        row.push_back(sign > 0 ? field_.subtract(step.after[i], image)
                               : field_.add(step.after[i], image));
      }
      return row;
    });
  }

  void find_densities() {
    watch_.begin("densities");
    std::vector<Row> space = multiplied_by_jacobian(1);
    const std::vector<Row> reversed = multiplied_by_jacobian(-1);
    space.insert(space.end(), reversed.begin(), reversed.end());
    result_.density_space = space.size();
    if (!result_.generic.empty()) return;
    std::vector<Polynomial> proved;
    for (const Row& vector : space) {
      const auto p = polynomial_of(vector);
      if (!p || p->is_zero()) continue;
      const ex density = 1 / ring_.expression(*p);
      std::string text = p->is_constant() ? "1" : fmt::format("1/({})", ring_.text(*p));
      const Proof proof = prove_density(map_, {text, density, {}});
      if (proof.verdict == Verdict::proved) {
        result_.densities.push_back({density, std::move(text), evidence_and_conditions(proof)});
        proved.push_back(*p);
      } else {
        leave_open();
      }
    }
    // Two measures that a map keeps differ by an integral.
    for (std::size_t i = 1; i < proved.size(); ++i) keep_quotient(proved[i], proved[0]);
  }

  const MapModel& map_;
  const search::Watch& watch_;
  int degree_;
  PrimeField field_;
  std::mt19937_64 random_{20190101};
  ModularProgram next_;
  search::Monomials monomials_;
  FunctionRing ring_;
  Row parameters_;
  std::vector<Step> steps_;
  MapSearch result_;
};

}  // namespace

MapSearch search_map(const MapModel& map, int degree, const search::Watch& watch) {
  if (degree < 0) throw ModelError("the degree of a search is not negative");
  const std::size_t n = map.base.variables.size();
  const double size = search::count_monomials(std::vector<int>(n, 1), degree);
  constexpr double kMostMonomials = 3000;
  if (size > kMostMonomials)
    throw search::TooMuchMemory(fmt::format(
        "{:g} monomials up to the degree {}: the dense matrix of a map is made for {:g}", size,
        degree, kMostMonomials));
  for (const Assumption& a : map.base.assumptions) {
    if (a.comparison == Comparison::equal)
      throw ModelError(fmt::format(
          "'{}' is assumed, and a search is for generic values: a definition can say it", a.text));
  }
  MapSearch found = Search(map, degree, watch).find();
  if (const auto thin = thin_domain_of(map)) {
    found.no_polynomial = found.no_fraction = false;
    found.not_generic = found.reason = *thin;
  }
  return found;
}

}  // namespace casimir::discrete

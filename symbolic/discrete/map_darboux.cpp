#include "symbolic/discrete/map_darboux.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/discrete/factored_quotient.hpp"
#include "symbolic/discrete/map_jacobian.hpp"
#include "symbolic/discrete/modular_kernel.hpp"
#include "symbolic/discrete/modular_program.hpp"
#include "symbolic/discrete/prove_candidate.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/proof/prover.hpp"
#include "symbolic/search/modular/monomials.hpp"

namespace casimir::discrete {
namespace {

using GiNaC::ex;
using Row = std::vector<Element>;
using Exponents = std::vector<int>;

/// P with P(x') = C P, and C as a product.
struct Darboux {
  Polynomial p;
  FactoredQuotient cofactor;
};

/// Exponents of a factor in cofactors of polynomials up to a degree.
struct Factor {
  Polynomial base;
  int in_denominators = 0;  ///< the highest power in one of them
};

class DarbouxSearch {
 public:
  DarbouxSearch(const MapModel& map, int degree, const search::Watch& watch)
      : map_(map),
        watch_(watch),
        degree_(degree),
        prover_(map.base, next_of(map), Subject::functions),
        program_(map.base.symbols(), map.next) {}

  MapDarboux find();

 private:
  static std::vector<ex> next_of(const MapModel& map) {
    std::vector<ex> result = map.next;
    result.insert(result.end(), map.next_domain.begin(), map.next_domain.end());
    return result;
  }
  const PolynomialRing& ring() const { return prover_.ring().ring(); }
  std::size_t dimension() const { return map_.next.size(); }

  void collect_factors();
  void add_factor(const Polynomial& base, int in_denominators);
  std::vector<Exponents> choices(int degree) const;
  void search_up_to(int degree);
  void search_with(const Exponents& exponents, const search::Monomials& monomials);
  struct Sample {
    Row before, after;  ///< monomials at x and x'
    Row factors;        ///< at x
  };
  void draw_samples(const search::Monomials& monomials, std::size_t count);
  Element factor_product(const Sample& sample, const Exponents& exponents) const;
  Pencil pencil(const Exponents& exponents, std::size_t first, std::size_t size) const;
  std::vector<Row> known_products(const Exponents& exponents, Element number,
                                  const search::Monomials& monomials);
  void take(const Row& coefficients, const search::Monomials& monomials);
  std::optional<FactoredQuotient> cofactor_of(const Polynomial& p);
  bool is_known(const Polynomial& p) const;
  void combine();
  void keep_combination(const std::vector<cln::cl_I>& powers);

  const MapModel& map_;
  const search::Watch& watch_;
  int degree_;
  Prover prover_;
  ModularProgram program_;
  PrimeField field_;
  std::mt19937_64 random_{20190301};
  std::vector<Polynomial> tops_, bottoms_;  ///< of x', in lowest terms
  std::vector<Factor> factors_;
  std::optional<FactoredQuotient> jacobian_;
  std::vector<Sample> samples_;
  std::vector<Darboux> found_;
  MapDarboux result_;
};

void DarbouxSearch::add_factor(const Polynomial& base, int in_denominators) {
  for (Factor& own : factors_) {
    if (!(own.base == base) && !(own.base == -base)) continue;
    own.in_denominators = std::max(own.in_denominators, in_denominators);
    return;
  }
  factors_.push_back({base, in_denominators});
}

/// A determinant is as long as the product of its rows.
void DarbouxSearch::collect_factors() {
  double terms = 1;
  for (const ex& next : map_.next) {
    auto [top, bottom] = prover_.ring().lowest_terms(prover_.convert(next));
    for (const auto& [factor, exponent] : bottom.factors())
      if (!factor.is_constant()) add_factor(factor, static_cast<int>(exponent));
    terms *= static_cast<double>(top.terms() + bottom.terms());
    tops_.push_back(std::move(top));
    bottoms_.push_back(std::move(bottom));
  }
  constexpr double kLongest = 20000;
  if (terms > kLongest) {
    result_.has_jacobian = false;
  } else {
    const auto [top, bottom] =
        prover_.ring().lowest_terms(determinant(ring(), jacobian(prover_, map_)));
    if (top.is_zero()) throw ModelError("the Jacobian determinant of the map is zero");
    jacobian_.emplace();
    jacobian_->multiply_factors(top, 1);
    jacobian_->multiply_factors(bottom, -1);
    for (const auto& [factor, exponent] : top.factors())
      if (!factor.is_constant()) add_factor(factor, 0);
  }
  for (const Factor& factor : factors_) result_.factors.push_back(prover_.ring().text(factor.base));
}

/// All exponents that the degrees allow, see `find_map_darboux`.
std::vector<Exponents> DarbouxSearch::choices(int degree) const {
  long common = 0, highest = 0;  // degrees of the common denominator, and of x' times that
  for (const Factor& f : factors_) common += f.in_denominators * f.base.total_degree();
  for (std::size_t i = 0; i < tops_.size(); ++i)
    highest = std::max(highest, tops_[i].total_degree() + common - bottoms_[i].total_degree());
  std::vector<Exponents> result;
  Exponents own(factors_.size(), 0);
  constexpr std::size_t kMost = 20000;
  // What is left of the degrees of the numerator and of factors of P.
  const std::function<void(std::size_t, long, long)> choose = [&](std::size_t k, long top, long p) {
    if (result.size() > kMost) return;
    if (k == factors_.size()) {
      result.push_back(own);
      return;
    }
    const Factor& f = factors_[k];
    const long size = f.base.total_degree();
    const int in_denominator = degree * f.in_denominators;
    for (int e = -in_denominator; e * size <= top; ++e) {
      own[k] = e;
      choose(k + 1, e > 0 ? top - e * size : top, p);
    }
    for (int in_p = 1; in_p * size <= p; ++in_p) {
      own[k] = -in_denominator - in_p;
      choose(k + 1, top, p - in_p * size);
    }
    own[k] = 0;
  };
  choose(0, degree * std::max(highest, common), degree);
  if (result.size() > kMost)
    throw ModelError(fmt::format(
        "the cofactors may have more than {} different exponents up to this degree", kMost));
  return result;
}

void DarbouxSearch::draw_samples(const search::Monomials& monomials, std::size_t count) {
  samples_.clear();
  constexpr int kTrials = 100;
  int failed = 0;
  while (samples_.size() < count) {
    Row x;
    for (std::size_t i = 0; i < dimension(); ++i) x.push_back(field_.random(random_));
    const auto image = program_.run(x);
    Sample sample;
    bool singular = !image;
    for (const Factor& f : factors_) {
      Element sum = 0;
      for (const auto& [number, exponents] : f.base.term_list()) {
        Element term = field_.reduce(number).value_or(0);
        for (std::size_t i = 0; i < x.size(); ++i)
          term = field_.multiply(term, field_.power(x[i], exponents[i]));
        sum = field_.add(sum, term);
      }
      singular = singular || sum == 0;
      sample.factors.push_back(sum);
    }
    if (singular) {
      if (++failed > kTrials)
        throw ModelError("the map has no value at random points: a denominator is zero");
      continue;
    }
    sample.before = values_at(x, monomials);
    sample.after = values_at(*image, monomials);
    samples_.push_back(std::move(sample));
  }
}

Element DarbouxSearch::factor_product(const Sample& sample, const Exponents& exponents) const {
  Element product = 1;
  for (std::size_t k = 0; k < exponents.size(); ++k) {
    if (exponents[k] == 0) continue;
    const Element base = exponents[k] > 0 ? sample.factors[k] : field_.inverse(sample.factors[k]);
    product = field_.multiply(
        product, field_.power(base, static_cast<std::uint64_t>(std::abs(exponents[k]))));
  }
  return product;
}

/// Rows P(x') = c K(x) P(x) of so many samples.
Pencil DarbouxSearch::pencil(const Exponents& exponents, std::size_t first,
                             std::size_t size) const {
  Pencil result;
  for (std::size_t s = first; s < first + size; ++s) {
    const Element product = factor_product(samples_[s], exponents);
    result.a.push_back(samples_[s].after);
    Row& row = result.b.emplace_back(samples_[s].before);
    for (Element& e : row) e = field_.multiply(e, product);
  }
  return result;
}

/// The coefficients of products of those found that have the cofactor c K, over the monomials. With
/// the integrals among these, their quotients, products are more than that and are not asked for.
std::vector<Row> DarbouxSearch::known_products(const Exponents& exponents, Element number,
                                               const search::Monomials& monomials) {
  std::vector<int> degrees;
  for (const Darboux& own : found_) degrees.push_back(static_cast<int>(own.p.total_degree()));
  const int highest = monomials.size() == 0 ? 0 : monomials.degree(monomials.size() - 1);
  std::vector<Row> rows;
  for (const std::vector<int>& powers : search::products_up_to(degrees, highest, 0)) {
    FactoredQuotient cofactor;
    Polynomial product = ring().constant(1);
    for (std::size_t k = 0; k < powers.size(); ++k) {
      if (powers[k] == 0) continue;
      cofactor.number = cofactor.number * cln::expt(found_[k].cofactor.number, powers[k]);
      for (const auto& [base, e] : found_[k].cofactor.powers)
        cofactor.multiply(base, e * powers[k]);
      product = product * found_[k].p.pow(static_cast<unsigned long>(powers[k]));
    }
    bool same = field_.reduce(cofactor.number) == number;
    for (std::size_t k = 0; k < factors_.size(); ++k)
      same = same && cofactor.exponent_of(factors_[k].base) == exponents[k];
    if (!same) continue;
    Row& row = rows.emplace_back(monomials.size(), 0);
    for (const auto& [coefficient, own] : product.term_list()) {
      for (std::size_t m = 0; m < monomials.size(); ++m)
        if (std::equal(monomials[m], monomials[m] + dimension(), own.begin()))
          row[m] = field_.reduce(coefficient).value_or(0);
    }
  }
  return rows;
}

/// P(x')/P(x) in lowest terms; empty where that is made of other factors too.
std::optional<FactoredQuotient> DarbouxSearch::cofactor_of(const Polynomial& p) {
  std::vector<unsigned long> highest(dimension(), 0);
  for (const auto& [number, exponents] : p.term_list())
    for (std::size_t i = 0; i < dimension(); ++i)
      highest[i] = std::max<unsigned long>(highest[i], exponents[i]);
  Polynomial top(ring());
  for (const auto& [number, exponents] : p.term_list()) {
    Polynomial term = ring().constant(number);
    for (std::size_t i = 0; i < dimension(); ++i) {
      term = prover_.ring().checked_product(term, tops_[i].pow(exponents[i]));
      term = prover_.ring().checked_product(term, bottoms_[i].pow(highest[i] - exponents[i]));
    }
    top += term;
  }
  if (top.is_zero()) return std::nullopt;
  FactoredQuotient result;
  result.multiply_factors(top, 1);
  result.multiply_factors(p, -1);
  for (std::size_t i = 0; i < dimension(); ++i)
    if (highest[i] > 0) result.multiply_factors(bottoms_[i], -static_cast<int>(highest[i]));
  std::erase_if(result.powers, [](const auto& power) { return power.second == 0; });
  const bool is_made_of_factors = std::ranges::all_of(result.powers, [&](const auto& power) {
    return std::ranges::any_of(factors_, [&](const Factor& own) {
      return own.base == power.first || own.base == -power.first;
    });
  });
  if (!is_made_of_factors) return std::nullopt;
  return result;
}

bool DarbouxSearch::is_known(const Polynomial& p) const {
  return std::ranges::any_of(found_, [&](const Darboux& own) { return own.p == p || own.p == -p; });
}

/// Keeps the irreducible factors that are Darboux polynomials themselves, or all of it.
void DarbouxSearch::take(const Row& coefficients, const search::Monomials& monomials) {
  const auto numbers = rationals_from(coefficients);
  const auto leave_open = [&] {
    result_.complete = false;
    result_.reason =
        "there seem to be others, whose coefficients were not found as fractions with numerators "
        "and denominators below 2^30";
  };
  if (!numbers) return leave_open();
  TermCollector terms(ring());
  for (std::size_t m = 0; m < monomials.size(); ++m) {
    if (cln::zerop((*numbers)[m])) continue;
    std::vector<unsigned long> exponents(ring().size(), 0);
    for (std::size_t i = 0; i < dimension(); ++i) exponents[i] = monomials[m][i];
    terms.add((*numbers)[m], exponents);
  }
  Polynomial p = terms.finish();
  p = p.scaled(1 / p.content());
  if (!cofactor_of(p)) return leave_open();
  std::vector<Darboux> parts;
  bool all = true;
  for (const auto& [factor, exponent] : p.factors()) {
    if (factor.is_constant()) continue;
    std::optional<FactoredQuotient> cofactor = cofactor_of(factor);
    all = all && cofactor.has_value();
    if (cofactor) parts.push_back({factor, std::move(*cofactor)});
  }
  if (!all) parts = {{p, *cofactor_of(p)}};
  for (Darboux& part : parts) {
    const bool is_integral = part.cofactor.powers.empty() && part.cofactor.number == 1;
    if (!is_integral && !is_known(part.p)) found_.push_back(std::move(part));
  }
}

void DarbouxSearch::search_with(const Exponents& exponents, const search::Monomials& monomials) {
  const std::size_t size = monomials.size();
  const auto [numbers, others] =
      common_eigenvalues({pencil(exponents, 0, size), pencil(exponents, size, size)});
  result_.has_conjugates = result_.has_conjugates || others;
  const bool constant = std::ranges::all_of(exponents, [](int e) { return e == 0; });
  for (const Element number : numbers) {
    if (constant && number == 1) continue;  // integrals
    std::vector<Row> rows;
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      const Element product = field_.multiply(number, factor_product(samples_[s], exponents));
      Row& row = rows.emplace_back();
      for (std::size_t m = 0; m < size; ++m)
        row.push_back(
            field_.subtract(samples_[s].after[m], field_.multiply(product, samples_[s].before[m])));
    }
    for (const Row& vector : null_space(rows, size)) {
      std::vector<Row> span = known_products(exponents, number, monomials);
      const std::size_t before = echelon(span, size).size();
      span.push_back(vector);
      if (echelon(span, size).size() > before) take(vector, monomials);
    }
  }
}

void DarbouxSearch::search_up_to(int degree) {
  watch_.begin(fmt::format("Darboux polynomials of degree {}", degree));
  const search::Monomials monomials =
      search::all_monomials(std::vector<int>(dimension(), 1), degree);
  constexpr std::size_t kMore = 12;
  draw_samples(monomials, 2 * monomials.size() + kMore);
  const std::vector<Exponents> all = choices(degree);
  for (std::size_t k = 0; k < all.size(); ++k) {
    watch_.tick(static_cast<double>(k) / static_cast<double>(all.size()));
    search_with(all[k], monomials);
  }
}

/// \param powers  of those found, and of the Jacobian determinant where there is one more
void DarbouxSearch::keep_combination(const std::vector<cln::cl_I>& powers) {
  ex value = 1;
  FactoredQuotient text;
  for (std::size_t k = 0; k < found_.size(); ++k) {
    if (powers[k] == 0) continue;
    const int own = cln::cl_I_to_int(powers[k]);
    value *= GiNaC::pow(prover_.ring().expression(found_[k].p), own);
    text.powers.emplace_back(found_[k].p, own);
  }
  const bool density = powers.size() > found_.size() && powers.back() != 0;
  const NamedExpression function{text.text(prover_.ring()), value, {}};
  const Proof proof = density ? prove_density(map_, function) : prove_integral(map_, function);
  if (proof.verdict != Verdict::proved) return;
  result_.combinations.push_back({density ? search::DarbouxCombination::Kind::multiplier
                                          : search::DarbouxCombination::Kind::integral,
                                  function.name, true, proof.verdict,
                                  evidence_and_conditions(proof)});
}

/// Products of powers whose cofactors cancel, up to a sign: then their squares do.
void DarbouxSearch::combine() {
  if (found_.empty()) return;
  std::vector<FactoredQuotient> cofactors;
  for (const Darboux& own : found_) cofactors.push_back(own.cofactor);
  const auto sign_of = [&](const std::vector<cln::cl_I>& powers) {
    bool minus = false;
    for (std::size_t k = 0; k < powers.size(); ++k)
      minus = minus != (cln::minusp(cofactors[k].number) && cln::oddp(powers[k]));
    return minus;
  };
  for (std::vector<cln::cl_I> powers :
       casimir::null_space(exponent_rows(cofactors), cofactors.size())) {
    if (sign_of(powers))
      for (cln::cl_I& power : powers) power = 2 * power;
    keep_combination(powers);
  }
  if (!jacobian_) return;
  // A measure has no orientation: the sign of the determinant does not matter.
  cofactors.push_back(*jacobian_);
  for (const std::vector<cln::cl_I>& powers :
       casimir::null_space(exponent_rows(cofactors), cofactors.size())) {
    if (powers.back() == 0) continue;
    // C_1^n_1 .. J = 1 makes P_1^n_1 .. a density.
    if (powers.back() == 1) keep_combination(powers);
    if (powers.back() == -1) {
      std::vector<cln::cl_I> opposite;
      for (const cln::cl_I& power : powers) opposite.push_back(-power);
      keep_combination(opposite);
    }
    break;
  }
}

MapDarboux DarbouxSearch::find() {
  result_.complete = true;
  collect_factors();
  for (int degree = 1; degree <= degree_; ++degree) search_up_to(degree);
  for (const Darboux& own : found_) {
    search::DarbouxPolynomial& one = result_.found.emplace_back();
    one.value = prover_.ring().expression(own.p);
    one.text = prover_.ring().text(own.p);
    one.cofactor = own.cofactor.text(prover_.ring());
    one.cofactor_value = own.cofactor.value(prover_.ring());
    one.degree = static_cast<int>(own.p.total_degree());
    one.verdict = Verdict::proved;
  }
  combine();
  return std::move(result_);
}

}  // namespace

MapDarboux find_map_darboux(const MapModel& map, int degree, const search::Watch& watch) {
  if (!map.base.parameters.empty())
    throw ModelError(
        fmt::format("Darboux polynomials of a map are looked for with numbers: the "
                    "parameter '{}' has none",
                    map.base.parameters.front().get_name()));
  const double size =
      search::count_monomials(std::vector<int>(map.base.variables.size(), 1), degree);
  constexpr double kMostMonomials = 250;
  if (size > kMostMonomials)
    throw search::TooMuchMemory(fmt::format(
        "{:g} monomials up to the degree {}: the pencils of cofactors are made for {:g}", size,
        degree, kMostMonomials));
  MapDarboux found = DarbouxSearch(map, degree, watch).find();
  if (const auto thin = thin_domain_of(map)) {
    found.complete = false;
    found.reason = *thin;
  }
  return found;
}

}  // namespace casimir::discrete

#include "symbolic/search/conditions/rank_conditions.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "symbolic/search/modular/nmod_poly.hpp"
#include "symbolic/search/polynomial_system.hpp"

namespace casimir::search {
namespace {

using Row = ParametricBlock::Row;

constexpr int kCombinations = 3;  // random compressions whose determinants are compared

std::vector<std::size_t> parameters_of(const System& system, const ParametricBlock& block) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < system.ring().size(); ++i) {
    const bool used = std::any_of(block.rows.begin(), block.rows.end(), [&](const Row& row) {
      return std::any_of(row.begin(), row.end(), [&](const auto& e) { return e.second.uses(i); });
    });
    if (used) result.push_back(i);
  }
  return result;
}

std::size_t generic_rank(const System& system, const ParametricBlock& block) {
  // Modulo a prime and at a point it may be lower, never higher.
  constexpr std::size_t kPrimes = 3;
  std::size_t best = 0;
  for (std::size_t i = 0; i < kPrimes; ++i) {
    const Modulus modulus = Modulus::nth(i);
    std::mt19937_64 random(21 + i);
    const std::optional<Point> point = system.random_point(modulus, random);
    if (!point) continue;
    DenseRows matrix = block.at(*point, modulus);
    best = std::max(best, reduce_rows(matrix, modulus).size());
  }
  return best;
}

/// Columns that occur, renumbered.
void drop_empty_columns(ParametricBlock& block) {
  std::vector<std::uint32_t> place(block.columns, 0);
  for (const Row& row : block.rows)
    for (const auto& [c, p] : row) place[c] = 1;
  std::uint32_t used = 0;
  for (std::uint32_t& p : place) p = p == 1 ? used++ : used;
  for (Row& row : block.rows)
    for (auto& [c, p] : row) c = place[c];
  block.columns = used;
}

/// U * A * V for matrices of small random integers.
std::vector<std::vector<Polynomial>> compressed(const System& system, const ParametricBlock& block,
                                                std::size_t rank, std::mt19937_64& random) {
  const auto draw = [&] { return cln::cl_I(static_cast<long>(random() % 19) - 9); };
  std::vector<std::vector<cln::cl_I>> v(block.columns, std::vector<cln::cl_I>(rank));
  for (auto& row : v)
    for (cln::cl_I& entry : row) entry = draw();
  if (block.columns == rank) {  // nothing to compress
    for (std::size_t i = 0; i < rank; ++i)
      for (std::size_t j = 0; j < rank; ++j) v[i][j] = i == j ? 1 : 0;
  }
  std::vector<std::vector<Polynomial>> result(
      rank, std::vector<Polynomial>(rank, Polynomial(system.ring())));
  for (std::size_t k = 0; k < block.rows.size(); ++k) {
    std::vector<Polynomial> row(rank, Polynomial(system.ring()));
    for (const auto& [c, p] : block.rows[k]) {
      for (std::size_t j = 0; j < rank; ++j)
        if (!cln::zerop(v[c][j])) row[j] += p.scaled(v[c][j]);
    }
    for (std::size_t i = 0; i < rank; ++i) {
      const cln::cl_I u = block.rows.size() == rank ? cln::cl_I(i == k ? 1 : 0) : draw();
      if (cln::zerop(u)) continue;
      for (std::size_t j = 0; j < rank; ++j) result[i][j] += row[j].scaled(u);
    }
  }
  return result;
}

Polynomial common_minor_factor(const System& system, const ParametricBlock& block, std::size_t rank,
                               std::vector<Polynomial>& combinations, const Watch& watch) {
  std::mt19937_64 random(31);
  Polynomial common(system.ring());
  for (int i = 0; i < kCombinations; ++i) {
    const Polynomial d =
        determinant_without_sign(compressed(system, block, rank, random), system.ring());
    watch.tick(0.5);
    common = i == 0 ? d : Polynomial::gcd(common, d);
    combinations.push_back(d);
    if (common.is_constant()) break;
  }
  return common;
}

/// Entries as polynomials in one parameter modulo a prime.
class OneParameter {
 public:
  OneParameter(const ParametricBlock& block, std::size_t place, const Point& others,
               const Modulus& modulus)
      : modulus_(modulus), rows_(block.rows.size()), columns_(block.columns) {
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      for (const auto& [c, p] : block.rows[i]) {
        Entry entry{i, c, {}};
        for (const Polynomial& k : p.coefficients(place))
          entry.coefficients.push_back(value_at(k, others, modulus).value_or(0));
        degree_ = std::max(degree_, entry.coefficients.size() - 1);
        entries_.push_back(std::move(entry));
      }
    }
  }

  std::size_t degree() const { return degree_; }

  /// Determinants of random compressions, as polynomials; the same ones for the same generator.
  std::vector<ModularPolynomial> determinants(std::size_t rank, std::mt19937_64& random) const {
    const std::size_t points = rank * degree_ + 1;
    std::vector<DenseRows> u, v;
    for (int q = 0; q < kCombinations; ++q) {
      u.push_back(random_matrix(rank, rows_, random));
      v.push_back(random_matrix(columns_, rank, random));
    }
    std::vector<mp_limb_t> places;
    std::vector<std::vector<mp_limb_t>> values(kCombinations);
    for (std::size_t i = 0; i < points; ++i) {
      constexpr Residue kFirst = 1000003;  // far from what a parameter may be
      places.push_back(kFirst + i);
      const DenseRows a = at(static_cast<Residue>(places.back()));
      for (std::size_t q = 0; q < kCombinations; ++q) {
        DenseRows av(rows_, rank), uav(rank, rank);
        subtract_product(av, a, v[q], modulus_);
        subtract_product(uav, u[q], av, modulus_);
        values[q].push_back(determinant(std::move(uav)));
      }
    }
    std::vector<ModularPolynomial> result;
    for (const auto& list : values)
      result.push_back(ModularPolynomial::through(places, list, modulus_));
    return result;
  }

 private:
  struct Entry {
    std::size_t row, column;
    std::vector<Residue> coefficients;
  };

  DenseRows at(Residue value) const {
    DenseRows matrix(rows_, columns_);
    for (const Entry& entry : entries_) {
      Residue sum = 0;
      for (std::size_t k = entry.coefficients.size(); k-- > 0;)
        sum = modulus_.add(modulus_.multiply(sum, value), entry.coefficients[k]);
      matrix.row(entry.row)[entry.column] = sum;
    }
    return matrix;
  }

  DenseRows random_matrix(std::size_t rows, std::size_t columns, std::mt19937_64& random) const {
    DenseRows matrix(rows, columns);
    for (Residue& entry : matrix.entries) entry = modulus_.random(random);
    return matrix;
  }

  Residue determinant(DenseRows m) const {
    Residue result = 1;
    for (std::size_t k = 0; k < m.rows; ++k) {
      std::size_t pivot = k;
      while (pivot < m.rows && m.row(pivot)[k] == 0) ++pivot;
      if (pivot == m.rows) return 0;
      if (pivot != k) {
        std::swap_ranges(m.row(pivot), m.row(pivot) + m.columns, m.row(k));
        result = modulus_.negative(result);
      }
      result = modulus_.multiply(result, m.row(k)[k]);
      const Residue inverse = modulus_.inverse(m.row(k)[k]);
      for (std::size_t i = k + 1; i < m.rows; ++i) {
        const Residue factor = modulus_.negative(modulus_.multiply(m.row(i)[k], inverse));
        if (factor == 0) continue;
        for (std::size_t j = k; j < m.columns; ++j)
          m.row(i)[j] = modulus_.reduce(m.row(i)[j] + std::uint64_t{factor} * m.row(k)[j]);
      }
    }
    return result;
  }

  const Modulus& modulus_;
  std::size_t rows_, columns_, degree_ = 0;
  std::vector<Entry> entries_;
};

ModularPolynomial common_factor(const std::vector<ModularPolynomial>& list) {
  ModularPolynomial result = list[0];
  for (const ModularPolynomial& p : list) result = ModularPolynomial::gcd(result, p);
  return result;
}

/// An upper bound, in bits, of the coefficients of any minor of that size in one parameter: the sum
/// of their moduli is at most the product of those of the rows, and of the columns.
double bits_of_minors(const ParametricBlock& block, std::size_t place, std::size_t rank,
                      const std::vector<long>& others) {
  const auto bits_of = [](const cln::cl_I& n) {
    return static_cast<double>(cln::integer_length(n));
  };
  std::vector<double> rows;
  std::map<std::uint32_t, cln::cl_RA> columns;
  double denominators = 0;
  for (const Row& row : block.rows) {
    cln::cl_RA sum = 0;
    cln::cl_I common = 1;
    for (const auto& [column, p] : row) {
      for (auto [number, exponents] : p.term_list()) {
        cln::cl_RA size = cln::abs(number);
        common = cln::lcm(common, cln::denominator(number));
        for (std::size_t i = 0; i < exponents.size(); ++i)
          if (i != place) size = size * cln::expt(cln::cl_RA(others[i]), cln::cl_I(exponents[i]));
        sum = sum + size;
        columns[column] = columns[column] + size;
      }
    }
    rows.push_back(bits_of(cln::ceiling1(sum * common)));
    denominators += bits_of(common) - 1;
  }
  std::vector<double> of_columns;
  for (const auto& [column, size] : columns) of_columns.push_back(bits_of(cln::ceiling1(size)));
  const auto product = [&](std::vector<double>& list) {
    std::sort(list.begin(), list.end(), std::greater<>());
    list.resize(std::min(list.size(), rank));
    return std::accumulate(list.begin(), list.end(), 0.0);
  };
  return std::min(product(rows), product(of_columns) + denominators);
}

/// What was found modulo primes for common factors of one degree.
struct FactorOfDegree {
  std::vector<cln::cl_I> residues;
  std::vector<cln::cl_RA> numbers;
  cln::cl_I product = 1;
  std::size_t primes = 0;
  bool stable = false;  ///< one more prime did not change the numbers

  void add(const ModularPolynomial& factor, const Modulus& modulus) {
    ++primes;
    residues.resize(static_cast<std::size_t>(std::max(factor.degree(), 0L)) + 1, 0);
    std::vector<cln::cl_RA> fresh;
    const cln::cl_I next = product * cln::cl_I(static_cast<unsigned long>(modulus.prime()));
    for (std::size_t k = 0; k < residues.size() && !stable; ++k) {
      residues[k] = chinese_remainder(residues[k], product,
                                      factor.coefficient(static_cast<long>(k)), modulus);
      if (const auto number = rational_from(residues[k], next)) fresh.push_back(*number);
    }
    product = next;
    if (stable) return;
    stable = fresh.size() == residues.size() && fresh == numbers;
    numbers = fresh;
  }
};

/// The same for one parameter, by values modulo primes; empty if it is not found.
///
/// Modulo a prime the common factor G of all minors divides what is computed, but may have a lower
/// degree, if the prime divides its leading coefficient. That divides the leading coefficient of a
/// minor, of which the size is known: so of so many primes that their product is larger, one does
/// not, and what all of them agree in has the degree of G at least.
std::optional<Polynomial> common_minor_factor(const System& system, const ParametricBlock& block,
                                              std::size_t place, std::size_t rank,
                                              const std::vector<long>& others_values,
                                              const Watch& watch) {
  constexpr std::size_t kMorePrimes = 40;
  constexpr double kBitsOfPrime = 28, kMostWork = 2e11;
  const Point others(others_values.begin(), others_values.end());
  const std::size_t needed =
      static_cast<std::size_t>(bits_of_minors(block, place, rank, others_values) / kBitsOfPrime) +
      1;
  std::map<long, FactorOfDegree> found;
  double work = 0;
  for (std::size_t i = 0; i < needed + kMorePrimes && work < kMostWork; ++i) {
    watch.tick(static_cast<double>(i) / static_cast<double>(needed + kMorePrimes));
    const Modulus modulus = Modulus::nth(i);
    std::mt19937_64 random(41 + i);
    const OneParameter matrix(block, place, others, modulus);
    const double size = static_cast<double>(rank);
    work += (size * static_cast<double>(matrix.degree()) + 1) * size * size * size;
    const ModularPolynomial factor = common_factor(matrix.determinants(rank, random));
    if (factor.degree() < 0) continue;  // all are zero modulo this prime: it says nothing
    FactorOfDegree& own = found[factor.degree()];
    own.add(factor, modulus);
    if (own.primes < needed || (factor.degree() > 0 && !own.stable)) continue;
    if (factor.degree() == 0) return system.ring().constant(1);
    Polynomial result(system.ring());
    for (std::size_t k = 0; k < own.numbers.size(); ++k)
      result += system.ring().variable(place).pow(k).scaled(own.numbers[k]);
    return result;
  }
  return std::nullopt;
}

/// Whether some combination of minors has no other factor with the free parameters: then minors
/// have no common zeros beside those of the common factors.
bool vanishes_only_there(const std::vector<Polynomial>& combinations,
                         const std::vector<Polynomial>& common,
                         const std::vector<std::size_t>& free) {
  return std::any_of(combinations.begin(), combinations.end(), [&](const Polynomial& d) {
    if (d.is_zero()) return false;
    const auto factors = d.factors();
    return std::all_of(factors.begin(), factors.end(), [&](const auto& entry) {
      const Polynomial& factor = entry.first;
      return std::none_of(free.begin(), free.end(),
                          [&](std::size_t place) { return factor.uses(place); }) ||
             std::find(common.begin(), common.end(), factor) != common.end();
    });
  });
}

}  // namespace

RankConditions rank_conditions(const System& system, ParametricBlock block,
                               const std::vector<std::size_t>& free, const Watch& watch) {
  constexpr std::size_t kLargestSymbolic = 9, kLargestModular = 400;
  RankConditions result;
  block.eliminate_constants();
  drop_empty_columns(block);
  const std::vector<std::size_t> parameters = parameters_of(system, block);
  if (std::none_of(parameters.begin(), parameters.end(), [&](std::size_t p) {
        return std::find(free.begin(), free.end(), p) != free.end();
      }))
    return result;
  const std::size_t rank = generic_rank(system, block);
  if (rank == 0) return result;
  result.rank = rank;
  std::optional<Polynomial> common;
  std::vector<Polynomial> combinations;
  std::vector<std::size_t> own;
  for (const std::size_t p : parameters)
    if (std::find(free.begin(), free.end(), p) != free.end()) own.push_back(p);
  if (parameters.size() > 1 && rank <= kLargestSymbolic) {
    common = common_minor_factor(system, block, rank, combinations, watch);
  } else if (own.size() == 1 && rank <= kLargestModular) {
    // Other parameters have two sets of values: what both have in common does not depend on them.
    std::mt19937_64 random(61);
    for (int round = 0; round < (parameters.size() > 1 ? 2 : 1); ++round) {
      std::vector<long> others;
      for (std::size_t i = 0; i < system.ring().size(); ++i)
        others.push_back(static_cast<long>(random() % 100000) + 1000);
      const std::optional<Polynomial> factor =
          common_minor_factor(system, block, own[0], rank, others, watch);
      if (!factor) {
        result.decided = result.covered = false;
        return result;
      }
      if (common && !(*common == *factor)) result.decided = false;
      common = common ? Polynomial::gcd(*common, *factor) : *factor;
    }
  }
  if (!common || common->is_zero()) {
    result.decided = result.covered = false;
    return result;
  }
  for (const auto& [factor, exponent] : common->factors()) {
    const bool relevant = std::any_of(free.begin(), free.end(),
                                      [&f = factor](std::size_t place) { return f.uses(place); });
    if (relevant) result.factors.push_back(factor);
  }
  result.covered = own.size() == 1 || vanishes_only_there(combinations, result.factors, own);
  return result;
}

std::vector<cln::cl_RA> isolated_values(const System& system, const ParametricBlock& original,
                                        std::size_t first, std::size_t second, const Watch& watch) {
  constexpr double kMaxWork = 4e9;
  std::vector<cln::cl_RA> result;
  ParametricBlock block = original;
  block.eliminate_constants();
  drop_empty_columns(block);
  const std::size_t rank = generic_rank(system, block);
  if (rank == 0) return result;
  const Modulus modulus = Modulus::nth(0);
  long degree_first = 0, degree_second = 0;
  for (const Row& row : block.rows) {
    for (const auto& [c, p] : row) {
      degree_first = std::max(degree_first, p.degree(first));
      degree_second = std::max(degree_second, p.degree(second));
    }
  }
  const std::size_t points = 2 * rank * rank * static_cast<std::size_t>(degree_first) *
                                 static_cast<std::size_t>(degree_second) +
                             2;
  const double size = static_cast<double>(rank);
  if (static_cast<double>(points) * size * size * size * size * 3 > kMaxWork) return result;
  std::vector<mp_limb_t> places;
  std::vector<mp_limb_t> values[2];
  long common_degree = -1;
  // The remaining parameters have values that no condition would depend on by chance.
  Point others;
  std::mt19937_64 of_others(71);
  for (std::size_t i = 0; i < system.ring().size(); ++i)
    others.push_back(modulus.random(of_others));
  for (std::size_t i = 0; i < points; ++i) {
    watch.tick(static_cast<double>(i) / static_cast<double>(points));
    constexpr Residue kFirst = 2000003;
    others[first] = static_cast<Residue>(kFirst + i);
    std::mt19937_64 random(51);
    const std::vector<ModularPolynomial> list =
        OneParameter(block, second, others, modulus).determinants(rank, random);
    const ModularPolynomial common = common_factor(list);
    if (common_degree < 0) common_degree = common.degree();
    if (common.degree() != common_degree) continue;
    places.push_back(others[first]);
    for (std::size_t q = 0; q < 2; ++q)
      values[q].push_back(
          ModularPolynomial::resultant(list[0].divided_by(common), list[q + 1].divided_by(common)));
  }
  const ModularPolynomial shared =
      ModularPolynomial::gcd(ModularPolynomial::through(places, values[0], modulus),
                             ModularPolynomial::through(places, values[1], modulus));
  for (const Residue root : shared.roots(modulus)) {
    const std::optional<cln::cl_RA> number =
        rational_from(cln::cl_I(static_cast<unsigned long>(root)),
                      cln::cl_I(static_cast<unsigned long>(modulus.prime())));
    // Small ones only: every residue is some fraction.
    constexpr long kLargest = 1000;
    if (number && cln::abs(cln::numerator(*number)) <= kLargest &&
        cln::denominator(*number) <= kLargest)
      result.push_back(*number);
  }
  return result;
}

}  // namespace casimir::search

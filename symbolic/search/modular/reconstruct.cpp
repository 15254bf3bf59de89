#include "symbolic/search/modular/reconstruct.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "symbolic/search/modular/echelon.hpp"

namespace casimir::search {
namespace {

/// The fields with parameters as variables that rest.
Fields with_parameters(const System& system, const Fields& fields,
                       const std::vector<std::size_t>& parameters) {
  Fields result = fields;
  for (const std::size_t place : parameters) {
    result.places.push_back(place);
    for (auto& rates : result.rates) rates.push_back(Polynomial(system.ring()));
  }
  return result;
}

/// Every monomial times every one in `count` further variables of a degree up to `degree`; those of
/// low degree first.
/// \param orders  of each of these variables: only lower powers; 0 for no limit; or empty
Monomials times_parameters(const Monomials& monomials, std::size_t count, int degree,
                           const std::vector<unsigned long>& orders = {}) {
  Monomials result(monomials.variables() + count);
  if (count == 0) {
    for (std::size_t c = 0; c < monomials.size(); ++c)
      result.add({monomials[c], monomials[c] + monomials.variables()}, monomials.degree(c));
    return result;
  }
  const Monomials factors = all_monomials(std::vector<int>(count, 1), degree);
  std::vector<std::uint8_t> exponents;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    bool reduced = true;
    for (std::size_t k = 0; k < orders.size(); ++k)
      reduced = reduced && (orders[k] == 0 || factors[f][k] < orders[k]);
    if (!reduced) continue;
    for (std::size_t c = 0; c < monomials.size(); ++c) {
      exponents.assign(monomials[c], monomials[c] + monomials.variables());
      exponents.insert(exponents.end(), factors[f], factors[f] + count);
      result.add(exponents, factors.degree(f));
    }
  }
  return result;
}

/// The first vector of the null space that has a part in the ansatz, and that part; empty if none.
std::vector<Residue> first_solution(const Equations& equations, std::size_t multipliers,
                                    const Modulus& modulus, const Watch& watch) {
  std::vector<Residue> best;
  std::size_t best_end = equations.columns;
  for (Block& block : split(equations)) {
    const std::size_t last = block.columns.back();
    if (last < multipliers) continue;
    const Echelon echelon(modulus, std::move(block.rows), block.columns.size(), watch);
    if (echelon.nullity() == 0) continue;
    for (const std::vector<Residue>& vector : echelon.null_basis()) {
      std::size_t end = vector.size();
      while (end > 0 && vector[end - 1] == 0) --end;
      const std::size_t column = block.columns[end - 1];
      if (column < multipliers) continue;
      if (column < best_end) {
        best_end = column;
        best.assign(equations.columns - multipliers, 0);
        for (std::size_t i = 0; i < end; ++i) {
          if (block.columns[i] >= multipliers) best[block.columns[i] - multipliers] = vector[i];
        }
      }
      break;
    }
  }
  return best;
}

Polynomial polynomial_of(const System& system, const std::vector<std::size_t>& places,
                         const Monomials& monomials, const std::vector<cln::cl_RA>& coefficients) {
  TermCollector collector(system.ring());
  for (std::size_t c = 0; c < monomials.size(); ++c) {
    if (cln::zerop(coefficients[c])) continue;
    std::vector<unsigned long> exponents(system.ring().size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i) exponents[places[i]] = monomials[c][i];
    collector.add(coefficients[c], exponents);
  }
  Polynomial result = collector.finish();
  return result.scaled(1 / result.content());
}

bool is_annihilated(const Polynomial& f, const Fields& fields) {
  return std::all_of(fields.rates.begin(), fields.rates.end(), [&](const auto& rates) {
    SumOfProducts sum(f.ring());
    for (std::size_t i = 0; i < rates.size(); ++i) {
      if (!rates[i].is_zero()) sum.add(f.derivative(fields.places[i]), rates[i]);
    }
    return sum.finish().is_zero();
  });
}

/// Solutions modulo one prime after the other, put together until the fractions are right.
class Lift {
 public:
  Lift(const System& system, const Fields& fields, const Monomials& monomials, bool exact_check)
      : system_(system), fields_(fields), monomials_(monomials), exact_check_(exact_check) {}

  /// \return  the function, once it is known.
  std::optional<Polynomial> add(const std::vector<Residue>& solution, const Modulus& modulus) {
    if (residues_.empty()) {
      for (const Residue r : solution)
        residues_.push_back(cln::cl_I(static_cast<unsigned long>(r)));
      product_ = cln::cl_I(static_cast<unsigned long>(modulus.prime()));
    } else {
      for (std::size_t i = 0; i < solution.size(); ++i)
        residues_[i] = chinese_remainder(residues_[i], product_, solution[i], modulus);
      product_ = product_ * cln::cl_I(static_cast<unsigned long>(modulus.prime()));
    }
    std::vector<cln::cl_RA> numbers;
    for (const cln::cl_I& residue : residues_) {
      const std::optional<cln::cl_RA> number = rational_from(residue, product_);
      if (!number) return std::nullopt;
      numbers.push_back(*number);
    }
    const bool stable = numbers == numbers_;
    numbers_ = numbers;
    if (!exact_check_ && !stable) return std::nullopt;
    Polynomial f = polynomial_of(system_, fields_.places, monomials_, numbers);
    if (exact_check_ && !is_annihilated(f, fields_)) return std::nullopt;
    return f;
  }

 private:
  const System& system_;
  const Fields& fields_;
  const Monomials& monomials_;
  bool exact_check_;
  std::vector<cln::cl_I> residues_;
  cln::cl_I product_ = 1;
  std::vector<cln::cl_RA> numbers_;
};

/// A solution modulo a prime for the coefficients of monomials with parameters of a degree; empty
/// where there is none; no value where the prime cannot be used.
using Solver = std::function<std::optional<std::vector<Residue>>(
    const Monomials& monomials, int degree, const Modulus& modulus)>;

std::optional<Polynomial> lift(Lift result, const Solver& solve, const Monomials& monomials,
                               int degree, const Watch& watch) {
  constexpr std::size_t kPrimes = 60;
  for (std::size_t i = 0; i < kPrimes; ++i) {
    const Modulus modulus = Modulus::nth(i);
    const std::optional<std::vector<Residue>> solution = solve(monomials, degree, modulus);
    if (!solution) continue;
    if (solution->empty()) return std::nullopt;
    if (std::optional<Polynomial> f = result.add(*solution, modulus)) return f;
    watch.tick(static_cast<double>(i) / kPrimes);
  }
  return std::nullopt;
}

/// The least degree in the parameters at which there is a solution, and that one exactly.
/// \param orders  powers of the parameters below these; or empty
/// \param most  of the unknowns
std::optional<Polynomial> reconstruct_by(const System& system, const Fields& extended,
                                         const Solver& solve, const Modulus& modulus,
                                         const Monomials& support, std::size_t parameters,
                                         const std::vector<unsigned long>& orders, bool exact_check,
                                         double most, const Watch& watch) {
  constexpr int kHighestDegree = 12;
  for (int degree = 0; degree <= kHighestDegree; ++degree) {
    const std::vector<int> weights(parameters, 1);
    if (static_cast<double>(support.size()) * count_monomials(weights, degree) > most) break;
    const Monomials monomials = times_parameters(support, parameters, degree, orders);
    const std::optional<std::vector<Residue>> solution = solve(monomials, degree, modulus);
    if (!solution) return std::nullopt;
    if (!solution->empty()) {
      // Only what occurs, from now on.
      Monomials used(monomials.variables());
      for (std::size_t c = 0; c < monomials.size(); ++c) {
        if ((*solution)[c] == 0) continue;
        used.add({monomials[c], monomials[c] + monomials.variables()}, monomials.degree(c));
      }
      return lift(Lift(system, extended, used, exact_check), solve, used, degree, watch);
    }
    if (parameters == 0) break;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Polynomial> reconstruct(const System& system, const Fields& fields,
                                      const Monomials& support,
                                      const std::vector<Relation>& relations,
                                      const std::vector<std::size_t>& parameters,
                                      const Watch& watch) {
  constexpr double kUnknowns = 60000;
  const Fields extended = with_parameters(system, fields, parameters);
  const Point constants(system.ring().size(), 0);
  const auto solve = [&](const Monomials& monomials, int degree, const Modulus& modulus) {
    std::vector<Relation> scaled;
    std::size_t multipliers = 0;
    for (const Relation& relation : relations) {
      scaled.push_back({relation.function,
                        times_parameters(relation.multipliers, parameters.size(), degree + 2)});
      multipliers += scaled.back().multipliers.size();
    }
    const Equations equations = make_equations(extended, monomials, scaled, constants, modulus);
    return std::optional(first_solution(equations, multipliers, modulus, watch));
  };
  return reconstruct_by(system, extended, solve, Modulus::nth(0), support, parameters.size(), {},
                        relations.empty(), kUnknowns, watch);
}

std::optional<Polynomial> reconstruct_from_values(const System& system, const Fields& fields,
                                                  Samples::Goal goal, const Monomials& support,
                                                  const std::vector<std::size_t>& parameters,
                                                  const Watch& watch) {
  constexpr double kUnknowns = 3000;
  constexpr std::size_t kMore = 8;
  const Fields extended = with_parameters(system, fields, parameters);
  // Roots among them obey their equations, and lower powers of these are independent: x + I*y is
  // annihilated by I*x*d/dx + .. only since I^2 = -1.
  std::vector<unsigned long> orders;
  for (const std::size_t place : parameters) orders.push_back(system.order_of(place));
  const bool rooted = std::any_of(orders.begin(), orders.end(), [](auto q) { return q > 0; });
  const std::vector<std::size_t> free = rooted ? std::vector<std::size_t>{} : parameters;
  const auto solve = [&](const Monomials& monomials, int,
                         const Modulus& modulus) -> std::optional<std::vector<Residue>> {
    std::mt19937_64 random(5);
    if (!system.random_point(modulus, random)) return std::nullopt;
    Samples samples(system, fields, modulus, 17);
    const std::size_t rows = monomials.size() + kMore;
    if (!samples.draw(rows, nullptr, free, watch)) return std::nullopt;
    std::vector<std::uint32_t> columns(monomials.size());
    std::iota(columns.begin(), columns.end(), 0U);
    const Echelon echelon(modulus, samples.rows(goal, monomials, columns, extended.places, rows),
                          columns.size(), watch);
    if (echelon.nullity() == 0) return std::vector<Residue>{};
    return echelon.null_basis().front();
  };
  return reconstruct_by(system, extended, solve, usable_modulus(system), support, parameters.size(),
                        orders, false, kUnknowns, watch);
}

}  // namespace casimir::search

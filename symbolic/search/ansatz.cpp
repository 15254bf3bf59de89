// The unknowns of a search: monomials of which none is a combination of others as a function.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/search/integral_space.hpp"

namespace casimir::search {
namespace {

/// A monomial of highest weighted degree of p over the places.
std::vector<std::uint8_t> leading_monomial(const Polynomial& p,
                                           const std::vector<std::size_t>& places,
                                           const std::vector<int>& weights) {
  std::vector<std::uint8_t> best(places.size(), 0);
  int highest = -1;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    std::vector<std::uint8_t> own(places.size());
    int degree = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      own[i] = static_cast<std::uint8_t>(exponents[places[i]]);
      degree += weights[i] * own[i];
    }
    // Of one degree, that with most of the last variables, as in c^2 + s^2 - 1 and u^2 - b.
    if (degree > highest ||
        (degree == highest &&
         std::lexicographical_compare(best.rbegin(), best.rend(), own.rbegin(), own.rend()))) {
      highest = degree;
      best = own;
    }
  }
  return best;
}

bool divides(const std::vector<std::uint8_t>& a, const std::uint8_t* b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > b[i]) return false;
  return true;
}

Monomials without_multiples(const Monomials& monomials,
                            const std::vector<std::vector<std::uint8_t>>& leading) {
  if (leading.empty()) return monomials;
  Monomials result(monomials.variables());
  for (std::size_t c = 0; c < monomials.size(); ++c) {
    if (std::none_of(leading.begin(), leading.end(),
                     [&](const auto& m) { return divides(m, monomials[c]); }))
      result.add({monomials[c], monomials[c] + monomials.variables()}, monomials.degree(c));
  }
  return result;
}

/// Of all relations: more take minutes to be written down alone.
constexpr double kMostCofactors = 2e6;

/// The monomials of an ansatz or of a cofactor: of tensors those that are linear in the components.
Monomials monomials_of(const Problem& problem, const std::vector<int>& weights, int degree) {
  if (problem.fibre.empty()) return all_monomials(weights, degree);
  std::vector<int> base;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!problem.fibre[i]) base.push_back(weights[i]);
  const Monomials factors = all_monomials(base, degree - 1);
  Monomials result(weights.size());
  for (std::size_t c = 0; c < factors.size(); ++c) {
    std::vector<std::uint8_t> exponents(weights.size(), 0);
    for (std::size_t i = 0, k = 0; i < weights.size(); ++i)
      if (!problem.fibre[i]) exponents[i] = factors[c][k++];
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (!problem.fibre[i]) continue;
      exponents[i] = 1;
      result.add(exponents, factors.degree(c) + 1);
      exponents[i] = 0;
    }
  }
  return result;
}

/// \throws TooMuchMemory
Monomials limited_monomials(const Problem& problem, double most) {
  std::optional<Monomials> list = monomials_within(problem.limits, problem.weights, most);
  if (!list)
    throw TooMuchMemory(
        fmt::format("there are more than {:.3g} monomials within these degrees", most));
  return std::move(*list);
}

/// How many bytes a monomial takes at least.
double bytes_of_a_function(const Problem& problem) {
  constexpr double kBytesOfAFunction = 100;
  return static_cast<double>(problem.weights.size()) + kBytesOfAFunction;
}

/// The unknowns before relations are used.
Monomials unknowns_of(const Problem& problem, const Watch& watch) {
  if (problem.limits.empty()) return monomials_of(problem, problem.weights, problem.degree);
  return limited_monomials(problem, watch.memory_limit / bytes_of_a_function(problem));
}

/// What the equations take, in bytes.
double bytes_of(const Problem& problem, const Watch& watch) {
  constexpr double kBytesOfAnEntry = 60;
  if (!problem.limits.empty()) {
    double terms = 0;
    for (const auto& rates : problem.fields.rates)
      for (const Polynomial& rate : rates) terms += static_cast<double>(rate.terms());
    return static_cast<double>(unknowns_of(problem, watch).size()) *
           (terms * kBytesOfAnEntry + bytes_of_a_function(problem));
  }
  if (problem.fibre.empty())
    return bytes_of_equations(problem.fields, problem.weights, problem.degree);
  std::vector<int> base;
  double terms = 0, components = 0;
  for (std::size_t i = 0; i < problem.weights.size(); ++i) {
    if (!problem.fibre[i]) base.push_back(problem.weights[i]);
    components += problem.fibre[i] ? 1 : 0;
    for (const auto& rates : problem.fields.rates) terms += static_cast<double>(rates[i].terms());
  }
  // A monomial times one component meets the terms of the base, and those of that component.
  return count_monomials(base, problem.degree - 1) * terms * components * kBytesOfAnEntry;
}

/// No problem of this size is begun.
void check_memory(const Problem& problem, const Watch& watch) {
  const double bytes = bytes_of(problem, watch);
  if (bytes <= watch.memory_limit) return;
  const double unknowns = problem.limits.empty()
                              ? count_monomials(problem.weights, problem.degree)
                              : static_cast<double>(unknowns_of(problem, watch).size());
  throw TooMuchMemory(fmt::format(
      "degree {} has {:.3g} unknowns, whose equations take about {:.3g} GB, more than the limit "
      "of {:.3g} GB",
      problem.degree, unknowns, bytes / 1e9, watch.memory_limit / 1e9));
}

/// By how much the fields raise the degree.
int growth_of(const Problem& problem, const std::vector<int>& weights) {
  int growth = 0;
  for (const auto& rates : problem.fields.rates) {
    for (std::size_t i = 0; i < rates.size(); ++i) {
      if (rates[i].is_zero()) continue;
      growth =
          std::max(growth, weighted_degree(rates[i], problem.fields.places, weights) - weights[i]);
    }
  }
  return growth;
}

/// Weights by which the relations are a Groebner basis if their leading monomials have no variable
/// in common: a defined function is as heavy as its value, and leads it as it stands behind.
std::vector<int> weights_of_relations(const System& system, const Problem& problem) {
  std::vector<int> weights = problem.weights;
  for (const System::Defined& d : system.defined()) {
    const auto place =
        std::find(problem.fields.places.begin(), problem.fields.places.end(), d.place);
    if (place == problem.fields.places.end()) continue;
    weights[static_cast<std::size_t>(place - problem.fields.places.begin())] =
        std::max(1, weighted_degree(d.value, problem.fields.places, weights));
  }
  return weights;
}

/// Of the rates of the ansatz, by the weights of the relations.
int highest_degree(const System& system, const Problem& problem, const Monomials& ansatz,
                   const std::vector<int>& weights) {
  int highest = problem.degree;
  for (std::size_t c = 0; c < ansatz.size() && !system.defined().empty(); ++c) {
    int own = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) own += weights[i] * ansatz[c][i];
    highest = std::max(highest, own);
  }
  highest += growth_of(problem, weights);
  constexpr int kHighestPower = 250;
  if (!system.defined().empty() && highest > kHighestPower)
    throw ModelError("the degrees of the declared functions are too high to be searched");
  return highest;
}

/// Functions of which each is a combination of those before it with rational coefficients, or
/// independent of them: the first is checked exactly, the second modulo a prime, where functions
/// are independent only if they are.
class Combinations {
 public:
  explicit Combinations(const System& system) : system_(system), modulus_(usable_modulus(system)) {
    std::mt19937_64 random(81);
    constants_ = system.random_point(modulus_, random);
  }

  enum class Added { independent, dependent, unknown };
  Added add(const Polynomial& f);

 private:
  using Row = std::map<std::size_t, Residue>;
  struct Reduced {
    std::size_t pivot;
    Row row, combination;  ///< row = the sum of combination[k] times the k-th function
  };
  Row row_of(const Polynomial& f);
  void subtract(Row& row, const Row& other, Residue factor) const;

  const System& system_;
  Modulus modulus_;
  std::optional<Point> constants_;
  std::map<std::vector<unsigned long>, std::size_t> columns_;
  std::vector<Polynomial> functions_;
  std::vector<Reduced> rows_;
};

/// The coefficients of the monomials in what moves.
Combinations::Row Combinations::row_of(const Polynomial& f) {
  Row row;
  for (auto [number, exponents] : f.term_list()) {
    Residue value = modulus_.reduce(number).value_or(0);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (!system_.is_constant()[i]) continue;
      value = modulus_.multiply(value, modulus_.power((*constants_)[i], exponents[i]));
      exponents[i] = 0;
    }
    Residue& sum = row[columns_.try_emplace(exponents, columns_.size()).first->second];
    sum = modulus_.add(sum, value);
  }
  std::erase_if(row, [](const auto& entry) { return entry.second == 0; });
  return row;
}

void Combinations::subtract(Row& row, const Row& other, Residue factor) const {
  for (const auto& [place, value] : other) {
    Residue& sum = row[place];
    sum = modulus_.add(sum, modulus_.negative(modulus_.multiply(factor, value)));
    if (sum == 0) row.erase(place);
  }
}

Combinations::Added Combinations::add(const Polynomial& f) {
  if (!constants_) return Added::unknown;
  Row row = row_of(f), combination{{functions_.size(), 1}};
  for (const Reduced& known : rows_) {
    const auto entry = row.find(known.pivot);
    if (entry == row.end()) continue;
    const Residue factor =
        modulus_.multiply(entry->second, modulus_.inverse(known.row.at(known.pivot)));
    subtract(row, known.row, factor);
    subtract(combination, known.combination, factor);
  }
  if (!row.empty()) {
    functions_.push_back(f);
    const std::size_t pivot = row.begin()->first;
    rows_.push_back({pivot, std::move(row), std::move(combination)});
    return Added::independent;
  }
  // f is minus the sum of the others.
  Polynomial rest = f;
  for (const auto& [k, residue] : combination) {
    if (k == functions_.size()) continue;
    const std::optional<cln::cl_RA> number =
        rational_from(cln::cl_I(static_cast<unsigned long>(residue)),
                      cln::cl_I(static_cast<unsigned long>(modulus_.prime())));
    if (!number) return Added::unknown;
    rest += functions_[k].scaled(*number);
  }
  return rest.is_zero() ? Added::dependent : Added::unknown;
}

/// The monomials without silent atoms, and without those that are combinations of others as
/// functions: (x^(2/3))^3 is x^2, and (x^2 + y^2)/r is r.
void choose_independent(const System& system, const Problem& problem, Ansatz& ansatz) {
  const auto& places = problem.fields.places;
  Monomials visible(places.size());
  std::vector<Polynomial> values;
  for (std::size_t c = 0; c < ansatz.monomials.size(); ++c) {
    const std::uint8_t* exponents = ansatz.monomials[c];
    Polynomial value = system.ring().constant(1);
    bool silent = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (exponents[i] == 0) continue;
      silent = silent || system.is_silent()[places[i]];
      const auto own = std::find_if(system.defined().begin(), system.defined().end(),
                                    [&](const auto& d) { return d.place == places[i]; });
      const Polynomial base =
          own == system.defined().end() ? system.ring().variable(places[i]) : own->value;
      if (!silent) value = system.functions().checked_product(value, base.pow(exponents[i]));
    }
    if (silent) continue;
    visible.add({exponents, exponents + places.size()}, ansatz.monomials.degree(c));
    values.push_back(std::move(value));
  }
  values = system.functions().common_numerators(std::move(values));
  ansatz.monomials = Monomials(places.size());
  Combinations kept(system);
  for (std::size_t c = 0; c < visible.size(); ++c) {
    const Combinations::Added added = kept.add(values[c]);
    if (added == Combinations::Added::dependent) continue;
    ansatz.independent = ansatz.independent && added == Combinations::Added::independent;
    ansatz.monomials.add({visible[c], visible[c] + places.size()}, visible.degree(c));
  }
}

/// Whether no term of a relation has a higher degree, by any of the limits, than its leading one.
bool stays_within(const std::vector<DegreeLimit>& limits, const Polynomial& relation,
                  const std::vector<std::size_t>& places,
                  const std::vector<std::uint8_t>& leading) {
  return std::ranges::all_of(limits, [&](const DegreeLimit& limit) {
    return limit.of(relation, places) <= limit.of(leading.data());
  });
}

}  // namespace

Monomials visible_monomials(const System& system, const Problem& problem, const Watch& watch) {
  if (problem.limits.empty()) {
    const double functions = count_monomials(problem.weights, problem.degree);
    if (functions * bytes_of_a_function(problem) > watch.memory_limit)
      throw TooMuchMemory(fmt::format("degree {} has {:.3g} unknowns, more than fit into {:.3g} GB",
                                      problem.degree, functions, watch.memory_limit / 1e9));
  }
  const auto& places = problem.fields.places;
  const Monomials all = unknowns_of(problem, watch);
  Monomials result(places.size());
  for (std::size_t c = 0; c < all.size(); ++c) {
    bool silent = false;
    for (std::size_t i = 0; i < places.size(); ++i)
      silent = silent || (all[c][i] != 0 && system.is_silent()[places[i]]);
    if (!silent) result.add({all[c], all[c] + places.size()}, all.degree(c));
  }
  return result;
}

Ansatz make_ansatz(const System& system, const Problem& problem, const Watch& watch) {
  check_memory(problem, watch);
  const auto& places = problem.fields.places;
  const std::vector<int> weights = weights_of_relations(system, problem);
  std::vector<Polynomial> level = problem.on;
  level.insert(level.end(), system.relations().begin(), system.relations().end());
  std::vector<std::vector<std::uint8_t>> leading;
  bool closed = true;
  for (const Polynomial& f : level) {
    leading.push_back(leading_monomial(f, places, weights));
    closed = closed && stays_within(problem.limits, f, places, leading.back());
  }
  // A defined function is an unknown itself, and not what it leads.
  const auto replaced = leading.end() - static_cast<std::ptrdiff_t>(system.defined().size());
  Ansatz ansatz{without_multiples(unknowns_of(problem, watch), {leading.begin(), replaced}), {}};
  ansatz.closed = closed;
  if (!system.defined().empty()) choose_independent(system, problem, ansatz);
  const int highest = highest_degree(system, problem, ansatz.monomials, weights);
  double cofactors = 0;
  for (std::size_t f = 0; f < level.size(); ++f) {
    const int left = highest - weighted_degree(level[f], places, weights);
    const auto own = leading.begin() + static_cast<std::ptrdiff_t>(f);
    cofactors += left >= 0 ? count_monomials(weights, left) : 0;
    if (cofactors > kMostCofactors)
      throw TooMuchWork(fmt::format(
          "the cofactors of relations between the functions would have {:.3g} unknowns, more than "
          "{:.3g}",
          cofactors, kMostCofactors));
    // A multiple of an earlier relation need not be a cofactor: that one's takes it over.
    if (left >= 0) {
      ansatz.relations.push_back({level[f], without_multiples(monomials_of(problem, weights, left),
                                                              {leading.begin(), own})});
    }
    for (auto earlier = leading.begin(); earlier != own; ++earlier) {
      for (std::size_t k = 0; k < places.size(); ++k)
        ansatz.coprime = ansatz.coprime && ((*earlier)[k] == 0 || (*own)[k] == 0);
    }
  }
  return ansatz;
}

}  // namespace casimir::search

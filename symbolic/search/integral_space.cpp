#include "symbolic/search/integral_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "symbolic/search/independent_monomials.hpp"
#include "symbolic/search/modular/level_points.hpp"
#include "symbolic/search/modular/reconstruct.hpp"
#include "symbolic/search/modular/shorten.hpp"

namespace casimir::search {
namespace {

/// The prime of a search. Where a level is given, one modulo which it has points: x^2 - 2*y^2 = 0
/// has none but zero for half of the primes.
Modulus modulus_for(const System& system, const LevelPoints& level) {
  constexpr std::size_t kPrimes = 64;
  for (std::size_t i = 0; i < kPrimes && level.possible(); ++i) {
    std::mt19937_64 random(11);
    const Modulus modulus = Modulus::nth(i);
    const std::optional<Point> constants = system.random_point(modulus, random);
    if (constants && level.draw(modulus, random, *constants)) return modulus;
  }
  return usable_modulus(system);
}

/// One search: the null space modulo a prime at a random point of the parameters, and what of it is
/// new.
class Run {
 public:
  Run(const System& system, const Problem& problem, const Watch& watch)
      : system_(system),
        problem_(problem),
        watch_(watch),
        level_(system, problem.on, problem.fields.places),
        modulus_(problem.on.empty() ? usable_modulus(system) : modulus_for(system, level_)),
        random_(11),
        ansatz_(problem.weights.size()),
        span_(modulus_),
        generators_(problem.known),
        by_values_(problem.on.empty() && !system.relations().empty() &&
                   !problem.fields.plain.empty()),
        samples_(system, problem.fields, modulus_, 41) {}

  Solution run();

 private:
  struct Vector {
    std::size_t block;
    int degree;
    std::vector<Residue> entries;  ///< over the block's columns
    std::vector<Residue> values;   ///< at the points
  };

  void take_ansatz();
  void take_ansatz_by_values();
  void eliminate();
  void eliminate_by_values();
  void add_block(Block block, std::size_t done, std::size_t columns);
  bool only_trivial();
  void check_memory() const;
  void draw_points(std::size_t count);
  std::vector<Residue> column_values(std::size_t column) const;
  std::vector<Residue> values_of(const Polynomial& f) const;
  std::vector<Vector> null_vectors();
  void add_product(const std::vector<int>& exponents);
  void add_products(std::size_t old);
  std::optional<Polynomial> realise(const Vector& vector);
  std::vector<std::vector<Residue>> trivial_vectors(int degree);

  const System& system_;
  const Problem& problem_;
  const Watch& watch_;
  LevelPoints level_;
  Modulus modulus_;
  std::mt19937_64 random_;
  Monomials ansatz_;
  std::vector<Relation> relations_;
  std::size_t multipliers_ = 0;
  bool coprime_ = true, independent_ = true, closed_ = true;
  Point constants_;
  std::vector<Block> blocks_;
  std::vector<Echelon> echelons_;
  std::size_t nullity_ = 0;
  std::vector<Point> points_;
  Span span_;
  std::vector<Generator> generators_;
  std::vector<std::vector<Residue>> generator_values_;
  /// Functions that obey relations are compared by their values, and not with cofactors.
  bool by_values_;
  Samples samples_;
  std::vector<std::vector<std::uint32_t>> parts_;
  Solution solution_;
};

void Run::take_ansatz_by_values() {
  const Monomials list = visible_monomials(system_, problem_, watch_);
  IndependentMonomials chosen = independent_monomials(
      system_, problem_.fields, {list, problem_.limits}, modulus_, constants_, samples_, watch_);
  ansatz_ = std::move(chosen.monomials);
  parts_ = std::move(chosen.parts);
  independent_ = chosen.complete;
}

void Run::take_ansatz() {
  if (by_values_) {
    take_ansatz_by_values();
    return;
  }
  Ansatz ansatz = make_ansatz(system_, problem_, watch_);
  ansatz_ = std::move(ansatz.monomials);
  relations_ = std::move(ansatz.relations);
  coprime_ = ansatz.coprime;
  independent_ = ansatz.independent;
  closed_ = ansatz.closed;
  for (const Relation& relation : relations_) multipliers_ += relation.multipliers.size();
}

/// \param done  columns of the blocks before it, of so many in all
void Run::add_block(Block block, std::size_t done, std::size_t columns) {
  Watch part = watch_;
  solution_.largest_block = std::max(solution_.largest_block, block.columns.size());
  const double before = static_cast<double>(done) / static_cast<double>(columns);
  const double width = static_cast<double>(block.columns.size()) / static_cast<double>(columns);
  part.tick = [&](double share) { watch_.tick(before + width * share); };
  echelons_.emplace_back(modulus_, std::move(block.rows), block.columns.size(), part);
  nullity_ += echelons_.back().nullity();
  block.rows.clear();
  blocks_.push_back(std::move(block));
}

void Run::eliminate() {
  if (by_values_) {
    eliminate_by_values();
    return;
  }
  const Equations equations =
      make_equations(problem_.fields, ansatz_, relations_, constants_, modulus_);
  std::vector<Block> blocks = split(equations);
  // Cofactors alone say only what holds between the relations.
  std::erase_if(blocks, [&](const Block& block) { return block.columns.back() < multipliers_; });
  solution_.unknowns = equations.columns;
  solution_.equations = equations.rows();
  solution_.blocks = blocks.size();
  std::size_t done = 0;
  echelons_.reserve(blocks.size());
  for (Block& block : blocks) {
    const std::size_t own = block.columns.size();
    add_block(std::move(block), done, equations.columns);
    done += own;
  }
}

void Run::eliminate_by_values() {
  constexpr std::size_t kMore = 16;
  solution_.unknowns = ansatz_.size();
  solution_.blocks = parts_.size();
  std::size_t done = 0;
  echelons_.reserve(parts_.size());
  for (std::vector<std::uint32_t>& columns : parts_) {
    const std::size_t rows = columns.size() + kMore;
    check_memory_of_values(rows, watch_);
    if (!samples_.draw(rows, &constants_, {}, watch_))
      throw ModelError("no points of the functions were found modulo a prime");
    solution_.equations += rows;
    Block block{std::move(columns), {}};
    block.rows = samples_.rows(Samples::Goal::annihilated, ansatz_, block.columns,
                               problem_.fields.places, rows);
    const std::size_t own = block.columns.size();
    add_block(std::move(block), done, ansatz_.size());
    done += own;
  }
}

/// Whether the known functions, if they are independent, account for the whole null space: the
/// products of independent functions are linearly independent, and need not be looked at.
bool Run::only_trivial() {
  if (!relations_.empty() || by_values_) return false;
  std::vector<Polynomial> functions;
  for (const Generator& g : generators_) functions.push_back(g.function);
  if (rank_of_gradients(system_, functions) < functions.size()) return false;
  if (known_products(generators_, problem_, problem_.degree, 0).size() != nullity_) return false;
  solution_.trivial = nullity_;
  return true;
}

/// Relations between the relations may make a large null space, of which nothing is new.
void Run::check_memory() const {
  const auto all = static_cast<double>(nullity_);
  double kept = all * all, largest = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto own = static_cast<double>(echelons_[b].nullity());
    const auto columns = own == 0 ? 0 : static_cast<double>(blocks_[b].columns.size());
    kept += columns * own;
    largest = std::max(largest, columns * (all + own));
  }
  if ((kept + largest) * sizeof(Residue) > watch_.memory_limit)
    throw TooMuchWork(fmt::format(
        "the equations have {} solutions, more than can be looked at one by one", nullity_));
}

void Run::draw_points(std::size_t count) {
  while (points_.size() < count) {
    watch_.tick(static_cast<double>(points_.size()) / static_cast<double>(count));
    std::optional<Point> point = problem_.on.empty()
                                     ? system_.random_point(modulus_, random_, &constants_)
                                     : level_.draw(modulus_, random_, constants_);
    if (!point)
      throw ModelError(
          "no points of the level were found modulo any of the primes that were tried");
    points_.push_back(std::move(*point));
  }
}

std::vector<Residue> Run::column_values(std::size_t column) const {
  std::vector<Residue> values(points_.size(), 0);
  if (column < multipliers_) return values;
  const std::uint8_t* exponents = ansatz_[column - multipliers_];
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Residue value = 1;
    for (std::size_t i = 0; i < ansatz_.variables(); ++i) {
      for (int k = 0; k < exponents[i]; ++k)
        value = modulus_.multiply(value, points_[p][problem_.fields.places[i]]);
    }
    values[p] = value;
  }
  return values;
}

std::vector<Residue> Run::values_of(const Polynomial& f) const {
  std::vector<Residue> values;
  for (const Point& point : points_) {
    const std::optional<Residue> value = value_at(f, point, modulus_);
    if (!value) throw std::domain_error("the prime divides a denominator");
    values.push_back(*value);
  }
  return values;
}

std::vector<Run::Vector> Run::null_vectors() {
  std::vector<Vector> result;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (echelons_[b].nullity() == 0) continue;
    const std::vector<std::uint32_t>& columns = blocks_[b].columns;
    std::vector<std::vector<Residue>> values;
    for (const std::uint32_t column : columns) values.push_back(column_values(column));
    watch_.tick(static_cast<double>(b) / static_cast<double>(blocks_.size()));
    for (std::vector<Residue>& entries : echelons_[b].null_basis()) {
      std::vector<std::uint64_t> sums(points_.size(), 0);
      int degree = -1;
      for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i] == 0) continue;
        if (columns[i] >= multipliers_)
          degree = std::max(degree, ansatz_.degree(columns[i] - multipliers_));
        for (std::size_t p = 0; p < sums.size(); ++p)
          sums[p] = modulus_.reduce(sums[p] + std::uint64_t{entries[i]} * values[i][p]);
      }
      result.push_back({b, degree, std::move(entries), {sums.begin(), sums.end()}});
    }
    watch_.tick(static_cast<double>(b) / static_cast<double>(blocks_.size()));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Vector& a, const Vector& b) { return a.degree < b.degree; });
  return result;
}

/// Puts a product of the generators into the span.
void Run::add_product(const std::vector<int>& exponents) {
  std::vector<Residue> values(points_.size(), 1);
  for (std::size_t g = 0; g < exponents.size(); ++g) {
    for (int k = 0; k < exponents[g]; ++k)
      for (std::size_t p = 0; p < values.size(); ++p)
        values[p] = modulus_.multiply(values[p], generator_values_[g][p]);
  }
  span_.insert(std::move(values));
}

/// Puts the products into the span that use any generator from the place `old` on.
void Run::add_products(std::size_t old) {
  while (generator_values_.size() < generators_.size())
    generator_values_.push_back(values_of(generators_[generator_values_.size()].function));
  for (const std::vector<int>& exponents :
       known_products(generators_, problem_, problem_.degree, old))
    add_product(exponents);
  if (!by_values_ || span_.dimension() == nullity_) return;
  for (const std::vector<int>& exponents : lowered_products(system_, generators_, problem_, old))
    add_product(exponents);
}

/// Coefficients, modulo the prime, of products of generators up to a degree.
std::vector<std::vector<Residue>> Run::trivial_vectors(int degree) {
  constexpr std::size_t kMaxTerms = 3000, kMaxProducts = 60;
  std::unordered_map<std::string, std::size_t> columns;
  for (std::size_t c = 0; c < ansatz_.size(); ++c)
    columns.emplace(std::string(ansatz_[c], ansatz_[c] + ansatz_.variables()), c);
  std::vector<std::vector<Residue>> result;
  std::vector<std::vector<int>> products = known_products(generators_, problem_, degree, 0);
  if (products.size() > kMaxProducts) return result;
  for (const std::vector<int>& exponents : products) {
    Polynomial product = system_.ring().constant(1);
    for (std::size_t g = 0; g < exponents.size() && product.terms() <= kMaxTerms; ++g)
      product = product * generators_[g].function.pow(static_cast<unsigned long>(exponents[g]));
    if (product.terms() > kMaxTerms) continue;
    std::vector<Residue> vector(ansatz_.size(), 0);
    bool inside = true;
    for (const auto& [number, powers] : product.term_list()) {
      std::string own(ansatz_.variables(), '\0');
      Residue coefficient = modulus_.reduce(number).value_or(0);
      for (std::size_t i = 0; i < own.size(); ++i)
        own[i] = static_cast<char>(powers[problem_.fields.places[i]]);
      for (std::size_t i = 0; i < powers.size(); ++i) {
        if (system_.is_constant()[i] && powers[i] != 0)
          coefficient = modulus_.multiply(coefficient, modulus_.power(constants_[i], powers[i]));
      }
      const auto column = columns.find(own);
      if (column == columns.end()) {
        inside = false;
        break;
      }
      vector[column->second] = modulus_.add(vector[column->second], coefficient);
    }
    if (inside) result.push_back(std::move(vector));
  }
  return result;
}

/// The function of a null vector, exactly: first made short by what is known, which leaves a few
/// monomials, and then found again among these.
std::optional<Polynomial> Run::realise(const Vector& vector) {
  std::vector<Residue> coefficients(ansatz_.size(), 0);
  const std::vector<std::uint32_t>& columns = blocks_[vector.block].columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] >= multipliers_) coefficients[columns[i] - multipliers_] = vector.entries[i];
  }
  const std::vector<Residue> plain = coefficients;
  coefficients = shortened(coefficients, trivial_vectors(vector.degree), modulus_);
  for (const std::vector<Residue>& form : {coefficients, plain}) {
    Monomials support(ansatz_.variables());
    for (std::size_t c = 0; c < form.size(); ++c) {
      if (form[c] != 0)
        support.add({ansatz_[c], ansatz_[c] + ansatz_.variables()}, ansatz_.degree(c));
    }
    std::optional<Polynomial> f =
        by_values_ ? reconstruct_from_values(system_, problem_.fields, Samples::Goal::annihilated,
                                             support, system_.parameters(), watch_)
                   : reconstruct(system_, problem_.fields, support, relations_,
                                 system_.parameters(), watch_);
    // As a function of a free I, or sqrt(2), there may be none.
    const bool rooted = !by_values_ && problem_.on.empty() && !problem_.fields.plain.empty() &&
                        !system_.bound_parameter().empty();
    if (!f && rooted)
      f = reconstruct_from_values(system_, problem_.fields, Samples::Goal::annihilated, support,
                                  system_.parameters(), watch_);
    if (f && !span_.contains(values_of(*f))) return f;
  }
  return std::nullopt;
}

Solution Run::run() {
  if (!problem_.on.empty() && !level_.possible())
    throw ModelError("the functions of the level cannot be solved one after the other");
  const std::optional<Point> constants = system_.random_point(modulus_, random_);
  if (!constants) throw ModelError("no values of the parameters were found modulo a prime");
  constants_ = *constants;
  take_ansatz();
  eliminate();
  if (only_trivial()) {
    solution_.complete = true;
    return solution_;
  }
  check_memory();
  draw_points(nullity_ + 16);
  add_products(0);
  solution_.trivial = span_.dimension();
  bool all_found = true;
  for (const Vector& vector : null_vectors()) {
    if (span_.contains(vector.values)) continue;
    std::optional<Polynomial> f = realise(vector);
    if (!f) {
      all_found = false;
      span_.insert(vector.values);
      continue;
    }
    const int degree = weighted_degree(*f, problem_.fields.places, problem_.weights);
    generators_.push_back({*f, degree});
    solution_.found.push_back(generators_.back());
    add_products(generators_.size() - 1);
  }
  solution_.found_dimension = span_.dimension() - solution_.trivial;
  // Cofactors, of the functions of a level, are unknowns for one field only.
  const bool cofactors = relations_.empty() || problem_.fields.rates.size() == 1;
  solution_.complete = all_found && coprime_ && independent_ && closed_ && cofactors &&
                       span_.dimension() == nullity_;
  if (!all_found) {
    solution_.reason =
        "there seem to be further integrals, but their coefficients were not found as polynomials "
        "of a moderate degree in the parameters with moderate numbers";
  } else if (!coprime_) {
    solution_.reason =
        "only cofactors of low degree were tried, and the functions of the level may need others";
  } else if (!independent_) {
    solution_.reason = "the declared functions are not independent of the others";
  } else if (!closed_) {
    solution_.reason =
        "by a relation between the functions, or on the level, a monomial is equal to one that is "
        "beyond a limit of the degrees";
  } else if (!cofactors) {
    solution_.reason =
        "the rates of Casimir functions are compared without the relations between roots, sines "
        "and denominators";
  } else if (!solution_.complete) {
    solution_.reason =
        fmt::format("modulo a prime there are {} solutions, while {} were found: more may exist",
                    nullity_, span_.dimension());
  }
  return solution_;
}

}  // namespace

int weighted_degree(const Polynomial& p, const std::vector<std::size_t>& places,
                    const std::vector<int>& weights) {
  int highest = 0;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    int degree = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      degree += weights[i] * static_cast<int>(exponents[places[i]]);
    highest = std::max(highest, degree);
  }
  return highest;
}

std::size_t rank_of_gradients(const System& system, const std::vector<Polynomial>& functions) {
  const Modulus modulus = usable_modulus(system);
  std::mt19937_64 random(5);
  const std::optional<Point> point = system.random_point(modulus, random);
  if (!point) return 0;
  Span span(modulus);
  for (const Polynomial& f : functions) {
    std::vector<Residue> gradient;
    for (const Polynomial& slope : system.gradient(f))
      gradient.push_back(value_at(slope, *point, modulus).value_or(0));
    span.insert(std::move(gradient));
  }
  return span.dimension();
}

Solution solve(const System& system, const Problem& problem, const Watch& watch) {
  return Run(system, problem, watch).run();
}

}  // namespace casimir::search

// Real solutions of polynomial equations by rational numbers and square roots.
#include <algorithm>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/structure/bracket_search.hpp"
#include "symbolic/structure/relate/equations.hpp"

namespace casimir::structure {
namespace {

using GiNaC::ex;

constexpr std::size_t kMostChoices = 300;

/// The value of p; without symbols.
ex value_of(const Polynomial& p, const std::vector<ex>& values) {
  ex sum = 0;
  for (const auto& [number, exponents] : p.term_list()) {
    ex term = GiNaC::numeric(number);
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] > 0) term *= GiNaC::pow(values[i], static_cast<int>(exponents[i]));
    sum += term;
  }
  return sum.expand();
}

bool vanishes_or_unknown(const ex& value) {
  if (GiNaC::is_a<GiNaC::numeric>(value)) return value.is_zero();
  const auto constant = exact_constant(value);
  return !constant || constant->zero;  // what is not known is not used
}

class Values {
 public:
  Values(const search::Branch& branch, const std::vector<std::size_t>& unknowns,
         std::size_t ring_size, const std::function<bool(const std::vector<ex>&)>& accept)
      : branch_(branch), unknowns_(unknowns), accept_(accept), values_(ring_size) {}

  bool run() {
    const auto relations = search::triangular(branch_.rest, unknowns_);
    if (!relations) return false;
    relations_ = *relations;
    std::vector<std::size_t> free;
    for (const std::size_t u : unknowns_) {
      const bool solved = std::any_of(branch_.solved.begin(), branch_.solved.end(),
                                      [&](const auto& s) { return s.place == u; });
      const bool bound = std::any_of(relations_.begin(), relations_.end(),
                                     [&](const auto& r) { return r.variable == u; });
      if (!solved && !bound) free.push_back(u);
    }
    std::size_t tried = 0;
    for (const auto& choice : simple_constants(free.size())) {
      if (++tried > kMostChoices) return false;
      for (std::size_t k = 0; k < free.size(); ++k) values_[free[k]] = choice[k];
      if (bound_values(relations_.size())) return true;
    }
    return false;
  }

 private:
  /// Values of the main variables of the first `count` relations: the last has the fewest others.
  bool bound_values(std::size_t count) {
    if (count == 0) return solved_values();
    const SolvedRelation& own = relations_[count - 1];
    const std::vector<Polynomial> parts = own.relation.coefficients(own.variable);
    std::vector<ex> numbers;
    for (const Polynomial& part : parts) numbers.push_back(value_of(part, values_));
    for (const ex& root : roots_of(numbers)) {
      values_[own.variable] = root;
      if (bound_values(count - 1)) return true;
    }
    return false;
  }

  /// The real roots of a polynomial of degree 1 or 2, or of a power alone, with rational numbers
  /// (of degree 1 with others too).
  static std::vector<ex> roots_of(std::vector<ex> c) {
    while (!c.empty() && c.back().is_zero()) c.pop_back();
    if (c.size() == 2) return {(-c[0] / c[1]).expand()};
    const bool rational = std::all_of(
        c.begin(), c.end(), [](const ex& e) { return e.info(GiNaC::info_flags::rational); });
    if (!rational || c.size() < 3) return {};
    const auto sign = [](const ex& e) { return GiNaC::ex_to<GiNaC::numeric>(e).csgn(); };
    if (c.size() == 3) {
      const ex discriminant = c[1] * c[1] - 4 * c[0] * c[2];
      if (sign(discriminant) < 0) return {};
      const ex root = GiNaC::sqrt(discriminant);
      return {((-c[1] + root) / (2 * c[2])).expand(), ((-c[1] - root) / (2 * c[2])).expand()};
    }
    const bool pure =
        std::all_of(c.begin() + 1, c.end() - 1, [](const ex& e) { return e.is_zero(); });
    const auto degree = static_cast<int>(c.size()) - 1;
    const ex inside = -c.front() / c.back();
    if (!pure || (sign(inside) < 0 && degree % 2 == 0)) return {};
    const ex root =
        GiNaC::pow(GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(inside)), GiNaC::numeric(1, degree));
    if (degree % 2 == 0) return {root, -root};
    return {sign(inside) < 0 ? ex(-root) : root};
  }

  bool solved_values() {
    for (auto s = branch_.solved.rbegin(); s != branch_.solved.rend(); ++s) {
      const ex bottom = value_of(s->denominator, values_);
      if (vanishes_or_unknown(bottom)) return false;
      values_[s->place] = (value_of(s->numerator, values_) / bottom).expand();
    }
    for (const Polynomial& p : branch_.nonzero)
      if (vanishes_or_unknown(value_of(p, values_))) return false;
    return accept_(values_);
  }

  const search::Branch& branch_;
  const std::vector<std::size_t>& unknowns_;
  const std::function<bool(const std::vector<ex>&)>& accept_;
  std::vector<SolvedRelation> relations_;
  std::vector<ex> values_;
};

}  // namespace

bool find_real_values(const search::Branch& branch, const std::vector<std::size_t>& unknowns,
                      std::size_t ring_size,
                      const std::function<bool(const std::vector<ex>&)>& accept) {
  return Values(branch, unknowns, ring_size, accept).run();
}

}  // namespace casimir::structure

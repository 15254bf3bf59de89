#include "symbolic/functions/convert/angles.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include "symbolic/algebra/machine_word.hpp"

namespace casimir::functions {

using GiNaC::ex;

/// The generators sin(unit) and cos(unit), which stand side by side.
std::pair<Polynomial, Polynomial> Angles::plain_sine_cosine(const Polynomial& unit) {
  std::size_t index = 0;
  if (table_.find(Kind::sine, unit, 1, &index) == nullptr) {
    index = table_.generators().size();
    if (!table_.has_room(2)) table_.grow();
    const Polynomial s = table_.variable(index);
    const Polynomial c = table_.ring().variable(table_.place(index) + 1);
    const ex angle = table_.expression(unit);
    const std::vector<Polynomial> unit_slopes = table_.slopes(unit);
    const double size = 1 + table_.expression_size(unit);
    Generator sine{Kind::sine, GiNaC::sin(angle), unit, 1, {}, size};
    // The relation c^2 = 1 - s^2 is stored as the "radicand" of c.
    Generator cosine{Kind::cosine, GiNaC::cos(angle), table_.ring().constant(1) - s * s, 2, {},
                     size};
    for (const Polynomial& slope : unit_slopes) {
      sine.derivatives.push_back(c * slope);
      cosine.derivatives.push_back(-(s * slope));
    }
    table_.add(std::move(sine));
    table_.add(std::move(cosine));
  }
  return {table_.variable(index), table_.ring().variable(table_.place(index) + 1)};
}

std::pair<Polynomial, Polynomial> Angles::sine_cosine(const Polynomial& angle) {
  Polynomial s(table_.ring());
  Polynomial c = table_.ring().constant(1);
  for (const auto& [coefficient, monomial] : angle.term_list()) {
    auto part = algebraic_sine_cosine(coefficient, monomial);
    if (!part) {
      const auto [unit, count] = units_.unit_of(monomial, coefficient);
      auto [sine, cosine] = plain_sine_cosine(unit);
      part = PartOfAngle{std::move(sine), std::move(cosine), count};
    }
    auto& [s1, c1, times] = *part;
    if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an angle is too large");
    if (cln::minusp(times)) s1 = -s1;
    for (unsigned long k = machine_word(times); k > 0; --k) {
      Polynomial next = table_.checked_product(s, c1) + table_.checked_product(c, s1);
      c = table_.checked_product(c, c1) - table_.checked_product(s, s1);
      s = std::move(next);
    }
  }
  return {std::move(s), std::move(c)};
}

}  // namespace casimir::functions

#include "symbolic/discrete/jet_field.hpp"

namespace casimir::discrete {

Jet JetField::variable(Element value, std::size_t number, std::size_t variables) {
  Jet result{value, std::vector<Element>(variables, 0)};
  result.slopes[number] = 1;
  return result;
}

Jet JetField::add(const Jet& a, const Jet& b) const {
  Jet result{field_.add(a.value, b.value), a.slopes.empty() ? b.slopes : a.slopes};
  if (a.slopes.empty()) return result;
  for (std::size_t i = 0; i < b.slopes.size(); ++i)
    result.slopes[i] = field_.add(result.slopes[i], b.slopes[i]);
  return result;
}

/// The chain rule: that value, and those slopes times a number.
Jet JetField::scaled(const Jet& a, Element value, Element slope) const {
  Jet result{value, a.slopes};
  for (Element& own : result.slopes) own = field_.multiply(own, slope);
  return result;
}

Jet JetField::multiply(const Jet& a, const Jet& b) const {
  const Element value = field_.multiply(a.value, b.value);
  if (a.slopes.empty()) return scaled(b, value, a.value);
  Jet result = scaled(a, value, b.value);
  for (std::size_t i = 0; i < b.slopes.size(); ++i)
    result.slopes[i] = field_.add(result.slopes[i], field_.multiply(a.value, b.slopes[i]));
  return result;
}

Jet JetField::power(const Jet& a, std::uint64_t n) const {
  if (n == 0) return constant(1);
  const Element below = field_.power(a.value, n - 1);
  return scaled(a, field_.multiply(below, a.value), field_.multiply(below, n % field_.prime()));
}

std::optional<Jet> JetField::inverse(const Jet& a) const {
  if (a.value == 0) return std::nullopt;
  const Element value = field_.inverse(a.value);
  return scaled(a, value, field_.subtract(0, field_.multiply(value, value)));
}

}  // namespace casimir::discrete

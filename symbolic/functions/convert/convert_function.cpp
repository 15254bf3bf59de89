// Functions to polynomials: which part of the converter reads them.
#include <algorithm>
#include <numeric>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/functions/convert/converter.hpp"
#include "symbolic/functions/convert/denominators.hpp"
#include "symbolic/functions/convert/elliptic_generators.hpp"

namespace casimir::functions {

using GiNaC::ex;

Polynomial Converter::convert_function(const GiNaC::function& f) {
  if (as_arbitrary(f)) return convert_arbitrary(f);
  const std::string name = f.get_name();
  if (name == "sin") return angles_.sine_cosine(convert(f.op(0))).first;
  if (name == "cos") return angles_.sine_cosine(convert(f.op(0))).second;
  if (name == "tan") {
    const auto [s, c] = angles_.sine_cosine(convert(f.op(0)));
    return table_.checked_product(s, divided_by(table_, c));
  }
  if (name == "exp") return exponentials_.exponential(convert(f.op(0)));
  if (is_elliptic_function(f)) return elliptic_polynomial(elliptic_tools(), f);
  if (name == "am_by_modulus" || name == "dn_by_modulus")
    throw TooLarge("a derivative of an elliptic function by its modulus is not known here");
  // So what holds among exponentials, of equal arguments and of multiples of each other, holds for
  // these too. The sum that tanh is divided by vanishes nowhere over the real numbers, and over the
  // complex ones tanh has no value where it does.
  if (const auto exponentials = by_exponentials(f)) return convert(*exponentials);
  const Polynomial v = convert(f.op(0));
  if (name == "log") return exponentials_.logarithm(f, v);
  if (name == "atan" || name == "asin" || name == "acos" || name == "atan2")
    return inverse_functions_.polynomial(f, v);
  throw ModelError("the function " + name + " has no derivation here");
}

GeneratorTools Converter::elliptic_tools() {
  GeneratorTools tools{
      .ring = table_.ring(),
      .convert = [this](const ex& e) { return convert(e); },
      .inverse = [this](const Polynomial& p) { return inverse_of(table_, p); },
      .square_root = [this](const Polynomial& p) { return roots_.root(p, 2); },
      .vanishes =
          [this](const Polynomial& p) {
            return table_.numerator(table_.fraction(p).first).is_zero();
          },
      .product = [this](const auto& a, const auto& b) { return table_.checked_product(a, b); },
      .slopes = [this](const Polynomial& p) { return table_.slopes(p); },
      .sine = [this](const Polynomial& p) { return angles_.sine_cosine(p).first; },
      .cosine = [this](const Polynomial& p) { return angles_.sine_cosine(p).second; }};
  // Whether I occurs is looked for when the first generator is made.
  tools.complex = table_.is_complex() && table_.capacity() > 0;
  tools.find = [this](unsigned long tag, const std::vector<Polynomial>& arguments) {
    return find_elliptic(tag, arguments);
  };
  tools.reserve = [this](std::size_t more) {
    if (!table_.has_room(more)) table_.grow();
  };
  tools.count = [this] { return table_.generators().size(); };
  tools.variable = [this](std::size_t g) { return table_.variable(g); };
  tools.add = [this](const ex& value, const Polynomial& base, unsigned long tag,
                     std::vector<Polynomial> derivatives) {
    table_.add({Kind::function, value, base, tag, std::move(derivatives),
                1 + table_.expression_size(base)});
  };
  tools.take_as_positive = [this](const Polynomial& p) {
    const auto [unreduced, bottom] = table_.fraction(p);
    const Polynomial top = table_.numerator(unreduced);
    if (top.is_zero()) return;  // it has a value nowhere, which is seen where it is derived
    signs_.imply_radicand(factors_of(table_, table_.checked_product(top, bottom)), true);
  };
  tools.add_root = [this](const ex& value, const Polynomial& radicand,
                          std::vector<Polynomial> derivatives) {
    table_.add({Kind::root, value, radicand, 2, std::move(derivatives),
                1 + table_.expression_size(radicand)});
  };
  return tools;
}

std::optional<std::size_t> Converter::find_elliptic(unsigned long tag,
                                                    const std::vector<Polynomial>& arguments) {
  std::optional<std::size_t> found;
  for (std::size_t g = 0; g < table_.generators().size() && !found; ++g) {
    if (table_.generators()[g].kind != Kind::function || table_.generators()[g].order != tag)
      continue;
    bool same = true;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      same = same && convert(table_.generators()[g].value.op(i)) == arguments[i];
    if (same) found = g;
  }
  return found;
}

/// U^(n)(a): one generator for all arguments that are the same functions. Its derivatives are made
/// before it, so that it is made of earlier ones as all generators are.
Polynomial Converter::convert_arbitrary(const GiNaC::function& f) {
  const Arbitrary own = *as_arbitrary(f);
  std::vector<Polynomial> arguments;
  for (const GiNaC::ex& argument : own.arguments) arguments.push_back(convert(argument));
  const auto is_same = [&](const Generator& g) {
    if (g.kind != Kind::function || (g.order != kArbitrary && g.order != kLastArbitrary))
      return false;
    const Arbitrary other = *as_arbitrary(GiNaC::ex_to<GiNaC::function>(g.value));
    if (!other.function.is_equal(own.function) || other.orders != own.orders) return false;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      if (!table_.numerator(arguments[i] - g.arguments[i]).is_zero()) return false;
    return true;
  };
  const auto known = [&]() -> std::optional<Polynomial> {
    for (std::size_t g = 0; g < table_.generators().size(); ++g)
      if (is_same(table_.generators()[g])) return table_.variable(g);
    return std::nullopt;
  };
  if (const auto found = known()) return *found;
  const unsigned order = std::accumulate(own.orders.begin(), own.orders.end(), 0U);
  const bool last = order >= highest_derivative_;
  std::vector<Polynomial> slopes_of_function;
  for (std::size_t i = 0; i < arguments.size() && !last; ++i) {
    std::vector<unsigned> orders = own.orders;
    ++orders[i];
    slopes_of_function.push_back(convert(arbitrary(own.function, orders, own.arguments)));
  }
  std::vector<Polynomial> derivatives(table_.symbols().size(), Polynomial(table_.ring()));
  Polynomial base(
      table_.ring());  // what it depends on, for all that asks how generators hang together
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    for (std::size_t s = 0; s < table_.symbols().size(); ++s) {
      const Polynomial slope = table_.derivative(arguments[i], s);
      // Of the last ones only that they are not zero counts: `derivative` refuses them.
      derivatives[s] += last ? slope * slope : table_.checked_product(slopes_of_function[i], slope);
    }
    base += arguments[i] * arguments[i];
  }
  const Polynomial result =
      table_.generator(Kind::function, f, base, last ? kLastArbitrary : kArbitrary,
                       [&](const Polynomial&) { return Polynomial(table_.ring()); });
  table_.last().derivatives = std::move(derivatives);
  table_.last().arguments = std::move(arguments);
  return result;
}

}  // namespace casimir::functions

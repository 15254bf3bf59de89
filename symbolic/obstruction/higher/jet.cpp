#include "symbolic/obstruction/higher/jet.hpp"

#include <numeric>

#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {

unsigned total(const Monomial& monomial) {
  return std::accumulate(monomial.begin(), monomial.end(), 0U);
}

Jet::Jet(std::size_t constants, const LaurentSeries& value) { add(Monomial(constants, 0), value); }

Jet Jet::constant(std::size_t constants, std::size_t i, const LaurentSeries& factor) {
  Jet result;
  Monomial own(constants, 0);
  own[i] = 1;
  result.add(own, factor);
  return result;
}

void Jet::add(const Monomial& monomial, const LaurentSeries& value) {
  LaurentSeries& own = terms_[monomial];
  own = own + value;
}

Jet Jet::of_degree(unsigned degree) const {
  Jet result;
  for (const auto& [monomial, value] : terms_)
    if (total(monomial) == degree) result.add(monomial, value);
  return result;
}

Jet operator+(Jet a, const Jet& b) {
  for (const auto& [monomial, value] : b.terms_) a.add(monomial, value);
  return a;
}

Jet Jet::product(const Jet& a, const Jet& b, unsigned degree) {
  Jet result;
  for (const auto& [left, x] : a.terms_)
    for (const auto& [right, y] : b.terms_) {
      if (total(left) + total(right) > degree) continue;
      Monomial both = left;
      for (std::size_t i = 0; i < both.size(); ++i) both[i] += right[i];
      result.add(both, x * y);
    }
  return result;
}

Jet value(const GiNaC::ex& polynomial, const std::vector<GiNaC::symbol>& symbols,
          const std::vector<Jet>& values, std::size_t constants, unsigned degree) {
  const auto part = [&](const GiNaC::ex& e) {
    return value(e, symbols, values, constants, degree);
  };
  if (GiNaC::is_a<GiNaC::numeric>(polynomial)) {
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(polynomial);
    if (!number.is_rational()) throw NotDecided("a coefficient is not rational");
    return {constants, LaurentSeries(cln::the<cln::cl_RA>(number.to_cl_N()))};
  }
  if (GiNaC::is_a<GiNaC::symbol>(polynomial)) {
    for (std::size_t i = 0; i < symbols.size(); ++i)
      if (polynomial.is_equal(symbols[i])) return values[i];
  } else if (GiNaC::is_a<GiNaC::add>(polynomial)) {
    Jet result;
    for (const GiNaC::ex& e : polynomial) result = std::move(result) + part(e);
    return result;
  } else if (GiNaC::is_a<GiNaC::mul>(polynomial)) {
    Jet result(constants, LaurentSeries(cln::cl_RA(1)));
    for (const GiNaC::ex& e : polynomial) result = Jet::product(result, part(e), degree);
    return result;
  } else if (GiNaC::is_a<GiNaC::power>(polynomial) &&
             polynomial.op(1).info(GiNaC::info_flags::posint) && polynomial.op(1) < 100) {
    const Jet base = part(polynomial.op(0));
    const int exponent = GiNaC::ex_to<GiNaC::numeric>(polynomial.op(1)).to_int();
    Jet result = base;
    for (int i = 1; i < exponent; ++i) result = Jet::product(result, base, degree);
    return result;
  }
  throw NotDecided("the equations are no polynomials");
}

}  // namespace casimir::obstruction

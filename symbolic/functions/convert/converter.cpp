#include "symbolic/functions/convert/converter.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <deque>

#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/expression/pairs.hpp"
#include "symbolic/functions/convert/denominators.hpp"
#include "symbolic/functions/function_factors.hpp"

namespace casimir::functions {
namespace {

using GiNaC::ex;

cln::cl_RA rational(const GiNaC::numeric& number) {
  if (!number.is_rational())
    throw ModelError("a number that is not rational in an exact expression");
  return cln::the<cln::cl_RA>(number.to_cl_N());
}

}  // namespace

Converter::Converter(GeneratorTable& table, SignTable& signs, unsigned highest_derivative)
    : table_(table),
      signs_(signs),
      highest_derivative_(highest_derivative),
      pi_(table, converting()),
      roots_(table, signs, pi_),
      units_(table),
      angles_(table, signs, pi_, roots_, units_, converting()),
      exponentials_(table, signs, roots_, angles_, units_),
      inverse_functions_(table, signs, roots_, angles_, converting()) {
  const std::vector<GiNaC::symbol>& symbols = table.symbols();
  for (std::size_t i = 0; i < symbols.size(); ++i) places_.emplace(symbols[i], i);
}

void Converter::restart() {
  known_.clear();
  inverse_functions_.restart();
}

Convert Converter::converting() {
  return [this](const ex& e) -> const Polynomial& { return convert(e); };
}

/// Only where there are functions does the order matter.
void Converter::order(GiNaC::exvector& operands) {
  if (table_.capacity() > 0) keys_.sort(operands);
}

const Polynomial& Converter::convert(const ex& e) {
  if (const auto it = known_.find(e); it != known_.end()) return it->second;
  return known_.emplace(e, convert_new(e)).first->second;
}

Polynomial Converter::convert_new(const ex& e) {
  if (GiNaC::is_exactly_a<GiNaC::add>(e)) return convert_sum(e);
  if (GiNaC::is_exactly_a<GiNaC::mul>(e)) return convert_product(e);
  if (GiNaC::is_a<GiNaC::symbol>(e)) return table_.ring().variable(place_of(e));
  if (GiNaC::is_a<GiNaC::power>(e)) return convert_power(e.op(0), e.op(1));
  if (GiNaC::is_a<GiNaC::numeric>(e)) return convert_number(GiNaC::ex_to<GiNaC::numeric>(e));
  if (GiNaC::is_a<GiNaC::function>(e)) return convert_function(GiNaC::ex_to<GiNaC::function>(e));
  if (GiNaC::is_a<GiNaC::constant>(e)) {
    const Polynomial one = table_.ring().constant(1);
    std::size_t index = 0;
    if (table_.find(Kind::function, one, kConstant, &index) != nullptr)
      return table_.variable(index);
    return table_.generator(Kind::function, e, one, kConstant,
                            [&](const Polynomial&) { return Polynomial(table_.ring()); });
  }
  throw ModelError("an expression that exact algebra does not know");
}

std::size_t Converter::place_of(const ex& symbol) const {
  const auto place = places_.find(symbol);
  if (place == places_.end()) throw ModelError("an expression uses a symbol of another case");
  return place->second;
}

Polynomial Converter::convert_number(const GiNaC::numeric& number) {
  if (number.is_real()) return table_.ring().constant(rational(number));
  std::size_t index = 0;
  const Polynomial minus_one = table_.ring().constant(-1);
  const Polynomial i =
      table_.find(Kind::imaginary, minus_one, 2, &index) != nullptr
          ? table_.variable(index)
          : table_.generator(Kind::imaginary, GiNaC::I, minus_one, 2,
                             [&](const Polynomial&) { return Polynomial(table_.ring()); });
  return table_.ring().constant(rational(number.real())) + i.scaled(rational(number.imag()));
}

/// Multiplies `monomial` by base^exponent if that is a number or a whole power of a symbol, else
/// leaves it as it is.
bool Converter::multiply_power(const ex& base, const ex& exponent, Monomial& monomial) const {
  const GiNaC::numeric& power = GiNaC::ex_to<GiNaC::numeric>(exponent);
  constexpr int kMaxBits = 20;
  if (!GiNaC::is_exactly_a<GiNaC::symbol>(base) || !power.is_pos_integer() ||
      power.int_length() > kMaxBits)
    return false;
  monomial.exponents[place_of(base)] += static_cast<unsigned long>(power.to_long());
  return true;
}

/// Multiplies `monomial` by `e` if that is a symbol, a whole power of one, or a product of such;
/// false otherwise, and then the monomial may have some of the factors.
bool Converter::multiply_monomial(const ex& e, Monomial& monomial) const {
  if (GiNaC::is_exactly_a<GiNaC::symbol>(e)) {
    ++monomial.exponents[place_of(e)];
    return true;
  }
  if (GiNaC::is_exactly_a<GiNaC::mul>(e)) {
    if (!multiply_number(Pairs::number(e), monomial)) return false;
    for (const GiNaC::expair& pair : Pairs::of(e)) {
      if (!multiply_power(pair.rest, pair.coeff, monomial)) return false;
    }
    return true;
  }
  if (!GiNaC::is_exactly_a<GiNaC::power>(e)) return false;
  const ex exponent = e.op(1);
  return GiNaC::is_exactly_a<GiNaC::numeric>(exponent) &&
         multiply_power(e.op(0), exponent, monomial);
}

bool Converter::multiply_number(const ex& e, Monomial& monomial) {
  const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(e);
  if (!number.is_rational()) return false;
  monomial.coefficient = monomial.coefficient * rational(number);
  return true;
}

/// Monomials are collected at once: made into polynomials and added one by one, a long sum of them
/// would cost the square of its length.
Polynomial Converter::convert_sum(const ex& e) {
  TermCollector monomials(table_.ring());
  GiNaC::exvector others;
  std::unordered_map<ex, cln::cl_RA> factors;  // of others, where not 1
  Monomial monomial;
  const auto restart = [&] {
    monomial.coefficient = 1;
    monomial.exponents.assign(table_.ring().size(), 0);
  };
  const GiNaC::epvector& pairs = Pairs::of(e);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    restart();
    const bool real = multiply_number(pairs[i].coeff, monomial);
    if (real && multiply_monomial(pairs[i].rest, monomial)) {
      monomials.add(monomial.coefficient, monomial.exponents);
      continue;
    }
    others.push_back(real ? pairs[i].rest : e.op(i));
    if (real && !pairs[i].coeff.is_equal(1))
      factors.emplace(pairs[i].rest, rational(GiNaC::ex_to<GiNaC::numeric>(pairs[i].coeff)));
  }
  restart();
  if (multiply_number(Pairs::number(e), monomial))
    monomials.add(monomial.coefficient, monomial.exponents);
  else
    others.push_back(Pairs::number(e));
  Polynomial first = monomials.finish();
  if (others.empty()) return first;
  order(others);
  std::vector<const Polynomial*> summands{&first};
  std::deque<Polynomial> multiples;
  for (const ex& term : others) {
    summands.push_back(&convert(term));
    const auto factor = factors.find(term);
    if (factor == factors.end()) continue;
    multiples.push_back(summands.back()->scaled(factor->second));
    summands.back() = &multiples.back();
  }
  return Polynomial::sum(table_.ring(), std::move(summands));
}

Polynomial Converter::convert_product(const ex& e) {
  Monomial monomial{1, std::vector<unsigned long>(table_.ring().size())};
  GiNaC::exvector others;
  const GiNaC::epvector& pairs = Pairs::of(e);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!multiply_power(pairs[i].rest, pairs[i].coeff, monomial)) others.push_back(e.op(i));
  }
  if (!multiply_number(Pairs::number(e), monomial)) others.push_back(Pairs::number(e));
  TermCollector collector(table_.ring());
  collector.add(monomial.coefficient, monomial.exponents);
  Polynomial product = collector.finish();
  order(others);
  for (const ex& factor : others) product = table_.checked_product(product, convert(factor));
  return product;
}

Polynomial Converter::convert_power(const ex& base, const ex& exponent) {
  if (!GiNaC::is_a<GiNaC::numeric>(exponent) ||
      !GiNaC::ex_to<GiNaC::numeric>(exponent).is_rational())
    return convert(GiNaC::exp(exponent * GiNaC::log(base)));
  const cln::cl_RA e = rational(GiNaC::ex_to<GiNaC::numeric>(exponent));
  const Polynomial b = convert(base);
  const cln::cl_I whole = cln::floor1(e);
  const cln::cl_RA part = e - whole;
  // GiNaC makes x^(-1/2) of both, and sqrt(-1) is not what 1/sqrt(-1) is.
  if (table_.is_complex() && table_.capacity() > 0 && cln::minusp(e) && !cln::zerop(part) &&
      (signs_.known_sign(b) <= 0 || !table_.is_real_everywhere(b)))
    throw TooLarge(
        "with complex numbers, (1/x)^(1/2) and 1/x^(1/2) differ where x < 0, and are not told "
        "apart "
        "here");
  const unsigned long size = machine_word(whole);
  Polynomial result = table_.power(whole >= 0 ? b : divided_by(table_, b), size);
  if (!cln::zerop(part)) {
    // 1/sqrt(x) has a value for x > 0 alone.
    if (cln::minusp(e) && cln::evenp(cln::denominator(part)) && !table_.is_complex()) {
      const auto [top, bottom] = table_.fraction(b);
      signs_.imply_radicand(
          factors_of(table_, table_.checked_product(table_.numerator(top), bottom)), true);
    }
    const Polynomial one = roots_.root(b, machine_word(cln::denominator(part)));
    result = table_.checked_product(result, table_.power(one, machine_word(cln::numerator(part))));
  }
  return result;
}

}  // namespace casimir::functions

#include "symbolic/discrete/modular_program.hpp"

#include <cln/integer.h>
#include <fmt/format.h>
#include <fmt/ostream.h>

#include "symbolic/algebra/machine_word.hpp"

namespace casimir::discrete {

std::optional<Element> PrimeField::reduce(const cln::cl_RA& number) const {
  const cln::cl_I prime = cln::cl_I(static_cast<unsigned long>(this->prime()));
  const auto residue = [&](const cln::cl_I& n) {
    return static_cast<Element>(cln::cl_I_to_ulong(cln::mod(n, prime)));
  };
  const Element bottom = residue(cln::denominator(number));
  if (bottom == 0) return std::nullopt;
  return multiply(residue(cln::numerator(number)), inverse(bottom));
}

ModularProgram::ModularProgram(const std::vector<GiNaC::symbol>& symbols,
                               const std::vector<GiNaC::ex>& functions, Element prime)
    : field_(prime) {
  for (const GiNaC::symbol& s : symbols)
    known_.emplace(s, add({Kind::symbol, known_.size(), 0, 0}));
  for (const GiNaC::ex& f : functions) results_.push_back(place_of(f));
  known_.clear();
}

std::size_t ModularProgram::add(Operation operation) {
  operations_.push_back(operation);
  return operations_.size() - 1;
}

std::size_t ModularProgram::place_of(const GiNaC::ex& e) {
  if (const auto found = known_.find(e); found != known_.end()) return found->second;
  const std::size_t place = compile(e);
  known_.emplace(e, place);
  return place;
}

std::size_t ModularProgram::compile(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e) && e.info(GiNaC::info_flags::rational)) {
    const auto number = cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(e).to_cl_N());
    const std::optional<Element> value = field_.reduce(number);
    if (!value) throw ModelError("a number of the map has a multiple of the prime as denominator");
    // It would be no term at all, and the degree another one.
    if (*value == Element{} && !cln::zerop(number))
      throw ModelError("a number of the map is a multiple of the prime");
    return add({Kind::constant, 0, 0, *value});
  }
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    const Kind kind = GiNaC::is_a<GiNaC::add>(e) ? Kind::sum : Kind::product;
    std::size_t sum = place_of(e.op(0));
    for (std::size_t i = 1; i < e.nops(); ++i) sum = add({kind, sum, place_of(e.op(i)), 0});
    return sum;
  }
  if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::integer)) {
    const auto exponent = cln::the<cln::cl_I>(GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_cl_N());
    const std::size_t power = add({Kind::power, place_of(e.op(0)), machine_word(exponent), 0});
    return cln::minusp(exponent) ? add({Kind::inverse, power, 0, 0}) : power;
  }
  throw ModelError(
      fmt::format("{} is no rational function with rational coefficients: the degrees of a map "
                  "and searches are for maps that are made of such",
                  printable(fmt::format("{}", fmt::streamed(e)), 200)));
}

namespace {

/// The field as a ring of `run_over`.
struct Residues {
  PrimeField field;
  Element constant(Element a) const { return a; }
  Element add(Element a, Element b) const { return field.add(a, b); }
  Element multiply(Element a, Element b) const { return field.multiply(a, b); }
  Element power(Element a, std::uint64_t n) const { return field.power(a, n); }
  std::optional<Element> inverse(Element a) const {
    if (a == 0) return std::nullopt;
    return field.inverse(a);
  }
};

}  // namespace

std::optional<std::vector<Element>> ModularProgram::run(const std::vector<Element>& values) const {
  return run_over(values, Residues{field_});
}

}  // namespace casimir::discrete

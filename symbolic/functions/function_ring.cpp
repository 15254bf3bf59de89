#include "symbolic/functions/function_ring.hpp"

#include <algorithm>
#include <unordered_set>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/pairs.hpp"
#include "symbolic/functions/convert/converter.hpp"

namespace casimir {

using GiNaC::ex;

namespace {

/// `seen` has what was looked through: expressions share their parts.
bool uses_imaginary_unit(const ex& e, std::unordered_set<ex>& seen) {
  if (GiNaC::is_exactly_a<GiNaC::numeric>(e)) return !GiNaC::ex_to<GiNaC::numeric>(e).is_real();
  if (e.nops() == 0 || !seen.insert(e).second) return false;
  if (GiNaC::is_exactly_a<GiNaC::add>(e) || GiNaC::is_exactly_a<GiNaC::mul>(e)) {
    const GiNaC::epvector& pairs = Pairs::of(e);
    return uses_imaginary_unit(Pairs::number(e), seen) ||
           std::any_of(pairs.begin(), pairs.end(), [&](const GiNaC::expair& pair) {
             return uses_imaginary_unit(pair.rest, seen) || uses_imaginary_unit(pair.coeff, seen);
           });
  }
  for (std::size_t i = 0; i < e.nops(); ++i) {
    if (uses_imaginary_unit(e.op(i), seen)) return true;
  }
  return false;
}

/// Up to which order derivatives of arbitrary functions are needed; 0 where there are none.
unsigned derivatives_needed(const std::vector<GiNaC::symbol>& symbols,
                            const std::vector<Assumption>& assumptions,
                            const std::vector<ex>& expressions) {
  // So often, and once more, is differentiated what claims are about.
  constexpr unsigned kFurther = 3;
  unsigned result = 0;
  const auto look = [&](const ex& e) {
    if (const auto order = highest_derivative(e)) result = std::max(result, *order + kFurther);
  };
  const bool any = std::any_of(symbols.begin(), symbols.end(), [](const GiNaC::symbol& s) {
    return function_name(s.get_name()).has_value();
  });
  if (any) {
    for (const ex& e : expressions) look(e);
    for (const Assumption& a : assumptions) look(a.difference);
  }
  return result;
}

}  // namespace

FunctionRing::FunctionRing(std::vector<GiNaC::symbol> symbols,
                           const std::vector<Assumption>& assumptions,
                           const std::vector<ex>& expressions, const Limits& limits)
    : table_(std::move(symbols), limits),
      signs_(table_, assumptions),
      converter_(std::make_unique<functions::Converter>(
          table_, signs_, derivatives_needed(table_.symbols(), assumptions, expressions))),
      pieces_(table_, signs_) {
  build(expressions);
}

FunctionRing::~FunctionRing() = default;

const Polynomial& FunctionRing::convert(const ex& expression) {
  return converter_->convert(expression);
}

/// The ring of a FLINT polynomial has a fixed number of variables, so that generators are first
/// counted: when they do not fit, or an angle needs a finer unit, everything starts again.
void FunctionRing::build(const std::vector<ex>& expressions) {
  const functions::Convert convert = converter_->converting();
  for (bool first = true;;) {
    converter_->restart();
    signs_.restart();
    table_.restart();
    try {
      signs_.read(convert);
      const functions::SignTable::Implications before = signs_.implications();
      for (const ex& e : expressions) convert(e);
      if (signs_.wants_another_build(before, convert)) continue;
      signs_.finish();
      return;
    } catch (const functions::Full&) {
      if (!first) continue;
      first = false;  // only now is it seen that there is more than polynomials
      std::unordered_set<ex> seen;
      table_.set_complex(std::any_of(expressions.begin(), expressions.end(),
                                     [&](const ex& e) { return uses_imaginary_unit(e, seen); }));
    }
  }
}

ex FunctionRing::quotient(const Polynomial& p, const Polynomial& q) const {
  const auto [p_top, p_bottom] = table_.fraction(p);
  const auto [q_top, q_bottom] = table_.fraction(q);
  Polynomial top = table_.numerator(table_.checked_product(p_top, q_bottom));
  Polynomial bottom = table_.numerator(table_.checked_product(q_top, p_bottom));
  if (top.is_zero()) return 0;
  const Polynomial common = Polynomial::gcd(top, bottom);
  top.divide(common, &top);
  bottom.divide(common, &bottom);
  return table_.expression(top) / table_.expression(bottom);
}

void FunctionRing::mark_denominators(const Polynomial& p, std::vector<bool>& marks) const {
  std::size_t place = 0;
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    if (table_.generators()[g].kind != functions::Kind::inverse) continue;
    if (marks.size() == place) marks.push_back(false);
    if (!marks[place]) marks[place] = p.uses(table_.place(g));
    ++place;
  }
}

std::vector<Polynomial> FunctionRing::denominators() const {
  std::vector<Polynomial> result;
  for (const functions::Generator& g : table_.generators()) {
    if (g.kind == functions::Kind::inverse) result.push_back(g.base);
  }
  return result;
}

bool FunctionRing::depends_on_first(const Polynomial& p, std::size_t coordinates) const {
  for (std::size_t i = 0; i < coordinates; ++i)
    if (depends_on(p, i)) return true;
  return false;
}

bool FunctionRing::rests_on_what_was_converted() const {
  using functions::Kind;
  if (signs_.rests_on_what_was_converted()) return true;
  return std::ranges::any_of(table_.generators(), [&](const functions::Generator& g) {
    switch (g.kind) {
      case Kind::sine:
      case Kind::cosine:
      case Kind::exponential:
      case Kind::inverse:
        return false;
      case Kind::root:  // of a number, which has its value everywhere
        for (std::size_t i = 0; i < table_.ring().size(); ++i)
          if (g.base.uses(i)) return true;
        return false;
      case Kind::function:
        return g.order != functions::kConstant && g.order != functions::kCosineOfPi;
      case Kind::absolute:
      case Kind::imaginary:
        break;
    }
    return true;
  });
}

}  // namespace casimir

#include "symbolic/proof/points/exact_point.hpp"

#include <cln/complex.h>
#include <cln/rational_io.h>

#include <optional>
#include <unordered_map>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/point_completer.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// "2*atan(1/3)", divided by the factor of the angle.
std::string over(const std::string& text, const cln::cl_RA& factor) {
  return factor == 1 ? text : "(" + text + ")/(" + rational_text(factor) + ")";
}

}  // namespace

/// Replaces sines, cosines, tangents and exponentials of the point's angles by their values, those
/// that are shared once.
struct ExactPoint::Functions : public GiNaC::map_function {
  explicit Functions(const ExactPoint& point) : point_(point) {}

  ex operator()(const ex& e) override {
    if (e.nops() == 0) return e;
    if (const auto it = known_.find(e); it != known_.end()) return it->second;
    return known_.emplace(e, fresh(e)).first->second;
  }

 private:
  ex fresh(const ex& e) {
    if (GiNaC::is_a<GiNaC::power>(e))
      return checked_power((*this)(e.op(0)), (*this)(e.op(1)), point_.limits_);
    const ex inner = e.map(*this);
    if (!GiNaC::is_a<GiNaC::function>(inner)) return inner;
    const std::string name = GiNaC::ex_to<GiNaC::function>(inner).get_name();
    if (const auto exponentials = by_exponentials(GiNaC::ex_to<GiNaC::function>(inner)))
      return (*this)(*exponentials);
    if (name == "exp") {
      const std::optional<numeric> value =
          product(inner.op(0), point_.exponents_, &Exponent::value);
      return value ? ex(*value) : inner;
    }
    if (name != "sin" && name != "cos" && name != "tan") return inner;
    const std::optional<numeric> circle = product(inner.op(0), point_.angles_, &Angle::circle);
    if (!circle) return inner;
    if (name == "sin") return circle->imag();
    if (name == "cos") return circle->real();
    return circle->imag() / circle->real();
  }

  /// The product of value^k over the terms k * factor * symbol of the argument, if it has no
  /// others.
  template <class Argument>
  static std::optional<numeric> product(const ex& argument, const std::vector<Argument>& arguments,
                                        numeric Argument::*value) {
    ex rest = argument.expand();
    numeric result = 1;
    for (const Argument& a : arguments) {
      const ex coefficient = rest.coeff(a.symbol, 1) / a.factor;
      if (!GiNaC::is_a<numeric>(coefficient)) return std::nullopt;
      const numeric k = GiNaC::ex_to<numeric>(coefficient);
      if (!k.is_integer()) return std::nullopt;
      result = result * (a.*value).power(k);
      rest = (rest - coefficient * a.factor * a.symbol).expand();
    }
    return rest.is_zero() ? std::optional(result) : std::nullopt;
  }

  const ExactPoint& point_;
  std::unordered_map<ex, ex> known_;
};

ExactPoint::ExactPoint(const FunctionRing& ring, const std::vector<cln::cl_RA>& point,
                       const std::vector<bool>& bare)
    : limits_(ring.limits()) {
  const auto& symbols = ring.symbols();
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    values_[symbols[i]] = numeric(point[i]);
    texts.push_back(rational_text(point[i]));
  }
  for (const functions::PointCompleter::PlainArgument& a :
       functions::PointCompleter(ring.table()).plain_arguments(point)) {
    if (bare[a.symbol]) continue;
    const ex symbol = symbols[a.symbol];
    const numeric factor(a.factor);
    if (a.angle) {
      angles_.push_back({symbol, factor, numeric(cln::complex(a.cosine, a.sine))});
      if (a.cosine == -1) {
        values_[symbol] = GiNaC::Pi / factor;
        texts[a.symbol] = over("Pi", a.factor);
        continue;
      }
      const cln::cl_RA t = a.sine / (1 + a.cosine);
      values_[symbol] = 2 * GiNaC::atan(ex(numeric(t))) / factor;
      texts[a.symbol] = t == 0 ? "0" : over("2*atan(" + rational_text(t) + ")", a.factor);
    } else {
      exponents_.push_back({symbol, factor, numeric(a.exponential)});
      values_[symbol] = GiNaC::log(ex(numeric(a.exponential))) / factor;
      texts[a.symbol] =
          a.exponential == 1 ? "0" : over("log(" + rational_text(a.exponential) + ")", a.factor);
    }
  }
  for (std::size_t i = 0; i < symbols.size(); ++i)
    coordinates_.emplace_back(symbols[i].get_name(), texts[i]);
}

ex ExactPoint::evaluate(const ex& expression) const {
  Functions functions(*this);
  return substituted(functions(expression), values_, limits_);
}

}  // namespace casimir

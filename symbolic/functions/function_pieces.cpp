#include "symbolic/functions/function_pieces.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace casimir::functions {

namespace {

/// Whether a function of this kind may stay bounded, itself or in a quotient, where its base
/// becomes infinite: atan(1/x) jumps by half a turn where x passes zero, 1/(1 + exp(1/x)) by 1,
/// sin(1/x) has no limit, and of an arbitrary function of 1/x nothing is known. A power or a
/// logarithm becomes infinite, too.
bool is_bounded_at_poles(const Generator& generator) {
  switch (generator.kind) {
    case Kind::sine:
    case Kind::cosine:
    case Kind::exponential:
      return true;
    case Kind::function:
      return generator.order != kLogarithm && generator.order != kLogOfAbsolute;
    case Kind::root:
    case Kind::absolute:
    case Kind::inverse:
    case Kind::imaginary:
      return false;
  }
  return true;
}

}  // namespace

/// Each is factored once.
const std::vector<Polynomial>& FunctionPieces::factors_of_radicand(std::size_t g) const {
  const auto [known, fresh] = radicands_.try_emplace(g);
  if (fresh && !table_.generators()[g].base.is_zero()) {
    for (const auto& [f, exponent] : table_.fraction(table_.generators()[g].base).first.factors())
      known->second.push_back(f);
  }
  return known->second;
}

std::vector<Polynomial> FunctionPieces::radicand_factors(const Polynomial& p, bool cuts) const {
  std::vector<Polynomial> result;
  const auto add_factor = [&](const Polynomial& f) {
    if (!f.is_constant() && std::find(result.begin(), result.end(), f) == result.end())
      result.push_back(f);
  };
  const auto add = [&](const Polynomial& base) {
    if (base.is_zero()) return;
    for (const auto& [f, exponent] : table_.fraction(base).first.factors()) add_factor(f);
  };
  const Polynomial one = table_.ring().constant(1);
  // Parts of inverse functions are analytic where these are, and sin(atan2(y, x)/2) but for the
  // cut, where the root of r + x in its relation vanishes.
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& generator = table_.generators()[g];
    if (generator.kind == Kind::root || generator.kind == Kind::absolute)
      for (const Polynomial& f : factors_of_radicand(g)) add_factor(f);
    const bool arc = generator.kind == Kind::function &&
                     (generator.order == kArcSine || generator.order == kArcCosine);
    // By the relations: with v = sqrt(1 - y) it is y, of which the motion may have a root as well.
    if (arc) add(table_.numerator(one - generator.base * generator.base));
    if (!cuts) continue;
    if (is_bounded_at_poles(generator)) {
      add(table_.fraction(generator.base).second);
      for (const Polynomial& end : ends_of_powers(generator.base)) add(end);
    }
    if (generator.kind != Kind::function) continue;
    // atan2 jumps on its cut, y = 0 and x < 0; where y is zero all over, at x = 0; and at poles of
    // both, atan2(1, 1/x) as atan(x) does not.
    if (generator.order == kArcTangentOfTwo) {
      const Polynomial& y = generator.arguments[0];
      const Polynomial& x = generator.arguments[1];
      if (signs_.known_sign(x) <= 0 || !signs_.known_nonzero(x))
        add(table_.numerator(y).is_zero() ? x : y);
    }
    for (const Polynomial& argument : generator.arguments) add(table_.fraction(argument).second);
  }
  return result;
}

bool FunctionPieces::vanishes_with(const Polynomial& p, const Polynomial& f) const {
  Polynomial rest = table_.numerator(p);
  for (const std::size_t g : table_.generators_in({rest})) {
    const Generator& own = table_.generators()[g];
    const std::size_t place = table_.place(g);
    if ((own.kind != Kind::root && own.kind != Kind::absolute) || !rest.uses(place)) continue;
    const std::vector<Polynomial>& factors = factors_of_radicand(g);
    if (std::find(factors.begin(), factors.end(), f) == factors.end()) continue;
    rest = rest.coefficients(place)[0];
  }
  Polynomial quotient(table_.ring());
  return rest.is_zero() || rest.divide(f, &quotient);
}

namespace {

/// Divides by f as often as that goes. \return how often
unsigned long take_out(Polynomial& p, const Polynomial& f) {
  unsigned long times = 0;
  Polynomial quotient(p.ring());
  for (; !p.is_zero() && !f.is_constant() && p.divide(f, &quotient); ++times) p = quotient;
  return times;
}

}  // namespace

/// Nothing where several roots vanish with f, or several terms are of the lowest order.
std::optional<FunctionPieces::Leading> FunctionPieces::leading_at(const Polynomial& p,
                                                                  const Polynomial& f) const {
  std::optional<std::size_t> place;
  cln::cl_RA weight = 0;
  Polynomial beside = table_.ring().constant(1);  // under that root
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& own = table_.generators()[g];
    if (own.kind != Kind::root && own.kind != Kind::absolute) continue;
    Polynomial radicand = table_.fraction(own.base).first;
    const unsigned long times = take_out(radicand, f);
    if (times == 0) continue;
    if (place) return std::nullopt;
    place = table_.place(g);
    weight = cln::cl_RA(times) / (own.kind == Kind::root ? own.order : 2);
    beside = radicand;
  }
  std::optional<Leading> result;
  bool several = false;
  const std::vector<Polynomial> parts = place ? p.coefficients(*place) : std::vector<Polynomial>{p};
  for (std::size_t power = 0; power < parts.size(); ++power) {
    Polynomial part = parts[power];
    if (part.is_zero()) continue;
    const cln::cl_RA order = take_out(part, f) + weight * static_cast<unsigned long>(power);
    if (result && order > result->order) continue;
    several = result && order == result->order;
    result = Leading{order, power > 0 ? table_.checked_product(part, beside) : part};
  }
  return several ? std::nullopt : result;
}

/// Sines and exponentials of functions that stay finite are bounded, and exponentials of them are
/// not zero: (q^2)^a, which is exp(a*log(q^2)), is at q = 0.
std::optional<Polynomial> FunctionPieces::pole_coefficient(const Polynomial& p,
                                                           const Polynomial& f) const {
  const auto [top, bottom] = table_.lowest_terms(p);
  for (const std::size_t g : table_.generators_in({top, bottom})) {
    const Generator& own = table_.generators()[g];
    const bool finite = own.base.is_zero() || table_.fraction(own.base).second.is_constant();
    if (own.kind == Kind::function || own.kind == Kind::imaginary || !finite) return std::nullopt;
  }
  const auto of_top = leading_at(top, f), of_bottom = leading_at(bottom, f);
  if (!of_top || !of_bottom || of_top->order >= of_bottom->order) return std::nullopt;
  Polynomial coefficient = table_.ring().constant(1), divisor = of_bottom->coefficient;
  for (const auto& [factor, exponent] : of_top->coefficient.factors())
    if (factor.is_constant() || take_out(divisor, factor) < exponent) coefficient *= factor;
  return coefficient;
}

/// In the variables that `f` uses; other functions than roots count as numbers.
double FunctionPieces::lowest_degree(const Polynomial& p, const Polynomial& f) const {
  std::vector<double> weights(table_.ring().size(), 0);
  for (std::size_t i = 0; i < table_.symbols().size(); ++i) weights[i] = f.uses(i) ? 1 : 0;
  const auto lowest = [&](const Polynomial& q) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [coefficient, exponents] : q.term_list()) {
      double degree = 0;
      for (std::size_t i = 0; i < exponents.size(); ++i)
        degree += weights[i] * static_cast<double>(exponents[i]);
      least = std::min(least, degree);
    }
    return least;
  };
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& own = table_.generators()[g];
    if (own.kind == Kind::root || own.kind == Kind::absolute) {
      const double order = own.kind == Kind::root ? static_cast<double>(own.order) : 2;
      const auto [top, bottom] = table_.fraction(own.base);
      weights[table_.place(g)] = (lowest(top) - lowest(bottom)) / order;
    }
  }
  return lowest(p);
}

bool FunctionPieces::grows_towards_zero(const Polynomial& p, const Polynomial& f) const {
  double highest = 0;
  for (const auto& [coefficient, exponents] : f.term_list()) {
    double degree = 0;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] > 0 && i >= table_.symbols().size()) return false;
      degree += static_cast<double>(exponents[i]);
    }
    highest = std::max(highest, degree);
  }
  const auto [top, bottom] = table_.lowest_terms(p);
  return lowest_degree(f, f) == highest && lowest_degree(top, f) < lowest_degree(bottom, f);
}

/// Two of them have to be zero: those that are shown to be, or others that may be.
std::vector<JumpPlace> FunctionPieces::common_zeros(const std::vector<Polynomial>& list) const {
  std::vector<JumpPlace> result;
  if (list.size() < 2) return result;
  for (const Polynomial& rough : list)
    for (const Polynomial& f : radicand_factors(rough)) {
      const auto vanishes = [&](const Polynomial& own) { return vanishes_with(own, f); };
      if (std::ranges::count_if(list, vanishes) >= 2) {
        result.push_back({f, std::nullopt});
        continue;
      }
      for (const Polynomial& own : list)
        if (!vanishes(own)) result.push_back({f, own});
    }
  return result;
}

/// Irreducible functions one of which is zero where the irreducible `f` is: of a root, those under
/// it.
std::vector<Polynomial> FunctionPieces::zeros_of(const Polynomial& f) const {
  for (const std::size_t g : table_.generators_in({f})) {
    const Kind kind = table_.generators()[g].kind;
    const bool root = kind == Kind::root || kind == Kind::absolute;
    const Polynomial own = table_.ring().variable(table_.place(g));
    if (root && (f == own || f == -own)) return factors_of_radicand(g);
  }
  return {f};
}

/// Where powers x^a, which are exp(a*log(x)), become zero or infinite.
std::vector<Polynomial> FunctionPieces::ends_of_powers(const Polynomial& p) const {
  std::vector<Polynomial> result;
  if (p.is_zero()) return result;
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& own = table_.generators()[g];
    if (own.kind != Kind::exponential) continue;
    const std::vector<Polynomial> ends = ends_of_logarithms(own.base);
    result.insert(result.end(), ends.begin(), ends.end());
  }
  return result;
}

std::vector<Polynomial> FunctionPieces::ends_of_logarithms(const Polynomial& p) const {
  std::vector<Polynomial> result;
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& own = table_.generators()[g];
    if (own.kind != Kind::function || (own.order != kLogarithm && own.order != kLogOfAbsolute))
      continue;
    const auto [top, bottom] = table_.fraction(own.base);
    result.push_back(top);
    result.push_back(bottom);
  }
  return result;
}

std::vector<Polynomial> FunctionPieces::pole_factors(const Polynomial& p) const {
  std::vector<Polynomial> result;
  const auto add = [&](const Polynomial& bottom) {
    for (const auto& [f, exponent] : bottom.factors())
      for (const Polynomial& zero : zeros_of(f))
        if (!zero.is_constant() && std::find(result.begin(), result.end(), zero) == result.end())
          result.push_back(zero);
  };
  for (const Polynomial& end : ends_of_logarithms(p)) add(end);
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& generator = table_.generators()[g];
    if (generator.kind == Kind::inverse) add(generator.base);
    for (const Polynomial& argument : generator.arguments) add(table_.fraction(argument).second);
  }
  return result;
}

std::optional<Polynomial> FunctionPieces::leading_divided_by(const Polynomial& p,
                                                             const Polynomial& f) const {
  std::optional<std::size_t> place;
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& own = table_.generators()[g];
    Polynomial quotient(table_.ring());
    if (own.kind != Kind::inverse || !own.base.divide(f, &quotient)) continue;
    if (place) return std::nullopt;
    place = table_.place(g);
  }
  if (!place || !p.uses(*place)) return std::nullopt;
  return p.coefficients(*place).back();
}

std::vector<JumpPlace> FunctionPieces::jump_factors(const Polynomial& p, bool cuts,
                                                    const std::vector<Polynomial>& more) const {
  std::vector<JumpPlace> result;
  std::vector<Polynomial> rough = radicand_factors(p);
  rough.insert(rough.end(), more.begin(), more.end());
  const auto add = [&](const Polynomial& zero, const std::optional<Polynomial>& with) {
    if (zero.is_constant()) return;
    if (std::none_of(result.begin(), result.end(), [&](const JumpPlace& known) {
          return known.zero == zero && (!known.with || known.with == with);
        }))
      result.push_back({zero, with});
  };
  // What is divided by, itself or under a root that is.
  const auto divided_by = [&](const Polynomial& bottom, bool inverse) {
    for (const auto& [f, exponent] : bottom.factors()) {
      if (signs_.is_assumed_nonzero(f)) continue;  // as in 1/exp(|x|)
      for (const Polynomial& zero : zeros_of(f)) {
        if (inverse || std::find(rough.begin(), rough.end(), zero) != rough.end())
          add(zero, std::nullopt);
        else
          for (const Polynomial& own : rough) add(zero, own);
      }
    }
  };
  divided_by(table_.lowest_terms(p).second, false);
  // y*log|x| is 0 times infinity where the motion has a kink.
  for (const Polynomial& end : ends_of_logarithms(p))
    for (const auto& [f, exponent] : end.factors())
      for (const Polynomial& zero : zeros_of(f))
        if (std::find(more.begin(), more.end(), zero) != more.end()) add(zero, std::nullopt);
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& generator = table_.generators()[g];
    const bool function = generator.kind == Kind::function;
    const bool angle = function && generator.order == kArcTangentOfTwo;
    if (generator.kind != Kind::inverse && !generator.base.is_zero())
      divided_by(table_.fraction(generator.base).second, is_bounded_at_poles(generator));
    for (const Polynomial& argument : generator.arguments)
      divided_by(table_.fraction(argument).second, function);
    if (is_bounded_at_poles(generator)) {
      for (const Polynomial& end : ends_of_powers(generator.base)) divided_by(end, true);
      for (const Polynomial& argument : generator.arguments)
        for (const Polynomial& end : ends_of_powers(argument)) divided_by(end, true);
    }
    if (!cuts || !angle) continue;
    const Polynomial& y = generator.arguments[0];
    const Polynomial& x = generator.arguments[1];
    if (signs_.known_sign(x) > 0 && signs_.known_nonzero(x)) continue;
    const Polynomial cut =
        table_.numerator(y).is_zero() ? table_.numerator(x) : table_.numerator(y);
    for (const auto& [f, exponent] : cut.factors()) add(f, std::nullopt);
  }
  return result;
}

std::vector<JumpPlace> FunctionPieces::split_jump_factors(const Polynomial& p) const {
  std::vector<JumpPlace> result;
  std::vector<Polynomial> logarithms;
  const auto add = [&](const std::vector<Polynomial>& list) {
    for (JumpPlace& place : common_zeros(list)) result.push_back(std::move(place));
  };
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& generator = table_.generators()[g];
    if (generator.kind != Kind::function) continue;
    if (generator.order == kArcTangentOfTwo) add(generator.arguments);
    if (generator.order == kLogarithm || generator.order == kLogOfAbsolute)
      logarithms.push_back(generator.base);
  }
  add(logarithms);
  return result;
}

/// max(b, 0)^(1 + k/q) and b*|b| are continuously differentiable functions of b. So is p where it
/// depends on a root of b by terms with such powers alone, b being a polynomial in the symbols; on
/// the edge of the root's domain this is so from inside.
bool FunctionPieces::is_smooth_across(const Polynomial& p, const Polynomial& f) const {
  const auto [top, bottom] = table_.lowest_terms(p);
  const std::vector<std::size_t> used = table_.generators_in({top, bottom});
  std::optional<std::size_t> rough;
  for (const std::size_t g : used) {
    const Generator& own = table_.generators()[g];
    if (own.kind == Kind::function) return false;
    if (own.kind != Kind::root && own.kind != Kind::absolute) continue;
    Polynomial quotient(table_.ring());
    if (!table_.fraction(own.base).first.divide(f, &quotient)) continue;
    if (rough) return false;
    rough = g;
  }
  if (!rough) return false;
  const std::size_t place = table_.symbols().size() + *rough;
  const Generator& root = table_.generators()[*rough];
  for (std::size_t i = table_.symbols().size(); i < table_.ring().size(); ++i)
    if (root.base.uses(i)) return false;
  if (bottom.uses(place) || std::any_of(used.begin(), used.end(), [&](std::size_t g) {
        return table_.generators()[g].base.uses(place);
      }))
    return false;
  Polynomial needed = root.base;
  if (root.kind == Kind::absolute) {
    needed = table_.ring().constant(1);
    for (const auto& [factor, exponent] : root.base.factors())
      if (!factor.is_constant()) needed *= factor.pow(exponent / 2);
  }
  const std::vector<Polynomial> parts = top.coefficients(place);
  return std::all_of(parts.begin() + 1, parts.end(), [&](const Polynomial& part) {
    Polynomial quotient(table_.ring());
    return part.is_zero() || part.divide(needed, &quotient);
  });
}

bool FunctionPieces::is_rough_in_absolute_value_alone(const Polynomial& p,
                                                      const Polynomial& f) const {
  const std::vector<std::size_t> used = table_.generators_in({p});
  return std::all_of(used.begin(), used.end(), [&](std::size_t g) {
    const Generator& own = table_.generators()[g];
    if (own.kind == Kind::function) return false;
    if (own.kind != Kind::root && own.kind != Kind::absolute) return true;
    Polynomial quotient(table_.ring());
    if (!table_.fraction(own.base).first.divide(f, &quotient)) return true;
    return own.kind == Kind::absolute && own.base.divide(f * f, &quotient) &&
           quotient.is_constant();
  });
}

namespace {

/// Whether each root has an irreducible factor of its own in its radicand.
bool are_independent(const std::vector<const Generator*>& roots) {
  return std::all_of(roots.begin(), roots.end(), [&](const Generator* root) {
    const auto factors = root->base.factors();
    return std::any_of(factors.begin(), factors.end(), [&](const auto& factor) {
      const Polynomial& f = factor.first;
      if (f.is_constant() || std::gcd(factor.second, root->order) != 1) return false;
      return std::none_of(roots.begin(), roots.end(), [&](const Generator* other) {
        Polynomial quotient(f.ring());
        return other != root && other->base.divide(f, &quotient);
      });
    });
  });
}

}  // namespace

/// Sums, products, quotients, sines, cosines and exponentials of entire functions are meromorphic
/// on all of C^n, which is connected: what is not zero at one point is zero on no open set. An
/// extension of their field by roots whose radicands are independent modulo powers (Kummer) is a
/// field again: an element that vanishes on an open set has norm zero, and is zero on every sheet.
/// Here the radicands are polynomials in the symbols alone, where irreducible factors tell that; in
/// the ring of sines and cosines they do not: 1 - sin(x) is 2*sin(Pi/4 - x/2)^2. |p| is p or -p
/// where p keeps its sign. All else (logarithms, inverse functions, roots of such functions) is
/// analytic, and what is known at a point is known on the connected part of the domain around it.
FunctionPieces::Pieces FunctionPieces::pieces(const std::vector<Polynomial>& functions) const {
  Pieces result;
  const auto in_symbols = [&](const Polynomial& p) {
    for (std::size_t g = 0; g < table_.generators().size(); ++g)
      if (p.uses(table_.place(g))) return false;
    return true;
  };
  const auto is_plain = [&](const Polynomial& p) {  // meromorphic
    const auto used = table_.generators_in({p});
    return std::all_of(used.begin(), used.end(), [&](std::size_t g) {
      const Kind kind = table_.generators()[g].kind;
      const bool argument = kind == Kind::sine || kind == Kind::exponential;
      return kind == Kind::cosine || kind == Kind::inverse ||
             table_.generators()[g].base.is_constant() ||
             (argument && in_symbols(table_.generators()[g].base));
    });
  };
  std::vector<const Generator*> roots;
  for (const std::size_t g : table_.generators_in(functions)) {
    const Generator& generator = table_.generators()[g];
    switch (generator.kind) {
      case Kind::sine:
      case Kind::exponential:
        result.rigid = result.rigid && in_symbols(generator.base);
        break;
      case Kind::absolute: {
        Polynomial inside = table_.ring().constant(1);  // the base is its square
        for (const auto& [f, exponent] : generator.base.factors())
          if (!f.is_constant()) inside *= f.pow(exponent / 2);
        result.rigid = result.rigid && is_plain(inside);
        result.switches.push_back(std::move(inside));
        break;
      }
      case Kind::root:
        if (generator.base.is_constant()) break;
        result.rigid = result.rigid && in_symbols(generator.base);
        roots.push_back(&generator);
        break;
      case Kind::function:
        result.rigid =
            result.rigid && generator.base.is_constant() && generator.order != kArcTangentOfTwo;
        break;
      case Kind::imaginary:
        result.rigid = result.rigid && !table_.is_complex();
        break;
      case Kind::cosine:
      case Kind::inverse:
        break;
    }
  }
  result.rigid = result.rigid && are_independent(roots);
  return result;
}

}  // namespace casimir::functions

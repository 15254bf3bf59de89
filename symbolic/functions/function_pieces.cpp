#include "symbolic/functions/function_pieces.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace casimir::functions {

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
    if (!cuts || generator.kind != Kind::function) continue;
    // atan(1/x) jumps by half a turn where x passes zero.
    if (generator.order == kArcTangent) add(table_.fraction(generator.base).second);
    // atan2 jumps on its cut, y = 0 and x < 0; where y is zero all over, at x = 0; and at poles of
    // both, atan2(1, 1/x) as atan(x) does not.
    if (generator.order == kArcTangentOfTwo) {
      const Polynomial& y = generator.arguments[0];
      const Polynomial& x = generator.arguments[1];
      if (signs_.known_sign(x) <= 0 || !signs_.known_nonzero(x))
        add(table_.numerator(y).is_zero() ? x : y);
      add(table_.fraction(y).second);
      add(table_.fraction(x).second);
    }
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

std::vector<Polynomial> FunctionPieces::zeros_with_roots(const std::vector<Polynomial>& list,
                                                         std::size_t least) const {
  std::vector<Polynomial> result;
  for (const Polynomial& rough : list)
    for (const Polynomial& f : radicand_factors(rough)) {
      const auto count =
          std::ranges::count_if(list, [&](const Polynomial& own) { return vanishes_with(own, f); });
      if (static_cast<std::size_t>(count) >= least) result.push_back(f);
    }
  return result;
}

std::vector<Polynomial> FunctionPieces::jump_factors(const Polynomial& p, bool cuts) const {
  std::vector<Polynomial> result;
  const std::vector<Polynomial> rough = radicand_factors(p);
  const auto add = [&](const Polynomial& f) {
    if (!f.is_constant() && std::find(result.begin(), result.end(), f) == result.end())
      result.push_back(f);
  };
  // What is divided by, itself or under a root that is.
  const auto divided_by = [&](const Polynomial& bottom, bool inverse) {
    for (const auto& [f, exponent] : bottom.factors()) {
      if (signs_.is_assumed_nonzero(f)) continue;  // as in 1/exp(|x|)
      std::vector<Polynomial> parts = radicand_factors(f);
      parts.push_back(f);
      for (const Polynomial& part : parts)
        if (inverse || std::find(rough.begin(), rough.end(), part) != rough.end()) add(part);
    }
  };
  divided_by(table_.lowest_terms(p).second, false);
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& generator = table_.generators()[g];
    const bool function = generator.kind == Kind::function;
    if (generator.kind != Kind::inverse && !generator.base.is_zero())
      divided_by(table_.fraction(generator.base).second,
                 function && generator.order == kArcTangent);  // atan(1/x)
    for (const Polynomial& argument : generator.arguments)
      divided_by(table_.fraction(argument).second, cuts && function);
    if (!cuts || !function || generator.order != kArcTangentOfTwo) continue;
    const Polynomial& y = generator.arguments[0];
    const Polynomial& x = generator.arguments[1];
    if (signs_.known_sign(x) > 0 && signs_.known_nonzero(x)) continue;
    const Polynomial cut =
        table_.numerator(y).is_zero() ? table_.numerator(x) : table_.numerator(y);
    for (const auto& [f, exponent] : cut.factors()) add(f);
  }
  return result;
}

std::vector<Polynomial> FunctionPieces::split_jump_factors(const Polynomial& p) const {
  std::vector<Polynomial> result, logarithms;
  const auto add = [&](const std::vector<Polynomial>& list) {
    for (const Polynomial& f : zeros_with_roots(list, 2))
      if (std::find(result.begin(), result.end(), f) == result.end()) result.push_back(f);
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

// What a FunctionRing knows of the places where its functions are not analytic.
#include <algorithm>
#include <numeric>
#include <utility>

#include "symbolic/functions/function_ring.hpp"

namespace casimir {

/// Their indices, with those that they are made of.
std::vector<std::size_t> FunctionRing::generators_in(
    const std::vector<Polynomial>& functions) const {
  std::vector<bool> used(generators_.size());
  const auto mark = [&](const Polynomial& p) {
    for (std::size_t g = 0; g < generators_.size(); ++g)
      used[g] = used[g] || p.uses(symbols_.size() + g);
  };
  for (const Polynomial& f : functions) mark(f);
  // Each is made of earlier ones.
  for (std::size_t g = generators_.size(); g-- > 0;) {
    if (!used[g]) continue;
    mark(generators_[g].base);
    if (generators_[g].kind == Kind::cosine) used[g - 1] = true;
    // cos(v/3) is no smoother than the cos(v) of its relation.
    for (const Polynomial& coefficient : generators_[g].relation) mark(coefficient);
    if (generators_[g].quotient) mark(generators_[g].quotient->second);
    if (generators_[g].partner) used[generators_[g].partner->first - symbols_.size()] = true;
    for (const Polynomial& slope : generators_[g].derivatives) {
      // The arguments of atan2 are seen in its derivatives alone.
      if (generators_[g].kind == Kind::function && generators_[g].order == kArcTangentOfTwo)
        mark(slope);
    }
  }
  std::vector<std::size_t> result;
  for (std::size_t g = 0; g < used.size(); ++g)
    if (used[g]) result.push_back(g);
  return result;
}

bool FunctionRing::depends_on(const Polynomial& p, std::size_t symbol) const {
  if (p.uses(symbol)) return true;
  const auto used = generators_in({p});
  return std::any_of(used.begin(), used.end(),
                     [&](std::size_t g) { return depends_on(generators_[g], symbol); });
}

bool FunctionRing::depends_on_first(const Polynomial& p, std::size_t coordinates) const {
  for (std::size_t i = 0; i < coordinates; ++i)
    if (depends_on(p, i)) return true;
  return false;
}

/// Whether it has real values only, I apart from which functions might have others.
bool FunctionRing::is_real_everywhere(const Polynomial& p) const {
  if (!complex_) return true;
  const auto used = generators_in({p});
  return std::all_of(used.begin(), used.end(), [&](std::size_t g) {
    const Generator& generator = generators_[g];
    switch (generator.kind) {
      case Kind::sine:
      case Kind::cosine:
      case Kind::exponential:
      case Kind::inverse:
      case Kind::absolute:
        return true;  // of what is real, which the others that are used make sure
      case Kind::root:
        return generator.base.is_constant() && !cln::minusp(generator.base.term_list()[0].first);
      case Kind::imaginary:
        return false;
      case Kind::function:
        return generator.order == kConstant || generator.order == kArcTangent ||
               generator.order == kArcTangentOfTwo || generator.order == kCosineOfPi;
    }
    return false;
  });
}

namespace {

/// Divides both by their greatest common divisor, which has the leading coefficient 1. The same few
/// denominators come again and again, and their factors are remembered.
void cancel(Polynomial& top, Polynomial& bottom) {
  constexpr std::size_t kMostTerms = 100;
  constexpr long kMostDegree = 50;
  if (bottom.terms() > kMostTerms || bottom.total_degree() > kMostDegree) {
    const Polynomial common = Polynomial::gcd(top, bottom);
    top.divide(common, &top);
    bottom.divide(common, &bottom);
    return;
  }
  Polynomial quotient(top.ring());
  for (const auto& [f, exponent] : bottom.factors()) {
    if (f.is_constant()) continue;
    const Polynomial factor = f.scaled(1 / f.term_list()[0].first);
    for (unsigned long k = 0; k < exponent && top.divide(factor, &quotient); ++k) {
      std::swap(top, quotient);
      bottom.divide(factor, &bottom);
    }
  }
}

}  // namespace

std::pair<Polynomial, Polynomial> FunctionRing::lowest_terms(const Polynomial& p) const {
  if (generators_.empty()) return {p, ring_->constant(1)};
  const auto [unreduced_top, unreduced_bottom] = fraction(reduced(p));
  Polynomial top = reduced(unreduced_top);
  Polynomial bottom = reduced(unreduced_bottom);
  if (top.is_zero()) return {top, ring_->constant(1)};
  if (bottom.is_constant()) return {std::move(top), std::move(bottom)};
  cancel(top, bottom);
  return {std::move(top), std::move(bottom)};
}

bool FunctionRing::is_nowhere_zero(const Polynomial& p) const {
  if (p.is_zero()) return false;
  // Where nothing is assumed, a polynomial in the symbols without constant term is zero at zero.
  if (generators_.empty() && signs_.empty() && nonzero_.empty() &&
      cln::zerop(p.evaluate(std::vector<cln::cl_RA>(ring_->size()))))
    return false;
  const auto factors = p.factors();
  return std::all_of(factors.begin(), factors.end(),
                     [&](const auto& factor) { return known_nonzero(factor.first); });
}

bool FunctionRing::is_assumed_positive(const Polynomial& p) const {
  int sign = 1;
  for (const auto& [f, exponent] : p.factors()) {
    if (f.is_constant()) {
      if (cln::minusp(f.term_list()[0].first)) sign = -sign;
      continue;
    }
    if (is_exponential(f)) continue;
    const auto found = std::find_if(signs_.begin(), signs_.end(), [&f = f](const Sign& s) {
      return !s.implied && s.strict && (s.of == f || s.of == -f);
    });
    if (found == signs_.end() && !(known_sign(f) != 0 && is_sum_of_squares(f) && known_nonzero(f)))
      return false;
    if (known_sign(f) < 0 && exponent % 2 == 1) sign = -sign;
  }
  return sign > 0;
}

/// Each is factored once.
const std::vector<Polynomial>& FunctionRing::factors_of_radicand(std::size_t g) const {
  const auto [known, fresh] = radicands_.try_emplace(g);
  if (fresh && !generators_[g].base.is_zero()) {
    for (const auto& [f, exponent] : fraction(generators_[g].base).first.factors())
      known->second.push_back(f);
  }
  return known->second;
}

std::vector<Polynomial> FunctionRing::radicand_factors(const Polynomial& p, bool cuts) const {
  std::vector<Polynomial> result;
  const auto add_factor = [&](const Polynomial& f) {
    if (!f.is_constant() && std::find(result.begin(), result.end(), f) == result.end())
      result.push_back(f);
  };
  const auto add = [&](const Polynomial& base) {
    if (base.is_zero()) return;
    for (const auto& [f, exponent] : fraction(base).first.factors()) add_factor(f);
  };
  const Polynomial one = ring_->constant(1);
  // Parts of inverse functions are analytic where these are, and sin(atan2(y, x)/2) but for the
  // cut, where the root of r + x in its relation vanishes.
  for (const std::size_t g : generators_in({p})) {
    const Generator& generator = generators_[g];
    if (generator.kind == Kind::root || generator.kind == Kind::absolute)
      for (const Polynomial& f : factors_of_radicand(g)) add_factor(f);
    const bool arc = generator.kind == Kind::function &&
                     (generator.order == kArcSine || generator.order == kArcCosine);
    // By the relations: with v = sqrt(1 - y) it is y, of which the motion may have a root as well.
    if (arc) add(numerator(one - generator.base * generator.base));
    if (!cuts || generator.kind != Kind::function) continue;
    // atan(1/x) jumps by half a turn where x passes zero.
    if (generator.order == kArcTangent) add(fraction(generator.base).second);
    // atan2 jumps on its cut, y = 0 and x < 0; where y is zero all over, at x = 0; and at poles of
    // both, atan2(1, 1/x) as atan(x) does not.
    if (generator.order == kArcTangentOfTwo) {
      const Polynomial& y = known_.at(generator.value.op(0));
      const Polynomial& x = known_.at(generator.value.op(1));
      if (known_sign(x) <= 0 || !known_nonzero(x)) add(numerator(y).is_zero() ? x : y);
      add(fraction(y).second);
      add(fraction(x).second);
    }
  }
  return result;
}

/// max(b, 0)^(1 + k/q) and b*|b| are continuously differentiable functions of b. So is p where it
/// depends on a root of b by terms with such powers alone, b being a polynomial in the symbols; on
/// the edge of the root's domain this is so from inside.
bool FunctionRing::is_smooth_across(const Polynomial& p, const Polynomial& f) const {
  const auto [top, bottom] = lowest_terms(p);
  const std::vector<std::size_t> used = generators_in({top, bottom});
  std::optional<std::size_t> rough;
  for (const std::size_t g : used) {
    const Generator& own = generators_[g];
    if (own.kind == Kind::function) return false;
    if (own.kind != Kind::root && own.kind != Kind::absolute) continue;
    Polynomial quotient(*ring_);
    if (!fraction(own.base).first.divide(f, &quotient)) continue;
    if (rough) return false;
    rough = g;
  }
  if (!rough) return false;
  const std::size_t place = symbols_.size() + *rough;
  const Generator& root = generators_[*rough];
  for (std::size_t i = symbols_.size(); i < ring_->size(); ++i)
    if (root.base.uses(i)) return false;
  if (bottom.uses(place) || std::any_of(used.begin(), used.end(), [&](std::size_t g) {
        return generators_[g].base.uses(place);
      }))
    return false;
  Polynomial needed = root.base;
  if (root.kind == Kind::absolute) {
    needed = ring_->constant(1);
    for (const auto& [factor, exponent] : root.base.factors())
      if (!factor.is_constant()) needed *= factor.pow(exponent / 2);
  }
  const std::vector<Polynomial> parts = top.coefficients(place);
  return std::all_of(parts.begin() + 1, parts.end(), [&](const Polynomial& part) {
    Polynomial quotient(*ring_);
    return part.is_zero() || part.divide(needed, &quotient);
  });
}

bool FunctionRing::is_rough_in_absolute_value_alone(const Polynomial& p,
                                                    const Polynomial& f) const {
  const std::vector<std::size_t> used = generators_in({p});
  return std::all_of(used.begin(), used.end(), [&](std::size_t g) {
    const Generator& own = generators_[g];
    if (own.kind == Kind::function) return false;
    if (own.kind != Kind::root && own.kind != Kind::absolute) return true;
    Polynomial quotient(*ring_);
    if (!fraction(own.base).first.divide(f, &quotient)) return true;
    return own.kind == Kind::absolute && own.base.divide(f * f, &quotient) &&
           quotient.is_constant();
  });
}

/// Sums, products, quotients, sines, cosines and exponentials of entire functions are meromorphic
/// on all of C^n, which is connected: what is not zero at one point is zero on no open set. An
/// extension of their field by roots whose radicands are independent modulo powers (Kummer) is a
/// field again: an element that vanishes on an open set has norm zero, and is zero on every sheet.
/// Here the radicands are polynomials in the symbols alone, where irreducible factors tell that; in
/// the ring of sines and cosines they do not: 1 - sin(x) is 2*sin(Pi/4 - x/2)^2. |p| is p or -p
/// where p keeps its sign. All else (logarithms, inverse functions, roots of such functions) is
/// analytic, and what is known at a point is known on the connected part of the domain around it.
FunctionRing::Pieces FunctionRing::pieces(const std::vector<Polynomial>& functions) const {
  Pieces result;
  const auto in_symbols = [&](const Polynomial& p) {
    for (std::size_t g = 0; g < generators_.size(); ++g)
      if (p.uses(symbols_.size() + g)) return false;
    return true;
  };
  const auto is_plain = [&](const Polynomial& p) {  // meromorphic
    const auto used = generators_in({p});
    return std::all_of(used.begin(), used.end(), [&](std::size_t g) {
      const Kind kind = generators_[g].kind;
      const bool argument = kind == Kind::sine || kind == Kind::exponential;
      return kind == Kind::cosine || kind == Kind::inverse || generators_[g].base.is_constant() ||
             (argument && in_symbols(generators_[g].base));
    });
  };
  std::vector<const Generator*> roots;
  for (const std::size_t g : generators_in(functions)) {
    const Generator& generator = generators_[g];
    switch (generator.kind) {
      case Kind::sine:
      case Kind::exponential:
        result.rigid = result.rigid && in_symbols(generator.base);
        break;
      case Kind::absolute: {
        Polynomial inside = ring_->constant(1);  // the base is its square
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
        result.rigid = result.rigid && !complex_;
        break;
      case Kind::cosine:
      case Kind::inverse:
        break;
    }
  }
  // Each root has an irreducible factor of its own in its radicand.
  std::vector<std::vector<Polynomial>> own;
  for (const Generator* root : roots) {
    own.emplace_back();
    for (const auto& [f, exponent] : root->base.factors()) {
      const bool coprime = std::gcd(exponent, root->order) == 1;
      if (!f.is_constant() && coprime) own.back().push_back(f);
    }
  }
  for (std::size_t i = 0; i < roots.size() && result.rigid; ++i) {
    result.rigid = std::any_of(own[i].begin(), own[i].end(), [&](const Polynomial& f) {
      return std::none_of(roots.begin(), roots.end(), [&](const Generator* other) {
        Polynomial quotient(*ring_);
        return other != roots[i] && other->base.divide(f, &quotient);
      });
    });
  }
  return result;
}

}  // namespace casimir

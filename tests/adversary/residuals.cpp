#include "tests/adversary/residuals.hpp"

#include <algorithm>

namespace casimir::adversary {
namespace {

Ball scalar_product(const std::vector<Ball>& a, const std::vector<Ball>& b) {
  Ball sum;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) sum = sum + a[i] * b[i];
  return sum;
}

bool declares(const Case& claim, const std::string& name) {
  const auto is_it = [&](const Named& n) { return n.name == name; };
  const std::vector<std::string> symbols = claim.system.symbols();
  return std::find(symbols.begin(), symbols.end(), name) != symbols.end() ||
         std::any_of(claim.system.definitions.begin(), claim.system.definitions.end(), is_it);
}

/// The function of that name, or the only one.
const Expr& subject(const std::vector<Named>& functions, const std::string& name) {
  for (const Named& f : functions) {
    if (f.name == name) return f.value;
  }
  return functions.front().value;
}

}  // namespace

Substitution names_of(const Case& claim) {
  Substitution names;
  if (claim.system.bracket != Bracket::none && !declares(claim, "H"))
    names.emplace("H", claim.system.hamiltonian);
  for (const Named& d : claim.system.definitions) names.emplace(d.name, d.value);
  return names;
}

std::vector<Expr> expressions_of(const Case& claim) {
  std::vector<Expr> list;
  for (const auto& [place, entry] : claim.system.entries) list.push_back(entry);
  list.insert(list.end(), claim.system.equations.begin(), claim.system.equations.end());
  list.push_back(claim.system.hamiltonian);
  const auto add = [&](const std::vector<Named>& functions) {
    for (const Named& f : functions) list.push_back(f.value);
  };
  add(claim.casimirs);
  add(claim.integrals);
  for (const auto* claims : {&claim.conditionals, &claim.invariant_relations}) {
    for (const OnLevel& c : *claims) {
      list.push_back(c.expression);
      list.insert(list.end(), c.on.begin(), c.on.end());
    }
  }
  for (const IdentityClaim& i : claim.identities) {
    list.push_back(i.left);
    list.push_back(i.right);
  }
  for (const Lax& pair : claim.lax) {
    for (const auto* m : {&pair.l, &pair.a}) {
      for (const auto& row : *m) list.insert(list.end(), row.begin(), row.end());
    }
  }
  for (const Map& m : claim.maps)
    list.insert(list.end(), m.expressions.begin(), m.expressions.end());
  for (const Measure& m : claim.measures) list.push_back(m.density);
  return list;
}

bool is_complex(const Case& claim) {
  const std::vector<Expr> all = expressions_of(claim);
  return std::any_of(all.begin(), all.end(), [](const Expr& e) { return is_complex(e); });
}

std::vector<Expr> functions_of(const Case& claim, bool casimirs) {
  std::vector<Expr> functions;
  if (claim.system.bracket != Bracket::none && claim.system.time.empty())
    functions.push_back(claim.system.hamiltonian);
  for (const Named& f : claim.integrals) functions.push_back(f.value);
  if (casimirs) {
    for (const Named& f : claim.casimirs) functions.push_back(f.value);
  }
  return functions;
}

At::At(const Case& claim, const Point& point)
    : case_(claim),
      point_(point),
      along_(claim.system.variables),
      names_(names_of(claim)),
      real_(!is_complex(claim)) {
  if (!claim.system.time.empty()) along_.push_back(claim.system.time);
}

Dual At::dual(const Expr& e) const { return evaluate(named(e), point_, along_, real_); }

Ball At::value(const Expr& f) const { return adversary::value(named(f), point_, real_); }

std::vector<Ball> At::gradient(const Expr& f) const { return dual(f).slope; }

std::vector<std::vector<Ball>> At::structure() const {
  const std::size_t n = case_.system.variables.size();
  std::vector<std::vector<Ball>> rows(n, std::vector<Ball>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      rows[i][j] = value(case_.system.bracket_of(i, j));
      rows[j][i] = Ball(-1) * rows[i][j];
    }
  }
  return rows;
}

std::vector<Ball> At::flow(const Expr& f) const {
  const std::vector<Ball> slope = gradient(f);
  std::vector<Ball> result;
  for (const auto& row : structure()) result.push_back(scalar_product(row, slope));
  return result;
}

Ball At::bracket(const Expr& f, const Expr& g) const {
  return scalar_product(gradient(f), flow(g));
}

std::vector<Ball> At::field() const {
  if (case_.system.bracket != Bracket::none) return flow(case_.system.hamiltonian);
  std::vector<Ball> result;
  for (const Expr& rate : case_.system.equations) result.push_back(value(rate));
  return result;
}

Ball At::rate(const Expr& f) const {
  std::vector<Ball> velocity = field();
  if (!case_.system.time.empty()) velocity.emplace_back(1);
  return scalar_product(gradient(f), velocity);
}

std::vector<Ball> At::jacobi() const {
  const System& system = case_.system;
  const std::size_t n = system.variables.size();
  std::vector<std::vector<Dual>> j(n, std::vector<Dual>(n));
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) j[a][b] = dual(system.bracket_of(a, b));
  }
  std::vector<Ball> result;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        Ball sum;
        for (std::size_t l = 0; l < n; ++l)
          sum = sum + j[a][l].value * j[b][c].slope[l] + j[b][l].value * j[c][a].slope[l] +
                j[c][l].value * j[a][b].slope[l];
        result.push_back(sum);
      }
    }
  }
  return result;
}

std::vector<Ball> At::lax() const {
  std::vector<Ball> result;
  for (const Lax& pair : case_.lax) {
    const std::size_t n = pair.l.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        Ball sum = rate(pair.l[i][k]);
        for (std::size_t m = 0; m < n; ++m)
          sum = sum - value(pair.l[i][m]) * value(pair.a[m][k]) +
                value(pair.a[i][m]) * value(pair.l[m][k]);
        result.push_back(sum);
      }
    }
  }
  return result;
}

std::vector<Ball> At::map() const {
  std::vector<Ball> result;
  for (const Map& m : case_.maps) {
    Substitution image;
    for (std::size_t i = 0; i < m.expressions.size(); ++i)
      image.emplace(m.target.variables[i], m.expressions[i]);
    for (std::size_t i = 0; i < m.expressions.size(); ++i) {
      for (std::size_t j = i + 1; j < m.expressions.size(); ++j)
        result.push_back(bracket(m.expressions[i], m.expressions[j]) -
                         Ball(m.sign) * value(substitute(m.target.bracket_of(i, j), image)));
    }
  }
  return result;
}

std::vector<Ball> At::measure() const {
  const System& system = case_.system;
  const std::size_t n = system.variables.size();
  std::vector<Ball> result;
  for (const Measure& m : case_.measures) {
    if (system.bracket == Bracket::none) {
      Ball divergence;
      for (std::size_t i = 0; i < n; ++i)
        divergence = divergence + dual(system.equations[i]).slope[i];
      result.push_back(rate(m.density) + value(m.density) * divergence);
      continue;
    }
    // The divergence of J grad H is that of the rows of J along grad H, since J is skew.
    const Dual density = dual(m.density);
    std::vector<Ball> modular(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const Dual entry = dual(system.bracket_of(i, j));
        modular[j] = modular[j] + density.slope[i] * entry.value + density.value * entry.slope[i];
      }
    }
    if (m.every_hamiltonian) {
      result.insert(result.end(), modular.begin(), modular.end());
    } else {
      Ball sum = scalar_product(modular, gradient(system.hamiltonian));
      if (!system.time.empty()) sum = sum + density.slope.back();
      result.push_back(sum);
    }
  }
  return result;
}

std::vector<Ball> At::rates_of(const OnLevel& claim) const {
  std::vector<Ball> result;
  // One that is certainly not zero says that the claim fails, whatever the others are.
  const auto add = [&](const Expr& f) {
    try {
      result.push_back(rate(f));
    } catch (const Unknown&) {
      acb_indeterminate(result.emplace_back().get());
    }
  };
  add(claim.expression);
  for (const Expr& f : claim.on) add(f);
  return result;
}

std::vector<Ball> At::residuals() const {
  switch (case_.kind) {
    case Kind::integral:
      return {rate(subject(case_.integrals, case_.name))};
    case Kind::casimir:
      return flow(subject(case_.casimirs, case_.name));
    case Kind::jacobi:
      return jacobi();
    case Kind::identity:
      return {value(case_.identities.front().left) - value(case_.identities.front().right)};
    case Kind::conditional:
      return rates_of(case_.conditionals.front());
    case Kind::invariant_relation:
      return rates_of(case_.invariant_relations.front());
    case Kind::lax:
      return lax();
    case Kind::measure:
      return measure();
    case Kind::map:
      return map();
    case Kind::involution:
      return {bracket(case_.integrals.at(0).value, case_.integrals.at(1).value)};
    default:
      throw std::logic_error("no residual of a fact about ranks");
  }
}

}  // namespace casimir::adversary

#include "symbolic/search/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "symbolic/error.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/search/modular/modular_roots.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {
namespace {

std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions,
                                 std::vector<GiNaC::ex> others) {
  for (const NamedExpression& f : functions) others.push_back(f.value);
  return others;
}

bool contains(const std::vector<std::size_t>& list, std::size_t i) {
  return std::find(list.begin(), list.end(), i) != list.end();
}

/// How a function is written as a factor.
std::string factor_text(const std::string& text) {
  std::size_t depth = 0;
  const std::size_t open = text.find('(');
  const std::size_t word =
      text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_");
  if (word == std::string::npos) return text;
  bool call = open != std::string::npos && open > 0 && word == open && text.back() == ')';
  for (std::size_t i = open; call && i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    call = depth > 0 || i + 1 == text.size();
  }
  return call ? text : "(" + text + ")";
}

bool is_variable(const Polynomial& p) {
  const auto terms = p.term_list();
  return terms.size() == 1 && terms[0].first == 1 && p.total_degree() == 1;
}

/// The model with a symbol more for each function that is not a variable of its ring: F itself is
/// the unknown, and not the finer function that the ring makes it of. Null where there is none.
std::unique_ptr<Model> with_symbols_for(const Model& model,
                                        const std::vector<NamedExpression>& functions,
                                        const std::vector<GiNaC::ex>& others) {
  if (functions.empty()) return nullptr;
  Prover prover(model, values_of(functions, others));
  std::unique_ptr<Model> result;
  for (const NamedExpression& f : functions) {
    const Polynomial value = prover.ring().reduced(prover.convert(f.value));
    if (value.is_constant() || is_variable(value)) continue;
    if (!result) result = std::make_unique<Model>(model);
    result->parameters.emplace_back(factor_text(f.name));
  }
  return result;
}

}  // namespace

std::vector<NamedExpression> System::with_own_functions(const Model& model,
                                                        std::vector<NamedExpression> functions,
                                                        const std::vector<GiNaC::ex>& others,
                                                        Denominators denominators) {
  if (functions.empty()) return functions;
  const System plain(model, {}, others, denominators);
  for (const std::size_t place : plain.places_of_functions()) {
    const GiNaC::ex value = plain.functions().variable_value(place);
    if (std::ranges::none_of(functions,
                             [&](const NamedExpression& f) { return f.value.is_equal(value); }))
      functions.push_back({plain.name(place), value, {}});
  }
  return functions;
}

System::System(const Model& model, const std::vector<NamedExpression>& functions,
               const std::vector<GiNaC::ex>& others, Denominators denominators)
    : System(model, with_own_functions(model, functions, others, denominators), others,
             denominators, Declared{}) {}

System::System(const Model& model, const std::vector<NamedExpression>& functions,
               const std::vector<GiNaC::ex>& others, Denominators denominators, Declared) try
    : meter_(std::in_place, model.limits),
      extended_(with_symbols_for(model, functions, others)),
      prover_(extended_ ? *extended_ : model, values_of(functions, others)) {
  const std::size_t dimension = model.variables.size();
  for (std::size_t g = this->functions().symbols().size();
       g < this->functions().end_of_generators(); ++g) {
    if (this->functions().origin(g).kind == FunctionRing::Origin::Kind::arbitrary)
      throw ModelError("a search needs functions that are given, and this case has arbitrary ones");
  }
  for (std::size_t i = 0; i < dimension; ++i) moving_.push_back(i);
  if (model.time) moving_.push_back(dimension + this->model().parameters.size());
  for (std::size_t i = prover_.ring().symbols().size(); i < ring().size(); ++i)
    bonds_.push_back(bond_of(i));
  constant_.assign(ring().size(), true);
  for (const std::size_t i : moving_) constant_[i] = false;
  for (std::size_t g = prover_.ring().symbols().size(); g < ring().size(); ++g) {
    constant_[g] = std::all_of(moving_.begin(), moving_.end(), [&](std::size_t i) {
      return prover_.ring().derivative(ring().variable(g), i).is_zero();
    });
  }
  for (std::size_t place = dimension + model.parameters.size();
       place < dimension + this->model().parameters.size(); ++place)
    constant_[place] = false;
  collect_atoms(functions, denominators);
  std::vector<Polynomial> rates = prover_.field();
  if (model.time) rates.push_back(ring().constant(1));
  flow_ = of_atoms(rates);
  plain_flow_ = plain_rates(rates);
  for (std::size_t j = 0; model.poisson && j < dimension; ++j) {
    std::vector<Polynomial> row;
    for (std::size_t i = 0; i < dimension; ++i) row.push_back(prover_.bracket_entry(i, j));
    if (model.time) row.push_back(Polynomial(ring()));
    coordinate_flows_.push_back(of_atoms(row));
    plain_coordinate_flows_.push_back(plain_rates(row));
  }
  collect_parameters();
  meter_.reset();
} catch (const TooLarge& problem) {
  throw TooMuchWork(problem.what());
}

System::Bond System::bond_of(std::size_t place) const {
  using OriginKind = FunctionRing::Origin::Kind;
  if (place >= functions().end_of_generators()) return {Bond::Kind::none, Polynomial(ring()), 1};
  if (has_elliptic_function(functions().variable_value(place)))
    throw TooLarge("elliptic functions are known to proofs of claims, and not to a search");
  FunctionRing::Origin origin = functions().origin(place);
  switch (origin.kind) {
    case OriginKind::inverse:
      return {Bond::Kind::inverse, std::move(origin.argument), 1};
    case OriginKind::root:
    case OriginKind::absolute:
    case OriginKind::imaginary:
      return {Bond::Kind::root, std::move(origin.argument), origin.order};
    case OriginKind::cosine: {
      const Polynomial sine = ring().variable(place - 1);
      return {Bond::Kind::root, ring().constant(1) - sine * sine, 2};
    }
    default:
      return {Bond::Kind::none, Polynomial(ring()), 1};
  }
}

void System::need(const Polynomial& p) {
  for (std::size_t g = prover_.ring().symbols().size(); g < ring().size(); ++g)
    if (p.uses(g) && !constant_[g] && !contains(atoms_, g)) atoms_.push_back(g);
}

/// The inverses that p contains.
void System::need_denominators(const Polynomial& p) {
  const std::size_t symbols = prover_.ring().symbols().size();
  for (std::size_t g = symbols; g < ring().size(); ++g)
    if (p.uses(g) && bonds_[g - symbols].kind == Bond::Kind::inverse) need(ring().variable(g));
}

/// All functions that the rates of the atoms are polynomials in once denominators are multiplied
/// out, and that these are bound to.
void System::need_all(const std::vector<Polynomial>& rates) {
  const std::size_t symbols = prover_.ring().symbols().size();
  for (std::size_t known = 0; known != atoms_.size();) {
    known = atoms_.size();
    for (const Polynomial& rate : of_atoms(rates)) need(rate);
    for (std::size_t a = moving_.size(); a < atoms_.size(); ++a)
      if (atoms_[a] >= symbols) need(bonds_[atoms_[a] - symbols].base);
  }
}

/// The coordinates and all functions that their rates, or the declared functions, are polynomials
/// in once denominators are multiplied out; and the relations between them.
void System::collect_atoms(const std::vector<NamedExpression>& declared,
                           Denominators denominators) {
  atoms_ = moving_;
  std::size_t place = model().variables.size() + model().parameters.size();
  for (const NamedExpression& f : declared) {
    const Polynomial value = prover_.ring().reduced(prover_.convert(f.value));
    if (value.is_constant()) continue;
    if (is_variable(value))
      need(value);
    else
      defined_.push_back({0, value});
  }
  for (std::size_t k = defined_.size(); k-- > 0;) defined_[k].place = --place;
  std::vector<Polynomial> rates = prover_.field();
  if (denominators == Denominators::atoms) {
    for (const Polynomial& rate : rates) need_denominators(rate);
    if (model().hamiltonian) need_denominators(prover_.convert(*model().hamiltonian));
  }
  if (model().time) rates.push_back(ring().constant(1));
  need_all(rates);
  silent_.assign(ring().size(), false);
  if (!defined_.empty()) {
    const std::vector<std::size_t> own = atoms_;
    for (const Defined& d : defined_) {
      need(d.value);
      for (std::size_t i = 0; i < moving_.size(); ++i) need(slope(d.value, i));
    }
    need_all(rates);
    for (const std::size_t atom : atoms_) silent_[atom] = !contains(own, atom);
  }
  for (const Defined& d : defined_) atoms_.push_back(d.place);
  for (const std::size_t atom : atoms_)
    if (std::optional<Polynomial> relation = relation_of(atom))
      relations_.push_back(std::move(*relation));
}

std::optional<Polynomial> System::relation_of(std::size_t place) const {
  const Polynomial variable = ring().variable(place);
  for (const Defined& d : defined_)
    if (d.place == place) return variable - d.value;
  const std::size_t symbols = prover_.ring().symbols().size();
  if (place < symbols) return std::nullopt;
  const Bond& bond = bonds_[place - symbols];
  if (bond.kind == Bond::Kind::inverse) return variable * bond.base - ring().constant(1);
  if (bond.kind == Bond::Kind::root) return variable.pow(bond.order) - bond.base;
  return std::nullopt;
}

Polynomial System::slope(const Polynomial& p, std::size_t i) const {
  Polynomial result = prover_.ring().derivative(p, moving_[i]);
  for (const Defined& d : defined_) {
    if (p.uses(d.place))
      result += p.derivative(d.place) * prover_.ring().derivative(d.value, moving_[i]);
  }
  return result;
}

std::vector<Polynomial> System::plain_rates(const std::vector<Polynomial>& rates) const {
  if (prover_.ring().is_polynomial() && defined_.empty()) return rates;
  std::vector<Polynomial> result;
  for (const std::size_t atom : atoms_) {
    SumOfProducts sum(ring());
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      if (rates[i].is_zero()) continue;
      const Polynomial own = slope(ring().variable(atom), i);
      if (!own.is_zero()) sum.add(own, rates[i]);
    }
    result.push_back(sum.finish());
  }
  return result;
}

std::vector<Polynomial> System::of_atoms(const std::vector<Polynomial>& rates) const {
  if (prover_.ring().is_polynomial() && defined_.empty()) return rates;
  return prover_.ring().common_numerators(plain_rates(rates));
}

std::vector<std::size_t> System::places_of_functions() const {
  std::vector<std::size_t> places;
  for (const std::size_t atom : atoms_)
    if (!contains(moving_, atom) && !silent_[atom]) places.push_back(atom);
  return places;
}

std::vector<std::string> System::names_of_functions() const {
  std::vector<std::string> names;
  for (const std::size_t place : places_of_functions()) names.push_back(name(place));
  return names;
}

GiNaC::ex System::expression(const Polynomial& p) const {
  const FunctionRing& own = prover_.ring();
  GiNaC::exmap values;
  for (const Defined& d : defined_) values.emplace(own.symbols()[d.place], own.expression(d.value));
  return own.expression(p).subs(values, GiNaC::subs_options::no_pattern);
}

std::string System::text_of(const GiNaC::ex& expression) const {
  const FunctionRing& own = prover_.ring();
  FunctionRing fresh(own.symbols(), model().assumptions, {expression}, own.limits());
  return fresh.text(fresh.convert(expression));
}

void System::collect_parameters() {
  for (std::size_t i = 0; i < ring().size(); ++i) {
    if (!constant_[i]) continue;
    const auto uses = [&](const Polynomial& p) { return p.uses(i); };
    bool used = std::any_of(flow_.begin(), flow_.end(), uses) ||
                std::any_of(relations_.begin(), relations_.end(), uses);
    for (const auto& row : coordinate_flows_)
      used = used || std::any_of(row.begin(), row.end(), uses);
    if (used) parameters_.push_back(i);
  }
}

std::vector<std::string> System::generic_parameters() const {
  std::vector<std::string> names;
  for (const std::size_t place : parameters_)
    if (!is_number(place)) names.push_back(name(place));
  return names;
}

bool System::is_number(std::size_t place) const {
  if (place < functions().symbols().size() || place >= functions().end_of_generators())
    return false;
  const GiNaC::ex value = functions().variable_value(place);
  return std::none_of(functions().symbols().begin(), functions().symbols().end(),
                      [&](const GiNaC::symbol& s) { return GiNaC::has(value, s); });
}

unsigned long System::order_of(std::size_t place) const {
  const std::size_t symbols = prover_.ring().symbols().size();
  if (place < symbols || bonds_[place - symbols].kind != Bond::Kind::root) return 0;
  return bonds_[place - symbols].order;
}

std::string System::bound_parameter() const {
  const std::size_t symbols = prover_.ring().symbols().size();
  for (const std::size_t place : parameters_) {
    if (place >= symbols && bonds_[place - symbols].kind != Bond::Kind::none) return name(place);
  }
  return {};
}

std::vector<Polynomial> System::gradient(const Polynomial& p) const {
  std::vector<Polynomial> result;
  for (std::size_t i = 0; i < moving_.size(); ++i) result.push_back(slope(p, i));
  return result;
}

bool System::in_atoms(const Polynomial& p) const {
  for (std::size_t i = 0; i < ring().size(); ++i)
    if (p.uses(i) && !constant_[i] && !contains(atoms_, i)) return false;
  return true;
}

bool System::is_zero_function(const Polynomial& p) const {
  Polynomial value = p;
  for (const Defined& d : defined_) {
    SumOfProducts sum(ring());
    const std::vector<Polynomial> coefficients = value.coefficients(d.place);
    for (std::size_t k = 0; k < coefficients.size(); ++k)
      sum.add(coefficients[k], functions().reduced(d.value.pow(k)));
    value = sum.finish();
  }
  return functions().numerator(value).is_zero();
}

std::optional<Polynomial> System::hamiltonian() {
  const Model& model = prover_.model();
  if (!model.hamiltonian || model.time) return std::nullopt;
  Polynomial h = prover_.convert(*model.hamiltonian);
  if (!in_atoms(h)) return std::nullopt;
  return h;
}

std::optional<Residue> System::bound_value(std::size_t place, const Point& point,
                                           const Modulus& modulus, std::mt19937_64& random) const {
  const Bond& bond = bonds_[place - prover_.ring().symbols().size()];
  if (bond.kind == Bond::Kind::none) return modulus.random(random);
  const std::optional<Residue> base = value_at(bond.base, point, modulus);
  if (!base) return std::nullopt;
  if (bond.kind == Bond::Kind::inverse) {
    if (*base == 0) return std::nullopt;
    return modulus.inverse(*base);
  }
  if (bond.order == 2) return random_square_root(*base, modulus, random);
  // Most numbers have no root, which a power tells faster than a search for roots.
  const std::uint64_t units = modulus.prime() - 1;
  if (*base != 0 && modulus.power(*base, units / std::gcd(units, bond.order)) != 1)
    return std::nullopt;
  std::vector<Residue> equation(bond.order + 1, 0);
  equation[0] = modulus.negative(*base);
  equation[bond.order] = 1;
  return random_root(equation, modulus, random);
}

std::optional<Point> System::random_point(const Modulus& modulus, std::mt19937_64& random,
                                          const Point* constants) const {
  // Half of all numbers have a square root: ten roots need a thousand tries, of which most end at
  // once.
  constexpr int kTries = 8192;
  const std::size_t symbols = prover_.ring().symbols().size();
  for (int attempt = 0; attempt < kTries; ++attempt) {
    Point point(ring().size(), 0);
    bool found = true;
    for (std::size_t i = 0; i < point.size() && found; ++i) {
      if (constants != nullptr && constant_[i]) {
        point[i] = (*constants)[i];
      } else if (i < symbols) {
        point[i] = modulus.random(random);
      } else {
        const std::optional<Residue> value = bound_value(i, point, modulus, random);
        found = value.has_value();
        point[i] = value.value_or(0);
      }
    }
    for (const Defined& d : defined_) {
      if (!found) break;
      const std::optional<Residue> value = value_at(d.value, point, modulus);
      found = value.has_value();
      point[d.place] = value.value_or(0);
    }
    if (found) return point;
  }
  return std::nullopt;
}

Modulus usable_modulus(const System& system) {
  constexpr std::size_t kPrimes = 64;
  for (std::size_t i = 0; i < kPrimes; ++i) {
    std::mt19937_64 random(5);
    const Modulus modulus = Modulus::nth(i);
    if (system.random_point(modulus, random)) return modulus;
  }
  return Modulus::nth(0);
}

std::optional<Residue> value_at(const Polynomial& p, const Point& point, const Modulus& modulus) {
  Residue sum = 0;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    const std::optional<Residue> number = modulus.reduce(coefficient);
    if (!number) return std::nullopt;
    Residue term = *number;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] != 0) term = modulus.multiply(term, modulus.power(point[i], exponents[i]));
    }
    sum = modulus.add(sum, term);
  }
  return sum;
}

}  // namespace casimir::search

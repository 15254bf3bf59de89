#include "tests/adversary/systems.hpp"
#include "tests/adversary/templates.hpp"

namespace casimir::adversary {
namespace {

/// Names that a library might keep for itself, or that mean something in mathematics.
const std::vector<std::string>& tempting_names() {
  static const std::vector<std::string> names{"H",  "t",    "E", "L", "s", "d",  "rho", "lambda",
                                              "x0", "time", "n", "F", "C", "u1", "y1",  "_s1"};
  return names;
}

/// A definition by such a name, which the claim is about: an integral if what it stands for is one.
Case definition(Random& random) {
  Case claim;
  claim.kind = Kind::integral;
  claim.family = "names";
  System& s = claim.system;
  s.variables = {"q", "p"};
  s.bracket = Bracket::canonical;
  const Expr q{"q"}, p{"p"};
  s.hamiltonian = pow(p, 2) + pow(q, 2) * small_number(random);
  const bool conserved = random.one_in(2);
  const std::string name = random.of(tempting_names());
  s.definitions = {
      {name, conserved ? s.hamiltonian * 2 + 1 : random.of(std::vector<Expr>{p, q, q * p})}};
  claim.name = name == "F" ? "G" : "F";
  const Expr f{name};
  claim.integrals = {{claim.name, random.one_in(2) ? f : pow(f, 2) + f}};
  claim.truth = conserved ? Truth::yes : Truth::no;
  return claim;
}

/// A parameter of such a name.
Case parameter(Random& random) {
  Case claim;
  claim.kind = Kind::integral;
  claim.family = "names";
  System& s = claim.system;
  s.variables = {"q", "p"};
  s.bracket = Bracket::canonical;
  const Expr q{"q"}, p{"p"};
  const std::string name = random.of(tempting_names());
  const Expr a{name};
  s.parameters = {{name}};
  const bool conserved = random.one_in(2);
  s.hamiltonian = pow(p, 2) + a * pow(q, 2);
  claim.name = name == "F" ? "G" : "F";
  claim.integrals = {{claim.name, conserved ? (pow(p, 2) + a * pow(q, 2)) * a : pow(p, 2) + a * q}};
  claim.truth = conserved ? Truth::yes : Truth::no;
  return claim;
}

/// Variables of such names, without and with a time.
Case variable(Random& random) {
  Case claim;
  claim.kind = Kind::integral;
  claim.family = "names";
  System& s = claim.system;
  const std::string first = random.of(tempting_names());
  std::string second = random.of(tempting_names());
  if (second == first) second = "other";
  s.variables = {first, second};
  const Expr a{first}, b{second};
  s.equations = {1, a};
  const bool conserved = random.one_in(2);
  claim.name = "K";
  claim.integrals = {{"K", 2 * b - (conserved ? Expr(1) : Expr(2)) * pow(a, 2)}};
  claim.truth = conserved ? Truth::yes : Truth::no;
  if (first != "t" && second != "t" && random.one_in(2)) {
    s.time = "t";
    const Expr t{"t"};
    claim.integrals.front().value = conserved ? a - t : a + t;
  }
  return claim;
}

}  // namespace

const std::vector<Template>& name_templates() {
  static const std::vector<Template> all{definition, definition, parameter, variable};
  return all;
}

}  // namespace casimir::adversary

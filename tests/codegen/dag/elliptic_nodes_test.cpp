// Elliptic functions in generated code, against Boost.
#include "codegen/dag/elliptic_nodes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <map>

#include "codegen/emit/number_literal.hpp"
#include "codegen/optimise/differentiate.hpp"
#include "codegen/optimise/optimise.hpp"
#include "runtime/evaluate.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/elliptic.hpp"

namespace casimir::test {
namespace {

/// Each function is generated once.
const Program& program_of(const std::string& name) {
  static std::map<std::string, Program> programs;
  if (const auto found = programs.find(name); found != programs.end()) return found->second;
  const EllipticFunction& function = *find_elliptic_function(name);
  std::vector<GiNaC::symbol> symbols;
  std::vector<std::string> inputs;
  GiNaC::exvector given;
  for (std::size_t i = 0; i < function.arity; ++i) {
    inputs.push_back("x" + std::to_string(i));
    symbols.emplace_back(inputs.back());
    given.push_back(symbols.back());
  }
  codegen::Dag dag(symbols, symbols.size());
  const codegen::Scaled node = dag.convert(function.apply(given));
  return programs[name] = codegen::optimised(dag, {node}, inputs, {"value"});
}

double generated(const std::string& name, const std::vector<double>& arguments) {
  return evaluate(program_of(name), arguments).front();
}

void expect_near(double value, double expected, const std::string& what) {
  EXPECT_NEAR(value, expected, 4e-14 * (1 + std::abs(expected))) << what;
}

TEST(EllipticNodes, OfJacobiAreThoseOfBoost) {
  for (const double u : {-3.7, 0.2, 1.1, 2.9, 17.3})
    for (const double k : {0.1, 0.5, 0.9, 0.9999, 0.99999999}) {
      double cn = 0, dn = 0;
      const double sn = boost::math::jacobi_elliptic(k, u, &cn, &dn);
      const std::string where = std::to_string(u) + " " + std::to_string(k);
      // Near k = 1 the modulus itself is not known better.
      if (k > 0.99999 && std::abs(u) > 4) continue;
      expect_near(generated("sn", {u, k}), sn, "sn " + where);
      expect_near(generated("cn", {u, k}), cn, "cn " + where);
      expect_near(generated("dn", {u, k}), dn, "dn " + where);
      expect_near(std::sin(generated("am", {u, k})), sn, "am " + where);
    }
}

/// With its derivative. The smallest factors of that have the squares of what those of the function
/// have: too small for a float.
TEST(EllipticNodes, OfAModulusThatIsANumberAreThoseOfBoostAndHaveDerivatives) {
  const GiNaC::symbol x("x");
  std::vector<GiNaC::ex> moduli{GiNaC::sqrt(GiNaC::ex(2)) / 3, GiNaC::numeric(0),
                                GiNaC::numeric(-2, 3), GiNaC::numeric(99, 100)};
  for (int n = 1; n < 10; ++n) moduli.push_back(GiNaC::numeric(n, 10));
  for (const GiNaC::ex& k : moduli) {
    codegen::Dag dag({x}, 1);
    const codegen::Scaled node = dag.convert(elliptic::sn(x, k));
    const Program program = codegen::optimised(dag, {node}, {"x"}, {"value"});
    const SparseProgram slope = codegen::jacobian(program, 1);
    for (const double u : {-3.7, 0.2, 2.9}) {
      double cn = 0, dn = 0;
      const double modulus = GiNaC::ex_to<GiNaC::numeric>(k.evalf()).to_double();
      const double sn = boost::math::jacobi_elliptic(std::abs(modulus), u, &cn, &dn);
      const std::string where = std::to_string(u) + " " + std::to_string(modulus);
      expect_near(evaluate(program, std::vector<double>{u}).front(), sn, where);
      expect_near(evaluate(slope.program, std::vector<double>{u}).front(), cn * dn, where);
    }
    for (const cln::cl_RA& constant : program.constants)
      EXPECT_NO_THROW(codegen::nearest<float>(constant)) << k;
    for (const cln::cl_RA& constant : slope.program.constants)
      EXPECT_NO_THROW(codegen::nearest<double>(constant)) << k;
  }
}

TEST(EllipticNodes, OfCarlsonAreThoseOfBoost) {
  for (const auto& [x, y, z] :
       {std::array{1., 2., 3.}, std::array{1e-6, 2., 1e5}, std::array{0.5, 0.5000001, 0.4999},
        std::array{3., 1e-12, 7e3}, std::array{2., 2., 2.}, std::array{1e-20, 1., 1e20}}) {
    const auto expect = [](double value, double expected) {
      EXPECT_NEAR(value, expected, 1e-13 * std::abs(expected));
    };
    expect(generated("R_F", {x, y, z}), boost::math::ellint_rf(x, y, z));
    expect(generated("R_D", {x, y, z}), boost::math::ellint_rd(x, y, z));
    expect(generated("R_J", {x, y, z, 1.5}), boost::math::ellint_rj(x, y, z, 1.5));
    expect(generated("R_J", {x, y, z, 1e-3}), boost::math::ellint_rj(x, y, z, 1e-3));
    if (x > 0.1) expect(generated("R_J", {x, y, z, 1e8}), boost::math::ellint_rj(x, y, z, 1e8));
  }
}

// Beyond what the duplications bring together there is no value, and no wrong one; between the two
// no digit of a double is lost.
TEST(EllipticNodes, OfTheThirdKindHaveNoWrongValue) {
  for (int power = -40; power <= 40; ++power) {
    const double p = std::pow(10., power / 2.), expected = boost::math::ellint_rj(1., 2., 3., p);
    const double value = generated("R_J", {1, 2, 3, p});
    if (p >= 1e-6 && p <= 1e8) EXPECT_FALSE(std::isnan(value)) << p;
    if (!std::isnan(value)) EXPECT_NEAR(value, expected, 2e-12 * expected) << p;
    if (p >= 1e12) EXPECT_TRUE(std::isnan(value)) << p << ' ' << value;
  }
}

/// Of numbers alone.
double of_constants(const std::string& name, const GiNaC::exvector& arguments) {
  codegen::Dag dag({}, 0);
  const codegen::Scaled node = dag.convert(find_elliptic_function(name)->apply(arguments));
  const Program program = codegen::optimised(dag, {node}, {}, {"value"});
  return cln::double_approx(codegen::constant_value(program, program.outputs.front(), {}));
}

TEST(EllipticNodes, OfJacobiHaveNoValueAtTheModulusOne) {
  for (const char* name : {"am", "sn", "cn", "dn"})
    for (const double k : {-1., 1., 1.5}) EXPECT_TRUE(std::isnan(generated(name, {1, k}))) << name;
  const GiNaC::symbol k("k");
  for (const GiNaC::ex& value : {GiNaC::ex(1), GiNaC::ex(-1), GiNaC::ex(2)}) {
    codegen::Dag dag({}, 0);
    EXPECT_THROW(dag.convert(GiNaC::ex(elliptic::sn(1, k)).subs(k == value)), ModelError);
  }
}

/// Written out each would be the three before, ten times over.
TEST(EllipticNodes, OfConstantsAreNumbers) {
  expect_near(of_constants("R_F", {1, 2, 3}), boost::math::ellint_rf(1., 2., 3.), "R_F");
  expect_near(of_constants("R_D", {1, 2, 3}), boost::math::ellint_rd(1., 2., 3.), "R_D");
  expect_near(of_constants("R_J", {1, 2, 3, GiNaC::numeric(1, 7)}),
              boost::math::ellint_rj(1., 2., 3., 1. / 7), "R_J");
  // mpmath's, of a p that is far from the others.
  expect_near(of_constants("R_J", {1, 2, 3, GiNaC::pow(GiNaC::numeric(10), 8)}) * 1e8,
              2.18036665160537, "R_J");
  for (const GiNaC::exvector& none : {GiNaC::exvector{0, 0, 1}, GiNaC::exvector{1, 1, -1}}) {
    EXPECT_THROW(of_constants("R_F", none), ModelError);
    EXPECT_THROW(of_constants("R_D", none), ModelError);
  }
  // sn(u, k) of a modulus that no double tells from 1, where u is as large as the period's part.
  expect_near(of_constants("sn", {GiNaC::numeric(33), 1 - GiNaC::pow(GiNaC::numeric(10), -30)}),
              std::tanh(33.), "sn");
  // Beyond the doubles nothing goes on without end.
  EXPECT_THROW(of_constants("sn", {1, 1 - GiNaC::pow(GiNaC::numeric(10), -700)}), ModelError);
  EXPECT_THROW(of_constants("R_F", {1, 2, GiNaC::pow(GiNaC::numeric(10), 400)}), ModelError);
  EXPECT_THROW(of_constants("R_F", {1, 2, GiNaC::pow(GiNaC::numeric(10), -400)}), ModelError);
  for (const int digits : {3, 6, 12}) {  // k = 1 - 10^-digits
    const GiNaC::ex k = 1 - GiNaC::pow(GiNaC::numeric(10), -digits);
    // sn(u, k) is tanh(u) up to (1 - k^2)/4 (sinh u cosh u - u) sech(u)^2 (DLMF 22.10.7).
    const double u = 1.5, rest = 2 * std::pow(10., -digits);
    const double expected =
        std::tanh(u) + rest / 4 * (std::sinh(u) * std::cosh(u) - u) / std::pow(std::cosh(u), 2);
    EXPECT_NEAR(of_constants("sn", {GiNaC::numeric(3, 2), k}), expected, rest * rest + 1e-15);
  }
}

}  // namespace
}  // namespace casimir::test

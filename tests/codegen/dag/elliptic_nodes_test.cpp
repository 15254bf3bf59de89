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

#include "codegen/optimise/optimise.hpp"
#include "runtime/evaluate.hpp"
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
  }
}

}  // namespace
}  // namespace casimir::test

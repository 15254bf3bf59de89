#include "codegen/specialise.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using testing::equations;
using testing::exact;
using testing::kKovalevskaya;
using testing::model_of;
using testing::Points;
using testing::specialised;

std::string left_out(const Specialisation& spec, const std::string& kind) {
  std::string result;
  for (const LeftOut& l : spec.left_out) {
    if (l.kind == kind) result += l.name + ": " + l.reason + "\n";
  }
  return result;
}

std::string error_of(const std::string& toml, const SpecialiseOptions& options = {}) {
  try {
    specialised(toml, options);
  } catch (const ModelError& e) {
    return e.what();
  }
  return "";
}

/// Every program against the expressions of the model, exactly, at random points.
void expect_exact(const std::string& toml, const SpecialiseOptions& options) {
  const Model model = model_of(toml);
  const Scene& scene = model.scenes.at(0);
  const Specialisation spec = specialise(model, scene, options);
  Points points;
  GiNaC::exmap map;
  std::vector<cln::cl_RA> inputs;
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    const cln::cl_RA value = points.next();
    map[model.variables[i]] = GiNaC::numeric(value);
    if (std::ranges::count(spec.state_indices, static_cast<int>(i))) inputs.push_back(value);
  }
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const cln::cl_RA value = points.next();
    map[model.parameters[i]] =
        options.fold_parameters ? scene.parameters[i] : GiNaC::ex(GiNaC::numeric(value));
    if (!options.fold_parameters) inputs.push_back(value);
  }
  inputs.push_back(0);
  const auto value = [&](const GiNaC::ex& e) {
    return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(e.subs(map)).to_cl_N());
  };
  const auto rates = exact(spec.rhs, inputs);
  const auto entries = exact(spec.jacobian.program, inputs);
  const std::size_t n = spec.states.size();
  std::vector<cln::cl_RA> dense(n * n, 0);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto& [row, column] = spec.jacobian.entries[k];
    dense[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)] = entries[k];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const GiNaC::ex& rate = model.field[static_cast<std::size_t>(spec.state_indices[i])];
    EXPECT_EQ(rates[i], value(rate));
    for (std::size_t j = 0; j < n; ++j) {
      const auto& by = model.variables[static_cast<std::size_t>(spec.state_indices[j])];
      EXPECT_EQ(dense[i * n + j], value(rate.diff(by)));
    }
  }
  if (model.hamiltonian && !spec.invariant_names.empty() && spec.invariant_names[0] == "H") {
    EXPECT_EQ(exact(spec.invariants, inputs)[0], value(*model.hamiltonian));
  }
}

const char* const kClebsch = R"toml(
title = "t"
source = "s"
hamiltonian = "(a1*M1^2 + a2*M2^2 + a3*M3^2)/2 + (c1*g1^2 + c2*g2^2 + c3*g3^2)/2 - (M1 - g2)^2/7"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[parameters]
a1 = {}
a2 = {}
a3 = {}
c1 = {}
c2 = {}
c3 = {}
[[scene]]
name = "default"
parameters = { a1 = "1", a2 = "1", a3 = "1/2", c1 = "1/3", c2 = "-2", c3 = "0" }
initial = { M1 = "1", M2 = "1/2", M3 = "1/3", g1 = "3/5", g2 = "0", g3 = "4/5" }
duration = "10"
)toml";

TEST(Specialise, FoldedProgramsAreExact) {
  expect_exact(kKovalevskaya, {});
  expect_exact(kClebsch, {});
}

TEST(Specialise, GeneralProgramsAreExactForAnyParameters) {
  SpecialiseOptions options;
  options.fold_parameters = false;
  expect_exact(kKovalevskaya, options);
  expect_exact(kClebsch, options);
  const Specialisation spec = specialised(kClebsch, options);
  EXPECT_EQ(spec.parameters.size(), 6u);
  EXPECT_EQ(spec.rhs.inputs.size(), 13u);  // states, parameters, time
  EXPECT_EQ(spec.rhs.inputs[6], "a1");
}

TEST(Specialise, SaysWhereItComesFrom) {
  const Specialisation spec = specialised(kKovalevskaya);
  EXPECT_EQ(spec.case_name, "kovalevskaya");
  EXPECT_EQ(spec.hamiltonian, "M1^2/2 + M2^2/2 + M3^2 - g1*r");
  EXPECT_EQ(spec.invariant_names, (std::vector<std::string>{"H", "F1", "F2", "K"}));
  EXPECT_EQ(spec.rhs.output_names[0], "dM1");
  EXPECT_EQ(left_out(spec, "parameter"), "r: folded to 1\n");
  EXPECT_EQ(exact(spec.start, {}).at(2), cln::cl_RA(1) / 3);
  EXPECT_EQ(exact(spec.start, {}).back(), 100);
}

TEST(Specialise, TermsThatVanishAreDroppedAndNamed) {
  const std::string field =
      "[parameters]\na = {}\nb = {}\n[[scene]]\nname = \"default\"\nparameters = ";
  const std::vector<std::pair<std::string, std::string>> rates{
      {"u", "(a - b)*v*w + u"}, {"v", "w"}, {"w", "b*u"}};
  const Specialisation equal = specialised(equations(rates, field + "{ a = \"2\", b = \"2\" }"));
  EXPECT_EQ(left_out(equal, "term"), "v*w in du: vanishes: coefficient a - b = 0\n");
  EXPECT_EQ(equal.specialised.mul, 1);
  const Specialisation unequal = specialised(equations(rates, field + "{ a = \"2\", b = \"3\" }"));
  EXPECT_EQ(left_out(unequal, "term"), "");
  EXPECT_EQ(unequal.specialised.mul, 2);
}

TEST(Specialise, StatesThatAreNotObservedAreDropped) {
  const std::vector<std::pair<std::string, std::string>> rates{
      {"u", "v"}, {"v", "-u + (u + w)*v - w*v"}, {"w", "u"}, {"s", "w*s"}};
  SpecialiseOptions options;
  options.observe = {"v"};
  const Specialisation spec =
      specialised(equations(rates, "[integrals]\nA = \"u^2\"\nB = \"w*u\"\n"), options);
  EXPECT_EQ(spec.states, (std::vector<std::string>{"u", "v"}));  // w cancels from dv/dt
  EXPECT_EQ(spec.state_indices, (std::vector<int>{0, 1}));
  EXPECT_EQ(left_out(spec, "state"), "w: not needed for v\ns: not needed for v\n");
  EXPECT_EQ(left_out(spec, "invariant"), "B: needs w\n");
  EXPECT_EQ(spec.invariant_names, (std::vector<std::string>{"A"}));
  options.observe = {"B"};
  EXPECT_EQ(specialised(equations(rates, "[integrals]\nB = \"w*u\"\n"), options).states.size(), 3u);
  options.observe = {"s"};
  EXPECT_EQ(specialised(equations(rates), options).states.size(), 4u);
  EXPECT_EQ(specialised(equations(rates)).states.size(), 4u);
}

TEST(Specialise, AFoldedParameterMayDecoupleStates) {
  const std::string field = "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = ";
  const std::vector<std::pair<std::string, std::string>> rates{{"u", "-u + a*v"}, {"v", "u"}};
  SpecialiseOptions options;
  options.observe = {"u"};
  EXPECT_EQ(specialised(equations(rates, field + "{ a = \"0\" }"), options).states.size(), 1u);
  EXPECT_EQ(specialised(equations(rates, field + "{ a = \"1\" }"), options).states.size(), 2u);
  options.fold_parameters = false;
  EXPECT_EQ(specialised(equations(rates, field + "{ a = \"0\" }"), options).states.size(), 2u);
}

TEST(Specialise, UnknownNamesAndDivisionsByZeroAreErrors) {
  SpecialiseOptions options;
  options.observe = {"M4"};
  EXPECT_NE(error_of(kKovalevskaya, options).find("cannot observe 'M4'"), std::string::npos);
  const std::string field =
      "[parameters]\na = {}\nb = {}\n[[scene]]\nname = \"default\"\nparameters = ";
  const std::vector<std::pair<std::string, std::string>> rates{{"u", "u/(a - b)"}};
  EXPECT_EQ(error_of(equations(rates, field + "{ a = \"2\", b = \"2\" }")),
            "scene \"default\" (a = 2, b = 2): du cannot be computed: division by zero");
  EXPECT_EQ(error_of(equations(rates, field + "{ a = \"2\", b = \"3\" }")), "");
  EXPECT_NE(error_of(equations({{"u", "sqrt(a - b)*u"}}, field + "{ a = \"2\", b = \"3\" }"))
                .find("is not a real number"),
            std::string::npos);
}

TEST(Specialise, IrrationalParametersStayExact) {
  const Specialisation spec = specialised(equations(
      {{"u", "a^2*u + a*Pi"}},
      "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"sqrt(2)\" }"));
  EXPECT_EQ(spec.specialised, (OperationCount{1, 1, 0, 0}));  // 2*u + constant
}

TEST(Specialise, HiddenZerosLeaveTheJacobian) {
  const Specialisation spec = specialised(equations({{"u", "(u + v)*v - u*v"}, {"v", "u*v"}}));
  EXPECT_EQ(spec.jacobian.entries, (std::vector<std::pair<int, int>>{{1, 0}, {0, 1}, {1, 1}}));
  // One that only multiplying out shows, in the file's form and not in the shortest.
  const Specialisation cubic =
      specialised(equations({{"u", "(u + v)^3 - u^3 - 3*u^2*v - 3*u*v^2 + v"}, {"v", "u*v"}}));
  EXPECT_EQ(cubic.jacobian.entries, spec.jacobian.entries);
  EXPECT_EQ(exact(cubic.jacobian.program, {2, 5, 0}), (std::vector<cln::cl_RA>{5, 76, 2}));
}

}  // namespace
}  // namespace casimir

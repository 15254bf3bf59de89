// Parameters that stay arguments of the generated code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "codegen/emit_cpp.hpp"
#include "runtime/integrate.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using testing::equations;
using testing::exact;
using testing::Points;
using testing::specialised;

/// w is needed only where a differs from b; c divides.
std::string with_values(const std::string& a, const std::string& b, const std::string& c) {
  return equations(
      {{"u", "(a - b)*v*w + u/c"}, {"v", "a*w"}, {"w", "b*u"}},
      "[parameters]\na = {}\nb = {}\nc = {}\n[[scene]]\nname = \"default\"\nparameters "
      "= { a = \"" +
          a + "\", b = \"" + b + "\", c = \"" + c + "\" }");
}

SpecialiseOptions keeping(const std::vector<std::string>& names) {
  SpecialiseOptions options;
  options.keep_parameters = names;
  return options;
}

SpecialiseOptions keeping_all() {
  SpecialiseOptions options;
  options.fold_parameters = false;
  return options;
}

TEST(KeepParameters, TheModuleDoesNotDependOnTheirValues) {
  for (const SpecialiseOptions& options : {keeping_all(), keeping({"a", "c"})}) {
    const std::string one = emit_module(specialised(with_values("1", "2", "3"), options));
    EXPECT_EQ(one, emit_module(specialised(with_values("2", "2", "1/7"), options)));
    EXPECT_EQ(one, emit_module(specialised(with_values("0", "2", "sqrt(2)"), options)));
  }
  const std::string one = emit_module(specialised(with_values("1", "2", "3"), keeping({"a"})));
  EXPECT_NE(one, emit_module(specialised(with_values("1", "2", "4"), keeping({"a"}))));
}

TEST(KeepParameters, OnlyThoseNamedAreInputs) {
  const Specialisation spec = specialised(with_values("1", "2", "3"), keeping({"c", "a"}));
  EXPECT_EQ(spec.parameters, (std::vector<std::string>{"a", "c"}));
  EXPECT_EQ(spec.rhs.inputs, (std::vector<std::string>{"u", "v", "w", "a", "c", "t"}));
  EXPECT_EQ(exact(spec.start, {}).at(4), 3);
  const auto rates = exact(spec.rhs, {2, 3, 5, 7, 11, 0});
  EXPECT_EQ(rates[0], cln::cl_RA(5 * 15) + cln::cl_RA(2) / 11);
  EXPECT_EQ(rates[1], 35);
  EXPECT_EQ(rates[2], 4);
  EXPECT_THROW(specialised(with_values("1", "2", "3"), keeping({"d"})), ModelError);
}

TEST(KeepParameters, NothingVanishesBecauseOfOneValue) {
  // At a = b the term v*w is gone from the folded code, not from this one.
  const Specialisation folded = specialised(with_values("2", "2", "1"));
  EXPECT_FALSE(folded.jacobian.entries == specialised(with_values("2", "3", "1")).jacobian.entries);
  SpecialiseOptions options = keeping_all();
  options.gradients = true;
  options.variational = true;
  const Specialisation equal = specialised(with_values("2", "2", "1"), options);
  const Specialisation unequal = specialised(with_values("2", "3", "1"), options);
  EXPECT_EQ(equal.jacobian.entries, unequal.jacobian.entries);
  EXPECT_EQ(exact(equal.rhs, {1, 1, 1, 2, 3, 1, 0})[0], 0);
  EXPECT_EQ(exact(equal.rhs, {1, 1, 1, 2, 2, 1, 0})[0], 1);
}

TEST(KeepParameters, APowerThatStaysOpenSaysForWhichValuesItIsCode) {
  const std::string scene =
      "[parameters]\nn = {}\nk = {}\n[[scene]]\nname = \"default\"\nparameters = { n = \"2\", "
      "k = \"3\" }";
  const auto left_out = [&](const std::string& rate, const SpecialiseOptions& options) {
    std::vector<std::string> values;
    for (const LeftOut& item : specialised(equations({{"u", rate}}, scene), options).left_out)
      if (item.kind == "values") values.push_back(item.name + ": " + item.reason);
    return values;
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(left_out("k*u^n", keeping({"n"})), Lines{"u <= 0: the code computes exp(n*log(u))"});
  EXPECT_EQ(left_out("k*u^n", keeping_all()), Lines{"u <= 0: the code computes exp(n*log(u))"});
  EXPECT_EQ(left_out("u^k*u^n", keeping({"n"})).size(), 1U);
  // With n = 2 in the code it is u*u.
  EXPECT_EQ(left_out("k*u^n", {}), Lines{});
  EXPECT_EQ(left_out("k*u^n", keeping({"k"})), Lines{});
  for (const char* positive : {"2", "(1 + u^2)", "exp(u)"})
    EXPECT_EQ(left_out(std::string(positive) + "^n", keeping_all()), Lines{}) << positive;
  for (const char* other : {"u^2", "(u^2 - 1)", "(u + exp(u))", "u^3"})
    EXPECT_EQ(left_out("(" + std::string(other) + ")^n", keeping_all()).size(), 1U) << other;
  EXPECT_EQ(left_out("exp(n*u)", keeping_all()), Lines{});
  const auto of_parameter = [&](const std::string& k) {
    const std::string assuming = "[parameters]\nn = {}\nk = " + k +
                                 "\n[[scene]]\nname = \"default\"\nparameters = { n = \"2\", k = "
                                 "\"3\" }";
    const auto items = specialised(equations({{"u", "u*k^n"}}, assuming), keeping_all()).left_out;
    return std::ranges::count(items, "values", &LeftOut::kind);
  };
  EXPECT_EQ(of_parameter("{}"), 1);
  EXPECT_EQ(of_parameter("{ assume = \"k > 0\" }"), 0);
}

TEST(KeepParameters, StatesThatNobodyNeedsAreStillLeftOut) {
  SpecialiseOptions options = keeping_all();
  options.observe = {"u"};
  const std::string rest =
      "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"0\" }";
  const Specialisation spec =
      specialised(equations({{"u", "-u + a*v"}, {"v", "u"}, {"w", "u*a"}}, rest), options);
  EXPECT_EQ(spec.states, (std::vector<std::string>{"u", "v"}));  // v counts for another a
}

TEST(KeepParameters, ValuesForWhichThereIsNoFunctionAreRefused) {
  for (const SpecialiseOptions& options : {SpecialiseOptions{}, keeping_all(), keeping({"c"})}) {
    try {
      specialised(with_values("1", "2", "0"), options);
      FAIL() << "divided by zero";
    } catch (const ModelError& e) {
      EXPECT_NE(std::string(e.what()).find("du cannot be computed: division by zero"),
                std::string::npos)
          << e.what();
    }
  }
  const std::string root =
      equations({{"u", "sqrt(a)*u"}},
                "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"-1\" }");
  EXPECT_THROW(specialised(root, keeping_all()), ModelError);
}

TEST(KeepParameters, ADivisionByZeroAtRunTimeEndsInAStatus) {
  const Specialisation spec = specialised(with_values("1", "2", "3"), keeping_all());
  for (const char* name : {"dop853", "gauss8", "taylor-compiled"}) {
    const Method& method = *find_method(name);
    const Module module = Module::load(
        compile(emit_module(spec, kernel_source(method), {.series = method.series})).path);
    Settings settings;
    settings.duration = 1;
    const std::vector<double> start{0.5, 0.5, 0.5};
    EXPECT_EQ(integrate(module, method, settings, start, {1, 2, 3}).status, Status::ok) << name;
    const Trajectory refused = integrate(module, method, settings, start, {1, 2, 0});
    EXPECT_NE(refused.status, Status::ok) << name;
    EXPECT_EQ(refused.time, 0) << name;
  }
}

TEST(KeepParameters, HeadersHaveTheDefaultsOfTheScene) {
  const std::string header = emit_header(specialised(with_values("1", "2", "1/2"), keeping({"c"})));
  EXPECT_NE(header.find("struct parameters {\n  double c = 0.5;\n};"), std::string::npos) << header;
  EXPECT_NE(header.find("scene \"default\" (a = 1, b = 2, c = 1/2)"), std::string::npos) << header;
}

}  // namespace
}  // namespace casimir

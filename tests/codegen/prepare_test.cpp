// What depends on parameters only is taken out of what is computed at every call.
#include "codegen/prepare.hpp"

#include <gtest/gtest.h>

#include "codegen/emit_cpp.hpp"
#include "runtime/integrate.hpp"
#include "tests/codegen/differential/random_system.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using codegen::count_operations;
using codegen::OperationCount;
using codegen::Prepared;
using codegen::prepared;
using testing::equations;
using testing::exact;
using testing::Points;
using testing::specialised;

SpecialiseOptions keeping_all() {
  SpecialiseOptions options;
  options.fold_parameters = false;
  return options;
}

std::string with_parameters(const std::vector<std::pair<std::string, std::string>>& field) {
  return equations(field,
                   "[parameters]\na = {}\nb = {}\nc = {}\n[[scene]]\nname = \"default\"\n"
                   "parameters = { a = \"3\", b = \"2\", c = \"5\" }");
}

Prepared parted(const Specialisation& spec) {
  return prepared({spec.rhs, spec.jacobian.program}, spec.states.size(), spec.parameters.size());
}

std::vector<cln::cl_RA> slice(const std::vector<cln::cl_RA>& all, std::size_t from,
                              std::size_t to) {
  return {all.begin() + static_cast<std::ptrdiff_t>(from),
          all.begin() + static_cast<std::ptrdiff_t>(to)};
}

/// The rest, at the inputs of the whole.
std::vector<cln::cl_RA> together(const Prepared& parts, const Program& rest,
                                 const Specialisation& spec, std::vector<cln::cl_RA> inputs) {
  const std::size_t n = spec.states.size();
  const std::vector<cln::cl_RA> ready =
      exact(parts.prepare, slice(inputs, n, n + spec.parameters.size()));
  inputs.insert(inputs.end() - 1, ready.begin(), ready.end());
  return exact(rest, inputs);
}

const std::vector<std::pair<std::string, std::string>> kField = {
    {"u", "(a - b)*v*w + u/c - a*b"},
    {"v", "a*w*b - 2*u*w/(b + c)"},
    {"w", "-(a*u*v) + v/(a*v^2 + c^2) + a*(u + v)*c"}};

TEST(Prepare, ThePartsTogetherAreTheWhole) {
  const Specialisation spec = specialised(with_parameters(kField), keeping_all());
  const Prepared parts = parted(spec);
  EXPECT_GE(parts.prepare.outputs.size(), 4U);
  Points points;
  for (int i = 0; i < 20; ++i) {
    std::vector<cln::cl_RA> inputs;
    for (std::size_t k = 0; k < spec.rhs.inputs.size(); ++k) inputs.push_back(points.next());
    EXPECT_EQ(together(parts, parts.rest[0], spec, inputs), exact(spec.rhs, inputs));
    EXPECT_EQ(together(parts, parts.rest[1], spec, inputs), exact(spec.jacobian.program, inputs));
  }
}

int all_of(const OperationCount& count) { return count.mul + count.add + count.div + count.calls; }

TEST(Prepare, NoCallHasMoreToDoAndNoneDividesByParameters) {
  const Specialisation spec = specialised(with_parameters(kField), keeping_all());
  const Prepared parts = parted(spec);
  const OperationCount whole = count_operations(spec.rhs), rest = count_operations(parts.rest[0]);
  EXPECT_LT(all_of(rest), all_of(whole));
  EXPECT_EQ(rest.div, 1);  // by a*v^2 + c^2
  EXPECT_GT(whole.div, 1);
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Specialisation random = specialised(testing::random_case(seed), keeping_all());
    if (random.parameters.empty()) continue;
    const Prepared of_random = parted(random);
    EXPECT_LE(codegen::weight(count_operations(of_random.rest[0])),
              codegen::weight(count_operations(random.rhs)))
        << seed;
  }
}

TEST(Prepare, FunctionsOfParametersAreCalledOnce) {
  const Specialisation spec = specialised(
      with_parameters({{"u", "sin(a)*v + sqrt(b)*u"}, {"v", "u*exp(u*c)"}}), keeping_all());
  const Prepared parts = parted(spec);
  EXPECT_EQ(count_operations(parts.prepare).calls, 2);
  EXPECT_EQ(count_operations(parts.rest[0]).calls, 1);  // the twin: of a state
}

TEST(Prepare, WhereThereIsNothingToPrepareNothingChanges) {
  const Specialisation spec =
      specialised(with_parameters({{"u", "a*v"}, {"v", "-b*u + c"}}), keeping_all());
  EXPECT_TRUE(parted(spec).prepare.outputs.empty());
  const std::string text = emit_module(spec, kernel_source(*find_method("dop853")));
  EXPECT_EQ(text.find("prepare("), std::string::npos);
}

TEST(Prepare, ModulesIntegrateEverySetOfParameters) {
  const Specialisation spec = specialised(with_parameters(kField), keeping_all());
  for (const char* name : {"dop853", "dopri5", "midpoint", "gauss8", "radau5"}) {
    const Method& method = *find_method(name);
    const std::string text = emit_module(spec, kernel_source(method));
    EXPECT_NE(text.find("prepare("), std::string::npos);
    const Module module = Module::load(compile(text).path);
    for (const std::vector<double>& p :
         std::vector<std::vector<double>>{{3, 2, 5}, {1, 0.5, 0.25}, {-1, 2, 3}}) {
      Settings settings;
      settings.duration = 0.5;
      settings.rtol = settings.atol = 1e-9;
      const Trajectory run = integrate(module, method, settings, {0.5, 0.25, 0.125}, p);
      ASSERT_EQ(run.status, Status::ok) << name;
      std::string values = "[parameters]\na = {}\nb = {}\nc = {}\n[[scene]]\nname = \"default\"\n";
      values += "parameters = { a = \"" + std::to_string(p[0]) + "\", b = \"" +
                std::to_string(p[1]) + "\", c = \"" + std::to_string(p[2]) + "\" }";
      const Specialisation folded = specialised(equations(kField, values));
      const Method& other = *find_method("dop853");
      const Module alone = Module::load(compile(emit_module(folded, kernel_source(other))).path);
      const Trajectory truth = integrate(alone, other, settings, {0.5, 0.25, 0.125});
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(run.state[i], truth.state[i], 1e-7) << name << ' ' << i;
      // What others call takes the parameters as ever.
      double with[3], without[3];
      module.functions().rhs(0, run.state.data(), p.data(), with);
      alone.functions().rhs(0, run.state.data(), nullptr, without);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(with[i], without[i], 1e-12);
    }
  }
}

TEST(Prepare, HeadersHaveBothForms) {
  const testing::Folder folder;
  for (const Scalar scalar : {Scalar::real64, Scalar::templated}) {
    const Specialisation spec = specialised(with_parameters(kField), keeping_all());
    testing::write(folder.path() / "t.hpp", emit_header(spec, {.scalar = scalar}));
    const std::string real = scalar == Scalar::templated ? "<double>" : "";
    testing::write(
        folder.path() / "main.cpp",
        "#include \"t.hpp\"\n#include <cmath>\n"
        "int main() {\n  kovalevskaya::parameters" +
            real +
            " p;\n  p.a = 0.7;\n"
            "  const double x[3] = {0.3, -1.1, 2.5};\n  double one[3], two[3], J[9], K[9];\n"
            "  kovalevskaya::rhs(x, p, one);\n"
            "  const auto ready = kovalevskaya::prepare(p);\n"
            "  kovalevskaya::rhs(x, ready, two);\n"
            "  kovalevskaya::jacobian(x, p, J);\n  kovalevskaya::jacobian(x, ready, K);\n"
            "  double worst = 0;\n"
            "  for (int i = 0; i < 3; ++i) worst = std::fmax(worst, std::fabs(one[i] - two[i]));\n"
            "  for (int i = 0; i < 9; ++i) worst = std::fmax(worst, std::fabs(J[i] - K[i]));\n"
            "  const kovalevskaya::prepared_system" +
            real +
            " system{ready};\n"
            "  system(x, two, 0.0);\n"
            "  worst = std::fmax(worst, std::fabs(one[0] - two[0]));\n" +
            (scalar == Scalar::templated
                 ? std::string()
                 : "  kovalevskaya::rhs(x, {}, one);\n  kovalevskaya::rhs(x, {0.7}, two);\n"
                   "  if (one[0] == two[0]) return 2;\n") +
            "  return worst < 1e-13 ? 0 : 1;\n}\n");
    const std::string program = folder.path() / "main";
    const auto compiled = testing::run("c++",
                                       {"-std=c++20", "-Wall", "-Wextra", "-Wshadow", "-Werror",
                                        "-o", program, folder.path() / "main.cpp"},
                                       folder.path());
    ASSERT_TRUE(compiled.succeeded) << compiled.messages;
    EXPECT_TRUE(testing::run(program, {}, folder.path()).succeeded);
  }
}

}  // namespace
}  // namespace casimir

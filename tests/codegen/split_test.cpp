// Hamiltonians that split: the flows of the parts, and the methods made of them.
#include "codegen/split.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "codegen/emit_cpp.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/integrate.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::testing {
namespace {

using Number = cln::cl_F;
using State = std::vector<Number>;

constexpr int kDigits = 60;

Number number(const char* text) {
  return cln::cl_float(cln::cl_R(text), cln::float_format(kDigits));
}

struct Prepared {
  Specialisation spec;
  Splitting splitting;
};

Splitting split_of(const Model& model, const Scene& scene) {
  const Specialisation spec = specialise(model, scene);
  std::string why_not;
  const auto source = scene_hamiltonian(model, scene, spec.states, spec.parameters, why_not);
  if (!source) throw ModelError(why_not);
  return split(*source);
}

Splitting split_of(const std::string& toml) {
  const Model model = model_of(toml);
  return split_of(model, model.scenes.at(0));
}

std::string top(const std::string& hamiltonian, const std::string& algebra = "e(3)") {
  const std::string variables = algebra == "so(3)"
                                    ? "\"M1\", \"M2\", \"M3\""
                                    : "\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"";
  const std::string initial = algebra == "so(3)" ? "M1 = \"1\", M2 = \"1/2\", M3 = \"1/3\""
                                                 : "M1 = \"1\", M2 = \"1/2\", M3 = \"1/3\", g1 = "
                                                   "\"3/5\", g2 = \"0\", g3 = \"4/5\"";
  return "title = \"t\"\nsource = \"s\"\nhamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [" + variables + "]\nalgebra = \"" + algebra +
         "\"\n[[scene]]\nname = \"default\"\ninitial = { " + initial + " }\nduration = \"10\"\n";
}

std::string canonical(const std::string& hamiltonian) {
  return "title = \"t\"\nsource = \"s\"\nhamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n"
         "[[scene]]\nname = \"default\"\ninitial = { q1 = \"1/5\", q2 = \"1/7\", p1 = \"1/3\", p2 "
         "= "
         "\"-1/4\" }\nduration = \"10\"\n";
}

State moved(const Program& flow, const State& x, const Number& t) {
  State inputs = x;
  inputs.push_back(t);
  const State added = evaluate(flow, inputs, Arithmetic<Number>(kDigits));
  State y = x;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] + added[i];
  return y;
}

double distance(const State& a, const State& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(cln::double_approx(a[i] - b[i])));
  return largest;
}

/// That a map is a flow, by phi(s + t) = phi(s) phi(t); and that the flows' fields add up to the
/// right-hand side. Both together make each the flow of a part.
void check_flows(const Specialisation& spec, const Splitting& splitting) {
  State x;
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    x.push_back(number("0.7") / (2 + static_cast<int>(i)) + number("0.31"));
  const Number small = number("1e-25"), a = number("0.3"), b = number("0.45");
  State sum(x.size(), number("0"));
  for (const Program& flow : splitting.flows) {
    EXPECT_LT(distance(moved(flow, moved(flow, x, a), b), moved(flow, x, a + b)), 1e-40);
    EXPECT_LT(distance(moved(flow, moved(flow, x, a), -a), x), 1e-40);
    const State up = moved(flow, x, small), down = moved(flow, x, -small);
    for (std::size_t i = 0; i < x.size(); ++i) sum[i] = sum[i] + (up[i] - down[i]) / (2 * small);
  }
  State inputs = x;
  inputs.push_back(number("0"));
  EXPECT_LT(distance(sum, evaluate(spec.rhs, inputs, Arithmetic<Number>(kDigits))), 1e-20);
}

TEST(Split, PartsOfATopAreRotationsAndAPotential) {
  const Splitting splitting = split_of(kKovalevskaya);
  EXPECT_EQ(std::set(splitting.parts.begin(), splitting.parts.end()),
            (std::set<std::string>{"M1^2/2", "M2^2/2", "M3^2", "-g1"}));
}

TEST(EveryCase, ThatSplitsHasTheFlowsOfItsParts) {
  int split_cases = 0;
  for (const auto& path : test::cases_to_go_through()) {
    SCOPED_TRACE(path.filename());
    const Model model = build_model(read_case(path));
    if (model.scenes.empty()) continue;
    const Scene* scene = nullptr;
    for (const Scene& one : model.scenes)
      if (one.observe.empty() && one.unusable.empty()) scene = &one;
    if (!scene) continue;
    std::optional<Splitting> splitting;
    try {
      splitting = split_of(model, *scene);
    } catch (const ModelError&) {
      continue;
    }
    ++split_cases;
    check_flows(specialise(model, *scene), *splitting);
  }
  EXPECT_GE(split_cases, test::wants_every_case() ? 30 : 6);
}

TEST(Split, SystemsOfEveryKindSplit) {
  for (const std::string& toml :
       {top("M1^2/2 + M2^2/3 + M3^2/5", "so(3)"), top("M1*M2 + M2*M3 + M3^2/5 + M1/3", "so(3)"),
        top("M1^4 + sin(M2) + M3", "so(3)"), top("(M1^2 + M2^2 + 2*M3^2)/2 + g1*g2 + g3^3 + M3/2"),
        top("M1^2 + M2^2/2 + M3^2/3 + M1*g1/2 - M2*g2 + M3*g3/5 + g1^2"),  // screws
        top("M1^2 + M2^2/2 + M3^2/3", "so(4)"), top("M1*g1 + M2*g2 + g1^2 + g3^2/2", "so(4)"),
        top("M1^2 + g1^2/3 + g2", "so(3,1)"), canonical("(p1^2 + p2^2)/2 + q1^2*q2 + cos(q1)"),
        canonical("(p1^2 + p2^2)/2 - (q1*p2 - q2*p1)/3 + 1/(2 + q1^2)"),
        canonical("(p1^2 + p2^2)/2 - (q1^2 + q2^2)/2"), canonical("q1*p1 + q1*p2/3 + 2*q2*p2 + p1"),
        canonical("q1*p1 + p2^2/2 - cos(q2)")}) {
    SCOPED_TRACE(toml);
    const Model model = model_of(toml);
    check_flows(specialise(model, model.scenes[0]), split_of(model, model.scenes[0]));
  }
}

TEST(Split, WhatDoesNotSplitIsNamed) {
  const auto refusal = [](const std::string& toml) {
    try {
      split_of(toml);
    } catch (const ModelError& problem) {
      return std::string(problem.what());
    }
    return std::string("it splits");
  };
  EXPECT_NE(refusal(top("M1^2 + M2^2*g1")).find("the flow of M2^2*g1"), std::string::npos);
  EXPECT_NE(refusal(canonical("p1^2*q1^2 + p2^2")).find("q1^2*p1^2"), std::string::npos);
  // Neither a rotation nor a boost.
  EXPECT_NE(refusal(top("M1^2 + M2*g2", "so(3,1)")).find("(M2 + g2)^2"), std::string::npos);
  EXPECT_NE(refusal(equations({{"x", "y"}, {"y", "-x"}})).find("no Hamiltonian"),
            std::string::npos);
}

Module compiled(const Model& model, const Method& method) {
  const Splitting splitting = split_of(model, model.scenes[0]);
  const Specialisation spec = specialise(model, model.scenes[0]);
  return Module::load(
      compile(emit_module(spec, kernel_source(method), {.splitting = splitting})).path);
}

double error_at(const Module& module, const Method& method, double step,
                const std::vector<double>& from, const std::vector<double>& end) {
  Settings settings;
  settings.duration = 3;
  settings.fixed_step = step;
  const Trajectory orbit = integrate(module, method, settings, from);
  EXPECT_EQ(orbit.status, Status::ok) << orbit.reason;
  double error = 0;
  for (std::size_t i = 0; i < end.size(); ++i)
    error = std::max(error, std::abs(orbit.state[i] - end[i]));
  return error;
}

const std::vector<double> kFrom{1, 0.5, 1. / 3, 0.6, 0, 0.8};

TEST(Splitting, HasTheOrderOfItsName) {
  const Model model = model_of(top("M1^2/2 + M2^2/3 + M3^2/5 + M1*g1/4 + g3 + g1*g2/3"));
  for (const auto& [name, order, step] :
       {std::tuple{"splitting6", 6, 0.25}, {"splitting", 8, 0.375}}) {
    const Method& method = *find_method(name);
    const Module module = compiled(model, method);
    Settings exact;
    exact.duration = 3;
    exact.rtol = exact.atol = 1e-14;
    const std::vector<double> end = integrate(module, method, exact, kFrom).state;
    const double coarse = error_at(module, method, step, kFrom, end);
    const double fine = error_at(module, method, step / 2, kFrom, end);
    const double measured = std::log2(coarse / fine);
    EXPECT_GT(measured, order - 0.7) << name << ' ' << coarse << ' ' << fine;
    EXPECT_LT(measured, order + 1.5) << name;
    EXPECT_LT(fine, 1e-5) << name;
    EXPECT_GT(fine, 1e-12) << name << ": rounding hides the order";
  }
}

TEST(Splitting, AgreesWithAnotherMethodAtEveryTolerance) {
  const Model model = model_of(kKovalevskaya);
  const Method& method = *find_method("splitting");
  const Module module = compiled(model, method);
  const Method& other = *find_method("dop853");
  Specialisation spec = specialise(model, model.scenes[0]);
  const Module another = Module::load(compile(emit_module(spec, kernel_source(other))).path);
  Settings settings;
  settings.duration = 20;
  settings.rtol = settings.atol = 1e-14;
  const std::vector<double> end = integrate(another, other, settings, kFrom).state;
  for (const double tolerance : {1e-4, 1e-7, 1e-10, 1e-13}) {
    settings.rtol = settings.atol = tolerance;
    settings.sample_every = 0.37;
    const Trajectory orbit = integrate(module, method, settings, kFrom);
    ASSERT_EQ(orbit.status, Status::ok);
    for (std::size_t i = 0; i < end.size(); ++i)
      EXPECT_NEAR(orbit.state[i], end[i], 1000 * tolerance) << tolerance;
    ASSERT_EQ(orbit.samples.size(), 56u);  // the dense output is on the sphere too
    for (const auto& x : orbit.samples)
      EXPECT_NEAR(x[3] * x[3] + x[4] * x[4] + x[5] * x[5], 1, 1e-14);
  }
}

// The point of it: at a coarse step, for long, Casimirs to rounding and a bounded error of H.
TEST(Splitting, KeepsCasimirsToRoundingAndBoundsTheEnergyError) {
  const Model model = model_of(kKovalevskaya);
  const Method& method = *find_method("splitting");
  const Module module = compiled(model, method);
  Settings settings;
  settings.fixed_step = 0.5;
  std::vector<double> energy;
  for (const double duration : {500., 50000.}) {
    settings.duration = duration;
    const Trajectory orbit = integrate(module, method, settings, kFrom);
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    energy.push_back(orbit.invariants[0].drift);
    EXPECT_LT(orbit.invariants[1].drift, 1e-13);  // F1
    EXPECT_LT(orbit.invariants[2].drift, 1e-13);  // F2
  }
  EXPECT_GT(energy[0], 1e-9);  // coarse indeed
  EXPECT_LT(energy[1], 3 * energy[0]);
  // The twin: at the same error of the energy in the beginning another method loses it.
  const Method& other = *find_method("dop853");
  Specialisation spec = specialise(model, model.scenes[0]);
  const Module another = Module::load(compile(emit_module(spec, kernel_source(other))).path);
  std::vector<double> lost;
  for (const double duration : {500., 50000.}) {
    settings.duration = duration;
    lost.push_back(integrate(another, other, settings, kFrom).invariants[0].drift);
  }
  EXPECT_GT(lost[1], 20 * lost[0]);
}

}  // namespace
}  // namespace casimir::testing

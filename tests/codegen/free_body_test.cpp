// The moments of inertia that the map of Moser and Veselov asks for, and its kernel.
#include "codegen/free_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "codegen/emit_cpp.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/integrate.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::testing {
namespace {

using Triple = std::vector<double>;

constexpr const char* kSo3 = "variables = [\"M1\", \"M2\", \"M3\"]\nalgebra = \"so(3)\"";

std::string body_case(const std::string& hamiltonian, const std::string& space = kSo3) {
  return "title = \"t\"\nsource = \"s\"\nhamiltonian = \"" + hamiltonian +
         "\"\n[parameters]\na = {}\n[phase_space]\n" + space +
         "\n[[scene]]\nname = \"default\"\nparameters = { a = \"3\" }\n"
         "initial = { M1 = \"1\", M2 = \"1/2\", M3 = \"1/3\"" +
         (space.find("g1") == std::string::npos ? "" : ", g1 = \"1\"") + " }\nduration = \"10\"\n";
}

std::string bracket_text(const std::string& k1, const std::string& k2, const std::string& k3) {
  return "variables = [\"M1\", \"M2\", \"M3\"]\nbrackets = { \"M1,M2\" = \"" + k3 +
         "*M3\", \"M2,M3\" = \"" + k1 + "*M1\", \"M3,M1\" = \"" + k2 + "*M2\" }";
}

Program moments_of(const Model& model) {
  const Specialisation spec = specialise(model, model.scenes.at(0));
  std::string why_not;
  const auto source =
      scene_hamiltonian(model, model.scenes[0], spec.states, spec.parameters, why_not);
  if (!source) throw ModelError(why_not);
  return free_body_moments(*source);
}

Triple values_of(const std::string& toml) {
  return evaluate(moments_of(model_of(toml)), Triple{7, 8, 9, 10}, Arithmetic<double>());
}

TEST(FreeBody, MomentsAreThoseOfTheHamiltonian) {
  EXPECT_EQ(values_of(body_case("M1^2/2 + M2^2/4 + a*M3^2/24")), (Triple{1, 2, 4, 1}));
  // The map is another one for another energy with the same equations.
  EXPECT_EQ(values_of(body_case("M1^2/2 + M2^2/4 + a*M3^2/24 + (M1^2 + M2^2 + M3^2)/2 + 5")),
            (Triple{1. / 2, 2. / 3, 4. / 5, 1}));
  EXPECT_EQ(values_of(body_case("M1^2/2 + M2^2/4 + M3^2/8", bracket_text("-2", "-2", "-2"))),
            (Triple{1, 2, 4, 2}));
}

TEST(FreeBody, WhatIsNoneIsRefused) {
  const auto refusal = [](const std::string& hamiltonian, const std::string& space = kSo3) {
    try {
      moments_of(model_of(body_case(hamiltonian, space)));
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string("a free body");
  };
  const auto expect = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(refusal("M1^2 + M2^2 + M3^2 + M1*M2"), "no sum of squares in M1");
  expect(refusal("M1^2 + M2^2 + M3^2 + M3"), "no sum of squares in M3");
  expect(refusal("M1^2 + M2^4 + M3^2"), "no sum of squares in M2");
  expect(refusal("M1^2 + M2^2 + (a - 3)*M3^2"), "the coefficient of M3^2 is 0");
  expect(refusal("M1^2 + M2^2 + 2*M3^2", bracket_text("1", "1", "2")),
         "bracket is not that of so(3)");
  expect(refusal("M1^2 + M2^2 + 2*M3^2", bracket_text("1", "1", "-1")),
         "bracket is not that of so(3)");
  expect(refusal("M1^2 + M2^2 + M3^2 + g1^2",
                 "variables = [\"M1\", \"M2\", \"M3\", \"g1\"]\nbrackets = { \"M1,M2\" = \"M3\", "
                 "\"M2,M3\" = \"M1\", \"M3,M1\" = \"M2\" }"),
         "4 variables");
}

Trajectory run_of(const std::string& toml, double step, double duration, const Triple& from) {
  const Model model = model_of(toml);
  const Method& method = *find_method("moser-veselov");
  const Specialisation spec = specialise(model, model.scenes[0]);
  static std::map<std::string, Module> modules;
  auto found = modules.find(toml);
  if (found == modules.end()) {
    const std::string text =
        emit_module(spec, kernel_source(method), {.moments = moments_of(model)});
    found = modules.emplace(toml, Module::load(compile(text).path)).first;
  }
  Settings settings;
  settings.duration = duration;
  settings.fixed_step = step;
  return integrate(found->second, method, settings, from);
}

double largest_gap(const Triple& a, const Triple& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

const std::string kBody = body_case("M1^2/2 + M2^2/4 + M3^2/8");
const Triple kBodyStart{1, 0.5, 1. / 3};

// The equation that defines the map, m h = R^T J - J R with a rotation R, written out by matrices.
TEST(MoserVeselov, IsTheMapOfItsDefinition) {
  const double h = 0.5, inertia[3] = {1, 2, 4};
  const Triple next = run_of(kBody, h, h, kBodyStart).state;
  // Of m and m1 = R m the sum and the difference are (4/h) s I q and -(4/h) q x I q, s^2 = 1 - q^2.
  // So I q is parallel to the sum, and its length follows from the difference.
  Triple along, axis;
  for (int i = 0; i < 3; ++i) {
    along.push_back(kBodyStart[static_cast<std::size_t>(i)] + next[static_cast<std::size_t>(i)]);
    axis.push_back(along.back() / inertia[i]);
  }
  const double axis2 = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  // q = f axis with 1 = (4/h) sqrt(1 - f^2 axis2) f.
  const double u = (1 - std::sqrt(1 - axis2 * h * h / 4)) / (2 * axis2);
  const double f = std::sqrt(u);
  const Triple turned{axis[1] * along[2] - axis[2] * along[1],
                      axis[2] * along[0] - axis[0] * along[2],
                      axis[0] * along[1] - axis[1] * along[0]};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(next[i] - kBodyStart[i], -4 / h * f * f * turned[i], 1e-15) << i;
  EXPECT_GT(largest_gap(next, kBodyStart), 0.05);
}

TEST(MoserVeselov, HasOrderTwoAndReturns) {
  const Triple end = run_of(kBody, 1e-4, 2, kBodyStart).state;
  const double coarse = largest_gap(run_of(kBody, 0.1, 2, kBodyStart).state, end);
  const double fine = largest_gap(run_of(kBody, 0.05, 2, kBodyStart).state, end);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
  const Triple there = run_of(kBody, 0.4, 40, kBodyStart).state;
  EXPECT_LT(largest_gap(run_of(kBody, 0.4, -40, there).state, kBodyStart), 1e-12);
  EXPECT_GT(largest_gap(there, kBodyStart), 0.1);
}

// Another factor of the bracket is another unit of time.
TEST(MoserVeselov, FollowsTheSignOfTheBracket) {
  const std::string turned = body_case("M1^2/2 + M2^2/4 + M3^2/8", bracket_text("2", "2", "2"));
  const Triple forward = run_of(turned, 0.2, 2, kBodyStart).state;
  EXPECT_LT(largest_gap(forward, run_of(kBody, 0.4, -4, kBodyStart).state), 1e-14);
}

TEST(MoserVeselov, KeepsIntegralsForEver) {
  const Trajectory orbit = run_of(kBody, 0.4, 40000, kBodyStart);
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  for (const auto& invariant : orbit.invariants) EXPECT_LT(invariant.drift, 1e-13);
  ASSERT_FALSE(orbit.invariants.empty());
}

TEST(MoserVeselov, OfTooLongAStepThereIsNoRotation) {
  EXPECT_EQ(run_of(kBody, 50, 100, kBodyStart).status, Status::no_convergence);
}

}  // namespace
}  // namespace casimir::testing

// Places from which more than one solution goes on.
#include "tools/analysis/estimate/parting_solutions.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/solve.hpp"

namespace casimir::test {
namespace {

Solution solved(const Model& model, const char* method, double tolerance) {
  SolveOptions options;
  options.method = method;
  if (tolerance > 0) options.run.tolerance = tolerance;
  return solve(model, model.scene("default"), options);
}

// x = (1 - t/2)^2 comes to 0 at t = 2, and may stay, or go on as -(t - c)^2/4 from any c >= 2.
TEST(PartingSolutions, AreNotAnsweredWithOneOfThem) {
  for (const char* const rate : {"-sqrt(abs(x))", "-sqrt(sqrt(x^2))"}) {
    const Model model = one_equation(rate, "3");
    for (const auto& [method, tolerance] :
         {std::pair{"auto", 0.}, {"radau9", 1e-10}, {"gauss8", 1e-8}, {"dop853", 1e-8}}) {
      const Solution motion = solved(model, method, tolerance);
      EXPECT_TRUE(!motion.ok() || motion.trust().error_estimate >= 1) << rate << ' ' << method;
      if (motion.ok() && motion.trust().one_of_several)
        EXPECT_NEAR(*motion.trust().one_of_several, 2, 1e-2) << method;
    }
  }
}

// The twins: a motion that crosses the place has the argument for its time, and one that ends
// before it does not come there.
TEST(PartingSolutions, NeedAPlaceThatIsNotCrossed) {
  const Model crossed = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"-1\"\n"
      "y = \"sqrt(abs(x))\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"1\", y = \"0\" }\nduration = \"2\"\n");
  for (const char* const method : {"auto", "radau9", "dop853"}) {
    const Solution motion = solved(crossed, method, 1e-10);
    ASSERT_TRUE(motion.ok()) << method;
    EXPECT_FALSE(motion.trust().one_of_several) << method;
    EXPECT_NEAR(motion.trajectory().state[1], 4. / 3, 1e-6) << method;
  }
  // Drag: the fall from 1000 is a million times as fast as the passage through 0, which is crossed.
  const Solution drag = solved(one_equation("-1 - 1000*x*sqrt(1000*abs(x))/1000", "10"), "auto", 0);
  ASSERT_TRUE(drag.ok());
  EXPECT_FALSE(drag.trust().one_of_several);
  // What rests at 0, or comes there by rounding, as fast as it is far from it.
  for (const auto& [z, rate, method] : {std::tuple{"0", "-z", "auto"},
                                        {"1", "-1000000*z", "cvode-bdf"},
                                        {"1", "-z*sqrt(abs(z))", "auto"}}) {
    const Model rest = model_of(
        "[phase_space]\nvariables = [\"y\", \"z\"]\n[equations]\n"
        "y = \"-y + sqrt(abs(z))\"\nz = \"" +
        std::string(rate) + "\"\n[[scene]]\nname = \"default\"\ninitial = { y = \"1\", z = \"" + z +
        "\" }\nduration = \"3\"\n");
    const Solution motion = solved(rest, method, method == std::string("auto") ? 0 : 1e-10);
    EXPECT_FALSE(motion.trust().one_of_several) << rate;
  }
  const Solution slow = solved(one_equation("-x*sqrt(abs(x))", "10^6"), "auto", 1e-10);
  ASSERT_TRUE(slow.ok());
  EXPECT_FALSE(slow.trust().one_of_several);
  const Solution before = solved(one_equation("-sqrt(abs(x))", "3/2"), "auto", 0);
  ASSERT_TRUE(before.ok());
  EXPECT_FALSE(before.trust().one_of_several);
  EXPECT_NEAR(before.trajectory().state[0], 1. / 16, 1e-12);
}

// x = t^2/4 leaves x = 0, too; x = 0 is the only motion of -sqrt(x), of x' = 0 beside it, and of a
// root that is crossed.
TEST(PartingSolutions, MayPartAtTheStart) {
  EXPECT_TRUE(solved(driven_equation("sqrt(x)"), "auto", 0).trust().one_of_several);
  EXPECT_TRUE(solved(driven_equation("x^(1/3)"), "auto", 0).trust().one_of_several);
  EXPECT_FALSE(solved(driven_equation("-sqrt(x)"), "auto", 0).trust().one_of_several);
  EXPECT_FALSE(solved(driven_equation("x"), "auto", 0).trust().one_of_several);
  const auto pair = [](const char* x, const char* y) {
    return model_of(std::string("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"") +
                    x + "\"\ny = \"" + y +
                    "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"0\", y = \"0\" }\n"
                    "duration = \"2\"\n");
  };
  EXPECT_TRUE(solved(pair("y", "sqrt(x)"), "auto", 0).trust().one_of_several);
  EXPECT_FALSE(solved(pair("0*x", "sqrt(x)"), "auto", 0).trust().one_of_several);
  EXPECT_FALSE(solved(pair("1", "sqrt(x)"), "auto", 0).trust().one_of_several);
}

}  // namespace
}  // namespace casimir::test

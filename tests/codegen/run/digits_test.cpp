// Every bundled case that is polynomial, in 50 and in 200 digits: what is generated from a case
// file is exact, whatever arithmetic reads it.
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/evaluate.hpp"
#include "runtime/precise_run.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::testing {
namespace {

bool polynomial(const Program& program) {
  return std::ranges::all_of(program.code, [](const Instruction& line) {
    return line.op == Op::input || line.op == Op::constant || line.op == Op::pi ||
           line.op == Op::add || line.op == Op::sub || line.op == Op::mul || line.op == Op::neg;
  });
}

TEST(EveryCase, ThatIsPolynomialHasTheSameMotionInFiftyAndTwoHundredDigits) {
  int cases = 0;
  for (const auto& path : test::cases_to_go_through()) {
    SCOPED_TRACE(path.stem().string());
    const Model model = build_model(read_case(path));
    for (const Scene& scene : model.scenes) {
      SpecialiseOptions what;
      what.jacobian = false;
      const Specialisation s = specialise(model, scene, what);
      if (!polynomial(s.rhs)) break;
      PreciseProblem problem;
      problem.rhs = &s.rhs;
      problem.start = [&](int digits) {
        const auto values = evaluate(s.start, {}, Arithmetic<cln::cl_F>(digits));
        return std::vector<cln::cl_R>(values.begin(), values.end());
      };
      problem.end = cln::cl_RA("1/8");
      const PreciseRun few = precise_run(problem, 50), many = precise_run(problem, 200);
      ASSERT_EQ(few.status, Status::ok) << few.reason;
      ASSERT_EQ(many.status, Status::ok) << many.reason;
      cln::cl_F size = cln::abs(many.state[0]);
      for (const cln::cl_F& x : many.state) size = cln::max(size, cln::abs(x));
      const cln::cl_F least = size * cln::cl_float(cln::expt(cln::cl_RA(10), -50), size);
      for (std::size_t i = 0; i < many.state.size(); ++i)
        EXPECT_LT(cln::abs(few.state[i] - many.state[i]), least) << s.states[i];
      ++cases;
      break;
    }
  }
  EXPECT_GT(cases, test::wants_every_case() ? 50 : 10);
}

}  // namespace
}  // namespace casimir::testing

// The header in the hands of its users: Boost.Odeint and CVODE, compiled as they would.
#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

#include "codegen/emit_cpp.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using testing::Folder;
using testing::kKovalevskaya;
using testing::specialised;

/// Three headers, each in a namespace of its own: Boost's are long to compile.
const char* const kOdeint = R"(
#include "top.hpp"
#include "bent.hpp"
#include "general.hpp"
#include <boost/numeric/odeint.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>
using namespace boost::numeric::odeint;

double largest(const double* before, const double* after) {
  double drift = 0;
  for (int i = 0; i < 4; ++i) {
    const double d = std::fabs(after[i] - before[i]);
    if (!(d <= drift)) drift = d;
  }
  return drift;
}

template <class System>
double drift_of(System system, void (*invariants)(const double*, double*)) {
  std::vector<double> x(kovalevskaya::initial_state, kovalevskaya::initial_state + kovalevskaya::dimension);
  double before[4], after[4];
  invariants(x.data(), before);
  integrate_adaptive(make_controlled(1e-12, 1e-12, runge_kutta_fehlberg78<std::vector<double>>()),
                     system, x, 0.0, kovalevskaya::duration, 0.01);
  invariants(x.data(), after);
  return largest(before, after);
}

double drift_with_parameters() {
  std::array<double, 6> x{1, 0.5, 0.25, 0.6, 0, 0.8};
  general::system top;
  top.p.r = 3;
  double before[4], after[4];
  general::invariants(x.data(), top.p, before);
  integrate_adaptive(make_controlled(1e-12, 1e-12, runge_kutta_fehlberg78<std::array<double, 6>>()), top, x, 0.0,
                     10.0, 0.01);
  general::invariants(x.data(), top.p, after);
  return largest(before, after);
}

int main() {
  const auto invariants = [](const double* x, double* f) { kovalevskaya::invariants(x, f); };
  std::printf("%.17g %.17g %.17g\n", drift_of(kovalevskaya::system{}, invariants),
              drift_of(bent::system{}, invariants), drift_with_parameters());
}
)";

const char* const kStiff = R"(
#include "top.hpp"
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <utility>
int main() {
  using namespace boost::numeric::odeint;
  boost::numeric::ublas::vector<double> x(6);
  for (int i = 0; i < 6; ++i) x[i] = kovalevskaya::initial_state[i];
  double before[4], after[4];
  kovalevskaya::invariants(&x[0], before);
  integrate_adaptive(make_dense_output<rosenbrock4<double>>(1e-10, 1e-10),
                     std::make_pair(kovalevskaya::system{}, kovalevskaya::stiff_system{}), x, 0.0, 5.0, 0.01);
  kovalevskaya::invariants(&x[0], after);
  double drift = 0;
  for (int i = 0; i < 4; ++i) {
    const double d = std::fabs(after[i] - before[i]);
    if (!(d <= drift)) drift = d;
  }
  std::printf("%.17g\n", drift);
}
)";

const char* const kCvode = R"(
#include "top.hpp"
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <cmath>
#include <cstdio>
int main() {
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  N_Vector y = N_VNew_Serial(kovalevskaya::dimension, context);
  for (int i = 0; i < kovalevskaya::dimension; ++i) NV_Ith_S(y, i) = kovalevskaya::initial_state[i];
  double before[4], after[4];
  kovalevskaya::invariants(N_VGetArrayPointer(y), before);
  void* memory = CVodeCreate(CV_BDF, context);
  CVodeInit(memory, kovalevskaya::sundials_rhs<N_Vector>, 0, y);
  CVodeSStolerances(memory, 1e-11, 1e-11);
  CVodeSetMaxNumSteps(memory, 1000000);
  SUNMatrix matrix = SUNDenseMatrix(kovalevskaya::dimension, kovalevskaya::dimension, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  CVodeSetLinearSolver(memory, solver, matrix);
  CVodeSetJacFn(memory, kovalevskaya::sundials_jacobian<N_Vector, SUNMatrix>);
  double t = 0;
  if (CVode(memory, 10.0, y, &t, CV_NORMAL) < 0) return 1;
  kovalevskaya::invariants(N_VGetArrayPointer(y), after);
  double drift = 0;
  for (int i = 0; i < 4; ++i) {
    const double d = std::fabs(after[i] - before[i]);
    if (!(d <= drift)) drift = d;
  }
  std::printf("%.17g\n", drift);
}
)";

const char* const kWide = R"(
#include "top.hpp"
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdio>
int main() {
  using Real = boost::multiprecision::cpp_bin_float_50;
  Real x[6] = {1, Real(1) / 2, Real(1) / 3, Real(3) / 5, 0, Real(4) / 5};
  Real invariants[4];
  kovalevskaya::invariants(x, invariants);
  const Real exact = (1 + Real(1) / 4 + Real(2) / 9) / 2 - Real(3) / 5;
  std::printf("%.17g\n", static_cast<double>(abs(invariants[0] - exact)));
}
)";

using Headers = std::vector<std::pair<std::string, std::string>>;  // names and texts

/// Compiles a user's program with the headers beside it, runs it, and reads the numbers it prints.
std::vector<double> printed_by(const std::string& user, const Headers& headers,
                               const std::vector<std::string>& libraries = {},
                               const std::string& standard = "-std=c++20") {
  const Folder folder;
  for (const auto& [name, text] : headers) testing::write(folder.path() / name, text);
  testing::write(folder.path() / "user.cpp", user);
  std::vector<std::string> arguments{standard, "-O0",
                                     "-w",     (folder.path() / "user.cpp").string(),
                                     "-o",     (folder.path() / "user").string()};
  if (const std::string boost = CASIMIR_BOOST_INCLUDE; !boost.empty() && boost != "/usr/include") {
    arguments.push_back("-I" + boost);
  }
  arguments.insert(arguments.end(), libraries.begin(), libraries.end());
  const codegen::CompilerRun built = testing::run("", arguments, folder.path());
  EXPECT_TRUE(built.succeeded) << built.messages;
  if (!built.succeeded) return {};
  const codegen::CompilerRun done =
      testing::run((folder.path() / "user").string(), {}, folder.path());
  EXPECT_TRUE(done.succeeded) << done.messages;
  std::istringstream numbers(done.messages);
  return {std::istream_iterator<double>(numbers), {}};
}

/// The one number that a program with one header prints.
double drift_of(const std::string& header, const std::string& user,
                const std::vector<std::string>& libraries = {},
                const std::string& standard = "-std=c++20") {
  const std::vector<double> printed = printed_by(user, {{"top.hpp", header}}, libraries, standard);
  return printed.size() == 1 ? printed[0] : 1e300;
}

/// The header of a case of that name.
std::string named(std::string header, const std::string& name) {
  for (const char* old : {"kovalevskaya", "KOVALEVSKAYA"})
    for (std::size_t at = 0; (at = header.find(old, at)) != std::string::npos; at += name.size())
      header.replace(at, std::string(old).size(), name);
  return header;
}

TEST(Integrators, OdeintConservesTheIntegralsAlsoWithParametersAndSeesABentEquation) {
  const std::string header = emit_header(specialised(kKovalevskaya));
  const std::string was = "g2 * t1 - M2 * g3";
  std::string bent = named(header, "bent");
  ASSERT_NE(bent.find(was), std::string::npos);
  bent.replace(bent.find(was), 2, "1.001 * g2");
  SpecialiseOptions options;
  options.fold_parameters = false;
  const std::string general = named(emit_header(specialised(kKovalevskaya, options)), "general");
  const std::vector<double> drifts =
      printed_by(kOdeint, {{"top.hpp", header}, {"bent.hpp", bent}, {"general.hpp", general}});
  ASSERT_EQ(drifts.size(), 3U);
  EXPECT_LT(drifts[0], 1e-9);
  EXPECT_GT(drifts[1], 1e-3);
  EXPECT_LT(drifts[2], 1e-9);
}

TEST(Integrators, OdeintStiffStepperUsesTheJacobian) {
  const std::string header = emit_header(specialised(kKovalevskaya));
  // Boost 1.74's ublas is no C++20.
  EXPECT_LT(drift_of(header, kStiff, {}, "-std=c++17"), 1e-7);
}

TEST(Integrators, CvodeConservesTheIntegrals) {
  const std::vector<std::string> libraries{"-lsundials_cvode", "-lsundials_nvecserial",
                                           "-lsundials_sunmatrixdense", "-lsundials_sunlinsoldense",
                                           "-lm"};
  EXPECT_LT(drift_of(emit_header(specialised(kKovalevskaya)), kCvode, libraries), 1e-7);
}

TEST(Integrators, TemplatesTakeFiftyDigits) {
  EXPECT_LT(drift_of(emit_header(specialised(kKovalevskaya), {Scalar::templated}), kWide), 1e-48);
}

}  // namespace
}  // namespace casimir

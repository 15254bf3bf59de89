// The header in the hands of those who write C.
#include <gtest/gtest.h>

#include <cstdlib>

#include "codegen/emit_cpp.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using testing::equations;
using testing::Folder;
using testing::kKovalevskaya;
using testing::specialised;

const std::vector<std::string> kC99{"-std=c99", "-Wall",        "-Wextra", "-Wpedantic",
                                    "-Werror",  "-Wconversion", "-Wshadow"};

SpecialiseOptions everything(bool fold) {
  SpecialiseOptions options;
  options.fold_parameters = fold;
  options.gradients = options.variational = true;
  return options;
}

std::string c_header(const Specialisation& spec, Scalar scalar = Scalar::real64) {
  return emit_header(spec, {.scalar = scalar, .sparse_jacobian = true, .language = Language::c});
}

/// What a C compiler says to a program with the header, and what the program prints.
codegen::CompilerRun c_program(const std::string& header, const std::string& program,
                               const std::vector<std::string>& libraries = {"-lm"}) {
  const Folder folder;
  testing::write(folder.path() / "top.h", header);
  testing::write(folder.path() / "user.c", "#include \"top.h\"\n" + program);
  const std::string user = (folder.path() / "user").string();
  std::vector<std::string> arguments = kC99;
  for (const std::string& last : {user + ".c", std::string("-o"), user}) arguments.push_back(last);
  arguments.insert(arguments.end(), libraries.begin(), libraries.end());
  codegen::CompilerRun run = testing::run("cc", arguments, folder.path());
  if (run.succeeded) run = testing::run(user, {}, folder.path());
  return run;
}

/// A run by the classical method of Runge, and the drift of the invariants along it; in front of
/// that everything else in the header against differences. Prints the largest of these defects.
const char* const kUser = R"(
#include <math.h>
#include <stdio.h>
#include <string.h>

static double largest = 0;

static void expect_near(double value, double expected) {
  const double defect = fabs(value - expected);
  if (!(defect <= largest)) largest = defect;
}

enum { n = kovalevskaya_dimension, m = kovalevskaya_invariant_count };
static const double h = 1e-4;

static void shifted(const double* x, double step, const double* direction, double* result) {
  for (int i = 0; i < n; ++i) result[i] = x[i] + step * direction[i];
}

static void check_derivatives(const double* x, const kovalevskaya_parameters* p) {
  double J[n * n], entries[kovalevskaya_jacobian_nonzeros], gradients[n * m];
  kovalevskaya_jacobian(x, p, J);
  kovalevskaya_jacobian_entries(x, p, entries);
  kovalevskaya_gradients(x, p, gradients);
  for (int j = 0; j < n; ++j) {
    double unit[n] = {0}, left[n], right[n], below[n], above[n], low[m], high[m], dx[n], ddx[n];
    unit[j] = 1;
    shifted(x, -h, unit, left);
    shifted(x, h, unit, right);
    kovalevskaya_rhs(left, p, below);
    kovalevskaya_rhs(right, p, above);
    kovalevskaya_variational(x, unit, p, dx, ddx);
    kovalevskaya_invariants(left, p, low);
    kovalevskaya_invariants(right, p, high);
    for (int i = 0; i < n; ++i) {
      expect_near(J[i + n * j], (above[i] - below[i]) / (2 * h));
      expect_near(J[i + n * j], ddx[i]);
    }
    for (int k = kovalevskaya_jacobian_columns[j]; k < kovalevskaya_jacobian_columns[j + 1]; ++k)
      expect_near(entries[k], J[kovalevskaya_jacobian_rows[k] + n * j]);
    for (int k = 0; k < m; ++k) expect_near(gradients[j + n * k], (high[k] - low[k]) / (2 * h));
  }
}

int main(void) {
  kovalevskaya_parameters p = kovalevskaya_default_parameters;
  double x[n], before[m], after[m], k1[n], k2[n], k3[n], k4[n], at[n];
  if (strcmp(kovalevskaya_state_names[3], "g1") != 0) return 1;
  if (strcmp(kovalevskaya_invariant_names[m - 1], "K") != 0) return 1;
  if (kovalevskaya_duration != 100 || p.r != 1) return 1;
  p.r = 3;
  memcpy(x, kovalevskaya_initial_state, sizeof x);
  check_derivatives(x, &p);
  kovalevskaya_invariants(x, &p, before);
  for (int step = 0; step < 10000; ++step) {
    const double dt = 1e-3;
    kovalevskaya_rhs(x, &p, k1);
    shifted(x, dt / 2, k1, at);
    kovalevskaya_rhs(at, &p, k2);
    shifted(x, dt / 2, k2, at);
    kovalevskaya_rhs(at, &p, k3);
    shifted(x, dt, k3, at);
    kovalevskaya_rhs(at, &p, k4);
    for (int i = 0; i < n; ++i) x[i] += dt / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  kovalevskaya_invariants(x, &p, after);
  for (int k = 0; k < m; ++k) expect_near(after[k], before[k]);
  printf("%.17g\n", largest);
  return 0;
}
)";

/// The callbacks of CVODE around the header's functions, and the drift of the energy.
const char* const kCvode = R"(
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

static int rhs(realtype t, N_Vector y, N_Vector ydot, void* user) {
  (void)t;
  kovalevskaya_rhs(N_VGetArrayPointer(y), user, N_VGetArrayPointer(ydot));
  return 0;
}

static int jacobian(realtype t, N_Vector y, N_Vector fy, SUNMatrix J, void* user, N_Vector tmp1,
                    N_Vector tmp2, N_Vector tmp3) {
  (void)t, (void)fy, (void)tmp1, (void)tmp2, (void)tmp3;
  kovalevskaya_jacobian(N_VGetArrayPointer(y), user, SUNDenseMatrix_Data(J));
  return 0;
}

int main(void) {
  kovalevskaya_parameters p = kovalevskaya_default_parameters;
  double before[kovalevskaya_invariant_count], after[kovalevskaya_invariant_count], t, defect = 0;
  SUNContext context;
  if (SUNContext_Create(NULL, &context) != 0) return 1;
  N_Vector y = N_VNew_Serial(kovalevskaya_dimension, context);
  memcpy(N_VGetArrayPointer(y), kovalevskaya_initial_state, sizeof kovalevskaya_initial_state);
  kovalevskaya_invariants(N_VGetArrayPointer(y), &p, before);
  SUNMatrix matrix = SUNDenseMatrix(kovalevskaya_dimension, kovalevskaya_dimension, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  void* memory = CVodeCreate(CV_BDF, context);
  if (CVodeInit(memory, rhs, 0, y) != 0 || CVodeSStolerances(memory, 1e-11, 1e-11) != 0) return 2;
  if (CVodeSetUserData(memory, &p) != 0 || CVodeSetMaxNumSteps(memory, 100000) != 0) return 3;
  if (CVodeSetLinearSolver(memory, solver, matrix) != 0) return 4;
  if (CVodeSetJacFn(memory, jacobian) != 0 || CVode(memory, 5, y, &t, CV_NORMAL) != 0) return 5;
  kovalevskaya_invariants(N_VGetArrayPointer(y), &p, after);
  for (int k = 0; k < kovalevskaya_invariant_count; ++k)
    defect = fmax(defect, fabs(after[k] - before[k]));
  printf("%.17g\n", defect);
  return 0;
}
)";

double defect_of(const std::string& header, const char* program = kUser,
                 const std::vector<std::string>& libraries = {"-lm"}) {
  const codegen::CompilerRun run = c_program(header, program, libraries);
  EXPECT_TRUE(run.succeeded) << run.messages;
  return run.succeeded ? std::strtod(run.messages.c_str(), nullptr) : 1e300;
}

TEST(EmitC, PlainCIntegratesAndHasTheDerivatives) {
  EXPECT_LT(defect_of(c_header(specialised(kKovalevskaya, everything(false)))), 1e-6);
}

TEST(EmitC, CvodeIntegratesFromC) {
  const std::vector<std::string> libraries{"-lsundials_cvode", "-lsundials_nvecserial",
                                           "-lsundials_sunmatrixdense", "-lsundials_sunlinsoldense",
                                           "-lm"};
  const std::string header = c_header(specialised(kKovalevskaya, everything(false)));
  EXPECT_LT(defect_of(header, kCvode, libraries), 1e-6);
}

TEST(EmitC, PlainCSeesABentEquation) {
  std::string header = c_header(specialised(kKovalevskaya, everything(false)));
  const std::size_t place = header.find("g2 * t1 - M2 * g3");
  ASSERT_NE(place, std::string::npos);
  header.replace(place, 2, "1.001f * g2");
  EXPECT_GT(defect_of(header), 1e-4);
}

TEST(EmitC, EveryNumberTypeOfCCompilesStrictly) {
  const std::string difficult = equations(
      {{"u", "sin(u)*exp(-v/3) + Pi/7 + t*u^(1/3)"},
       {"sinf", "sqrt(2)*a*v^(-3/2) + atan2(u, v) - 10^30*v + atan2(u, 2)"},
       {"v", "1"},
       {"restrict", "cos(sinf)"}},
      "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"1/3\" }");
  const std::size_t place = difficult.find("[equations]");
  const std::string toml = difficult.substr(0, place) + "time = \"t\"\n" + difficult.substr(place);
  for (const bool fold : {true, false}) {
    const Specialisation spec = specialised(toml, everything(fold));
    for (const Scalar scalar : {Scalar::real64, Scalar::real32, Scalar::long_double}) {
      const codegen::CompilerRun run =
          c_program(c_header(spec, scalar), "int main(void) { return 0; }\n");
      EXPECT_TRUE(run.succeeded) << run.messages << c_header(spec, scalar);
    }
  }
}

/// All of them in one program, as their names are apart.
TEST(EveryCase, HasAHeaderInCThatGoesWithTheOthers) {
  std::string all;
  for (const auto& path : test::cases_to_go_through()) {
    const Model model = build_model(read_case(path));
    all += c_header(specialise(model, model.scenes.at(0)));
  }
  const codegen::CompilerRun run = c_program(all, "int main(void) { return 0; }\n");
  EXPECT_TRUE(run.succeeded) << run.messages;
}

TEST(EmitC, WhatCHasNoFormOfIsRefused) {
  EXPECT_THROW(c_header(specialised(kKovalevskaya), Scalar::templated), ModelError);
  EXPECT_THROW(c_header(specialised(kKovalevskaya), Scalar::float128), ModelError);
  SpecialiseOptions taylor;
  taylor.taylor = true;
  EXPECT_THROW(c_header(specialised(kKovalevskaya, taylor)), ModelError);
}

TEST(EmitC, TheHeaderSaysWhoseItIs) {
  for (const Language language : {Language::cpp, Language::c}) {
    const std::string text = emit_header(specialised(kKovalevskaya), {.language = language});
    EXPECT_NE(text.find("belongs to whoever had it generated"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace casimir

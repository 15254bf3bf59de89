// The emitted Taylor coefficients and variational equations.
#include <gtest/gtest.h>

#include <cmath>

#include "codegen/emit_cpp.hpp"
#include "runtime/evaluate.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using testing::equations;
using testing::kKovalevskaya;

/// Every function that a program may call, and the time.
std::string everything() {
  const std::string toml = equations(
      {{"u", "sin(v)*cos(u) + v/(2 + u) - t^2"},
       {"v", "exp(-u)*sqrt(2 + v) + tan(u/3) - u*v/5"},
       {"w", "log(3 + w) + asin(w/4) - acos(u/5) + 1/w"},
       {"s", "atan2(u, v) + atan2(1, s) + (1 + s)^(1/3) - Pi*s + a"}},
      "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"1/3\" }");
  const std::size_t place = toml.find("[equations]");
  return toml.substr(0, place) + "time = \"t\"\n" + toml.substr(place);
}

/// The Taylor coefficients of the solution by repeated Lie derivatives, in 30 digits.
std::vector<double> exact_coefficients(const Model& model, const std::vector<GiNaC::ex>& at,
                                       const GiNaC::ex& time, int order) {
  GiNaC::Digits = 30;
  GiNaC::exmap point;
  for (std::size_t i = 0; i < at.size(); ++i) point[model.variables[i]] = at[i];
  if (model.time) point[*model.time] = time;
  std::vector<GiNaC::ex> field;
  for (const GiNaC::ex& f : model.field) field.push_back(model.at_parameters(f, model.scenes[0]));
  std::vector<GiNaC::ex> series(model.variables.begin(), model.variables.end());
  std::vector<double> result;
  for (int k = 0; k <= order; ++k) {
    for (GiNaC::ex& s : series) {
      result.push_back(GiNaC::ex_to<GiNaC::numeric>(s.subs(point).evalf()).to_double());
      GiNaC::ex next = model.time ? s.diff(*model.time) : GiNaC::ex(0);
      for (std::size_t i = 0; i < field.size(); ++i) next += s.diff(model.variables[i]) * field[i];
      s = next / (k + 1);
    }
  }
  return result;
}

/// The header in a shared object, with plain functions around what is tested.
std::filesystem::path built(const std::string& header, const std::string& scope,
                            const std::string& time) {
  return compile(header +
                 "extern \"C\" void taylor5([[maybe_unused]] double t, const double* x, double* c) "
                 "{\n  " +
                 scope + "::taylor<5>(" + time + "x, c);\n}\n" +
                 "extern \"C\" void variational([[maybe_unused]] double t, const double* x, const "
                 "double* d, double* dx, "
                 "double* dd) {\n  " +
                 scope + "::variational(" + time + "x, d, dx, dd);\n}\n")
      .path;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::fabs(a[i] - b[i]) / (1 + std::fabs(a[i]));
    if (!(difference <= result)) result = difference;
  }
  return result;
}

SpecialiseOptions with_derivatives() {
  SpecialiseOptions options;
  options.taylor = true;
  options.variational = true;
  return options;
}

TEST(Derivatives, TaylorCoefficientsAreTheLieDerivatives) {
  const Model model = testing::model_of(everything(), "everything.toml");
  const std::string header = emit_header(specialise(model, model.scenes[0], with_derivatives()));
  const auto object = built(header, "everything", "t, ");
  const auto taylor = testing::entry<void(double, const double*, double*)>(object, "taylor5");
  ASSERT_NE(taylor, nullptr);
  const double x[] = {0.5, 0.25, 0.75, 0.125};
  std::vector<double> c(24);
  taylor(0.5, x, c.data());
  const GiNaC::ex one = 1;
  const auto exact =
      exact_coefficients(model, {one / 2, one / 4, 3 * one / 4, one / 8}, one / 2, 5);
  EXPECT_LT(largest_difference(exact, c), 1e-13);
  taylor(0.5000001, x, c.data());
  EXPECT_GT(largest_difference(exact, c), 1e-13);
}

TEST(Derivatives, TaylorCoefficientsOfKovalevskaya) {
  const Model model = testing::model_of(kKovalevskaya);
  const std::string header = emit_header(specialise(model, model.scenes[0], with_derivatives()));
  const auto taylor = testing::entry<void(double, const double*, double*)>(
      built(header, "kovalevskaya", ""), "taylor5");
  const double x[] = {1, 0.5, 0.25, 0.5, 0, 0.75};
  std::vector<double> c(36);
  taylor(0, x, c.data());
  const GiNaC::ex one = 1;
  EXPECT_LT(
      largest_difference(
          exact_coefficients(model, {one, one / 2, one / 4, one / 2, 0, 3 * one / 4}, 0, 5), c),
      1e-15);
}

TEST(Derivatives, VariationalEquationsAreTheDerivative) {
  const Model model = testing::model_of(everything(), "everything.toml");
  const std::string header = emit_header(specialise(model, model.scenes[0], with_derivatives()));
  const auto variational =
      testing::entry<void(double, const double*, const double*, double*, double*)>(
          built(header, "everything", "t, "), "variational");
  const double step = 1e-6;
  const double d[] = {1, -2, 0.5, 3};
  const double x[] = {0.5, 0.25, 0.75, 0.125};
  std::vector<double> left(4), right(4), dx(4), dd(4), unused(4);
  std::vector<double> a(4), b(4);
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = x[i] - step * d[i];
    b[i] = x[i] + step * d[i];
  }
  variational(0.5, a.data(), d, left.data(), unused.data());
  variational(0.5, b.data(), d, right.data(), unused.data());
  variational(0.5, x, d, dx.data(), dd.data());
  for (std::size_t i = 0; i < 4; ++i) {
    const double quotient = (right[i] - left[i]) / (2 * step);
    EXPECT_NEAR(dd[i], quotient, 1e-8);
    EXPECT_GT(std::fabs(dd[i] * 1.001 - quotient), 1e-8);
  }
}

TEST(Derivatives, VariationalProgramIsExact) {
  const Specialisation spec = testing::specialised(kKovalevskaya, with_derivatives());
  testing::Points points;
  std::vector<cln::cl_RA> x, d;
  for (int i = 0; i < 6; ++i) {
    x.push_back(points.next());
    d.push_back(points.next());
  }
  std::vector<cln::cl_RA> inputs = x;
  inputs.insert(inputs.end(), d.begin(), d.end());
  inputs.push_back(0);
  x.push_back(0);
  const auto both = testing::exact(spec.variational, inputs);
  const auto rates = testing::exact(spec.rhs, x);
  const auto entries = testing::exact(spec.jacobian.program, x);
  std::vector<cln::cl_RA> along(6, 0);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto& [row, column] = spec.jacobian.entries[k];
    along[static_cast<std::size_t>(row)] =
        along[static_cast<std::size_t>(row)] + entries[k] * d[static_cast<std::size_t>(column)];
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(both[i], rates[i]);
    EXPECT_EQ(both[i + 6], along[i]);
  }
}

using Wide = std::vector<cln::cl_F>;

/// A classical Runge-Kutta step of a program that is a right-hand side of these states and the
/// time.
Wide step(const Program& rhs, const Wide& x, const cln::cl_F& t, const cln::cl_F& h) {
  const Arithmetic<cln::cl_F> arithmetic(60);
  const cln::cl_F half = h / 2;
  const auto rates = [&](const Wide& at, const cln::cl_F& time) {
    Wide inputs = at;
    inputs.push_back(time);
    return evaluate(rhs, inputs, arithmetic);
  };
  const auto moved = [&](const Wide& k, const cln::cl_F& by) {
    Wide y = x;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] + by * k[i];
    return y;
  };
  const Wide k1 = rates(x, t);
  const Wide k2 = rates(moved(k1, half), t + half);
  const Wide k3 = rates(moved(k2, half), t + half);
  const Wide k4 = rates(moved(k3, h), t + h);
  Wide y = x;
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = y[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return y;
}

TEST(Derivatives, TheVariationalFlowIsTheDerivativeOfTheFlow) {
  // A Runge-Kutta method commutes with differentiation: its steps of the variational equations are
  // the derivative of its steps, whatever their size.
  const Arithmetic<cln::cl_F> arithmetic(60);
  for (const std::string& toml : {std::string(kKovalevskaya), everything()}) {
    const Specialisation spec = testing::specialised(toml, with_derivatives());
    const std::size_t n = spec.states.size();
    testing::Points points;
    Wide x, deviation;
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(arithmetic.from(cln::cl_RA(1) / 2 + points.next() / 16));
      deviation.push_back(arithmetic.from(points.next()));
    }
    const cln::cl_F h = arithmetic.from(cln::cl_RA(1) / 16);
    const auto end_of = [&](const Program& rhs, Wide at) {
      cln::cl_F t = arithmetic.from(cln::cl_RA(0));
      for (int k = 0; k < 8; ++k, t = t + h) at = step(rhs, at, t, h);
      return at;
    };
    const cln::cl_F change = arithmetic.from(cln::expt(cln::cl_RA(10), -20));
    Wide both = x, left = x, right = x;
    both.insert(both.end(), deviation.begin(), deviation.end());
    for (std::size_t i = 0; i < n; ++i) {
      left[i] = left[i] - change * deviation[i];
      right[i] = right[i] + change * deviation[i];
    }
    const Wide along = end_of(spec.variational, both);
    left = end_of(spec.rhs, left);
    right = end_of(spec.rhs, right);
    for (std::size_t i = 0; i < n; ++i) {
      const cln::cl_F quotient = (right[i] - left[i]) / (2 * change);
      EXPECT_LT(std::fabs(cln::double_approx(along[n + i] - quotient)), 1e-35) << spec.states[i];
      EXPECT_GT(std::fabs(cln::double_approx(quotient)), 1e-3);
    }
  }
}

TEST(Derivatives, EveryNumberTypeCompilesWithoutWarnings) {
  const Model model = testing::model_of(everything(), "everything.toml");
  const testing::Folder folder;
  for (const bool fold : {true, false}) {
    SpecialiseOptions options = with_derivatives();
    options.fold_parameters = fold;
    const Specialisation spec = specialise(model, model.scenes[0], options);
    const std::string p = fold ? "" : "{}, ";
    for (const Scalar scalar : {Scalar::real64, Scalar::real32, Scalar::long_double,
                                Scalar::float128, Scalar::templated}) {
      const std::string real =
          scalar == Scalar::real64 || scalar == Scalar::templated ? "double" : "everything::real";
      const std::string use = "void use(" + real + "* x, " + real + "* c);\nvoid use(" + real +
                              "* x, " + real + "* c) { everything::taylor<7>(" + real + "(0), x, " +
                              p + "c); }\n";
      testing::write(folder.path() / "alone.cpp", emit_header(spec, {scalar}) + use);
      const auto run =
          testing::run("",
                       {"-std=c++20", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion",
                        "-Wshadow", "-fsyntax-only", (folder.path() / "alone.cpp").string()},
                       folder.path());
      EXPECT_TRUE(run.succeeded) << run.messages;
    }
  }
}

}  // namespace
}  // namespace casimir

// The gradients of invariants: what they must be in every bundled case, and the emitted code.
#include <gtest/gtest.h>

#include <cmath>

#include "codegen/emit_cpp.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

namespace fs = std::filesystem;
using testing::equations;
using testing::Points;

constexpr int kDigits = 50;

SpecialiseOptions with_gradients() {
  SpecialiseOptions options;
  options.gradients = true;
  options.observe = std::vector<std::string>{};
  return options;
}

/// A point near the initial state, where every function of the case has a value.
std::vector<cln::cl_RA> near_start(const Specialisation& spec, Points& points) {
  const Arithmetic<cln::cl_F> arithmetic(kDigits);
  const auto start = evaluate(spec.start, {}, arithmetic);
  std::vector<cln::cl_RA> result;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const double x =
        cln::double_approx(start[i]) +
        cln::double_approx(points.next()) / 40 * (1 + std::fabs(cln::double_approx(start[i])));
    result.push_back(cln::rational(cln::cl_DF(x)));
  }
  result.push_back(0);
  return result;
}

std::vector<cln::cl_F> digits_of(const std::vector<cln::cl_RA>& at) {
  const Arithmetic<cln::cl_F> arithmetic(kDigits);
  std::vector<cln::cl_F> result;
  for (const cln::cl_RA& x : at) result.push_back(arithmetic.from(x));
  return result;
}

TEST(EveryCase, HasGradientsOfCasimirsInTheKernelOfTheStructureMatrix) {
  int checked = 0;
  for (const fs::path& path : test::cases_to_go_through()) {
    const Model model = build_model(read_case(path));
    if (!model.poisson || model.casimirs.empty()) continue;
    const Specialisation spec = specialise(model, model.scenes.at(0), with_gradients());
    Points points;
    const std::vector<cln::cl_RA> at = near_start(spec, points);
    GiNaC::exmap map;
    for (std::size_t i = 0; i < model.variables.size(); ++i)
      map[model.variables[i]] = GiNaC::numeric(at[i]);
    const auto values =
        evaluate(spec.gradients.program, digits_of(at), Arithmetic<cln::cl_F>(kDigits));
    GiNaC::Digits = kDigits;
    for (const NamedExpression& casimir : model.casimirs) {
      const auto place = std::ranges::find(spec.invariant_names, casimir.name);
      ASSERT_NE(place, spec.invariant_names.end()) << path;
      const auto column = static_cast<int>(place - spec.invariant_names.begin());
      for (std::size_t i = 0; i < model.variables.size(); ++i) {
        GiNaC::ex sum = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
          const auto& [row, of] = spec.gradients.entries[k];
          if (of != column) continue;
          const GiNaC::ex bracket = model.at_parameters(
              (*model.poisson)(i, static_cast<std::size_t>(row)), model.scenes[0]);
          sum += bracket.subs(map).evalf() * GiNaC::numeric(values[k]);
        }
        EXPECT_LT(abs(GiNaC::ex_to<GiNaC::numeric>(sum.evalf())).to_double(), 1e-40)
            << path << ": {x_" << i << ", " << casimir.name << "}";
      }
      ++checked;
    }
  }
  EXPECT_GE(checked, test::wants_every_case() ? 50 : 8);
}

TEST(EveryCase, HasGradientsOfIntegralsOrthogonalToTheFlow) {
  for (const fs::path& path : test::cases_to_go_through()) {
    const Model model = build_model(read_case(path));
    const Specialisation spec = specialise(model, model.scenes.at(0), with_gradients());
    Points points;
    const std::vector<cln::cl_F> at = digits_of(near_start(spec, points));
    const Arithmetic<cln::cl_F> arithmetic(kDigits);
    const auto rates = evaluate(spec.rhs, at, arithmetic);
    const auto values = evaluate(spec.gradients.program, at, arithmetic);
    std::vector<cln::cl_F> along(spec.invariant_names.size(), arithmetic.from(cln::cl_RA(0)));
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto& [row, column] = spec.gradients.entries[k];
      along[static_cast<std::size_t>(column)] = along[static_cast<std::size_t>(column)] +
                                                values[k] * rates[static_cast<std::size_t>(row)];
    }
    for (std::size_t i = 0; i < along.size(); ++i)
      EXPECT_LT(std::fabs(cln::double_approx(along[i])), 1e-40)
          << path << ": " << spec.invariant_names[i];
  }
}

/// The header's gradients in a shared object, optimised as users do, against 50 digits; in units of
/// the rounding of the terms.
TEST(EveryCase, HasCompiledGradientsExactToRounding) {
  for (const fs::path& path : test::cases_to_go_through()) {
    const Model model = build_model(read_case(path));
    const Specialisation spec = specialise(model, model.scenes.at(0), with_gradients());
    if (spec.invariant_names.empty()) continue;
    const std::string header = emit_header(spec);
    const std::size_t scope = header.find("namespace ") + 10;
    const std::string name = header.substr(scope, header.find(' ', scope) - scope);
    CompileOptions options;
    options.flags = {"-O1"};
    options.standard_library = header.find("#include") != std::string::npos;
    const auto object =
        compile(header + "extern \"C\" void values(const double* x, double* v) { " + name +
                    "::gradients(" + (spec.uses_time ? "0, " : "") + "x, v); }\n",
                options);
    const auto gradients = testing::entry<void(const double*, double*)>(object.path, "values");
    ASSERT_NE(gradients, nullptr) << path;
    Points points;
    const std::size_t n = spec.states.size();
    for (int round = 0; round < 20; ++round) {
      const std::vector<cln::cl_RA> at = near_start(spec, points);
      std::vector<double> x;
      std::vector<SizedNumber> sized;
      for (const cln::cl_RA& value : at) {
        x.push_back(cln::double_approx(value));
        sized.push_back(Arithmetic<SizedNumber>::plain(x.back()));
      }
      std::vector<double> dense(n * spec.invariant_names.size(), 0.1);
      gradients(x.data(), dense.data());
      const auto exact =
          evaluate(spec.gradients.program, digits_of(at), Arithmetic<cln::cl_F>(kDigits));
      const auto sizes = evaluate(spec.gradients.program, sized);
      for (std::size_t k = 0; k < exact.size(); ++k) {
        const auto& [row, column] = spec.gradients.entries[k];
        double& value = dense[static_cast<std::size_t>(row) + n * static_cast<std::size_t>(column)];
        EXPECT_LE(std::fabs(value - cln::double_approx(exact[k])), 2e-14 * std::fabs(sizes[k].size))
            << path << " " << spec.gradients.program.output_names[k];
        value = 0;
      }
      for (const double zero : dense) EXPECT_EQ(zero, 0) << path;
    }
  }
}

TEST(Gradients, ComeInEveryNumberTypeWithoutWarnings) {
  const testing::Folder folder;
  const std::string toml = equations(
      {{"u", "v + t"}, {"v", "-u*entries"}, {"entries", "0"}},
      "[parameters]\na = {}\n[integrals]\nF = \"atan2(u, v)*sqrt(entries) + a*u^(1/3)\"\nG = "
      "\"sin(u)*exp(v/3)/(1 + tan(entries)^2)\"\n[[scene]]\nname = \"default\"\nparameters = { a = "
      "\"1/3\" }");
  const std::size_t place = toml.find("[equations]");
  const std::string timed = toml.substr(0, place) + "time = \"t\"\n" + toml.substr(place);
  for (const bool fold : {true, false}) {
    SpecialiseOptions options = with_gradients();
    options.fold_parameters = fold;
    const Specialisation spec = testing::specialised(timed, options);
    for (const Scalar scalar : {Scalar::real64, Scalar::real32, Scalar::long_double,
                                Scalar::float128, Scalar::templated}) {
      const std::string text = emit_header(spec, {.scalar = scalar, .sparse_jacobian = true});
      for (const char* part : {"void gradients(", "void jacobian_entries(", "jacobian_columns[]"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
      testing::write(folder.path() / "alone.cpp", text);
      const auto run =
          testing::run("",
                       {"-std=c++20", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion",
                        "-Wshadow", "-fsyntax-only", (folder.path() / "alone.cpp").string()},
                       folder.path());
      EXPECT_TRUE(run.succeeded) << run.messages;
    }
  }
}

TEST(Gradients, AreOnlyThereWhenAskedFor) {
  const std::string text = emit_header(testing::specialised(testing::kKovalevskaya));
  EXPECT_EQ(text.find("gradients"), std::string::npos);
  EXPECT_EQ(text.find("jacobian_entries"), std::string::npos);
  SpecialiseOptions options = with_gradients();
  options.invariants = false;  // nothing to differentiate
  EXPECT_EQ(emit_header(testing::specialised(testing::kKovalevskaya, options)).find("gradients"),
            std::string::npos);
}

/// The pattern against the dense Jacobian: by columns, each entry once.
TEST(Gradients, TheSparseJacobianIsTheDenseOne) {
  const std::string header =
      emit_header(testing::specialised(testing::kKovalevskaya), {.sparse_jacobian = true});
  const auto object = compile(header + R"(
extern "C" int differ(const double* x) {
  using namespace kovalevskaya;
  double J[dimension * dimension], entries[jacobian_nonzeros];
  jacobian(x, J);
  jacobian_entries(x, entries);
  for (int j = 0; j < dimension; ++j)
    for (int k = jacobian_columns[j]; k < jacobian_columns[j + 1]; ++k) {
      if (J[jacobian_rows[k] + dimension * j] != entries[k]) return 1;
      J[jacobian_rows[k] + dimension * j] = 0;
    }
  for (const double rest : J)
    if (rest != 0) return 2;
  return jacobian_columns[dimension] == jacobian_nonzeros ? 0 : 3;
}
)");
  const auto differ = testing::entry<int(const double*)>(object.path, "differ");
  const double x[] = {1, 0.5, 0.25, 0.5, 3, 0.75};
  EXPECT_EQ(differ(x), 0);
}

}  // namespace
}  // namespace casimir

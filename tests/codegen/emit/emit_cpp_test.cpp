#include "codegen/emit_cpp.hpp"

#include <cln/dfloat.h>
#include <cln/integer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "runtime/module_abi.h"
#include "tests/bundled_cases.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

namespace fs = std::filesystem;
using testing::equations;
using testing::Folder;
using testing::kKovalevskaya;
using testing::specialised;

const std::vector<std::string> kStrict{"-std=c++20", "-Wall",        "-Wextra",  "-Werror",
                                       "-pedantic",  "-Wconversion", "-Wshadow", "-fsyntax-only"};

/// What the compiler says to a file that holds the text alone; empty if nothing.
std::string complaints(const std::string& text) {
  const Folder folder;
  testing::write(folder.path() / "alone.cpp", text);
  std::vector<std::string> arguments = kStrict;
  arguments.push_back((folder.path() / "alone.cpp").string());
  const codegen::CompilerRun run = testing::run("", arguments, folder.path());
  return run.succeeded ? "" : run.messages + " ";
}

/// The same of a C compiler to a program that includes it.
std::string c_complaints(const std::string& header) {
  const Folder folder;
  testing::write(folder.path() / "header.h", header);
  testing::write(folder.path() / "user.c", "#include \"header.h\"\nint main(void) { return 0; }\n");
  const codegen::CompilerRun run =
      testing::run("cc",
                   {"-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only",
                    (folder.path() / "user.c").string()},
                   folder.path());
  return run.succeeded ? "" : run.messages + " ";
}

std::string case_path(const std::string& name) {
  return std::string(CASIMIR_SOURCE_DIR) + "/cases/" + name;
}

void expect_golden(const std::string& text, const std::string& name) {
  const fs::path path = fs::path(CASIMIR_SOURCE_DIR) / "tests/codegen/golden" / name;
  if (std::getenv("UPDATE")) {
    fs::create_directories(path.parent_path());
    testing::write(path, text);
  }
  EXPECT_EQ(testing::read(path), text) << "UPDATE=1 writes the new text";
}

TEST(EmitCpp, KovalevskayaReadsLikeHandWrittenCode) {
  const Specialisation spec = specialised(kKovalevskaya);
  expect_golden(emit_header(spec), "kovalevskaya.hpp.txt");
  expect_golden(emit_module(spec), "kovalevskaya.cpp.txt");
  SpecialiseOptions general;
  general.fold_parameters = false;
  expect_golden(emit_header(specialised(kKovalevskaya, general), {Scalar::templated}),
                "kovalevskaya_general.hpp.txt");
}

TEST(EmitCpp, TwoProcessesWriteTheSame) {
  const Folder folder;
  for (const char* name : {"kovalevskaya.toml", "clebsch.toml", "lagrange-euler-angles.toml"}) {
    std::vector<std::string> texts;
    for (int i = 0; i < 4; ++i) {
      const auto run = testing::run(CASIMIR_PRINT, {case_path(name)}, folder.path());
      ASSERT_TRUE(run.succeeded) << run.messages;
      texts.push_back(testing::read(folder.path() / "messages"));
    }
    for (const std::string& text : texts) EXPECT_EQ(text, texts[0]);
    EXPECT_GT(texts[0].size(), 1000u);
  }
}

TEST(EveryCase, HasCodeThatCompilesAloneWithoutWarnings) {
  // A compiler runs for each text: every other case keeps its parameters.
  bool fold = false;
  for (const auto& path : test::cases_to_go_through()) {
    const Model model = build_model(read_case(path));
    SpecialiseOptions options;
    options.fold_parameters = fold = !fold;
    const Specialisation spec = specialise(model, model.scenes.at(0), options);
    EXPECT_EQ(complaints(emit_header(spec)), "") << path;
    EXPECT_EQ(complaints(emit_module(spec)), "") << path;
  }
}

TEST(EmitCpp, EveryNumberTypeCompiles) {
  const std::string difficult = equations(
      {{"u", "sin(u)*exp(-v/3) + Pi/7 + t*u^(1/3)"},
       {"v", "sqrt(2)*a*v^(-3/2) + atan2(u, v) - 10^40*v"}},
      "[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = { a = \"1/3\" }");
  const std::string timed = "time = \"t\"\n";
  const std::size_t place = difficult.find("[equations]");
  const std::string toml = difficult.substr(0, place) + timed + difficult.substr(place);
  for (const bool fold : {true, false}) {
    SpecialiseOptions options;
    options.fold_parameters = fold;
    const Specialisation spec = specialised(toml, options);
    EXPECT_TRUE(spec.uses_time);
    for (const Scalar scalar :
         {Scalar::real64, Scalar::long_double, Scalar::float128, Scalar::templated}) {
      EXPECT_EQ(complaints(emit_header(spec, {scalar})), "") << emit_header(spec, {scalar});
    }
    EXPECT_THROW(emit_header(spec, {Scalar::real32}), ModelError);  // 10^40 is no float
    EXPECT_EQ(complaints(emit_module(spec)), "");
  }
  EXPECT_EQ(complaints(emit_header(specialised(kKovalevskaya), {Scalar::real32})), "");
}

/// A model with names that no case file may have: du_i/dt = u_i * u_{i+1} + sin(u_i)/3.
Model model_with(const std::vector<std::string>& names) {
  Model model;
  Scene scene;
  for (const std::string& name : names) {
    model.variables.emplace_back(name);
    scene.initial.emplace_back(1);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const GiNaC::symbol& u = model.variables[i];
    model.field.push_back(u * model.variables[(i + 1) % names.size()] + sin(u) / 3);
    model.integrals.push_back({names[i], u, {}});
  }
  scene.duration = 1;
  model.scenes.push_back(scene);
  return model;
}

TEST(EmitCpp, HostileNamesAndTitlesStayHarmless) {
  Model model = model_with(
      {"int", "x",  "t1",   "c1",  "dx", "x_", "NULL",   "I",   "j0",  "errno", "std",
       "p",   "J",  "M_PI", "__a", "_B", "n",  "System", "rhs", "a b", "*/",    "\n#error name",
       "\\",  "\"", "",     "x"});
  model.title =
      "*/ #include </etc/passwd>\n#error no\\\n?"
      "?/ \a end \\";
  model.source = "*/ }\n#error source";
  model.scenes[0].name = "a\n#error scene \\";
  for (const std::string& name :
       {std::string("while"), std::string("std"), std::string("a b\n#error"), std::string("")}) {
    model.name = name;
    const Specialisation spec = specialise(model, model.scenes[0]);
    EXPECT_EQ(complaints(emit_header(spec)), "") << emit_header(spec);
    EXPECT_EQ(complaints(emit_module(spec)), "") << emit_module(spec);
    EXPECT_EQ(emit_header(spec).find("\n#error"), std::string::npos);
    const std::string c = emit_header(spec, {.language = Language::c});
    EXPECT_EQ(c_complaints(c), "") << c;
    EXPECT_EQ(c.find("\n#error"), std::string::npos);
  }
  // The compiler does notice.
  EXPECT_NE(complaints(emit_header(specialise(model, model.scenes[0])) + "\n#error here\n"), "");
}

TEST(EmitCpp, LinesAreShort) {
  for (const char* name :
       {"kovalevskaya.toml", "clebsch.toml", "steklov.toml", "lagrange-euler-angles.toml"}) {
    const Model model = build_model(read_case(case_path(name)));
    std::istringstream text(emit_header(specialise(model, model.scenes[0])));
    for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(EmitCpp, ParenthesesKeepTheOrderOfTheProgram) {
  const Specialisation spec = specialised(equations({{"u", "u - (v - w)*(u + v)"},
                                                     {"v", "u/(v*w)"},
                                                     {"w", "-(u + v)^2 - w"},
                                                     {"s", "u^(-2)*(-v)"}}));
  const std::string text = emit_header(spec);
  const fs::path object = compile(emit_module(spec)).path;
  using Rhs = void(double, const double*, const double*, double*);
  const auto rhs = testing::entry<Rhs>(object, "casimir_rhs");
  ASSERT_NE(rhs, nullptr);
  const double x[] = {3, 5, 7, 0};
  double dx[4] = {};
  rhs(0, x, nullptr, dx);
  EXPECT_DOUBLE_EQ(dx[0], 3 - (5 - 7) * (3 + 5));
  EXPECT_DOUBLE_EQ(dx[1], 3.0 / 35);
  EXPECT_DOUBLE_EQ(dx[2], -64 - 7);
  EXPECT_DOUBLE_EQ(dx[3], -5.0 / 9);
}

/// The sizes of what is added up, so that cancellation does not count as an error.
std::vector<double> magnitudes(Program program, const std::vector<double>& inputs) {
  std::vector<double> v;
  const auto at = [&](int i) { return v[static_cast<std::size_t>(i)]; };
  for (const Instruction& c : program.code) {
    switch (c.op) {
      case Op::input:
        v.push_back(std::fabs(inputs[static_cast<std::size_t>(c.a)]));
        break;
      case Op::constant:
        v.push_back(
            std::fabs(cln::double_approx(program.constants[static_cast<std::size_t>(c.a)])));
        break;
      case Op::add:
      case Op::sub:
        v.push_back(at(c.a) + at(c.b));
        break;
      case Op::mul:
        v.push_back(at(c.a) * at(c.b));
        break;
      case Op::neg:
        v.push_back(at(c.a));
        break;
      default:
        ADD_FAILURE() << "not a polynomial";
        return {};
    }
  }
  std::vector<double> result;
  for (const int output : program.outputs) result.push_back(at(output));
  return result;
}

/// The largest error of the compiled right-hand side in units of rounding of its terms, against the
/// model at exact points.
double largest_error(const Model& model, const fs::path& object) {
  using Rhs = void(double, const double*, const double*, double*);
  const auto rhs = testing::entry<Rhs>(object, "casimir_rhs");
  const Specialisation spec = specialise(model, model.scenes[0]);
  testing::Points points;
  double worst = 0;
  for (int k = 0; k < 50; ++k) {
    GiNaC::exmap map;
    std::vector<double> x;
    for (const GiNaC::symbol& variable : model.variables) {
      const cln::cl_RA value = points.next();
      map[variable] = GiNaC::numeric(value);
      x.push_back(cln::double_approx(value));
    }
    std::vector<double> dx(x.size());
    rhs(0, x.data(), nullptr, dx.data());
    x.push_back(0);
    const std::vector<double> sizes = magnitudes(spec.rhs, x);
    for (std::size_t i = 0; i < dx.size(); ++i) {
      const GiNaC::ex value = model.at_parameters(model.field[i], model.scenes[0]).subs(map);
      const cln::cl_RA exact = cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
      const cln::cl_RA error = cln::abs(cln::rational(cln::cl_DF(dx[i])) - exact);
      if (sizes[i] > 0) worst = std::max(worst, cln::double_approx(error) / sizes[i]);
    }
  }
  return worst / std::numeric_limits<double>::epsilon();
}

TEST(EmitCpp, CompiledCodeAgreesWithExactEvaluation) {
  for (const char* name : {"kovalevskaya.toml", "clebsch.toml", "steklov.toml"}) {
    const Model model = build_model(read_case(case_path(name)));
    const std::string text = emit_module(specialise(model, model.scenes[0]));
    EXPECT_LE(largest_error(model, compile(text).path), 8) << name;
  }
}

TEST(EmitCpp, ABentCoefficientIsSeen) {
  const Model model = build_model(read_case(case_path("kovalevskaya.toml")));
  std::string text = emit_module(specialise(model, model.scenes[0]));
  const std::size_t place = text.find("2 * M3");
  ASSERT_NE(place, std::string::npos);
  text.replace(place, 6, "2.00000000000001 * M3");
  EXPECT_GT(largest_error(model, compile(text).path), 8);
}

TEST(EmitCpp, ModulesFollowTheInterface) {
  SpecialiseOptions general;
  general.fold_parameters = false;
  const fs::path object = compile(emit_module(specialised(kKovalevskaya, general))).path;
  EXPECT_EQ(testing::entry<int()>(object, "casimir_abi_version")(), CASIMIR_ABI_VERSION);
  EXPECT_EQ(testing::entry<int()>(object, "casimir_dimension")(), 6);
  EXPECT_EQ(testing::entry<int()>(object, "casimir_parameter_count")(), 1);
  EXPECT_EQ(testing::entry<int()>(object, "casimir_invariant_count")(), 4);
  EXPECT_EQ(testing::entry<int()>(object, "casimir_integrate"), nullptr);
  using Function = void(double, const double*, const double*, double*);
  const double x[] = {1, 2, 3, 4, 5, 6};
  const double r[] = {10};
  double invariants[4] = {};
  testing::entry<Function>(object, "casimir_invariants")(0, x, r, invariants);
  EXPECT_EQ(invariants[0], (1 + 4 + 18) / 2.0 - 40);
  double J[36] = {};
  testing::entry<Function>(object, "casimir_jacobian")(0, x, r, J);
  EXPECT_EQ(J[1 + 6 * 5], -10);  // d(dM2)/dg3
  EXPECT_EQ(J[5 + 6 * 1], 4);    // d(dg3)/dM2
  EXPECT_EQ(J[0], 0);
}

TEST(EmitCpp, AKernelIsInstantiatedForTheSystem) {
  const std::string kernel =
      "struct casimir_run { double t_end; };\nstruct casimir_outcome { int status; };\n"
      "namespace casimir_kernel {\ntemplate <class System>\n"
      "void integrate(const casimir_run* run, double* x, casimir_outcome* outcome) {\n"
      "  double dx[System::n];\n  System::rhs(0, x, 0, dx);\n"
      "  for (int i = 0; i < System::n; ++i) x[i] += run->t_end * dx[i];\n  outcome->status = "
      "42;\n}\n}\n";
  const fs::path object = compile(emit_module(specialised(kKovalevskaya), kernel)).path;
  const auto integrate =
      testing::entry<void(const double*, double*, int*)>(object, "casimir_integrate");
  ASSERT_NE(integrate, nullptr);
  double x[] = {1, 2, 3, 4, 5, 6};
  const double end = 1;
  int status = 0;
  integrate(&end, x, &status);
  EXPECT_EQ(status, 42);
  EXPECT_EQ(x[0], 1 + 2 * 3);
}

}  // namespace
}  // namespace casimir

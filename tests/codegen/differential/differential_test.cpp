// What is emitted for random systems, in every form and number type, against exact values; compiled
// by two compilers, with and without optimisation, and under sanitizers.
#include <cmath>
#include <cstdlib>

#include "tests/codegen/differential/differential.hpp"

namespace casimir {
namespace {

using testing::Expected;
using testing::Place;
using testing::Precision;
using testing::RandomSystem;

/// More of them with CASIMIR_DIFFERENTIAL_SYSTEMS, as in tools/check.
unsigned system_count() {
  const char* wanted = std::getenv("CASIMIR_DIFFERENTIAL_SYSTEMS");
  return wanted ? static_cast<unsigned>(std::atoi(wanted)) : 8;
}
constexpr unsigned kSystemsOfProgram = 40;

/// Errors of this many times epsilon and the size of what goes in are possible in one operation.
constexpr double kUnits = 2;

struct Build {
  const char* name;
  const char* compiler;
  std::vector<std::string> flags;
};

void PrintTo(const Build& build, std::ostream* out) { *out << build.name; }

const Build kBuilds[] = {
    {"GccO0", "g++", {"-O0"}},
    {"GccO2", "g++", {"-O2"}},
    {"GccO3", "g++", {"-O3", "-march=native"}},
    {"ClangO0", "clang++", {"-O0"}},
    {"ClangO2", "clang++", {"-O2"}},
    {"ClangO3", "clang++", {"-O3", "-march=native"}},
    {"Sanitizers",
     "g++",
     {"-O1", "-g1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"}},
};

struct Tally {
  unsigned long values = 0;
  unsigned long sharp = 0;  ///< for which a relative error of a thousandth would be found
  double worst = 0;         ///< error by bound
};

/// The deviation of three parts of a number from the exact one.
double error_of(const double* parts, const cln::cl_F& exact) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(parts[i])) return INFINITY;
  cln::cl_F rest = exact;
  for (int i = 0; i < 3; ++i) rest = rest - cln::cl_float(cln::cl_DF(parts[i]), exact);
  return std::fabs(cln::double_approx(rest));
}

void compare(const RandomSystem& system, const Place& place, const double*& values, Tally& tally) {
  const Precision precision = testing::precision_of(system.scalar());
  for (const Expected& e : system.expected(place)) {
    const double* const parts = values;
    values += 3;
    // What has left the range of the type may be anything on the way there.
    if (!(e.exact.size * e.operations < precision.largest / 1e10)) continue;
    const double error = error_of(parts, e.exact.value);
    const double bound =
        kUnits * e.operations * (precision.epsilon * e.exact.size + precision.least);
    const double magnitude = std::fabs(cln::double_approx(e.exact.value));
    ++tally.values;
    tally.sharp += bound < 1e-3 * magnitude || magnitude == 0;
    tally.worst = std::max(tally.worst, error / bound);
    EXPECT_LE(error, bound) << e.what << " is " << parts[0] << " and not " << magnitude << ", size "
                            << e.exact.size << ", number type " << static_cast<int>(system.scalar())
                            << ", of\n"
                            << system.text();
  }
}

void run_build(const Build& build, unsigned first, unsigned count, Tally& tally) {
  const testing::Folder folder;
  std::vector<RandomSystem> systems;
  std::string input;
  for (unsigned i = 0; i < count; ++i) {
    systems.emplace_back(first + i);
    for (const Place& place : systems.back().places()) {
      for (const auto* list : {&place.state, &place.deviation})
        input.append(reinterpret_cast<const char*>(list->data()), list->size() * sizeof(double));
      input.append(reinterpret_cast<const char*>(&place.time), sizeof(double));
    }
  }
  testing::write(folder / "driver.cpp", testing::driver(systems));
  testing::write(folder / "in", input);
  std::vector<std::string> flags{"-std=c++20", "-Wall", "-Wextra", "-Werror", "-pipe"};
  flags.insert(flags.end(), build.flags.begin(), build.flags.end());
  for (const std::string& last : {folder / "driver.cpp", std::string("-o"), folder / "driver"})
    flags.push_back(last);
  if (std::string(build.compiler) == "g++") flags.emplace_back("-lquadmath");
  const codegen::CompilerRun compiled = testing::run(build.compiler, flags, folder.path());
  ASSERT_TRUE(compiled.succeeded) << compiled.messages;
  const codegen::CompilerRun done =
      testing::run(folder / "driver", {folder / "in", folder / "out"}, folder.path());
  ASSERT_TRUE(done.succeeded) << done.messages;
  const std::string output = testing::read(folder / "out");
  std::vector<double> values(output.size() / sizeof(double));
  std::memcpy(values.data(), output.data(), output.size());
  const double* next = values.data();
  for (const RandomSystem& system : systems) {
    if (system.scalar() == Scalar::float128 && std::string(build.compiler) != "g++") continue;
    for (const Place& place : system.places()) compare(system, place, next, tally);
  }
  EXPECT_EQ(next, values.data() + values.size());
}

class Differential : public ::testing::TestWithParam<Build> {};

TEST_P(Differential, EveryFormOfRandomSystemsHasItsValue) {
  Tally tally;
  for (unsigned first = 0; first < system_count(); first += kSystemsOfProgram) {
    run_build(GetParam(), 1 + first, std::min(kSystemsOfProgram, system_count() - first), tally);
    if (HasFailure()) break;
  }
  RecordProperty("values", std::to_string(tally.values));
  RecordProperty("worst", std::to_string(tally.worst));
  std::printf("%u systems, %lu values, %.1f %% of them sharp, largest error %.3g of its bound\n",
              system_count(), tally.values,
              100. * static_cast<double>(tally.sharp) / static_cast<double>(tally.values),
              tally.worst);
  EXPECT_GT(tally.sharp, tally.values * 8 / 10);
}

INSTANTIATE_TEST_SUITE_P(Builds, Differential, ::testing::ValuesIn(kBuilds),
                         [](const auto& build) { return build.param.name; });

}  // namespace
}  // namespace casimir

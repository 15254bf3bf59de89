// casimir integrate --method auto: which method it begins with.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// A free top in n dimensions.
std::string top(int n) {
  std::string names, energy, start;
  for (int i = 1; i <= n; ++i) {
    for (int j = i + 1; j <= n; ++j) {
      const std::string name = "M" + std::to_string(i) + std::to_string(j);
      names += (names.empty() ? "\"" : ", \"") + name + "\"";
      energy += (energy.empty() ? "" : " + ") + name + "^2*" + std::to_string(i * 7 % 5 + j) + "/8";
      start +=
          (start.empty() ? "" : ", ") + name + " = \"" + std::to_string(i * j % 9 - 4) + "/5\"";
    }
  }
  return "hamiltonian = \"" + energy + "\"\n[phase_space]\nvariables = [" + names +
         "]\nalgebra = \"so(" + std::to_string(n) +
         ")\"\n[[scene]]\nname = \"default\"\ninitial = { " + start + " }\nduration = \"2\"\n";
}

nlohmann::ordered_json answered(const std::string& text, const std::vector<std::string>& more,
                                const Environment& environment = {}) {
  std::vector<std::string> words{"integrate", "-", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = run(words, text, environment);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.json();
}

double distance(const nlohmann::ordered_json& a, const nlohmann::ordered_json& b) {
  double largest = 0;
  for (const auto& [name, value] : a.at("state").items())
    largest = std::max(largest, std::abs(std::stod(value.get<std::string>()) -
                                         std::stod(b.at("state").at(name).get<std::string>())));
  return largest;
}

TEST(AutoMethod, ManyCompiledProductsAndFewDigitsAreForRungeKutta) {
  const auto few = answered(top(8), {"--tolerance", "1e-6"});
  EXPECT_EQ(few.at("method"), "dop853");
  const auto many = answered(top(8), {});
  EXPECT_EQ(many.at("method"), "taylor");
  EXPECT_LT(distance(few, many), 1e-4);
  EXPECT_GT(distance(few, many), 1e-13) << "they were the same run";
  // What was estimated is what is known of any other run.
  EXPECT_LT(distance(few, many),
            std::stod(few.at("trust").at("error_estimate").get<std::string>()) * 3);
}

/// The integral of log(1 + exp(1000 (t - 5))) from 0 to 10 is 12500 + Pi^2/6/1000; that of
/// 1/(1 + exp(10^5 (t - 1/2))) to 1 is 1/2.
TEST(AutoMethod, ExponentsBeyondAllDoublesAreKeptApart) {
  const auto scene = [](const std::string& rate, const char* duration) {
    return "[phase_space]\nvariables = [\"x\"]\ntime = \"t\"\n[equations]\nx = \"" + rate +
           "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"0\" }\nduration = \"" + duration +
           "\"\n";
  };
  const auto x = [](const nlohmann::ordered_json& answer) {
    return std::stod(answer.at("state").at("x").get<std::string>());
  };
  const double softplus = 12500 + std::pow(std::acos(-1), 2) / 6000;
  const std::string log = scene("log(1 + exp(1000*(t - 5)))", "10");
  for (const char* method : {"auto", "taylor", "gauss8"}) {
    const auto answer = answered(log, {"--method", method});
    EXPECT_NEAR(x(answer), softplus, 1e-8) << method;
  }
  EXPECT_NE(answered(log, {}).at("chosen").get<std::string>().find("taken out of logarithms"),
            std::string::npos);
  const std::string front = scene("1/(1 + exp(100000*(t - 1/2)))", "1");
  EXPECT_NEAR(x(answered(front, {"--method", "taylor"})), 0.5, 1e-9);
}

TEST(AutoMethod, WhatNeedsNoCompilerStaysWithTables) {
  for (const char* tolerance : {"1e-3", "1e-6", "1e-12"})
    EXPECT_EQ(answered(top(5), {"--tolerance", tolerance}).at("method"), "taylor") << tolerance;
}

TEST(AutoMethod, BranchesAndConstantStepsStayWithTaylorSeries) {
  EXPECT_EQ(answered(top(8), {"--tolerance", "1e-6", "--step", "0.01"}).at("method"), "taylor");
  std::string text = top(8);
  const std::string what = "hamiltonian = \"";
  text.replace(text.find(what), what.size(), what + "abs(M12) + ");
  EXPECT_EQ(answered(text, {"--tolerance", "1e-6"}).at("method"), "taylor");
}

/// A body with a rotor, for that long.
std::string gyrostat(const std::string& duration, const std::string& more = "") {
  return "hamiltonian = \"(M1^2 + M2^2/2 + M3^2/3)/2 + M1/10 + M2/5 + M3/3" + more +
         "\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\"]\nalgebra = \"so(3)\"\n"
         "[[scene]]\nname = \"default\"\ninitial = { M1 = \"1\", M2 = \"1/2\", M3 = \"1/3\" }\n"
         "duration = \"" +
         duration + "\"\n";
}

TEST(AutoMethod, LongRunsAreByTheClosedFormWhereThereIsOne) {
  const auto closed = answered(gyrostat("1000000"), {});
  EXPECT_EQ(closed.at("method"), "exact");
  const auto stepped = answered(gyrostat("1000000"), {}, {{"CASIMIR_CLOSED_FORMS", "off"}});
  EXPECT_EQ(stepped.at("method"), "taylor");
  const auto estimate = [](const nlohmann::ordered_json& run) {
    return std::stod(run.at("trust").at("error_estimate").get<std::string>());
  };
  EXPECT_LT(estimate(closed), 1e-15);
  EXPECT_GT(estimate(stepped), 1e-14);
  EXPECT_LT(distance(closed, stepped), estimate(closed) + estimate(stepped));
  EXPECT_EQ(answered(gyrostat("3000"), {}).at("method"), "taylor");
  const Folder folder;
  const std::string table = (folder.path() / "t.csv").string();
  EXPECT_EQ(answered(gyrostat("1000000"), {"--every", "100", "--output", table}).at("method"),
            "taylor")
      << "so many samples take less by steps";
  EXPECT_EQ(answered(gyrostat("1000000", " + M1^4/1000"), {"--tolerance", "1e-6"}).at("method"),
            "taylor");
}

// The same by the sizes of its numbers, and less than a period.
TEST(AutoMethod, AShortRunWithLargeNumbersIsNotByTheClosedForm) {
  const auto run = answered(
      "[phase_space]\nvariables = [\"q\", \"p\"]\n[equations]\nq = \"p/10^20\"\n"
      "p = \"-10^6*sin(q)\"\n[[scene]]\nname = \"default\"\n"
      "initial = { q = \"1\", p = \"0\" }\nduration = \"10\"\n",
      {});
  EXPECT_EQ(run.at("method"), "taylor");
  // -10^7 sin(1) but for 10^-12 of it.
  EXPECT_NEAR(std::stod(run.at("state").at("p").get<std::string>()) / -1e7, std::sin(1.), 2e-12);
}

TEST(AutoMethod, WhereTheSignOfZeroIsTakenAllAlongThereIsNoMotion) {
  const Folder folder;
  const auto scene = [&](const char* rate) {
    folder.write("a.toml",
                 std::string("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"") +
                     rate +
                     "\"\ny = \"sign(x)\"\n[[scene]]\nname = \"default\"\n"
                     "initial = { x = \"0\", y = \"0\" }\nduration = \"1\"\n");
  };
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, {"--method", "dop853"}, {"--digits", "20"}}) {
    std::vector<std::string> command = {"integrate", "./a.toml"};
    command.insert(command.end(), how.begin(), how.end());
    scene("0");
    const Outcome rests = run_in(folder, command);
    EXPECT_EQ(rests.status, 5);
    EXPECT_NE(rests.err.find("the sign of 0"), std::string::npos) << rests.err;
    scene("1");  // it leaves, and only begins there
    EXPECT_EQ(run_in(folder, command).status, 0);
  }
}

TEST(AutoMethod, WhereDryFrictionHoldsABodyThereIsNoSolution) {
  const Folder folder;
  const auto scene = [&](const char* friction) {
    folder.write("a.toml", std::string("[phase_space]\nvariables = [\"x\", \"v\"]\n[equations]\n"
                                       "x = \"v\"\nv = \"-x - ") +
                               friction +
                               "*sign(v)\"\n[[scene]]\nname = \"default\"\n"
                               "initial = { x = \"1\", v = \"0\" }\nduration = \"20\"\n");
  };
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, {"--method", "dop853"}, {"--digits", "20"}}) {
    std::vector<std::string> command = {"integrate", "./a.toml", "--json"};
    command.insert(command.end(), how.begin(), how.end());
    scene("3/10");  // it turns at 1, -2/5 and -1/5, where friction is stronger
    const Outcome held = run_in(folder, command);
    EXPECT_EQ(held.status, 5) << held.err;
    EXPECT_EQ(held.json().at("status"), "at_jump");
    EXPECT_NEAR(std::stod(held.json().at("stopped").at("time").get<std::string>()), 2 * M_PI, 1e-4);
    scene("1/1000");  // goes on all the time
    EXPECT_EQ(run_in(folder, command).status, 0);
  }
}

// y' = x/sqrt(1 + x^2) is 1 and not 0 where x^2 is beyond all doubles.
TEST(AutoMethod, ANumberBeyondAllDoublesIsNotDividedBySilently) {
  const Folder folder;
  const auto run = [&](const char* x, const char* dy, const std::vector<std::string>& how) {
    folder.write("a.toml", std::string("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\n"
                                       "x = \"0\"\ny = \"") +
                               dy + "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"" + x +
                               "\", y = \"0\" }\nduration = \"2\"\n");
    std::vector<std::string> command = {"integrate", "./a.toml", "--json"};
    command.insert(command.end(), how.begin(), how.end());
    return run_in(folder, command);
  };
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, {"--method", "dop853"}, {"--method", "radau9"}}) {
    const Outcome wrong = run("10^200", "x/sqrt(1 + x^2)", how);
    EXPECT_EQ(wrong.status, 5);
    EXPECT_EQ(wrong.json().at("status"), "non_finite");
    EXPECT_EQ(run("10^100", "x/sqrt(1 + x^2)", how).status, 0);
    EXPECT_EQ(run("1000", "1/(1 + exp(x))", how).status, 0);  // 0 to all digits
  }
  const Outcome right = run("10^200", "x/sqrt(1 + x^2)", {"--digits", "20"});
  EXPECT_EQ(right.json().at("state").at("y"), "2");
}

// For a time, or for an angle.
TEST(AutoMethod, WhereTheEquationsHaveNoValueForATimeThereIsNoMotion) {
  const Folder folder;
  const auto status = [&](const std::string& dx, const std::string& dy,
                          const std::vector<std::string>& how) {
    folder.write("a.toml",
                 "[phase_space]\nvariables = [\"x\", \"y\"]\ntime = \"t\"\n[equations]\nx = \"" +
                     dx + "\"\ny = \"" + dy +
                     "\"\n[[scene]]\nname = \"default\"\n"
                     "initial = { x = \"0\", y = \"0\" }\nduration = \"3\"\n");
    std::vector<std::string> command = {"integrate", "./a.toml"};
    command.insert(command.end(), how.begin(), how.end());
    return run_in(folder, command).status;
  };
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, {"--method", "dop853"}, {"--digits", "20"}}) {
    EXPECT_EQ(status("abs(t - 1) + t - 1", "1 + sign(x)", how), 5);  // x is 0 up to t = 1
    EXPECT_EQ(status("t", "1 + sign(x)", how), 0);
    const bool begins_there = how.empty() || how[0] != "--digits";
    EXPECT_EQ(status("0", "1 + atan2(x, 2*x)", how), 5);
    if (begins_there) {
      EXPECT_EQ(status("1", "1 + atan2(x, 2*x)", how), 0);
    }
  }
  folder.write("e.csv", "x\n0\n1\n");
  ASSERT_EQ(status("0", "1 + sign(x)", {}), 5);
  const Outcome members =
      run_in(folder, {"integrate", "./a.toml", "--ensemble", "e.csv", "--json"});
  EXPECT_EQ(members.status, 5);
  EXPECT_NE(members.out.find("at_jump"), std::string::npos) << members.out;
}

TEST(AutoMethod, WithoutACompilerItIsTaylorSeriesAgain) {
  const Folder cache;
  const auto run =
      answered(top(8), {"--tolerance", "1e-6"},
               {{"PATH", "/nonexistent"}, {"CXX", ""}, {"CASIMIR_CACHE", cache.path().string()}});
  EXPECT_EQ(run.at("method"), "taylor");
  EXPECT_NE(run.at("warnings").dump().find("interpreted"), std::string::npos);
}

}  // namespace
}  // namespace casimir::test

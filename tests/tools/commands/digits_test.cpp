// integrate --digits: end states that were computed elsewhere, and what the command says.
#include <gtest/gtest.h>

#include <map>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using State = std::map<std::string, std::string>;

/// The mantissa digits of a number without zeros in front, and its decimal exponent.
std::pair<std::string, int> scientific(const std::string& text) {
  const std::size_t e = text.find('e');
  std::string digits = text.substr(0, e);
  int exponent = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
  std::string sign;
  if (digits[0] == '-') sign = "-", digits.erase(0, 1);
  std::size_t point = digits.find('.');
  if (point == std::string::npos)
    point = digits.size();
  else
    digits.erase(point, 1);
  const std::size_t zeros = digits.find_first_not_of('0');
  exponent += static_cast<int>(point) - static_cast<int>(zeros) - 1;
  return {sign + digits.substr(zeros), exponent};
}

/// Expects `got` to begin with the digits of `reference`, all but the last.
void expect_digits(const std::string& got, const std::string& reference) {
  const auto [a, ea] = scientific(got);
  const auto [b, eb] = scientific(reference);
  EXPECT_EQ(ea, eb) << got;
  EXPECT_EQ(a.substr(0, b.size() - 2), b.substr(0, b.size() - 2));
}

const std::string kEuler = R"toml(
hamiltonian = "M1^2/2 + M2^2/4 + M3^2/8"
[phase_space]
variables = ["M1", "M2", "M3"]
algebra = "so(3)"
[casimirs]
G2 = "M1^2 + M2^2 + M3^2"
[[scene]]
name = "near"
initial = { M1 = "1*10^(-9)", M2 = "1", M3 = "0" }
duration = "400"
[[scene]]
name = "nearer"
initial = { M1 = "1*10^(-12)", M2 = "1", M3 = "0" }
duration = "400"
)toml";

const std::string kHeavyTop = R"toml(
hamiltonian = "M1^2/2 + 3*M2^2/8 + M3^2/4 + g1/2 + g2/4 + g3"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[[scene]]
name = "chaotic"
initial = { M1 = "1", M2 = "1/2", M3 = "1/4", g1 = "3/5", g2 = "0", g3 = "4/5" }
duration = "100"
)toml";

const std::string kKovalevskaya = R"toml(
hamiltonian = "M1^2/2 + M2^2/2 + M3^2 - g1"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[integrals]
K = "(2*M1*M2 + 2*g2)^2 + (M1^2 - M2^2 + 2*g1)^2"
[[scene]]
name = "generic"
initial = { M1 = "1", M2 = "1/2", M3 = "1/4", g1 = "3/5", g2 = "0", g3 = "4/5" }
duration = "100"
)toml";

/// A heavy top in Euler's angles that passes 1e-4 from gimbal lock.
const std::string kGimbal = R"toml(
hamiltonian = "(ptheta*cos(phi) + (-pphi*cos(theta) + ppsi)*sin(phi)/sin(theta))^2/2 + (-ptheta*sin(phi) + (-pphi*cos(theta) + ppsi)*cos(phi)/sin(theta))^2/4 + 3*pphi^2/8 + sin(phi)*sin(theta)/2 + sin(theta)*cos(phi)/4 + cos(theta)"
[phase_space]
variables = ["theta", "phi", "psi", "ptheta", "pphi", "ppsi"]
canonical = true
[[scene]]
name = "pass"
initial = { theta = "1.2056081274137578", phi = "-0.4378603170563881", psi = "0", ptheta = "1.2791879322512945", pphi = "1.0709094770980152", ppsi = "0.25010913978126637" }
duration = "6"
)toml";

/// Robertson's reaction: stiff, and the second state is 1e-5 of the others.
const std::string kRobertson = R"toml(
[phase_space]
variables = ["y1", "y2", "y3"]
[equations]
y1 = "-y1/25 + 10000*y2*y3"
y2 = "y1/25 - 10000*y2*y3 - 30000000*y2^2"
y3 = "30000000*y2^2"
[[scene]]
name = "short"
initial = { y1 = "1", y2 = "0", y3 = "0" }
duration = "40"
)toml";

struct Known {
  const char* name;
  const std::string& file;
  std::vector<std::string> arguments;
  State state;
};

/// End states to 34 digits by a Taylor solver in another language, checked by closed forms where
/// there are any.
const Known kKnown[] = {
    {"kovalevskaya",
     kKovalevskaya,
     {"--scene", "generic"},
     {{"M1", "9.314032994660502364310950999798322e-1"},
      {"M2", "-7.727771548496725187650202251736759e-1"},
      {"M3", "-2.165199782262415614360373243103645e-1"},
      {"g1", "6.917292196279919174252871365318238e-1"},
      {"g2", "8.284220645188389721404163384672686e-4"},
      {"g3", "-7.221564930330075899430591212925448e-1"}}},
    {"separatrix",
     kEuler,
     {"--scene", "near"},
     {{"M1", "8.639496942000111748303514616053788e-5"},
      {"M2", "-9.999999888038638271988750607091428e-1"},
      {"M3", "1.22180937466389806925982010120541e-4"}}},
    {"beyond_double",
     kEuler,
     {"--scene", "nearer"},
     {{"M1", "3.974807481612881461283156301758248e-1"},
      {"M2", "7.252773018118158991323645076389303e-1"},
      {"M3", "-5.621226648318983587774675239529985e-1"}}},
    {"chaotic",
     kHeavyTop,
     {"--scene", "chaotic"},
     {{"M1", "2.026413899406182718907524704896139"},
      {"M2", "-7.478128923433312858843543464271304e-1"},
      {"M3", "5.351611441490297739502454212712415e-1"},
      {"g1", "5.142296204368305357535277469322575e-1"},
      {"g2", "-2.609909119076071724928246056676686e-1"},
      {"g3", "-8.16977136379610584030704908517189e-1"}}},
    {"gimbal",
     kGimbal,
     {"--scene", "pass"},
     {{"theta", "1.632331567503123943530540102322157"},
      {"phi", "-3.80503428588296405436852131473014"},
      {"psi", "5.007616634161846000229985948383109"},
      {"ptheta", "-7.118398018920469020235900324017928e-1"},
      {"pphi", "-1.863063917254247448063122931200254"},
      {"ppsi", "2.5010913978126637e-1"}}},
    {"robertson",
     kRobertson,
     {"--scene", "short"},
     {{"y1", "7.158270687194050904744737512050263e-1"},
      {"y2", "9.185534764557763903899212577750991e-6"},
      {"y3", "2.841637457458303517616223495823959e-1"}}},
};

class Digits : public testing::TestWithParam<Known> {};

TEST_P(Digits, AreThoseOfTheReference) {
  std::vector<std::string> arguments = {"integrate", "-", "--digits", "36", "--json"};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const Outcome outcome = run(arguments, GetParam().file);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json.at("status"), "ok");
  EXPECT_EQ(json.at("method"), "taylor");
  EXPECT_EQ(json.at("trust").at("digits"), 36);
  for (const auto& [name, value] : GetParam().state) {
    SCOPED_TRACE(name);
    expect_digits(json.at("state").at(name), value);
  }
  for (const auto& [name, invariant] : json.at("invariants").items()) {
    SCOPED_TRACE(name);
    EXPECT_LT(std::stod(invariant.at("drift").get<std::string>()), 1e-30);
    EXPECT_EQ(invariant.at("initial").get<std::string>().substr(0, 30),
              invariant.at("final").get<std::string>().substr(0, 30));
  }
}
INSTANTIATE_TEST_SUITE_P(Tools, Digits, testing::ValuesIn(kKnown),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Digits, JsonHasTheKeysOfTheInterface) {
  const auto json =
      run({"integrate", "-", "--scene", "near", "--digits", "20", "--json"}, kEuler).json();
  for (const char* key :
       {"case", "scene", "method", "tolerance", "status", "t", "state", "invariants", "steps",
        "rejected", "evaluations", "seconds", "left_out", "warnings", "trust"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"conditioning", "input_rounding", "error_estimate", "beyond_double"})
    EXPECT_TRUE(json.at("trust").contains(key)) << key;
  EXPECT_FALSE(json.contains("stopped"));
  // The passages of the separatrix cost more digits than a run has to spare: they are made up for.
  EXPECT_GE(json.at("trust").at("digits_lost"), 5);
  EXPECT_LT(std::stod(json.at("trust").at("error_estimate").get<std::string>()), 1e-20);
}

TEST(Digits, BlowUpNamesTheTimeToAllDigits) {
  const std::string file = R"toml(
[phase_space]
variables = ["x", "y"]
[equations]
x = "2*x^2 + x*y"
y = "-x^2 - 2*x*y"
[[scene]]
name = "escape"
initial = { x = "1", y = "1/2" }
duration = "10"
)toml";
  const Outcome outcome =
      run({"integrate", "-", "--scene", "escape", "--digits", "40", "--json"}, file);
  EXPECT_EQ(outcome.status, 5);
  const auto json = outcome.json();
  EXPECT_EQ(json.at("status"), "singularity");
  expect_digits(json.at("stopped").at("time"), "5.047517551399477966592256723656299e-1");
  EXPECT_NE(outcome.err.find("0.50475175513994779665922567236562"), std::string::npos)
      << outcome.err;
  EXPECT_LT(std::stod(json.at("t").get<std::string>()), 0.5047517552);
}

TEST(Digits, SamplesAndDurationAreExact) {
  const Folder folder;
  const std::string file = R"toml(
[phase_space]
variables = ["q", "p"]
[equations]
q = "p"
p = "-q"
[[scene]]
name = "circle"
initial = { q = "0", p = "sqrt(2)" }
duration = "1"
)toml";
  const Outcome outcome =
      run_in(folder,
             {"integrate", "-", "--scene", "circle", "--digits", "40", "--duration", "-Pi/4",
              "--output", "s.csv", "--every", "0.1", "--json"},
             file);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("state").at("q"), "-1");
  EXPECT_EQ(outcome.json().at("state").at("p"), "1");
  std::istringstream lines(file_text(folder.path() / "s.csv"));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  ASSERT_EQ(all.size(), 10U);
  EXPECT_EQ(all[0], "t,q,p");
  EXPECT_EQ(all[1], "0,0,1.41421356237309504880168872420969807857");
  EXPECT_EQ(all[2].substr(0, 5), "-0.1,");
  EXPECT_EQ(all[9], "-0.7853981633974483096156608458198757210493,-1,1");
}

TEST(Digits, LimitsEndTheRun) {
  const Outcome few =
      run({"integrate", "-", "--scene", "chaotic", "--digits", "30", "--max-steps", "5", "--json"},
          kHeavyTop);
  EXPECT_EQ(few.status, 5);
  EXPECT_EQ(few.json().at("status"), "max_steps");
  EXPECT_EQ(few.json().at("trust").at("digits"), 30);
  const Outcome late = run(
      {"integrate", "-", "--scene", "chaotic", "--digits", "1000", "--time-limit", "1", "--json"},
      kHeavyTop);
  EXPECT_EQ(late.status, 4);
  EXPECT_EQ(late.json().at("status"), "stopped");
}

TEST(Digits, WhatDoesNotFitIsRefused) {
  const auto refused = [](std::vector<std::string> more, const std::string& words) {
    std::vector<std::string> arguments = {"integrate", "-", "--scene", "near"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments, kEuler);
    EXPECT_EQ(outcome.status, 2) << words;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  };
  refused({"--digits", "16"}, "double precision");
  refused({"--digits", "1000000"}, "at most");
  refused({"--digits", "ten"}, "--digits");
  refused({"--digits", "30", "--method", "dop853"}, "only taylor");
  refused({"--digits", "30", "--tolerance", "1e-9"}, "the digits are the tolerance");
  refused({"--digits", "30", "--step", "0.1"}, "--step");
  refused({"--digits", "30", "--ensemble", "members.csv"}, "--ensemble");
  refused({"--digits", "30", "--every", "1"}, "--output");
  EXPECT_EQ(
      run({"integrate", "-", "--scene", "near", "--digits", "17", "--method", "taylor", "--quiet"},
          kEuler)
          .status,
      0);
}

/// A system of x and y, run with thirty digits.
Outcome two_equations(const std::string& x, const std::string& y, const std::string& start,
                      const std::string& digits = "30") {
  const Folder folder;
  const std::string file = folder.write(
      "two.toml", "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"" + x +
                      "\"\ny = \"" + y + "\"\n[[scene]]\nname = \"default\"\ninitial = { " + start +
                      " }\nduration = \"1\"\n");
  return run_in(folder, {"integrate", file, "--digits", digits, "--json"});
}

/// 1 - cos(y) has no digit left of 30 or 40 where y is 10^(-40), in both of two runs.
TEST(DigitsOf, ADifferenceThatLosesAllOfThem) {
  const Outcome outcome =
      two_equations("(1 - cos(y))/y^2", "0", "x = \"0\", y = \"10^(-40)\"", "60");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("state").at("x"), "0.5");
  const Outcome few = two_equations("(1 - cos(y))/y^2", "0", "x = \"0\", y = \"10^(-40)\"");
  // Fewer digits are right as well, or refused.
  EXPECT_TRUE(few.status == 5 || few.json().at("state").at("x") == "0.5") << few.out;
}

/// Two zeros of the argument are nearer to each other than doubles tell.
TEST(DigitsOf, KinksAndJumpsThatDoublesDoNotSee) {
  const Outcome kinks = two_equations("1", "abs(x^2 - 10^(-12))", "x = \"-1/3\", y = \"0\"");
  ASSERT_EQ(kinks.status, 0) << kinks.err;
  // 1/9 - 10^(-12) + 8/3*10^(-18)
  EXPECT_EQ(kinks.json().at("state").at("y"), "0.111111111110111113777777777778");
  const Outcome jumps = two_equations("1", "sign(x^2 - 10^(-40))", "x = \"-1/3\", y = \"0\"");
  ASSERT_EQ(jumps.status, 0) << jumps.err;
  EXPECT_EQ(jumps.json().at("state").at("y"), "0.99999999999999999996");
  const Outcome none = two_equations("1", "abs(x^2 + 10^(-40))", "x = \"-1/3\", y = \"0\"");
  ASSERT_EQ(none.status, 0) << none.err;
  EXPECT_EQ(none.json().at("state").at("y"), "0.111111111111111111111111111111");
}

/// The difference is 0 among doubles, all the time.
TEST(DigitsOf, ASignThatDoublesDoNotSee) {
  const Outcome outcome = two_equations("sign(y - 1)", "0", "x = \"0\", y = \"1 + 10^(-20)\"");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("state").at("x"), "1");
}

/// The integral is a number that doubles have, but not as a normal one.
TEST(DigitsOf, AnIntegralBelowTheNormalDoubles) {
  const Folder folder;
  folder.write("a.toml", R"toml(
[phase_space]
variables = ["x", "y"]
[equations]
x = "-y"
y = "x"
[integrals]
R = "x^2 + y^2"
[[scene]]
name = "default"
initial = { x = "3/10^161", y = "4/10^161" }
duration = "1"
)toml");
  const Outcome outcome = run_in(folder, {"integrate", "./a.toml", "--digits", "20", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2.5e-321"), std::string::npos) << outcome.out;
}

/// w = x - BIG c s stays at 0 until long after it may leave it, and z, beside BIG c, shows whether
/// it has left.
std::string latch_behind(const std::string& big) {
  std::string text = R"toml([phase_space]
variables = ["c", "s", "x", "z"]
[equations]
c = "-s"
s = "c"
x = "BIG*(c^2 - s^2) + 200*(c - 2/5)*(x - BIG*c*s) - (x - BIG*c*s)^3"
z = "-BIG*s + 10*(x - BIG*c*s)^2*(1 - z + BIG*c)"
[[scene]]
name = "default"
initial = { c = "-1", s = "0", x = "1/1000", z = "-BIG" }
duration = "2*Pi"
)toml";
  const std::string mark = "BIG";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
    text.replace(at, mark.size(), big);
  return text;
}

// Rounding leaves what a motion stays on, w = 0 or the top of a pendulum, at other times with
// other digits, and at the end there is no trace of when.
TEST(DigitsOf, AMotionThatRoundingDecides) {
  const Folder folder;
  for (const auto& [big, digits] : {std::pair{"1", "20"}, {"1", "50"}, {"100000", "30"}}) {
    folder.write("latch.toml", latch_behind(big));
    const Outcome outcome =
        run_in(folder, {"integrate", "./latch.toml", "--digits", digits, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NEAR(number(outcome.json().at("state").at("z")) + std::stod(big), 1.78571833397692310e-8,
                1e-10)
        << big << ' ' << digits;
  }
  folder.write("top.toml", R"toml(hamiltonian = "p^2/2 - cos(q)"
[phase_space]
variables = ["q", "p"]
canonical = true
[[scene]]
name = "default"
initial = { q = "Pi", p = "0" }
duration = "250"
)toml");
  const Outcome top = run_in(folder, {"integrate", "./top.toml", "--digits", "22", "--json"});
  EXPECT_NEAR(number(top.json().at("state").at("q")), std::acos(-1.), 1e-12) << top.out;
}

TEST(DigitsOf, APartThatCancelsIsWarnedOf) {
  const Outcome outcome = two_equations("sqrt(x)^2 - 2", "0", "x = \"1\", y = \"0\"");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.json().at("warnings").dump().find("sqrt(x)"), std::string::npos);
}

/// exp(-10^7) has four million zeros behind its point, which nothing needs to write down.
TEST(DigitsOf, ANumberBeyondDoublesArePrintedByItsExponent) {
  const Folder folder;
  folder.write("small.toml", R"toml([phase_space]
variables = ["x"]
[equations]
x = "exp(-10^7)"
[[scene]]
name = "default"
initial = { x = "0" }
duration = "1"
)toml");
  const Outcome plain = run_in(folder, {"integrate", "./small.toml", "--digits", "20", "--json"});
  ASSERT_EQ(plain.status, 0) << plain.err;
  EXPECT_EQ(plain.json().at("state").at("x"), "1.5169367808987343576e-4342945");
  const Outcome box =
      run_in(folder, {"integrate", "./small.toml", "--digits", "20", "--validated", "--json"});
  ASSERT_EQ(box.status, 0) << box.err;
  EXPECT_TRUE(has(box.out, "e-6021")) << box.out;
}

}  // namespace
}  // namespace casimir::test

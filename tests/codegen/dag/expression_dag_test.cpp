#include "codegen/dag/expression_dag.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/error.hpp"

namespace casimir::codegen {
namespace {

using GiNaC::ex;

struct Symbols {
  GiNaC::symbol x{"x"}, y{"y"}, z{"z"}, a{"a"};
  Dag dag{{x, y, z, a}, 3};
  std::string text(const ex& e) { return dag.text(dag.convert(e)); }
};

std::string message(Symbols& s, const ex& e) {
  try {
    s.dag.convert(e);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(Canonical, OrdersByDegreeAndThenByTheCoordinates) {
  Symbols s;
  EXPECT_EQ(s.text(s.a + s.z + s.x * s.y - 2 * s.x + s.y * s.y + 7), "x*y + y^2 - 2*x + z + a + 7");
  EXPECT_EQ(s.text(s.x / 2 - s.a * s.y / 3), "x/2 - y*a/3");
}

TEST(Canonical, DegreesOrderTerms) {
  // x stands for something quadratic and y for a parameter.
  const GiNaC::symbol x("x"), y("y"), z("z");
  Dag dag({x, y, z}, std::vector<int>{2, 0, 1});
  EXPECT_EQ(dag.text(dag.convert(z + x + y)), "x + z + y");
  Dag plain({x, y, z}, 3);
  EXPECT_EQ(plain.text(plain.convert(z + x + y)), "x + y + z");
}

TEST(Canonical, OrderDoesNotFollowTheCreationOfSymbols) {
  std::vector<std::string> texts;
  for (int permutation = 0; permutation < 6; ++permutation) {
    std::vector<std::string> names{"x", "y", "z"};
    for (int i = 0; i < permutation; ++i) std::next_permutation(names.begin(), names.end());
    std::map<std::string, GiNaC::symbol> s;
    std::vector<GiNaC::symbol> clutter(static_cast<std::size_t>(permutation * 7));
    for (const std::string& name : names) s.emplace(name, GiNaC::symbol(name));
    const ex e = pow(s["x"] - s["y"], 2) * sin(s["y"] - s["z"]) / pow(s["z"] - s["x"], 3) +
                 sqrt(s["x"] + s["y"] * s["z"]) * (s["x"] - s["z"]);
    Dag dag({s["x"], s["y"], s["z"]}, 3);
    texts.push_back(dag.text(dag.convert(e)));
  }
  for (const std::string& text : texts) EXPECT_EQ(text, texts[0]);
}

TEST(Canonical, DifferencesHaveOneSign) {
  Symbols s;
  const Scaled forward = s.dag.convert(s.x - s.y);
  const Scaled backward = s.dag.convert(s.y - s.x);
  EXPECT_EQ(forward.node, backward.node);
  EXPECT_EQ(forward.coefficient, -backward.coefficient);
  EXPECT_EQ(s.dag.convert(pow(s.y - s.x, 2)).node, s.dag.convert(pow(s.x - s.y, 2)).node);
  EXPECT_EQ(s.dag.convert(pow(s.y - s.x, 3)).coefficient, -1);
  // But not inside a root, where the sign matters.
  EXPECT_NE(s.dag.convert(sqrt(s.y - s.x)).node, s.dag.convert(sqrt(s.x - s.y)).node);
  EXPECT_EQ(s.text(sqrt(s.y - s.x)), "sqrt(-x + y)");
  EXPECT_EQ(s.text(sqrt(s.y - s.x) * sqrt(s.y - s.x)), "-x + y");
}

TEST(Canonical, EqualExpressionsAreOneNode) {
  Symbols s;
  EXPECT_EQ(s.dag.convert(2 * s.x + 4 * s.y).node, s.dag.convert(-s.x / 3 - 2 * s.y / 3).node);
  EXPECT_NE(s.dag.convert(2 * s.x + 4 * s.y).node, s.dag.convert(2 * s.x + 3 * s.y).node);
  EXPECT_EQ(s.text(sqrt(ex(8)) * sqrt(ex(2))), "4");
  EXPECT_EQ(s.text(atan(s.x)), "atan2(x, 1)");
  EXPECT_EQ(s.text(pow(s.x, s.y)), "exp(y*log(x))");
  EXPECT_EQ(s.text(sin(s.y - s.x) + cos(s.y - s.x)), "-sin(x - y) + cos(x - y)");
}

TEST(Canonical, RootsOfADifferenceAndItsPowersAreOneBase) {
  // The normal form of 1 - x is x - 1; under a root it cannot change its sign.
  Symbols s;
  const ex root = sqrt(1 - s.x);
  EXPECT_EQ(s.text(root / (1 - s.x)), s.text(pow(1 - s.x, ex(-1) / 2)));
  EXPECT_EQ(s.text((s.x - 1) * root), s.text(-pow(1 - s.x, ex(3) / 2)));
  EXPECT_EQ(s.text(pow(s.x - 1, 2) * s.y / root), s.text(s.y * pow(1 - s.x, ex(3) / 2)));
  EXPECT_EQ(s.text(root * root), "-x + 1");
}

TEST(Canonical, RefusesWhatIsNotRealOrNotKnown) {
  Symbols s;
  EXPECT_NE(message(s, s.x + sqrt(ex(-2))).find("negative number -2"), std::string::npos);
  EXPECT_NE(message(s, s.x * GiNaC::I).find("imaginary number I"), std::string::npos);
  EXPECT_NE(message(s, asinh(s.x)).find("unknown function 'asinh'"), std::string::npos);
  EXPECT_NE(message(s, s.x + GiNaC::symbol("w")).find("unknown symbol 'w'"), std::string::npos);
  EXPECT_NE(message(s, s.x * GiNaC::numeric(0.5)).find("not exact"), std::string::npos);
  EXPECT_NE(message(s, s.x + GiNaC::Euler).find("Euler"), std::string::npos);
  EXPECT_EQ(message(s, s.x + GiNaC::Pi), "");
}

TEST(Canonical, PrintedTextHasTheParenthesesItNeeds) {
  Symbols s;
  EXPECT_EQ(s.text(pow(s.x + s.y, 2) * s.z), "z*(x + y)^2");
  EXPECT_EQ(s.text(s.x / (s.y * s.z)), "x/(y*z)");
  EXPECT_EQ(s.text(-s.x * (s.y + 1)), "-x*(y + 1)");
  EXPECT_EQ(s.text(pow(s.x, ex(-3) / 2)), "1/x^(3/2)");
  EXPECT_EQ(s.text(-ex(1) / 2), "-1/2");
}

}  // namespace
}  // namespace casimir::codegen

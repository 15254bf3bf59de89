// What a scene does not need is left out: seen on bodies of the book, by comparing the code of one
// case with that of a simpler one.
#include <gtest/gtest.h>

#include <map>

#include "codegen/emit_cpp.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using Values = std::map<std::string, std::string>;

ParameterValues fixed(const Values& values) {
  ParameterValues result;
  for (const auto& [name, value] : values)
    result.push_back({Text{name, {"test", 1, 1}, name}, Text{value, {"test", 1, 1}, value}});
  return result;
}

Specialisation generated(const std::string& name, const std::string& scene, const Values& values) {
  const CaseFile file = read_case(CASIMIR_SOURCE_DIR "/cases/" + name + ".toml");
  const Model model = build_model(file, fixed(values));
  return specialise(model, model.scene(scene));
}

/// The body of the function `rhs` as it is emitted.
std::string rhs_code(const Specialisation& spec) {
  const std::string header = emit_header(spec);
  const std::size_t begin = header.find("inline void rhs(");
  return header.substr(begin, header.find("\n}\n", begin) - begin);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// Aligned comments depend on the lengths of names.
std::string without_doubled_spaces(std::string text) {
  while (text.find("  ") != std::string::npos) text = replaced(text, "  ", " ");
  return text;
}

int operations(const OperationCount& count) {
  return count.mul + count.add + count.div + count.calls;
}

const Values kTop = {{"a1", "1"}, {"a2", "1/2"}, {"a3", "1/3"},
                     {"r1", "1"}, {"r2", "1/2"}, {"r3", "1/3"}};

Values and_also(Values values, const Values& more) {
  for (const auto& [name, value] : more) values[name] = value;
  return values;
}

TEST(LeftOut, TwelveVariableBodyIsTheHeavyTopWhereOnlyTheVerticalIsObserved) {
  const Specialisation body = generated("direction-cosines", "momentum-and-vertical", kTop);
  EXPECT_EQ(body.states,
            (std::vector<std::string>{"M1", "M2", "M3", "gamma1", "gamma2", "gamma3"}));
  const Specialisation top = generated("euler-poisson", "default", kTop);
  EXPECT_EQ(without_doubled_spaces(replaced(rhs_code(body), "gamma", "g")),
            without_doubled_spaces(rhs_code(top)));
  EXPECT_EQ(std::ranges::count(body.left_out, "state", &LeftOut::kind), 6);
  // The twin: with everything observed, all of it stays.
  EXPECT_EQ(generated("direction-cosines", "default", kTop).states.size(), 12U);
}

TEST(LeftOut, GyrostatWithoutMomentumOfItsRotorIsThePlainTop) {
  const Values at_rest = and_also(kTop, {{"k1", "0"}, {"k2", "0"}, {"k3", "0"}});
  const Values spinning = and_also(kTop, {{"k1", "0"}, {"k2", "0"}, {"k3", "1"}});
  const std::string top = rhs_code(generated("euler-poisson", "default", kTop));
  EXPECT_EQ(rhs_code(generated("heavy-gyrostat", "default", at_rest)), top);
  EXPECT_NE(rhs_code(generated("heavy-gyrostat", "default", spinning)), top);
}

TEST(LeftOut, EqualMomentsOfInertiaDropTheirTerms) {
  const Specialisation different = generated("euler-poisson", "default", {});
  const Specialisation two = generated("euler-poisson", "default", {{"a2", "1"}});
  const Specialisation three = generated("euler-poisson", "default", {{"a2", "1"}, {"a3", "1"}});
  EXPECT_LT(operations(two.specialised), operations(different.specialised));
  EXPECT_LT(operations(three.specialised), operations(two.specialised));
  const auto dropped = [](const Specialisation& spec, const std::string& term) {
    return std::ranges::count_if(spec.left_out, [&](const LeftOut& left) {
      return left.kind == "term" && left.name.find(term) != std::string::npos;
    });
  };
  EXPECT_EQ(dropped(different, "M1*M2 in dM3"), 0);
  EXPECT_EQ(dropped(two, "M1*M2 in dM3"), 1);
  EXPECT_EQ(dropped(two, "M1*M3 in dM2"), 0);
  EXPECT_EQ(dropped(three, "M1*M3 in dM2"), 1);
}

TEST(LeftOut, WithoutItsFieldOneAxisIsNotNeededForTheMomentum) {
  const Values free = and_also(kTop, {{"r1", "0"}, {"r2", "0"}, {"r3", "0"}});
  const CaseFile file = read_case(CASIMIR_SOURCE_DIR "/cases/euler-poisson.toml");
  const Model model = build_model(file, fixed(free));
  SpecialiseOptions options;
  options.observe = std::vector<std::string>{"M1", "M2", "M3"};
  EXPECT_EQ(specialise(model, model.scene("default"), options).states.size(), 3U);
  const Model heavy = build_model(file, fixed(kTop));
  EXPECT_EQ(specialise(heavy, heavy.scene("default"), options).states.size(), 6U);
}

}  // namespace
}  // namespace casimir

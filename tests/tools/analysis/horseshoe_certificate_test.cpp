// Certificates of chaos: what is proved is checked, and what is changed is refuted.
#include "tools/analysis/certificate/horseshoe_certificate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "symbolic/case_file.hpp"
#include "symbolic/error.hpp"
#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/horseshoe/horseshoe.hpp"

namespace casimir {
namespace {

/// Duffing's equation in slow time, forced by a point on a circle.
constexpr const char* kDuffing = R"toml(title = "Duffing"
[phase_space]
variables = ["c", "s", "x", "y"]
[equations]
c = "-s"
s = "c"
x = "y/4"
y = "(x - x^3)/4 + c/12"
[integrals]
R = "c^2 + s^2"
[[scene]]
name = "default"
initial = { c = "1", s = "0", x = "1/10", y = "1/7" }
duration = "10"
)toml";

const Horseshoe& chaos_found() {
  static const Horseshoe answer = [] {
    const Model model = build_model(parse_case(kDuffing, "duffing"));
    HorseshoeOptions options;
    options.request.plane = FunctionText{model.variables[1], "s"};
    return find_horseshoe(model, model.scenes.front(), options);
  }();
  return answer;
}

HorseshoeCertificate chaos_certificate() {
  return certificate_of(chaos_found(), "duffing", kDuffing, "s");
}

CheckedHorseshoe tampered_chaos(const std::function<void(HorseshoeCertificate&)>& change) {
  HorseshoeCertificate changed = chaos_certificate();
  change(changed);
  return check_horseshoe(changed);
}

void replace_part(std::string& text, const std::string& old, const std::string& by) {
  const std::size_t place = text.find(old);
  ASSERT_NE(place, std::string::npos) << old;
  text.replace(place, old.size(), by);
}

TEST(HorseshoeCertificates, OfWhatIsProvedAreChecked) {
  ASSERT_TRUE(chaos_found().proved) << chaos_found().reason;
  const std::string text = certificate_text(chaos_certificate());
  const CertificateFile read = read_certificate(text, "h.json");
  ASSERT_TRUE(read.horseshoe);
  EXPECT_EQ(certificate_text(*read.horseshoe), text);
  const CheckedHorseshoe checked = check_horseshoe(*read.horseshoe);
  ASSERT_TRUE(checked.holds()) << checked.reason;
  EXPECT_EQ(checked.entropy, chaos_found().entropy);
  EXPECT_GE(checked.parts, chaos_found().sets.size());
  EXPECT_EQ(checked.level_names, std::vector<std::string>{"R"});
}

TEST(HorseshoeCertificates, WhatIsChangedIsRefuted) {
  const std::size_t last = chaos_found().sets.size() - 1;
  // An h-set that is elsewhere on the surface, one off it, and two that are one.
  EXPECT_FALSE(tampered_chaos([&](auto& c) { c.sets[last].centre[2] = "0x5p-1"; }).holds());
  EXPECT_FALSE(tampered_chaos([&](auto& c) { c.sets[0].centre[1] = "0x1p-2"; }).holds());
  EXPECT_FALSE(tampered_chaos([&](auto& c) { c.sets[last].centre = c.sets[0].centre; }).holds());
  // Too narrow for what is mapped over it (row i has columns U, V, ..), or to be mapped across.
  for (const std::size_t column : {0U, 1U})
    EXPECT_FALSE(tampered_chaos([&](auto& c) {
                   for (std::size_t i = 0; i < 4; ++i)
                     c.sets[1].frame[4 * i + column] =
                         traced_text(0x1p-20 * chaos_found().sets[1].frame(i, column));
                 }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.sets[0].frame.assign(16, "0x1p0"); }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.sets[0].sheet[0] = "-0x1p-4"; }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.sets[0].sheet[0] = "0x1p-200"; }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.sets[0].centre[0] = "0x1p900"; }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.sets[0].frame.pop_back(); }).holds());
}

TEST(HorseshoeCertificates, OfOtherArrowsLevelsAndEquationsAreRefuted) {
  // Every set covers every other: it does not.
  EXPECT_FALSE(tampered_chaos([](auto& c) {
                 const auto count = static_cast<int>(c.sets.size());
                 c.coverings.clear();
                 for (int i = 0; i < count; ++i)
                   for (int j = 0; j < count; ++j) c.coverings.emplace_back(i, j);
               }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.coverings.pop_back(); }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.coverings.clear(); }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.coverings[0].second = 1000; }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.levels[0] = {"0x3p-1", "0x3p-1"}; }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.levels.clear(); }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.levels[0] = {"0x3p-1", "0x1p-1"}; }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { c.plane = "-s"; }).holds());
  // Another force, none, and what is not constant in the place of an integral.
  EXPECT_FALSE(tampered_chaos([](auto& c) { replace_part(c.equations, "c/12", "c/2"); }).holds());
  EXPECT_FALSE(tampered_chaos([](auto& c) { replace_part(c.equations, "c/12", "0"); }).holds());
  EXPECT_FALSE(
      tampered_chaos([](auto& c) { replace_part(c.equations, "c^2 + s^2", "c^2 + s"); }).holds());
  EXPECT_THROW(tampered_chaos([](auto& c) { c.plane = "s + )"; }), CaseError);
}

TEST(HorseshoeCertificates, WhatIsMalformedIsSaid) {
  const std::string text = certificate_text(chaos_certificate());
  const std::string body = text.substr(0, text.rfind(",\n\"digest\""));
  const auto refuses = [&](const std::string& old, const std::string& by) {
    std::string changed = body;
    replace_part(changed, old, by);
    EXPECT_THROW(read_certificate(with_digest(changed), "h.json"), CaseError) << by;
  };
  refuses("\"coverings\": [[", "\"coverings\": [[-1,0],[");
  refuses("\"coverings\": [[", "\"coverings\": [[0],[");
  refuses("\"plane\": \"s\"", "\"plane\": 3");
  refuses("\"plane\": \"s\"", "\"more\": 1, \"plane\": \"s\"");
  refuses("\"sheet\": [", "\"sheet\": [\"0x1p-1\", ");
  refuses("\"centre\": [", "\"centre\": [\"nan\", ");
}

}  // namespace
}  // namespace casimir

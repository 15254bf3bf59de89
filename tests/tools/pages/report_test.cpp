// The pages of casimir report: complete, by themselves, safe, and as a browser sees them.
#include <gtest/gtest.h>

#include "tests/tools/pages/browser.hpp"
#include "tests/tools/pages/page_checks.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// A pendulum with an integral that is refuted, and names that would be markup.
const char* const kEvil =
    "title = \"</title><script>alert('1')</script> & <b>\\\" onload=x '\"\n"
    "source = \"<img src=x onerror=alert(2)>\"\n"
    "hamiltonian = \"p^2/2 - cos(q)\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n"
    "canonical = true\n[integrals]\nF = \"p\"\n"
    "[[invariant_relation]]\nname = \"<u>$\\\\frac{x}{y}$</u>\"\nexpression = \"p\"\n"
    "[[scene]]\nname = \"<i>&amp;\"\ninitial = { q = \"1\", p = \"0\" }\nduration = \"3\"\n";

void expect_readable(const Seen& seen, const View& view) {
  const auto& found = seen.found;
  ASSERT_TRUE(found.is_object());
  EXPECT_TRUE(seen.console.empty()) << seen.console.front();
  EXPECT_TRUE(found.at("requests").empty()) << found.at("requests");
  EXPECT_EQ(found.at("scripts"), 3) << "data, script and the probe";
  EXPECT_EQ(found.at("inner"), view.width);
  EXPECT_LE(found.at("width"), view.width) << "it scrolls sideways";
  EXPECT_TRUE(found.at("broken").empty()) << found.at("broken");
  EXPECT_TRUE(found.at("untypeset").empty()) << found.at("untypeset");
  constexpr double kWords = 4.5,
                   kCurves = 1.8;  // WCAG's contrast; curves have marks and dashes too
  EXPECT_GE(found.at("contrast"), kWords);
  for (const auto& [id, plot] : found.at("plots").items()) {
    EXPECT_GE(plot.at("points"), 20) << id;
    EXPECT_GE(plot.at("width"), 200) << id;
    EXPECT_GE(plot.at("contrast"), kCurves) << id;
    EXPECT_GE(plot.at("words"), kWords) << id;
  }
}

TEST(Report, OfACaseHasEverythingAndIsReadableEverywhere) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"report", "kovalevskaya", "--budget", "0.2", "--output", "k.html", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(folder.files(), 1U);
  const std::string page = file_text(folder.path() / "k.html");
  expect_self_contained(page);
  for (const char* part :
       {"Kovalevskaya top", "✓", "proved", "Liouville integrability", "Hamiltonian",
        "right-hand side, specialised", "multiplications", "folded to 1", "figure-drift",
        "figure-motion", "figure-apex", "figure-work-precision", "Versions and machine", "SUNDIALS",
        "casimir verify kovalevskaya", "casimir report kovalevskaya", "algebra = &quot;e(3)&quot;"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  const auto json = outcome.json();
  EXPECT_EQ(json.at("verdict"), "proved");
  EXPECT_EQ(json.at("claims").at("proved"), 12);
  EXPECT_GE(json.at("plots").size(), 5U);
  ASSERT_TRUE(has_browser()) << "chromium-headless-shell is not installed; tools/test does that";
  for (const View& view : {View{1200, 900, false}, View{1200, 900, true}, View{360, 740, true}}) {
    const Seen seen = look(page, view);
    SCOPED_TRACE(std::to_string(view.width) + (view.dark ? " dark" : " light"));
    expect_readable(seen, view);
    EXPECT_GE(seen.found.at("math"), 50);
    EXPECT_GE(seen.found.at("plots").size(), 5U);
  }
}

TEST(Report, TextOfStrangersIsNoMarkupAndWhatIsRefutedIsShown) {
  const Folder folder;
  const std::string file = folder.write("evil.toml", kEvil);
  const Outcome outcome = run_in(
      folder, {"report", file, "--scene", "<i>&amp;", "--budget", "0", "--output", "e.html"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  const std::string page = file_text(folder.path() / "e.html");
  EXPECT_EQ(nesting_problem(page), "");
  for (const char* markup : {"<script>alert", "</title><script", "<i>", "<u>", "<img", "<b>"})
    EXPECT_EQ(page.find(markup), std::string::npos) << markup;
  for (const char* part : {"&lt;script&gt;alert(&#39;1&#39;)", "✗", "refuted", "witness",
                           "residual", "&lt;i&gt;&amp;amp;"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  ASSERT_TRUE(has_browser()) << "chromium-headless-shell is not installed; tools/test does that";
  const View view{360, 740, false};
  const Seen seen = look(page, view);
  ASSERT_TRUE(seen.found.is_object());
  EXPECT_TRUE(seen.console.empty()) << seen.console.front();
  EXPECT_EQ(seen.found.at("scripts"), 3);
  EXPECT_LE(seen.found.at("width"), view.width);
}

/// What holds where a != 0 is not said to hold everywhere: by the page, its JSON, or the survey.
TEST(Report, WhatAVerdictDependsOnStandsWhereTheVerdictDoes) {
  const Folder folder;
  folder.write("free.toml", R"toml(title = "Free"
hamiltonian = "(p1^2 + p2^2)/2"
integrable = true
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[parameters]
a = {}
[integrals]
F = "sqrt(a)^2*p2"
[[scene]]
name = "default"
parameters = { a = "1" }
initial = { q1 = "0", q2 = "0", p1 = "1", p2 = "1" }
duration = "1"
)toml");
  const Outcome outcome =
      run_in(folder, {"report", "./free.toml", "--budget", "0", "--output", "p.html", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("where").dump(), R"(["a != 0"])");
  const std::string page = file_text(folder.path() / "p.html");
  const std::string badge = page.substr(page.find("class=\"badge"), 120);
  EXPECT_NE(badge.find("where a != 0"), std::string::npos) << badge;
  EXPECT_NE(page.find("where a &gt;= 0"), std::string::npos);
  const Outcome survey = run_in(folder, {"survey", "./free.toml"});
  EXPECT_NE(survey.out.find("free is proved where a != 0"), std::string::npos) << survey.out;
}

TEST(Report, AComplexLaxPairStandsWithItsLevel) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"report", "goryachev-chaplygin-lax", "--budget", "0", "--output", "p.html"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = file_text(folder.path() / "p.html");
  const std::size_t pair = page.find("<mover accent=\"true\"><mi>L</mi>");
  ASSERT_NE(pair, std::string::npos);
  const std::string said = page.substr(pair, page.find("</div>", pair) - pair);
  EXPECT_NE(said.find("class=\"on\">on "), std::string::npos) << said;
}

TEST(Report, OfAllCasesHasAnIndexWhoseLinksLead) {
  const Folder folder, cases;
  const std::string oscillator =
      "hamiltonian = \"(p^2 + q^2)/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n"
      "canonical = true\n[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"0\" }\n"
      "duration = \"3\"\n";
  cases.write("one.toml", "title = \"First\"\ntags = [\"mine\"]\n" + oscillator);
  cases.write("two.toml", "title = \"Second\"\ntags = [\"mine\"]\n" + oscillator);
  const Outcome outcome = run_in(
      folder, {"report", "--all", "--tag", "mine", "--budget", "0", "--output", "out", "--json"},
      {}, {{"CASIMIR_CASES", cases.path().string()}});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("cases").size(), 2U);
  const std::string index = file_text(folder.path() / "out" / "index.html");
  expect_self_contained(index);
  for (const char* name : {"one.html", "two.html"}) {
    EXPECT_NE(index.find(std::string("href=\"") + name + "\""), std::string::npos) << name;
    const std::string page = file_text(folder.path() / "out" / name);
    expect_self_contained(page);
    EXPECT_NE(page.find("href=\"index.html\""), std::string::npos) << name;
  }
  // The order is that of the list, and each leads to the next.
  EXPECT_NE(file_text(folder.path() / "out" / "one.html").find("rel=\"next\" href=\"two.html\""),
            std::string::npos);
  EXPECT_NE(file_text(folder.path() / "out" / "two.html").find("rel=\"prev\" href=\"one.html\""),
            std::string::npos);
  for (const char* part : {"id=\"search\"", "<svg", "data-words=\"first one", "Beside the book"})
    EXPECT_NE(index.find(part), std::string::npos) << part;
}

TEST(Report, IsWrittenWithoutPicturesWhereGnuplotIsMissing) {
  const Folder folder;
  const Outcome outcome = run_in(folder, {"report", "euler-jacobi", "--budget", "0"}, {},
                                 {{"PATH", "/nonexistent"}, {"CXX", "/usr/bin/g++"}});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("apt-get install gnuplot-nox"), std::string::npos) << outcome.err;
  const std::string page = file_text(folder.path() / "euler-jacobi.html");
  EXPECT_NE(page.find("There is no picture"), std::string::npos);
  EXPECT_NE(page.find("How well the invariants are kept"), std::string::npos);
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Report, RefusesWhatItCannotDo) {
  const Folder folder;
  EXPECT_EQ(run_in(folder, {"report"}).status, 2);
  EXPECT_EQ(run_in(folder, {"report", "euler", "--all"}).status, 2);
  EXPECT_EQ(run_in(folder, {"report", "euler", "--output", "x.pdf"}).status, 2);
  EXPECT_EQ(run_in(folder, {"report", "euler", "--scene", "defualt"}).status, 2);
  EXPECT_EQ(run_in(folder, {"report", "eulr"}).status, 2);
  EXPECT_EQ(run_in(folder, {"report", "euler", "--output", "no/such/folder.html"}).status, 4);
  EXPECT_EQ(folder.files(), 0U);
}

// Neither a mark of proof nor axes without a curve.
TEST(Report, OfACaseWithoutClaimsAndInvariantsSaysSo) {
  const Folder folder;
  folder.write("case.toml", R"toml(
[phase_space]
variables = ["x", "y"]
[equations]
x = "y"
y = "-x + y*(1 - x^2)"
[[scene]]
name = "default"
initial = { x = "1", y = "0" }
duration = "5"
)toml");
  const Outcome outcome =
      run_in(folder, {"report", "./case.toml", "--budget", "2", "--output", "r.html", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = file_text(folder.path() / "r.html");
  EXPECT_NE(page.find("<p>Nothing is claimed.</p>"), std::string::npos);
  EXPECT_NE(page.find("3 runs arrived, and there is no invariant to look at."), std::string::npos);
  EXPECT_EQ(page.find("class=\"badge"), std::string::npos);
  EXPECT_EQ(page.find("id=\"figure-drift\""), std::string::npos);
}

}  // namespace
}  // namespace casimir::test

// The page of casimir bench: complete, by itself, and safe whatever a case file calls itself.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// Little work: the two methods share what is compiled.
std::vector<std::string> bench_arguments(const std::string& what, const std::string& output) {
  std::vector<std::string> arguments{"bench", what, "--method", "taylor,arkode-erk"};
  arguments.insert(arguments.end(), {"--tolerances", "1e-4,1e-9", "--repeat", "1"});
  arguments.insert(arguments.end(), {"--output", output, "--quiet"});
  return arguments;
}

/// What is wrong with the nesting of the elements, or empty.
std::string nesting_problem(const std::string& page) {
  static const std::regex kTag(R"(<(/?)([A-Za-z][A-Za-z0-9]*)([^<>]*)>)");
  static const std::set<std::string> kEmpty{"meta", "br", "hr", "img", "input", "link"};
  std::vector<std::string> open;
  for (std::sregex_iterator it(page.begin(), page.end(), kTag), end; it != end; ++it) {
    const std::string name = (*it)[2], rest = (*it)[3];
    if (kEmpty.contains(name) || rest.ends_with("/")) continue;
    if ((*it)[1] != "/") {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is open";
}

/// A page that needs nothing but itself: no address to load from, no script, no identifier twice.
void expect_self_contained(const std::string& page) {
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(nesting_problem(page), "");
  const std::regex kLoads(R"((src|href|action|data)\s*=\s*["']?\s*(https?:|//|file:))");
  EXPECT_FALSE(std::regex_search(page, kLoads));
  for (const char* bad : {"<script", "<link", "<iframe", "<img", "@import", "url(http", "onload="})
    EXPECT_EQ(page.find(bad), std::string::npos) << bad;
  const std::regex kId(R"(\sid\s*=\s*["']([^"']*)["'])");
  std::set<std::string> ids;
  for (std::sregex_iterator it(page.begin(), page.end(), kId), end; it != end; ++it)
    EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];
  // Every reference inside the page leads somewhere.
  const std::regex kReference(R"(href\s*=\s*["']#([^"']*)["'])");
  for (std::sregex_iterator it(page.begin(), page.end(), kReference), end; it != end; ++it)
    EXPECT_TRUE(ids.contains((*it)[1])) << (*it)[1];
}

TEST(BenchPage, NestingIsChecked) {
  EXPECT_EQ(nesting_problem("<p><b>x</b><br></p>"), "");
  EXPECT_NE(nesting_problem("<p><b>x</p></b>"), "");
  EXPECT_NE(nesting_problem("<p>"), "");
}

TEST(BenchPage, OfOneCase) {
  const Folder folder;
  const Outcome outcome = run_in(folder, bench_arguments("kovalevskaya", "k.html"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = file_text(folder.path() / "k.html");
  expect_self_contained(page);
  for (const char* part : {"Kovalevskaya top", "<svg", "</svg>", "arkode-erk",
                           "Reference:", "one right-hand side", "all rows"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(folder.files(), 1U);
}

TEST(BenchPage, OfAllCasesHasEveryOneOfThem) {
  const Folder folder;
  std::vector<std::string> arguments = bench_arguments("--all", "all.html");
  arguments.insert(arguments.end(), {"--tag", "vortex-field", "--output", "all.csv"});
  const Folder more;
  more.write("endless.toml",
             "title = \"No end\"\ntags = [\"vortex-field\"]\n[phase_space]\nvariables = "
             "[\"x\"]\n[equations]\nx = \"x^2\"\n"
             "[[scene]]\nname = \"default\"\ninitial = { x = \"1\" }\nduration = \"2\"\n");
  const Outcome outcome = run_in(folder, arguments, {}, {{"CASIMIR_CASES", more.path().string()}});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = file_text(folder.path() / "all.html");
  expect_self_contained(page);
  const std::string csv = file_text(folder.path() / "all.csv");
  const auto cases = run({"list", "--json", "--tag", "vortex-field"}).json().at("cases");
  for (const auto& entry : cases) {
    const std::string name = entry.at("name");
    EXPECT_NE(page.find("<small>" + name + ", scene default</small>"), std::string::npos) << name;
    EXPECT_NE(csv.find('\n' + name + ",default,taylor,"), std::string::npos) << name;
  }
  EXPECT_NE(page.find("<h2>Summary</h2>"), std::string::npos);
  // A case without a reference is there with the reason.
  EXPECT_NE(page.find("Not measured: there is no reference state: the solution has a "
                      "singularity"),
            std::string::npos);
}

TEST(BenchPage, TextOfStrangersIsNoMarkup) {
  const Folder folder;
  const std::string file = folder.write(
      "evil.toml",
      "title = \"</title><script>alert('1')</script> & <b>\\\" onload=x '\"\n"
      "hamiltonian = \"(p^2 + q^2)/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n"
      "canonical = true\n[[scene]]\nname = \"<i>&amp;\"\ninitial = { q = \"1\", p = \"0\" }\n"
      "duration = \"3\"\n");
  std::vector<std::string> arguments = bench_arguments(file, "e.html");
  arguments.insert(arguments.end(), {"--scene", "<i>&amp;", "--plot", "e.svg"});
  const Outcome outcome = run_in(folder, arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = file_text(folder.path() / "e.html");
  EXPECT_EQ(nesting_problem(page), "");
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<i>"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert(&#39;1&#39;)"), std::string::npos);
  EXPECT_NE(page.find("scene &lt;i&gt;&amp;amp;"), std::string::npos);
  const std::string svg = file_text(folder.path() / "e.svg");
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("&lt;script"), std::string::npos);
}

TEST(BenchPage, IsWrittenWithoutPicturesWhereGnuplotIsMissing) {
  const Folder folder;
  const Outcome outcome = run_in(folder,
                                 {"bench", "euler", "--method", "taylor", "--tolerances", "1e-6",
                                  "--repeat", "1", "--output", "b.html", "--output", "b.csv"},
                                 {}, {{"PATH", "/nonexistent"}, {"CXX", "/usr/bin/g++"}});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("apt-get install gnuplot-nox"), std::string::npos) << outcome.err;
  EXPECT_NE(file_text(folder.path() / "b.html").find("needs gnuplot"), std::string::npos);
  EXPECT_FALSE(file_text(folder.path() / "b.csv").empty());
  EXPECT_EQ(folder.files(), 2U);
}

}  // namespace
}  // namespace casimir::test

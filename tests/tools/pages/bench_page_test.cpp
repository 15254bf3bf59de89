// The page of casimir bench: complete, by itself, and safe whatever a case file calls itself.
#include <gtest/gtest.h>

#include "tests/tools/pages/page_checks.hpp"
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

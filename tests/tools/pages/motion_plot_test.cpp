// integrate --plot: what is drawn is what was integrated.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// How many points the curves of a picture have: the paths that are not black.
std::size_t points_in(const std::string& svg) {
  const std::string begin = "<path stroke='rgb(";
  std::size_t count = 0;
  for (std::size_t at = svg.find(begin); at != std::string::npos; at = svg.find(begin, at + 1)) {
    const auto path = svg.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = svg.begin() + static_cast<std::ptrdiff_t>(svg.find("/>", at));
    count += static_cast<std::size_t>(std::count(path, end, 'M') + std::count(path, end, 'L'));
  }
  return count;
}

TEST(MotionPlot, DrawsEveryKindOfPicture) {
  const Folder folder;
  const std::vector<std::vector<std::string>> kinds{{},
                                                    {"--plot-y", "M1,M1^2 + M2^2"},
                                                    {"--plot-xy", "atan2(M1, M2),M3"},
                                                    {"--plot-sphere"},
                                                    {"--plot-sphere=g"},
                                                    {"--plot-apex"}};
  for (const auto& kind : kinds) {
    std::vector<std::string> arguments{"integrate", "kovalevskaya", "--plot", "p.svg"};
    arguments.insert(arguments.end(), kind.begin(), kind.end());
    const Outcome outcome = run_in(folder, arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("drew p.svg"), std::string::npos);
    EXPECT_GE(points_in(file_text(folder.path() / "p.svg")), 900U)
        << (kind.empty() ? "against time" : kind[0]);
  }
  ASSERT_EQ(run_in(folder, {"integrate", "euler", "--plot", "p.png", "--quiet"}).status, 0);
  EXPECT_TRUE(file_text(folder.path() / "p.png").starts_with("\x89PNG"));
  EXPECT_EQ(folder.files(), 2U);
}

TEST(MotionPlot, RefusesWhatCannotBeDrawnBeforeItRuns) {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& options, const char* words) {
    std::vector<std::string> arguments{"integrate", "kovalevskaya"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_in(folder, arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  };
  refused({"--plot", "p.gif"}, ".svg, .png, .pdf or .tex");
  refused({"--plot-xy", "M1,M2"}, "--plot FILE");
  refused({"--plot", "p.svg", "--plot-xy", "M1"}, "expected two");
  refused({"--plot", "p.svg", "--plot-xy", "M1,M7"}, "did you mean");
  refused({"--plot", "p.svg", "--plot-y", "M1 +"}, "--plot-y:1:");
  refused({"--plot", "p.svg", "--plot-apex", "--plot-sphere"}, "give one");
  refused({"--plot", "p.svg", "--plot-sphere=h"}, "there are M, g");
  EXPECT_EQ(folder.files(), 0U);
}

TEST(MotionPlot, AnswersWithoutGnuplotToo) {
  const Folder folder;
  const Outcome outcome = run_in(folder, {"integrate", "kovalevskaya", "--plot", "p.svg"}, {},
                                 {{"PATH", "/nonexistent"}, {"CXX", "/usr/bin/g++"}});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("apt-get install gnuplot-nox"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("M1"), std::string::npos) << outcome.out;
  EXPECT_EQ(folder.files(), 0U);
}

}  // namespace
}  // namespace casimir::test

// casimir generate --name: several headers of one case in one program.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

void generate(const Folder& folder, std::vector<std::string> more) {
  more.insert(more.begin(), "generate");
  const Outcome outcome = run_in(folder, more);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
}

/// The exit status of a program that is compiled from this text.
int result_of(const Folder& folder, const std::string& compiler, const std::string& file,
              const std::string& text) {
  folder.write(file, text);
  const std::string program = folder / "program";
  const std::string command = "cd '" + folder.path().string() + "' && " + compiler +
                              " -Wall -Wextra -Wshadow -Werror " + file + " -lm -o program";
  if (std::system(command.c_str()) != 0) return -1;
  return WEXITSTATUS(std::system(program.c_str()));
}

TEST(HeaderName, TwoScenesLiveInOneProgram) {
  const Folder folder;
  generate(folder, {"kovalevskaya", "-o", "one.hpp"});
  generate(folder, {"kovalevskaya", "--initial", "M1=2", "--name", "fast_top", "-o", "two.hpp"});
  generate(folder, {"kovalevskaya", "--initial", "M1=3", "--name", "Fast_top", "-o", "three.hpp"});
  EXPECT_EQ(result_of(folder, "c++ -std=c++20", "main.cpp",
                      "#include \"one.hpp\"\n#include \"two.hpp\"\n#include \"three.hpp\"\n"
                      "int main() {\n"
                      "  return static_cast<int>(kovalevskaya::initial_state[0] +\n"
                      "      10 * fast_top::initial_state[0] + 100 * Fast_top::initial_state[0]) "
                      "== 321 ? 0 : 1;\n}\n"),
            0);
}

/// y' = sign(x) from x = 0: whether the motion goes to the right is not known before its terms are.
TEST(Header, SeriesThatBeginAtAJumpAreNoNumbers) {
  const Folder folder;
  folder.write("jump.toml", R"toml(
title = "jump"
[phase_space]
variables = ["x", "y"]
[equations]
x = "1"
y = "sign(x)"
[[scene]]
name = "default"
initial = { x = "0", y = "0" }
duration = "1"
)toml");
  generate(folder, {"./jump.toml", "--with", "taylor", "-o", "jump.hpp"});
  EXPECT_EQ(result_of(folder, "c++ -std=c++20", "main.cpp", R"cpp(
#include "jump.hpp"
              int main() {
                double series[8];
                jump::taylor<3>(jump::initial_state, series);
                const double beside[] = {-1, 0};
                if (!std::isnan(series[3]) || series[2] != 1) return 1;
                jump::taylor<3>(beside, series);
                return series[3] == -1 ? 0 : 2;
              }
            )cpp"),
            0);
}

TEST(HeaderName, CHasItAsPrefix) {
  const Folder folder;
  generate(folder, {"kovalevskaya", "--language", "c", "-o", "one.h"});
  generate(folder, {"kovalevskaya", "--language", "c", "--initial", "M1=2", "--name", "fast", "-o",
                    "two.h"});
  EXPECT_EQ(
      result_of(folder, "cc -std=c99 -Wno-unused-function -Wno-unused-const-variable", "main.c",
                "#include \"one.h\"\n#include \"two.h\"\nint main(void) {\n"
                "  return kovalevskaya_initial_state[0] + 10 * fast_initial_state[0] == 21 ? "
                "0 : 1;\n}\n"),
      0);
}

TEST(HeaderName, TheNameOfTheCaseGivesWhatIsGivenWithoutOne) {
  for (const char* language : {"c", "c++"}) {
    const Outcome plain = run({"generate", "kovalevskaya", "--language", language});
    const Outcome named =
        run({"generate", "kovalevskaya", "--language", language, "--name", "kovalevskaya"});
    EXPECT_EQ(plain.status, 0) << plain.err;
    EXPECT_EQ(plain.out, named.out);
    const Outcome other =
        run({"generate", "kovalevskaya", "--language", language, "--name", "top"});
    EXPECT_NE(plain.out, other.out);
  }
}

}  // namespace
}  // namespace casimir::test

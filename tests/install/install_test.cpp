// An installed tree that was moved: the program, and the libraries for the programs of others.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "tests/install/shell.hpp"

namespace casimir::test {
namespace {

namespace fs = std::filesystem;

TEST(Install, TheProgramFindsItsCasesFromAnywhere) {
  const Installed installed;
  const Outcome outcome = shell(installed,
                                "mkdir links\nln -s ../prefix/bin/casimir links/casimir\n"
                                "cd /\n\"$HOME/links/casimir\" list\n"
                                "PATH=\"$HOME/prefix/bin:$PATH\"\ncasimir verify kovalevskaya\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(shows(outcome.out, "Clebsch")) << outcome.out;
  EXPECT_TRUE(shows(outcome.out, "12 proved, 0 refuted")) << outcome.out;
}

/// What it is not linked to comes from the folder of libraries.
TEST(Install, TheProgramFindsItsModules) {
  const Installed installed;
  const Outcome outcome = shell(
      installed,
      "prefix/bin/casimir sweep kovalevskaya --over r=1/2:3/2:2 --duration 1 --output s.h5\n");
  const bool built = fs::exists(fs::path(CASIMIR_BUILD_DIR) / "modules" / "casimir_hdf5.so");
  EXPECT_EQ(outcome.status, built ? 0 : 4) << outcome.err;
  EXPECT_EQ(fs::exists(installed.path() / "s.h5"), built) << outcome.err;
}

/// A folder that is configured, with the program and the libraries in it and nothing else: as
/// tools/start leaves it. Before they are there, nothing is installed.
TEST(Install, WorksRightAfterTheProgramWasBuiltAndNotBefore) {
  const Folder folder;
  const std::string built = CASIMIR_BUILD_DIR;
  const Outcome configured = shell(
      folder, "'" CASIMIR_CMAKE "' -S '" CASIMIR_SOURCE_DIR
              "' -B build -DCMAKE_BUILD_TYPE=Release -DCASIMIR_TESTS=OFF -DCMAKE_SKIP_RPATH=ON "
              "-DCMAKE_CXX_COMPILER='" CASIMIR_CXX "'\n");
  ASSERT_EQ(configured.status, 0) << configured.out << configured.err;
  const std::string install = "'" CASIMIR_CMAKE "' --install build --prefix \"$PWD/prefix\"\n";

  const Outcome early = shell(folder, install);
  EXPECT_NE(early.status, 0);
  EXPECT_TRUE(shows(early.err, "There is no")) << early.err;  // CMake breaks lines
  EXPECT_FALSE(fs::exists(folder.path() / "prefix"));

  const Outcome installed = shell(
      folder, "cd '" + built +
                  "'\nmkdir -p \"$HOME/build/modules\"\n"
                  "for file in casimir modules/*.so */libcasimir_*.a tools/*/libcasimir_*.a; do\n"
                  "  [ ! -e \"$file\" ] || cp \"$file\" \"$HOME/build/$file\"\ndone\ncd\n"
                  "ls build/manual && exit 1\n" +
                  install + "prefix/bin/casimir list\n");
  EXPECT_EQ(installed.status, 0) << installed.out << installed.err;
  EXPECT_TRUE(shows(installed.out, "Clebsch")) << installed.out;
  const auto names = [](const fs::path& prefix) {
    std::set<fs::path> result;
    for (const fs::path& file : files_below(prefix)) result.insert(file.lexically_relative(prefix));
    // The Python module is a target of its own.
    std::erase_if(result,
                  [](const fs::path& file) { return file.string().starts_with("lib/python3"); });
    return result;
  };
  EXPECT_EQ(names(folder.path() / "prefix"), names(Installed().prefix()));
}

TEST(Install, TheProgramCompilesWhatItIntegrates) {
  const Installed installed;
  const Outcome outcome =
      shell(installed,
            "prefix/bin/casimir integrate kovalevskaya --method dop853 --duration 1\n"
            "prefix/bin/casimir integrate euler-angles --method taylor-compiled --duration 1\n"
            "prefix/bin/casimir integrate kovalevskaya --method odeint-dopri5 --duration 1\n"
            "prefix/bin/casimir integrate kovalevskaya --method cvode-bdf --duration 1\n"
            "ls cache | wc -l\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  EXPECT_EQ(outcome.err, "");
}

/// Debugging information and messages of sanitizers would, in the program.
TEST(Install, NothingNamesTheFoldersItWasBuiltIn) {
  const Installed installed;
  const bool plain = std::string(CASIMIR_CXX_FLAGS).empty();
  for (const fs::path& file : files_below(installed.prefix())) {
    const bool binary = file.extension() == ".a" || file.filename() == "casimir";
    if (binary && !plain) continue;
    const std::string text = file_text(file);
    EXPECT_FALSE(shows(text, CASIMIR_BUILD_DIR)) << file;
    EXPECT_FALSE(shows(text, CASIMIR_SOURCE_DIR)) << file;
    EXPECT_FALSE(shows(text, installed.path().string())) << file;
  }
}

TEST(Install, PagesLeadToPagesThatAreInstalled) {
  const Installed installed;
  const fs::path pages = installed.prefix() / "share/doc/casimir";
  static const std::regex kLink(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  std::size_t links = 0;
  for (const fs::path& file : files_below(pages)) {
    if (file.extension() != ".md") continue;
    const std::string text = file_text(file);
    for (std::sregex_iterator it(text.begin(), text.end(), kLink), end; it != end; ++it, ++links)
      EXPECT_TRUE(fs::exists(file.parent_path() / (*it)[1].str())) << file << " " << (*it)[1];
  }
  EXPECT_GT(links, 10U);
}

TEST(Install, HeadersIncludeOnlyWhatIsInstalled) {
  const Installed installed;
  const fs::path headers = installed.prefix() / "include/casimir";
  static const std::regex kOwn(R"(#\s*include\s+"([^"]+)\")");
  static const std::regex kOutside(R"(#\s*include\s+<([a-z]+)[/+.])");
  const std::set<std::string> behind{"flint", "toml", "arb", "acb", "sundials", "nlohmann", "fmt"};
  std::size_t count = 0;
  for (const fs::path& file : files_below(headers)) {
    ++count;
    const std::string text = file_text(file);
    for (std::sregex_iterator it(text.begin(), text.end(), kOwn), end; it != end; ++it)
      EXPECT_TRUE(fs::exists(headers / (*it)[1].str())) << file << " " << (*it)[1].str();
    for (std::sregex_iterator it(text.begin(), text.end(), kOutside), end; it != end; ++it)
      EXPECT_FALSE(behind.contains((*it)[1].str())) << file << " " << (*it)[1].str();
  }
  EXPECT_GT(count, 40U);
}

/// What follows a mark in a text.
std::string after(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  return at == std::string::npos ? "(no " + mark + ")" : text.substr(at + mark.size());
}

/// A user's first programs are no longer than that, and the tour shows them as they are.
TEST(Install, TheTourShowsTheExamplesAndTheyAreShort) {
  const std::string readme = file_text(CASIMIR_SOURCE_DIR "/tools/README.md");
  for (const char* name : {"verify", "solve", "section"}) {
    const std::string text =
        file_text(std::string(CASIMIR_SOURCE_DIR "/tools/examples/") + name + ".cpp");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 25) << name;
    EXPECT_TRUE(shows(readme, "```cpp\n" + text + "```\n")) << name;
  }
}

TEST(Install, ExamplesBuildWithFindPackageAndRun) {
  const Installed installed;
  const Outcome built =
      shell(installed, "'" CASIMIR_CMAKE
                       "' -S prefix/share/doc/casimir/examples -B build "
                       "-DCMAKE_PREFIX_PATH=\"$PWD/prefix\" -DCMAKE_CXX_COMPILER='" CASIMIR_CXX
                       "' "
                       "-DCMAKE_CXX_FLAGS='" CASIMIR_CXX_FLAGS
                       "'\n"
                       "'" CASIMIR_CMAKE "' --build build -j 2\n");
  ASSERT_EQ(built.status, 0) << built.out << built.err;
  const Outcome proofs = shell(installed, "build/prove\n");
  EXPECT_EQ(proofs.status, 0) << proofs.err;
  EXPECT_TRUE(shows(proofs.out, "proved  casimir  F1")) << proofs.out;
  EXPECT_TRUE(shows(proofs.out, "refuted  integral  M3\n  its derivative is ")) << proofs.out;
  const Outcome header =
      shell(installed, "build/generate >pendulum.hpp\n'" CASIMIR_CXX
                       "' -std=c++20 -Wall -Wextra -Werror -fsyntax-only -x c++ pendulum.hpp\n");
  EXPECT_EQ(header.status, 0) << header.err;
  const Outcome run = shell(installed, "build/integrate\n");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(shows(run.out, "q1 = 0.22514698")) << run.out;
  EXPECT_TRUE(shows(run.out, "less than 1e-10: yes")) << run.out;
  const Outcome verified = shell(installed, "build/verify\n");
  EXPECT_EQ(verified.status, 0) << verified.err;
  EXPECT_TRUE(shows(verified.out, "L: proved\nF: refuted\nits rate is ")) << verified.out;
  const Outcome solved =
      shell(installed,
            "build/solve prefix/share/casimir/cases/kovalevskaya.toml\n"
            "prefix/bin/casimir integrate kovalevskaya --duration 10 --tolerance 1e-14 --json\n");
  EXPECT_EQ(solved.status, 0) << solved.err;
  EXPECT_TRUE(shows(solved.out, "taylor: the equations are not stiff")) << solved.out;
  EXPECT_TRUE(shows(solved.out, "\nerror about ")) << solved.out;
  // The same state as the program has it, to nine digits.
  const std::string mine = after(solved.out, "M1(10) = "),
                    program = after(solved.out, "\"M1\": \"");
  EXPECT_EQ(mine.substr(0, 11), program.substr(0, 11)) << solved.out;
  const Outcome section = shell(installed, "build/section\n");
  EXPECT_EQ(section.status, 0) << section.err;
  EXPECT_TRUE(shows(section.out, "H = 0.125: 1600 crossings")) << section.out;
  EXPECT_TRUE(shows(section.out, ": chaotic")) << section.out;
  EXPECT_TRUE(shows(section.out, ": regular")) << section.out;
}

TEST(Install, AnUnknownVersionOrComponentIsRefused) {
  const Installed installed;
  installed.write("CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES CXX)\n"
                  "find_package(casimir 99 REQUIRED)\n");
  const Outcome outcome =
      shell(installed, "'" CASIMIR_CMAKE "' -S . -B build -DCMAKE_PREFIX_PATH=\"$PWD/prefix\"\n");
  EXPECT_NE(outcome.status, 0);
  EXPECT_TRUE(shows(outcome.err, "\"99\"")) << outcome.err;
}

/// That which links to all four libraries.
TEST(Install, PkgConfigBuildsAnExample) {
  const Installed installed;
  const Outcome outcome =
      shell(installed,
            "export PKG_CONFIG_PATH=\"$PWD/prefix/lib/pkgconfig\"\n"
            "pkg-config --exact-version=$(prefix/bin/casimir --version) casimir\n"
            "'" CASIMIR_CXX "' " CASIMIR_CXX_FLAGS
            " -std=c++20 "
            "prefix/share/doc/casimir/examples/section.cpp -o section "
            "$(pkg-config --cflags --libs casimir)\n./section | head -1\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(shows(outcome.out, "H = 0.125: 1600 crossings")) << outcome.out;
}

TEST(Install, ShellsFindTheirCompletion) {
  const Installed installed;
  const Outcome outcome = shell(
      installed,
      "PATH=\"$PWD/prefix/bin:$PATH\"\n"
      "bash --norc -c '. prefix/share/bash-completion/completions/casimir; complete -p casimir'\n"
      "zsh -f -c 'fpath=(prefix/share/zsh/vendor-completions $fpath); autoload -U compinit; "
      "compinit -u -D; echo zsh: $_comps[casimir]'\n"
      "XDG_DATA_DIRS=\"$PWD/prefix/share\" fish -c 'complete -C \"casimir verif\"'\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(shows(outcome.out, "complete -F _casimir casimir")) << outcome.out;
  EXPECT_TRUE(shows(outcome.out, "zsh: _casimir")) << outcome.out;
  EXPECT_TRUE(shows(outcome.out, "verify\tProve")) << outcome.out;
}

}  // namespace
}  // namespace casimir::test

// The environment at fault: exit status 4, what is missing and what to do; results are not lost.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

TEST(Environment, NoCompilerSaysWhatToInstall) {
  const Folder folder;
  const Folder cache;
  const Outcome outcome =
      run_in(folder, {"integrate", "euler", "--method", "dop853"}, {},
             {{"PATH", "/nonexistent"}, {"CXX", ""}, {"CASIMIR_CACHE", cache.path().string()}});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("g++"), std::string::npos) << outcome.err;
  EXPECT_TRUE(outcome.out.empty()) << outcome.out;
}

Environment without_compiler(const Folder& cache) {
  return {{"PATH", "/nonexistent"}, {"CXX", ""}, {"CASIMIR_CACHE", cache.path().string()}};
}

TEST(Environment, TablesNeedNoCompilerAndNoWord) {
  const Folder cache;
  const Outcome outcome = run({"integrate", "kovalevskaya", "--json"}, {}, without_compiler(cache));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  EXPECT_EQ(outcome.json().at("warnings").dump().find("compiler"), std::string::npos);
  EXPECT_EQ(outcome.json().at("status"), "ok");
}

TEST(Environment, OtherSystemsAreInterpretedAndItIsSaid) {
  const Folder cache, with_compiler;
  const std::vector<std::string> arguments{"integrate", "lagrange-euler-angles", "--duration", "5",
                                           "--json"};
  const Outcome outcome = run(arguments, {}, without_compiler(cache));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.json().at("warnings").dump().find("interpreted"), std::string::npos);
  const Outcome compiled = run(arguments, {}, {{"CASIMIR_CACHE", with_compiler.path().string()}});
  EXPECT_EQ(compiled.json().at("warnings").dump().find("interpreted"), std::string::npos);
  const auto state = compiled.json().at("state");
  const auto states = outcome.json().at("state");
  for (const auto& [name, value] : states.items()) {
    EXPECT_NEAR(std::stod(value.get<std::string>()), std::stod(state.at(name).get<std::string>()),
                1e-12)
        << name;
  }
}

TEST(Environment, MethodsThatNeedACompilerNameTheOneThatDoesNot) {
  const Folder cache;
  for (const char* method : {"dop853", "gauss8", "taylor-compiled", "cvode-adams"}) {
    const Outcome outcome =
        run({"integrate", "euler", "--method", method}, {}, without_compiler(cache));
    EXPECT_EQ(outcome.status, 4) << method << outcome.err;
    EXPECT_NE(outcome.err.find("the method taylor"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("g++"), std::string::npos) << outcome.err;
  }
}

TEST(Environment, NoGnuplotSaysWhatToInstallAndKeepsTheRows) {
  const Folder folder, cache;
  const Outcome outcome = run_in(folder,
                                 {"conserve", "euler", "--scene", "default", "--method", "taylor",
                                  "--output", "rows.csv", "--plot", "drift.svg"},
                                 {}, without_compiler(cache));
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("gnuplot-nox"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("1 of 1 runs"), std::string::npos) << outcome.out;
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Environment, ProofsNeedNoCompiler) {
  EXPECT_EQ(run({"verify", "euler", "--quiet"}, {}, {{"PATH", "/nonexistent"}, {"CXX", ""}}).status,
            0);
}

TEST(Environment, CompilerThatFailsIsReported) {
  const Folder cache;
  const Outcome outcome = run({"integrate", "euler", "--method", "dop853"}, {},
                              {{"CXX", "/bin/false"}, {"CASIMIR_CACHE", cache.path().string()}});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
}

TEST(Environment, FolderThatCannotBeWrittenIsReported) {
  const Outcome outcome = run({"generate", "euler", "-o", "/proc/none/e.hpp"});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_NE(outcome.err.find("cannot write '/proc/none/e.hpp'"), std::string::npos) << outcome.err;
}

TEST(Environment, MissingGnuplotLosesNoRow) {
  const Folder folder;
  const Folder tools;
  std::filesystem::create_symlink("/usr/bin/g++", tools.path() / "g++");
  for (const char* tool : {"as", "ld", "cc1plus"}) {
    if (std::filesystem::exists(std::string("/usr/bin/") + tool))
      std::filesystem::create_symlink(std::string("/usr/bin/") + tool, tools.path() / tool);
  }
  const Outcome outcome = run_in(folder,
                                 {"bench", "euler", "--method", "dop853", "--tolerances", "1e-6",
                                  "--output", "b.csv", "--plot", "b.svg"},
                                 {}, {{"PATH", tools.path().string()}});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("apt-get install gnuplot-nox"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("dop853"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "b.csv"));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Environment, SecondRunComesFromTheCache) {
  const Folder folder;
  const Folder cache;
  const Environment environment{{"CASIMIR_CACHE", (cache.path() / "c").string()}};
  const std::vector<std::string> arguments{"integrate", "euler", "--method", "dop853", "--json"};
  EXPECT_EQ(run_in(folder, arguments, {}, environment).json().at("from_cache"), false);
  EXPECT_EQ(run_in(folder, arguments, {}, environment).json().at("from_cache"), true);
}

TEST(Environment, CacheOfSomebodyElseIsRefused) {
  const Folder cache;
  const std::filesystem::path open_to_all = cache.path() / "open";
  std::filesystem::create_directory(open_to_all);
  chmod(open_to_all.c_str(), 0777);
  const Outcome outcome = run({"integrate", "euler", "--method", "dop853"}, {},
                              {{"CASIMIR_CACHE", open_to_all.string()}});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
}

}  // namespace
}  // namespace casimir::test

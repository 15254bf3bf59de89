#include "codegen/compile.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <utime.h>

#include <thread>

#include "codegen/compile/cache.hpp"
#include "codegen/emit_cpp.hpp"
#include "runtime/instruction_set.hpp"
#include "tests/codegen/compile/compile_support.hpp"

namespace casimir {
namespace {

namespace fs = std::filesystem;
using testing::answer;
using testing::ask;
using testing::names_in;
using testing::Variable;
using testing::wrapper;

using Compile = testing::Compiles;

TEST_F(Compile, TheSecondTimeItIsThere) {
  const CompiledObject first = make(answer(1));
  EXPECT_FALSE(first.from_cache);
  EXPECT_EQ(ask(first), 1);
  const CompiledObject second = make(answer(1));
  EXPECT_TRUE(second.from_cache);
  EXPECT_EQ(second.path, first.path);
  const CompiledObject other = make(answer(2));
  EXPECT_FALSE(other.from_cache);
  EXPECT_EQ(ask(other), 2);
  EXPECT_TRUE(names_in(cache_, "work-").empty());
}

TEST_F(Compile, TheKeyHoldsFlagsAndCompiler) {
  const CompiledObject first = make(answer(1));
  EXPECT_FALSE(make(answer(1), "", {"-O1"}).from_cache);
  EXPECT_FALSE(make(answer(1), wrapper(folder_, "")).from_cache);
  EXPECT_TRUE(make(answer(1)).from_cache);
}

TEST_F(Compile, TheEnvironmentChoosesTheInstructionsAndTheKeyHoldsThem) {
  const std::string text =
      "extern \"C\" int answer(void) {\n"
      "#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)\n"
      "  return 512;\n"
      "#elif defined(__AVX2__) && defined(__FMA__)\n"
      "  return 256;\n"
      "#elif defined(__AVX__)\n"
      "  return -1;\n"
      "#else\n"
      "  return 128;\n"
      "#endif\n}\n";
  for (const InstructionSet set : instruction_sets_here()) {
    const Variable chosen("CASIMIR_INSTRUCTIONS", name_of(set).c_str());
    const CompiledObject first = make(text);
    EXPECT_FALSE(first.from_cache) << name_of(set);
    EXPECT_EQ(ask(first), set == InstructionSet::avx512 ? 512
                          : set == InstructionSet::avx2 ? 256
                                                        : 128);
    EXPECT_TRUE(make(text).from_cache);
  }
  const Variable chosen("CASIMIR_INSTRUCTIONS", "avx1024");
  EXPECT_THROW(make(text), InstructionsUnavailable);
}

TEST_F(Compile, TheFolderIsPrivate) {
  const mode_t old = umask(0);
  make(answer(1));
  umask(old);
  struct stat info {};
  ASSERT_EQ(stat(cache_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0700u);
}

TEST_F(Compile, AFolderThatOthersMayWriteIsRefused) {
  fs::create_directories(cache_);
  ASSERT_EQ(chmod(cache_.c_str(), 0777), 0);
  EXPECT_THROW(make(answer(1)), CacheUnsafe);
  ASSERT_EQ(chmod(cache_.c_str(), 0770), 0);
  EXPECT_THROW(make(answer(1)), CacheUnsafe);
  ASSERT_EQ(chmod(cache_.c_str(), 0755), 0);
  EXPECT_EQ(ask(make(answer(1))), 1);
  if (geteuid() == 0) {
    ASSERT_EQ(chown(cache_.c_str(), 12345, 12345), 0);
    EXPECT_THROW(make(answer(1)), CacheUnsafe);
  }
}

TEST_F(Compile, ADamagedObjectIsMadeAgain) {
  const CompiledObject first = make(answer(1));
  const std::string sound = testing::read(first.path);
  std::string bent = sound;
  bent[bent.size() / 2] = static_cast<char>(bent[bent.size() / 2] ^ 1);
  for (const std::string& damaged :
       {sound.substr(0, sound.size() / 2), bent, std::string(), std::string("no")}) {
    testing::write(first.path, damaged);
    const CompiledObject again = make(answer(1));
    EXPECT_FALSE(again.from_cache);
    EXPECT_EQ(testing::read(again.path), sound);
  }
  EXPECT_TRUE(make(answer(1)).from_cache);
}

TEST_F(Compile, AnObjectUnderAnotherNameIsNotTaken) {
  const CompiledObject one = make(answer(1));
  const CompiledObject two = make(answer(2));
  fs::copy_file(one.path, two.path, fs::copy_options::overwrite_existing);
  const CompiledObject again = make(answer(2));
  EXPECT_FALSE(again.from_cache);
  EXPECT_EQ(ask(again), 2);
}

TEST_F(Compile, NoCompilerSaysWhatToInstall) {
  const Variable path("PATH", (folder_.path() / "nothing").c_str());
  const Variable cxx("CXX", nullptr);
  try {
    make(answer(1));
    FAIL();
  } catch (const CompilerMissing& e) {
    EXPECT_NE(std::string(e.what()).find("apt-get install g++"), std::string::npos) << e.what();
  }
  EXPECT_THROW(make(answer(1), "no-such-compiler"), CompilerMissing);
}

TEST_F(Compile, TheEnvironmentMayNameTheCompiler) {
  {
    const Variable cxx("CXX", "no-such-compiler -m64");
    try {
      make(answer(1));
      FAIL();
    } catch (const CompilerMissing& e) {
      EXPECT_NE(std::string(e.what()).find("'no-such-compiler'"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("CXX"), std::string::npos);
    }
  }
  const Variable cxx("CXX", "g++ -DNUMBER=7");
  EXPECT_EQ(ask(make("extern \"C\" int answer(void) { return NUMBER; }\n")), 7);
}

TEST_F(Compile, TheCompilersOwnMessageIsShown) {
  try {
    make("this is no program\n");
    FAIL();
  } catch (const CompileFailed& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("error:"), std::string::npos) << text;
    const std::size_t place = text.find(cache_.string() + "/failed-");
    ASSERT_NE(place, std::string::npos) << text;
    EXPECT_EQ(testing::read(text.substr(place, text.find('\n', place) - place)),
              "this is no program\n");
  }
  EXPECT_TRUE(names_in(cache_, "work-").empty());
}

TEST_F(Compile, NowhereToWriteFallsBackAndThenSaysSo) {
  testing::write(folder_.path() / "file", "");
  const fs::path impossible = folder_.path() / "file" / "cache";  // root may write anywhere else
  const Variable temporary("TMPDIR", folder_.path().c_str());
  const CompiledObject object = compile(answer(1), {"", impossible, {}});
  EXPECT_EQ(ask(object), 1);
  EXPECT_TRUE(object.path.string().starts_with(folder_.path().string() + "/casimir-"));
  const Variable nowhere("TMPDIR", (folder_.path() / "file").c_str());
  EXPECT_THROW(compile(answer(1), {"", impossible, {}}), CacheUnusable);
}

TEST_F(Compile, TheCacheIsFoundFromTheEnvironment) {
  const Variable chosen("CASIMIR_CACHE", nullptr);
  const Variable xdg("XDG_CACHE_HOME", (folder_.path() / "xdg").c_str());
  const Variable home("HOME", (folder_.path() / "home").c_str());
  EXPECT_EQ(compile(answer(1)).path.parent_path(), folder_.path() / "xdg" / "casimir");
  const Variable no_xdg("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(compile(answer(1)).path.parent_path(), folder_.path() / "home" / ".cache" / "casimir");
  const Variable named("CASIMIR_CACHE", (folder_.path() / "named").c_str());
  EXPECT_EQ(compile(answer(1)).path.parent_path(), folder_.path() / "named");
}

TEST_F(Compile, TwoHundredProcessesMakeOneObject) {
  const fs::path log = folder_.path() / "log";
  const std::string compiler = wrapper(folder_, "echo run >> " + log.string());
  std::vector<pid_t> children;
  for (int i = 0; i < 200; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      int status = 1;
      try {
        status = testing::read(make(answer(5), compiler).path).empty() ? 2 : 0;
      } catch (const std::exception&) {
        status = 3;
      }
      _exit(status);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  const CompiledObject object = make(answer(5), compiler);
  EXPECT_TRUE(object.from_cache);
  EXPECT_EQ(ask(object), 5);
  EXPECT_EQ(testing::read(log), "run\n");
  EXPECT_TRUE(names_in(cache_, "work-").empty());
}

TEST_F(Compile, AKilledProcessLeavesTheCacheSound) {
  // The compiler outlives the process: it has to have begun, or it may make its files while the
  // folder of both is being removed.
  const fs::path begun = folder_.path() / "begun";
  const std::string slow = wrapper(folder_, "echo > " + begun.string() + "; sleep 5");
  const pid_t child = fork();
  if (child == 0) {
    try {
      make(answer(6), slow);
    } catch (const std::exception&) {
    }
    _exit(0);
  }
  while (!fs::exists(begun)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const std::set<std::string> left = names_in(cache_, "work-");
  ASSERT_EQ(left.size(), 1u);
  wrapper(folder_, "");
  EXPECT_EQ(ask(make(answer(6), slow)), 6);         // the lock died with its process
  EXPECT_EQ(names_in(cache_, "work-").size(), 1u);  // too young to be sure
  const utimbuf long_ago{time(nullptr) - 3600, time(nullptr) - 3600};
  ASSERT_EQ(utime((cache_ / *left.begin()).c_str(), &long_ago), 0);
  make(answer(7));
  EXPECT_TRUE(names_in(cache_, "work-").empty());
}

void on_signal(int) { abandon_compile(); }

TEST_F(Compile, ItCanBeAbandoned) {
  const std::string slow = wrapper(folder_, "exec sleep 30");
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGINT, on_signal);
    int status = 1;
    try {
      make(answer(8), slow);
    } catch (const CompileFailed&) {
      status = 42;
    }
    _exit(status);
  }
  while (!fs::exists(cache_) || names_in(cache_, "work-").empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(child, SIGINT);
  const auto begin = std::chrono::steady_clock::now();
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_TRUE(names_in(cache_, "work-").empty());
  abandon_compile();  // nothing runs: nothing happens
}

TEST_F(Compile, OldObjectsMakeRoom) {
  make(answer(1));
  const utimbuf long_ago{time(nullptr) - 3600, time(nullptr) - 3600};
  for (int i = 0; i < 1100; ++i) {
    const fs::path path = cache_ / ("old" + std::to_string(i) + ".so");
    testing::write(path, "x");
    utime(path.c_str(), &long_ago);
  }
  make(answer(2));
  EXPECT_EQ(names_in(cache_, "old").size(), 998u);  // with the two answers: a thousand
  EXPECT_TRUE(make(answer(1)).from_cache);
}

}  // namespace
}  // namespace casimir

// The compiler, the disk and other users at fault: a clear error or the right object, and a cache
// that stays sound.
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utime.h>

#include <chrono>
#include <functional>
#include <thread>

#include "codegen/compile/cache.hpp"
#include "tests/codegen/compile/compile_support.hpp"

namespace casimir {
namespace {

namespace fs = std::filesystem;
using testing::answer;
using testing::ask;
using testing::names_in;
using testing::Variable;
using testing::wrapper;

/// What a compilation failed with, or "".
std::string failure(const std::string& text, const CompileOptions& options) {
  try {
    compile(text, options);
    return {};
  } catch (const EnvironmentError& problem) {
    return problem.what();
  }
}

/// The exit status of a child that does this; exceptions are 99.
int in_child(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    int status = 99;
    try {
      status = work();
    } catch (const std::exception& problem) {
      fprintf(stderr, "%s\n", problem.what());
    }
    _exit(status);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool is_running(pid_t process) {
  const std::string stat = testing::read("/proc/" + std::to_string(process) + "/stat");
  const std::size_t state = stat.rfind(") ");
  return state != std::string::npos && stat[state + 2] != 'Z';
}

void sleep_for(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

class CompileFault : public testing::Compiles {
 protected:
  CompileOptions with(const std::string& compiler) const { return {compiler, cache_, {}}; }

  /// Nothing of a failed compilation is left but its source.
  void expect_clean() const {
    EXPECT_TRUE(names_in(cache_, "work-").empty());
    for (const auto& entry : fs::directory_iterator(cache_))
      EXPECT_NE(entry.path().extension(), ".so") << entry.path();
  }
};

TEST_F(CompileFault, ACompilerThatHangsIsStoppedWithAllThatItStarted) {
  const fs::path note = folder_.path() / "grandchild";
  CompileOptions options =
      with(wrapper(folder_, "sleep 1000 & echo $! > " + note.string() + "; wait"));
  options.time_limit = 0.5;
  const std::string text = failure(answer(1), options);
  EXPECT_NE(text.find("was stopped after 0.5 s"), std::string::npos) << text;
  EXPECT_NE(text.find("CASIMIR_COMPILE_SECONDS"), std::string::npos) << text;
  const pid_t grandchild = std::stoi(testing::read(note));
  for (int i = 0; i < 1000 && is_running(grandchild); ++i) sleep_for(5);
  EXPECT_FALSE(is_running(grandchild));
  expect_clean();
}

TEST_F(CompileFault, TheEnvironmentBoundsTheTimeOfTheCompiler) {
  const CompileOptions options = with(wrapper(folder_, "trap '' TERM INT; sleep 1000"));
  {
    const Variable limit("CASIMIR_COMPILE_SECONDS", "0.3");
    EXPECT_NE(failure(answer(1), options).find("after 0.3 s"), std::string::npos);
  }
  for (const char* wrong : {"soon", "-1", "0", "1s", "nan", "inf"}) {
    const Variable limit("CASIMIR_COMPILE_SECONDS", wrong);
    EXPECT_NE(failure(answer(1), options).find("CASIMIR_COMPILE_SECONDS"), std::string::npos)
        << wrong;
  }
}

TEST_F(CompileFault, WhatADriverThatDiesHasStartedDiesWithIt) {
  const fs::path note = folder_.path() / "grandchild";
  const std::string text = failure(
      answer(1),
      with(wrapper(folder_, "sleep 1000 & echo $! > " + note.string() + "; kill -SEGV $$")));
  EXPECT_NE(text.find("stopped by signal 11 (Segmentation fault)"), std::string::npos) << text;
  const pid_t grandchild = std::stoi(testing::read(note));
  for (int i = 0; i < 1000 && is_running(grandchild); ++i) sleep_for(5);
  EXPECT_FALSE(is_running(grandchild));
  expect_clean();
}

TEST_F(CompileFault, WhatCannotBeLoadedIsNotKept) {
  const std::string last = "for o; do :; done; ";  // the object's name
  for (const std::string& lines :
       {std::string("exit 0"), last + "echo junk > \"$o\"; exit 0", last + ": > \"$o\"; exit 0",
        last + "c++ \"$@\"; head -c 3000 \"$o\" > \"$o.2\"; mv \"$o.2\" \"$o\"; exit 0"}) {
    const std::string text = failure(answer(1), with(wrapper(folder_, lines)));
    EXPECT_NE(text.find("said that it succeeded, but what it made cannot be loaded"),
              std::string::npos)
        << lines << '\n'
        << text;
    expect_clean();
  }
}

TEST_F(CompileFault, ADiskWithoutRoomIsSaidOrAnotherFolderTaken) {
  fs::create_directories(cache_);
  fs::permissions(cache_, fs::perms::owner_all);
  const fs::path spare = folder_.path() / "spare";
  fs::create_directories(spare);
  const Variable temporary("TMPDIR", spare.c_str());
  // Source, object and messages meet the limit in turn.
  for (const std::string& text : {answer(3), answer(3) + "/*" + std::string(20000, '-') + "*/\n"}) {
    for (const rlim_t bytes :
         {0, 30, 1000, 5000, 10000, 13000, 14000, 16000, 18000, 21000, 30000}) {
      EXPECT_EQ(in_child([&] {
                  // No file longer than that: needs no right to mount, and all disks are alike.
                  signal(SIGXFSZ, SIG_IGN);
                  const rlimit limit{bytes, bytes};
                  setrlimit(RLIMIT_FSIZE, &limit);
                  const std::string problem = failure(text, {"", cache_, {}});
                  if (problem.empty()) return ask(make(text)) == 3 ? 0 : 1;
                  return problem.find("File too large") != std::string::npos ? 0 : 2;
                }),
                0)
          << bytes;
      EXPECT_TRUE(names_in(cache_, "work-").empty()) << bytes;
      EXPECT_EQ(ask(make(text)), 3) << bytes;
      for (const std::string& name : names_in(cache_, "")) fs::remove_all(cache_ / name);
    }
  }
}

/// A file system of so many bytes over a folder, for this process. \return  false without the right
bool mount_small_disk(const fs::path& folder, int bytes) {
  const std::string size = "mode=700,size=" + std::to_string(bytes);
  return unshare(geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) == 0 &&
         mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("none", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
}

TEST_F(CompileFault, AFullDiskLeavesTheWorkToAnotherOne) {
  fs::create_directories(cache_);
  const fs::path spare = folder_.path() / "spare";
  fs::create_directories(spare);
  const Variable temporary("TMPDIR", spare.c_str());
  const std::string text = answer(3) + "/*" + std::string(20000, '-') + "*/\n";
  for (const int bytes : {4096, 16384, 28672, 40960, 65536}) {
    const int status = in_child([&] {
      if (!mount_small_disk(cache_, bytes)) return 77;
      const CompiledObject object = compile(text, {"", cache_, {}});
      if (bytes < 40000 && !object.path.string().starts_with(spare.string())) return 2;
      return ask(object) == 3 && names_in(cache_, "work-").empty() ? 0 : 3;
    });
    // Where nobody may mount, the test above has the same errors from the limit of files.
    EXPECT_TRUE(status == 0 || status == 77) << bytes << ": " << status;
  }
}

TEST_F(CompileFault, AReadOnlyCacheIsReadAndNotWritten) {
  const CompiledObject known = make(answer(1));
  const fs::path spare = folder_.path() / "spare";
  fs::create_directories(spare);
  const Variable temporary("TMPDIR", spare.c_str());
  fs::permissions(cache_, fs::perms::owner_read | fs::perms::owner_exec);
  if (geteuid() == 0) {  // whom modes do not stop
    for (const fs::path& path : {folder_.path(), cache_, known.path, spare})
      ASSERT_EQ(chown(path.c_str(), 12345, 12345), 0);
  }
  EXPECT_EQ(in_child([&] {
              if (geteuid() == 0 && (setgid(12345) != 0 || setuid(12345) != 0)) return 1;
              const CompiledObject again = make(answer(1));
              if (!again.from_cache || again.path != known.path) return 2;
              const CompiledObject other = make(answer(2));
              return other.path.string().starts_with(spare.string()) && ask(other) == 2 ? 0 : 3;
            }),
            0);
  if (geteuid() == 0) {
    ASSERT_EQ(chown(folder_.path().c_str(), 0, 0), 0);
  }
  fs::permissions(cache_, fs::perms::owner_all);
}

TEST_F(CompileFault, OnlyAFileOfOursThatNobodyElseCanWriteIsAnObject) {
  const CompiledObject object = make(answer(1));
  const fs::path path = object.path;
  const std::string sound = testing::read(path);
  const fs::path aside = folder_.path() / "aside.so";
  testing::write(aside, sound);
  const std::vector<std::function<void()>> forgeries{
      [&] { chmod(path.c_str(), 0620); },
      [&] { chmod(path.c_str(), 0602); },
      [&] { fs::remove(path), fs::create_symlink(aside, path); },
      [&] { fs::remove(path), fs::create_symlink("/dev/zero", path); },
      [&] { fs::remove(path), mkfifo(path.c_str(), 0600); },
      [&] {
        if (geteuid() == 0)
          EXPECT_EQ(chown(path.c_str(), 12345, 12345), 0);
        else
          fs::remove(path);
      },
  };
  for (std::size_t i = 0; i < forgeries.size(); ++i) {
    forgeries[i]();
    const CompiledObject again = make(answer(1));
    EXPECT_FALSE(again.from_cache) << i;
    EXPECT_EQ(testing::read(again.path), sound) << i;
    struct stat info {};
    ASSERT_EQ(lstat(path.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode, static_cast<mode_t>(S_IFREG | 0600)) << i;
  }
  EXPECT_EQ(testing::read(aside), sound);  // it was not the link's business
}

TEST_F(CompileFault, AFolderThatOthersCanReplaceIsRefused) {
  const fs::path open = folder_.path() / "open";
  fs::create_directories(open);
  ASSERT_EQ(chmod(open.c_str(), 0777), 0);
  EXPECT_THROW(compile(answer(1), {"", open / "cache", {}}), CacheUnsafe);
  ASSERT_EQ(chmod(open.c_str(), 01777), 0);  // as /tmp: only the owner may rename
  EXPECT_EQ(ask(compile(answer(1), {"", open / "cache", {}})), 1);
}

TEST_F(CompileFault, LocksThatAreNoneDoNotHoldUs) {
  const CompiledObject object = make(answer(1));
  const fs::path lock = cache_ / ("lock-" + object.path.filename().string().substr(0, 2));
  const std::vector<std::function<void()>> obstacles{
      [&] { fs::create_directory(lock); },
      [&] { mkfifo(lock.c_str(), 0600); },
      [&] { fs::create_symlink("/dev/zero", lock); },
  };
  for (const auto& put : obstacles) {
    fs::remove(lock);
    fs::remove(object.path);
    put();
    EXPECT_EQ(ask(make(answer(1))), 1);
  }
}

TEST_F(CompileFault, AStuckHolderOfTheLockIsNotWaitedForLongerThanForACompiler) {
  const CompiledObject object = make(answer(1));
  fs::remove(object.path);
  const std::string key = object.path.stem();
  const pid_t holder = fork();
  if (holder == 0) {
    const codegen::CacheLock lock(codegen::Cache(cache_), key, 1);
    testing::write(folder_.path() / "held", "");
    sleep_for(1000000);
  }
  while (!fs::exists(folder_.path() / "held")) sleep_for(1);
  kill(holder, SIGSTOP);
  CompileOptions options = with("");
  options.time_limit = 2;
  EXPECT_EQ(ask(compile(answer(1), options)), 1);
  kill(holder, SIGKILL);
  waitpid(holder, nullptr, 0);
}

TEST_F(CompileFault, KilledAtAnyMomentTheCacheStaysSound) {
  constexpr int kKills = 40;
  unsigned random = 12345;
  for (int i = 0; i < kKills; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      try {
        make(answer(i));
      } catch (const std::exception&) {
      }
      _exit(0);
    }
    random = random * 1664525U + 1013904223U;
    std::this_thread::sleep_for(std::chrono::microseconds((random >> 8) % 120000));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  // Whatever stands under its name is whole.
  const codegen::Cache cache(cache_);
  for (const auto& entry : fs::directory_iterator(cache_)) {
    if (entry.path().extension() == ".so") {
      EXPECT_TRUE(cache.find(entry.path().stem()).has_value()) << entry.path();
    }
  }
  for (int i = 0; i < kKills; ++i) EXPECT_EQ(ask(make(answer(i))), i);
  for (const std::string& name : names_in(cache_, "work-")) {
    const utimbuf long_ago{time(nullptr) - 3600, time(nullptr) - 3600};
    ASSERT_EQ(utime((cache_ / name).c_str(), &long_ago), 0);
  }
  make(answer(kKills));
  EXPECT_TRUE(names_in(cache_, "work-").empty());
}

std::uintmax_t bytes_of_objects(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    struct stat info {};
    if (lstat(entry.path().c_str(), &info) == 0 && entry.is_regular_file())
      sum += static_cast<std::uintmax_t>(info.st_blocks) * 512;
  }
  return sum;
}

TEST_F(CompileFault, TheCacheKeepsWhatWasUsedLastWithinItsBound) {
  make(answer(0));
  const std::uintmax_t one = bytes_of_objects(cache_);
  const Variable bound("CASIMIR_CACHE_SIZE", std::to_string(4 * one).c_str());
  for (int i = 1; i < 12; ++i) {
    EXPECT_EQ(ask(make(answer(i))), i);
    EXPECT_LE(bytes_of_objects(cache_), 4 * one);
    EXPECT_TRUE(make(answer(0)).from_cache) << i;  // used all the time
  }
  EXPECT_TRUE(make(answer(11)).from_cache);
  EXPECT_FALSE(make(answer(3)).from_cache);
}

TEST_F(CompileFault, SourcesOfFailuresCountForTheBound) {
  const Variable bound("CASIMIR_CACHE_SIZE", "64K");
  for (int i = 0; i < 20; ++i)
    failure("error " + std::to_string(i) + std::string(8000, ' '), with("/bin/false"));
  make(answer(1));
  EXPECT_LE(bytes_of_objects(cache_), 64U << 10);
}

TEST_F(CompileFault, WhatIsInUseIsNotRemoved) {
  const CompiledObject held = make(answer(1));
  const Variable bound("CASIMIR_CACHE_SIZE", "0");
  const CompiledObject second = make(answer(2));
  EXPECT_TRUE(fs::exists(held.path));
  EXPECT_EQ(ask(second), 2);
  EXPECT_EQ(ask(held), 1);
  make(answer(3));  // not held
  make(answer(4));
  EXPECT_EQ(names_in(cache_, "").size(), names_in(cache_, "lock-").size() + 3);
}

TEST_F(CompileFault, ABoundThatIsNoSizeIsSaid) {
  for (const char* wrong : {"many", "-1", "1.5M", "5T", "99999999999999999999", "20000000000G"}) {
    const Variable bound("CASIMIR_CACHE_SIZE", wrong);
    EXPECT_NE(failure(answer(1), with("")).find("CASIMIR_CACHE_SIZE"), std::string::npos) << wrong;
  }
}

TEST_F(CompileFault, AnObjectForAnotherProcessorIsNotTaken) {
  const std::string description = "flags : teleport\n" + testing::read("/proc/cpuinfo");
  CompileOptions elsewhere = with("");
  elsewhere.processor = folder_.path() / "cpuinfo";
  testing::write(elsewhere.processor, description);
  const CompiledObject foreign = compile(answer(1), elsewhere);
  EXPECT_TRUE(compile(answer(1), elsewhere).from_cache);
  const CompiledObject ours = make(answer(1));
  EXPECT_FALSE(ours.from_cache);
  EXPECT_NE(ours.path, foreign.path);
  // Not even under the name that it would have here.
  fs::copy_file(foreign.path, ours.path, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(make(answer(1)).from_cache);
  // Without a description the system's word still tells processors apart.
  elsewhere.processor = folder_.path() / "none";
  EXPECT_GT(codegen::processor_identity(elsewhere.processor).size(), 5U);
}

}  // namespace
}  // namespace casimir

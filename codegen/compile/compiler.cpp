#include "codegen/compile/compiler.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/auxv.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "codegen/compile.hpp"

extern char** environ;

namespace casimir {

namespace {

namespace fs = std::filesystem;

constexpr const char* kInstall = "install one, for instance with: apt-get install g++";
constexpr std::size_t kMessageLimit = 8000;
constexpr std::size_t kPathLimit = 4096;

// What a signal handler may need. Written only between runs, read by abandon_compile.
std::atomic<pid_t> running{0};
std::atomic<bool> has_files{false};
char abandoned_folder[kPathLimit];

std::vector<std::string> words(const std::string& command) {
  std::istringstream in(command);
  std::vector<std::string> result;
  for (std::string word; in >> word;) result.push_back(word);
  return result;
}

bool is_program(const fs::path& path) {
  struct stat info {};
  return stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode) && access(path.c_str(), X_OK) == 0;
}

/// The program's absolute path, or empty.
fs::path located(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    std::error_code ignored;
    return is_program(name) ? fs::absolute(name, ignored) : fs::path();
  }
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path(folder.empty() ? "." : folder) / name;
    if (is_program(candidate)) return fs::absolute(candidate);
  }
  return {};
}

std::string identity_of(const fs::path& program) {
  std::error_code ignored;
  const fs::path real = fs::canonical(program, ignored);
  struct stat info {};
  if (stat(program.c_str(), &info) != 0) return real.string();
  std::ostringstream out;
  out << real.string() << ' ' << info.st_size << ' ' << info.st_mtim.tv_sec << '.'
      << info.st_mtim.tv_nsec;
  return out.str();
}

/// The environment of the compiler: ours, with its temporary files where they will be removed and
/// its messages in English.
std::vector<std::string> compiler_environment(const fs::path& folder) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (!text.starts_with("TMPDIR=") && !text.starts_with("LC_ALL=")) result.push_back(text);
  }
  result.push_back("TMPDIR=" + folder.string());
  result.push_back("LC_ALL=C");
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::string beginning_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(kMessageLimit, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

/// Starts the program with default signals, no input, and its messages in a file.
int spawn(pid_t& child, const codegen::Compiler& compiler, std::vector<std::string> arguments,
          const fs::path& folder) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const fs::path messages = folder / "messages";
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&files, 1, 2);

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGCHLD}) {
    sigaddset(&signals, signal);
  }
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);

  std::vector<std::string> environment = compiler_environment(folder);
  const int failure = posix_spawn(&child, compiler.program.c_str(), &files, &attributes,
                                  pointers(arguments).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return failure;
}

/// While it lives, signals that end the program wait: their handler has to know of a child that was
/// started.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, signal);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

/// Waits for the end of the child but leaves its number taken. \return  false after `seconds`
bool has_ended(pid_t child, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (auto pause = std::chrono::microseconds(200);;) {
    siginfo_t info{};
    const int failed = waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
    // Where the parent ignores SIGCHLD there is no child any more, and no status.
    if (failed ? errno != EINTR : info.si_pid == child) return true;
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(5000));
  }
}

/// Removes the files in a folder with nothing but system calls: a signal handler may not use more.
void remove_files(int folder) {
  struct Entry {  // as the kernel writes them
    ino64_t inode;
    off64_t offset;
    unsigned short length;
    unsigned char type;
    char name[1];
  };
  alignas(Entry) char entries[4096];
  for (long size = 0; (size = syscall(SYS_getdents64, folder, entries, sizeof entries)) > 0;) {
    for (long at = 0; at < size;) {
      const auto* const entry = reinterpret_cast<const Entry*>(entries + at);
      unlinkat(folder, entry->name, 0);
      at += entry->length;
    }
  }
}

}  // namespace

namespace codegen {

Compiler find_compiler(const std::string& wanted) {
  const char* variable = std::getenv("CXX");
  const bool from_variable = wanted.empty() && variable && !words(variable).empty();
  const std::vector<std::string> command = words(from_variable ? variable : wanted);
  if (!command.empty()) {
    const fs::path program = located(command[0]);
    if (program.empty()) {
      throw CompilerMissing("the C++ compiler '" + command[0] + "'" +
                            (from_variable ? " (from the environment variable CXX)" : "") +
                            " was not found; " + kInstall);
    }
    return {program, {command.begin() + 1, command.end()}, identity_of(program)};
  }
  for (const char* name : {"c++", "g++", "clang++"}) {
    const fs::path program = located(name);
    if (!program.empty()) return {program, {}, identity_of(program)};
  }
  throw CompilerMissing(std::string("no C++ compiler was found (looked for c++, g++, clang++); ") +
                        kInstall);
}

std::string processor_identity(const fs::path& description) {
  std::ifstream in(description);
  std::string result =
      std::to_string(getauxval(AT_HWCAP)) + " " + std::to_string(getauxval(AT_HWCAP2)) + "\n";
#ifdef __x86_64__
  for (const bool has : {__builtin_cpu_supports("avx"), __builtin_cpu_supports("avx2"),
                         __builtin_cpu_supports("fma"), __builtin_cpu_supports("bmi2"),
                         __builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512vl"),
                         __builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512bw"),
                         __builtin_cpu_supports("avx512ifma"), __builtin_cpu_supports("gfni")}) {
    result += has ? '1' : '0';
  }
#endif
  for (std::string line; std::getline(in, line) && !line.empty();) {
    for (const char* key :
         {"vendor_id", "cpu family", "model", "stepping", "flags", "Features", "CPU "}) {
      if (line.starts_with(key)) result += line + "\n";
    }
  }
  return result;
}

CompilerRun run_compiler(const Compiler& compiler, const std::vector<std::string>& arguments,
                         const fs::path& folder, double seconds) {
  std::vector<std::string> all{compiler.program.string()};
  all.insert(all.end(), compiler.arguments.begin(), compiler.arguments.end());
  all.insert(all.end(), arguments.begin(), arguments.end());
  pid_t child = 0;
  {
    const SignalsWait wait;
    if (const int failure = spawn(child, compiler, std::move(all), folder)) {
      throw CompilerMissing("the C++ compiler " + compiler.program.string() +
                            " cannot be started: " + std::strerror(failure) + "; " + kInstall);
    }
    running = child;
  }
  CompilerRun result;
  result.timed_out = !has_ended(child, seconds);
  // What the driver started, too, and before the driver's number can be given to others.
  kill(-child, SIGKILL);
  int status = 0;
  pid_t waited = -1;
  do {
    waited = waitpid(child, &status, 0);
  } while (waited < 0 && errno == EINTR);
  running = 0;
  // Where the parent ignores SIGCHLD there is no status: the object tells.
  result.succeeded =
      !result.timed_out && (waited == child ? WIFEXITED(status) && WEXITSTATUS(status) == 0
                                            : fs::exists(folder / "object.so"));
  result.signal = waited == child && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.messages = beginning_of(folder / "messages");
  return result;
}

void set_abandoned_files(const fs::path& folder) {
  has_files = false;
  if (folder.empty() || folder.string().size() >= kPathLimit) return;
  std::strcpy(abandoned_folder, folder.c_str());
  has_files = true;
}

}  // namespace codegen

void abandon_compile() noexcept {
  const int saved = errno;
  if (const pid_t child = running; child > 0) kill(-child, SIGKILL);
  if (has_files) {
    const int folder = open(abandoned_folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder >= 0) remove_files(folder);
    if (folder >= 0) close(folder);
    rmdir(abandoned_folder);
  }
  errno = saved;
}

}  // namespace casimir

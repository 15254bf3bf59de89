#include "codegen/compiler.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "codegen/compile.hpp"

extern char** environ;

namespace casimir {

namespace {

namespace fs = std::filesystem;

constexpr const char* kInstall = "install one, for instance with: apt-get install g++";
constexpr std::size_t kMessageLimit = 8000;
constexpr std::size_t kPathLimit = 4096;
constexpr const char* kFilesOfRun[] = {"source.cpp", "object.so", "messages"};

// What a signal handler may need. Written only between runs, read by abandon_compile.
std::atomic<pid_t> running{0};
std::atomic<bool> has_files{false};
char abandoned_folder[kPathLimit];
char abandoned_files[std::size(kFilesOfRun)][kPathLimit];

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
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::vector<std::string> environment = compiler_environment(folder);
  const int failure = posix_spawn(&child, compiler.program.c_str(), &files, &attributes,
                                  pointers(arguments).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return failure;
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

std::string processor_identity() {
  std::ifstream in("/proc/cpuinfo");
  std::string result;
  for (std::string line; std::getline(in, line) && !line.empty();) {
    for (const char* key :
         {"vendor_id", "cpu family", "model", "stepping", "flags", "Features", "CPU "}) {
      if (line.starts_with(key)) result += line + "\n";
    }
  }
  return result;
}

CompilerRun run_compiler(const Compiler& compiler, const std::vector<std::string>& arguments,
                         const fs::path& folder) {
  std::vector<std::string> all{compiler.program.string()};
  all.insert(all.end(), compiler.arguments.begin(), compiler.arguments.end());
  all.insert(all.end(), arguments.begin(), arguments.end());
  pid_t child = 0;
  if (const int failure = spawn(child, compiler, std::move(all), folder)) {
    throw CompilerMissing("the C++ compiler " + compiler.program.string() +
                          " cannot be started: " + std::strerror(failure) + "; " + kInstall);
  }
  running = child;
  int status = 0;
  pid_t waited = -1;
  do {
    waited = waitpid(child, &status, 0);
  } while (waited < 0 && errno == EINTR);
  running = 0;
  CompilerRun result;
  // Where the parent ignores SIGCHLD there is no status: the object tells.
  result.succeeded = waited == child ? WIFEXITED(status) && WEXITSTATUS(status) == 0
                                     : fs::exists(folder / "object.so");
  result.signal = waited == child && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.messages = beginning_of(folder / "messages");
  return result;
}

void set_abandoned_files(const fs::path& folder) {
  has_files = false;
  if (folder.empty() || folder.string().size() + 20 > kPathLimit) return;
  std::strcpy(abandoned_folder, folder.c_str());
  for (std::size_t i = 0; i < std::size(kFilesOfRun); ++i) {
    std::strcpy(abandoned_files[i], (folder / kFilesOfRun[i]).c_str());
  }
  has_files = true;
}

}  // namespace codegen

void abandon_compile() noexcept {
  const int saved = errno;
  // SIGTERM, so that the compiler's driver removes its own temporary files.
  if (const pid_t child = running; child > 0) kill(child, SIGTERM);
  if (has_files) {
    for (const char* file : abandoned_files) unlink(file);
    rmdir(abandoned_folder);
  }
  errno = saved;
}

}  // namespace casimir

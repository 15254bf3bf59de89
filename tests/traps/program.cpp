#include "tests/traps/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace casimir::traps {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Starts it in a process group of its own, so that its compiler ends with it.
pid_t start(const std::vector<std::string>& words, const std::string& out, const std::string& err) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), kWrite, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), kWrite, 0600);
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&how, 0);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, copies[0].c_str(), &files, &how, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&how);
  if (failed != 0) throw std::runtime_error("cannot run " + copies[0]);
  return child;
}

bool ends_within(pid_t child, double seconds) {
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  if (handle < 0) throw std::runtime_error("no handle of a process");
  pollfd end{handle, POLLIN, 0};
  const bool ended = poll(&end, 1, static_cast<int>(seconds * 1000)) > 0;
  close(handle);
  return ended;
}

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

Said run_program(const std::vector<std::string>& words, const std::string& folder, double seconds) {
  const std::string out = folder + "/stdout", err = folder + "/stderr";
  Said said;
  const pid_t child = start(words, out, err);
  const rlimit most{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds) + 1};
  prlimit(child, RLIMIT_CPU, &most, nullptr);
  said.in_time = ends_within(child, 10 * seconds);
  if (!said.in_time) kill(-child, SIGKILL);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  said.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  said.in_time = said.in_time && said.status != 128 + SIGXCPU;
  said.seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  said.out = text_of(out);
  said.err = text_of(err);
  return said;
}

}  // namespace casimir::traps

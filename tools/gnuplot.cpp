#include "tools/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tools/cli.hpp"

extern char** environ;

namespace casimir::tools {
namespace {

/// Runs `gnuplot FILE`; what it says is kept in `log`.
int run_gnuplot(const std::string& file, const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::string program = "gnuplot";
  std::string argument = file;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int problem = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0)
    throw SystemError(
        fmt::format("a plot needs gnuplot, which could not be started ({}); install it with: "
                    "apt-get install gnuplot-nox",
                    std::strerror(problem)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c >= ' ' && c <= '~' && c != '\'' && c != '`' && c != '\\') result += c;
  }
  return result + "'";
}

void check_plot_name(const std::string& path) {
  if (!path.ends_with(".svg") && !path.ends_with(".png")) {
    throw UsageError(
        fmt::format("'{}': a plot's name must end in .svg or .png", printable(path, 200)));
  }
}

void draw_script(const std::string& script, OutputFile& picture) {
  if (picture.temporary().string().find_first_of("'`\\\n") != std::string::npos)
    throw UsageError("a plot's name must not contain quotes");
  const std::string beside = picture.temporary().string();
  OutputFile commands(beside + ".gnuplot");
  OutputFile log(beside + ".log");
  commands.stream() << script;
  commands.stream().flush();
  if (run_gnuplot(commands.temporary().string(), log.temporary().string()) != 0) {
    std::ifstream said(log.temporary());
    std::string line;
    while (line.empty() && std::getline(said, line)) {
    }
    throw SystemError("gnuplot failed: " + printable(line, 200));
  }
}

}  // namespace casimir::tools

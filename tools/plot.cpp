#include "tools/plot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "tools/cli.hpp"
#include "tools/output.hpp"

extern char** environ;

namespace casimir::tools {
namespace {

/// Colours that differ in lightness too (Okabe and Ito), each with its own mark: the curves can be
/// told apart without colour.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#000000", "#e69f00", "#56b4e9"};

/// gnuplot's numbers of marks that have an open and a filled form.
struct Mark {
  int open, filled;
};
constexpr Mark kMarks[] = {{4, 5}, {6, 7}, {8, 9}, {10, 11}, {12, 13}};

/// Text for gnuplot: plain characters only, so that nothing of a case file is a command there.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c >= ' ' && c <= '~' && c != '\'' && c != '`' && c != '\\') result += c;
  }
  return result + "'";
}

std::string script(const Plot& plot, const std::string& terminal, const std::string& output) {
  std::string text =
      fmt::format("set terminal {} noenhanced\nset output {}\n", terminal, quoted(output));
  text += fmt::format("set title {}\nset xlabel {}\nset ylabel {}\n", quoted(plot.title),
                      quoted(plot.x_label), quoted(plot.y_label));
  text += "set grid lc rgb '#d0d0d0'\nset key outside right top\nset tics nomirror\nset border 3\n";
  if (plot.log_x) text += "set logscale x\nset format x '1e%T'\n";
  if (plot.log_y) text += "set logscale y\nset format y '1e%T'\n";
  std::string commands;
  std::size_t group = 0;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    text += fmt::format("$curve{} << EOD\n", i);
    for (const auto& [x, y] : curve.points) {
      const bool drawn =
          std::isfinite(x) && std::isfinite(y) && (!plot.log_x || x > 0) && (!plot.log_y || y > 0);
      if (drawn) text += fmt::format("{:.9g} {:.9g}\n", x, y);
    }
    text += "EOD\n";
    if (i > 0 && !curve.variant) ++group;
    const std::size_t mark = group % std::size(kMarks);
    const std::string style =
        curve.variant ? fmt::format("points lw 1.4 pt {} ps 1.6", kMarks[mark].open)
                      : fmt::format("linespoints lw 1.8 pt {} ps 0.9", kMarks[mark].filled);
    commands += fmt::format("{}$curve{} using 1:2 with {} lc rgb '{}' title {}",
                            i == 0 ? "plot " : ", \\\n     ", i, style,
                            kColours[group % std::size(kColours)], quoted(curve.name));
  }
  return text + commands + "\n";
}

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

void check_plot_name(const std::string& path) {
  if (!path.ends_with(".svg") && !path.ends_with(".png")) {
    throw UsageError(
        fmt::format("'{}': a plot's name must end in .svg or .png", printable(path, 200)));
  }
}

void draw(const Plot& plot, const std::string& path) {
  check_plot_name(path);
  const std::string terminal =
      path.ends_with(".svg") ? "svg size 900,560 dynamic background rgb 'white' font 'sans,13'"
                             : "png size 1200,750 font 'sans,13' background rgb 'white'";
  OutputFile picture(path);
  OutputFile commands(path + ".gnuplot");
  OutputFile log(path + ".log");
  commands.stream() << script(plot, terminal, picture.temporary().string());
  commands.stream().flush();
  if (picture.temporary().string().find_first_of("'`\\\n") != std::string::npos)
    throw UsageError("a plot's name must not contain quotes");
  if (run_gnuplot(commands.temporary().string(), log.temporary().string()) != 0) {
    std::ifstream said(log.temporary());
    std::string line;
    while (line.empty() && std::getline(said, line)) {
    }
    throw SystemError("gnuplot failed: " + printable(line, 200));
  }
  picture.commit();
}

}  // namespace casimir::tools

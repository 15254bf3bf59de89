#include "tools/plot/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/text/text_layout.hpp"
#include "tools/typeset/printed_names.hpp"

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

/// Whether the picture has its end: gnuplot does not notice where it cannot write.
bool is_whole(const std::string& picture) {
  std::ifstream in(picture, std::ios::binary | std::ios::ate);
  const auto size = std::min<std::streamoff>(in.tellg(), 32);
  std::string end(static_cast<std::size_t>(std::max<std::streamoff>(size, 0)), '\0');
  in.seekg(-size, std::ios::end);
  in.read(end.data(), size);
  return in &&
         (end.find("</svg>") != std::string::npos || end.find("\\endgroup") != std::string::npos ||
          end.find("IEND") != std::string::npos || end.find("%%EOF") != std::string::npos);
}

}  // namespace

std::string quoted(const std::string& text, const Sheet& sheet) {
  std::string kept;
  for (const char c : one_line(text)) {
    if (c != '\'' && c != '`' && c != '\\') kept += c;
  }
  return "'" + (sheet.latex() ? latex_text(kept) : kept) + "'";
}

std::string quoted_lines(const std::string& text, std::size_t letters, const Sheet& sheet) {
  std::string lines;
  for (const std::string& line : wrapped(text, letters))
    lines += (lines.empty() ? "" : ".\"\\n\".") + quoted(line, sheet);
  return lines.empty() ? "''" : lines;
}

std::string quoted_path(const std::string& path) {
  if (path.find_first_of("'`\\\n") != std::string::npos)
    throw UsageError("a plot's name must not contain quotes");
  // From the root on: gnuplot runs what follows a '|', and takes a '-' for an option.
  return "'" + std::filesystem::absolute(path).string() + "'";
}

void draw_script(const std::string& script, const std::filesystem::path& file) {
  const std::string beside = std::filesystem::absolute(file).string();
  OutputFile commands(beside + ".gnuplot");
  OutputFile log(beside + ".log");
  commands.stream() << script;
  if (!commands.stream().flush())
    throw SystemError(fmt::format("cannot write all of '{}': the disk may be full",
                                  printable(commands.temporary().string(), 200)));
  if (run_gnuplot(commands.temporary().string(), log.temporary().string()) != 0) {
    std::ifstream said(log.temporary());
    std::string line;
    while (line.empty() && std::getline(said, line)) {
    }
    throw SystemError("gnuplot failed: " + printable(line, 200));
  }
  if (std::filesystem::is_regular_file(beside) && !is_whole(beside))
    throw SystemError(fmt::format("gnuplot could not write all of '{}': the disk may be full",
                                  printable(beside, 200)));
}

namespace {

/// Names that \includegraphics takes as they are.
void check_latex_name(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  const bool plain = std::ranges::all_of(name, [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.';
  });
  if (!plain || std::ranges::count(name, '.') != 1 || name.front() == '.' || name.front() == '-')
    throw UsageError(fmt::format(
        "'{}': LaTeX includes the picture by its name, which can have letters, digits and hyphens",
        printable(path, 200)));
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// gnuplot writes the lines to a PDF of the same name, which the text then includes. It wants three
/// letters at the end of names.
void draw_latex(const Sheet& sheet, const std::function<std::string(const std::string&)>& script) {
  check_latex_name(sheet.path);
  OutputFile text(sheet.path);
  OutputFile lines(std::filesystem::path(sheet.path).replace_extension(".pdf"));
  const std::string name = std::filesystem::absolute(text.temporary()).string();
  const ScratchFile drawn_text(name + ".tex"), drawn_lines(name + ".pdf");
  draw_script(script(drawn_text.path().string()), drawn_text.path());
  std::string content = content_of(drawn_text.path());
  const std::size_t at = content.find("{" + name + "}");
  if (at == std::string::npos)
    throw SystemError("gnuplot wrote a LaTeX figure that does not include its lines");
  content.replace(at + 1, name.size(), std::filesystem::path(sheet.path).stem().string());
  text.stream() << content;
  lines.stream() << content_of(drawn_lines.path());
  lines.commit();
  text.commit();
}

}  // namespace

void draw_sheet(const Sheet& sheet, const std::function<std::string(const std::string&)>& script,
                const std::function<void(const std::filesystem::path&)>& finished) {
  check_plot_name(sheet.path);
  if (sheet.latex()) {
    draw_latex(sheet, script);
    return;
  }
  OutputFile picture(sheet.path);
  draw_script(script(picture.temporary().string()), picture.temporary());
  if (finished) finished(picture.temporary());
  picture.commit();
}

}  // namespace casimir::tools

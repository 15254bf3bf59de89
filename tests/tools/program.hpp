#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/folder.hpp"

namespace casimir::test {

/// What a run of the program left.
struct Outcome {
  int status = -1;  ///< exit status, or 128 + signal
  std::string out, err;
  nlohmann::ordered_json json() const { return nlohmann::ordered_json::parse(out); }
};

/// What a document of ours carries as text.
inline double number(const nlohmann::ordered_json& text) {
  return std::stod(text.get<std::string>());
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

using Environment = std::vector<std::pair<std::string, std::string>>;

/// Makes this process the program.
[[noreturn]] inline void execute(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{CASIMIR_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(CASIMIR_PROGRAM, pointers.data());
  _exit(127);
}

/// Starts the program in `folder`, with `input` on standard input; does not wait.
inline pid_t start(const std::vector<std::string>& arguments, const Folder& folder,
                   const std::string& input = {}, const Environment& environment = {}) {
  const std::string in = folder.write(".stdin", input);
  const pid_t child = fork();
  if (child != 0) return child;
  const auto redirect = [&](const char* name, int descriptor, int flags) {
    dup2(open((folder.path() / name).c_str(), flags, 0600), descriptor);
  };
  if (chdir(folder.path().c_str()) != 0) _exit(127);
  redirect(".stdin", STDIN_FILENO, O_RDONLY);
  redirect(".stdout", STDOUT_FILENO, O_WRONLY | O_CREAT | O_TRUNC);
  redirect(".stderr", STDERR_FILENO, O_WRONLY | O_CREAT | O_TRUNC);
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  execute(arguments);
}

inline Outcome finish(pid_t child, const Folder& folder) {
  int status = 0;
  waitpid(child, &status, 0);
  Outcome outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = file_text(folder.path() / ".stdout");
  outcome.err = file_text(folder.path() / ".stderr");
  for (const char* name : {".stdin", ".stdout", ".stderr"})
    std::filesystem::remove(folder.path() / name);
  return outcome;
}

inline Outcome run_in(const Folder& folder, const std::vector<std::string>& arguments,
                      const std::string& input = {}, const Environment& environment = {}) {
  return finish(start(arguments, folder, input, environment), folder);
}

inline Outcome run(const std::vector<std::string>& arguments, const std::string& input = {},
                   const Environment& environment = {}) {
  const Folder folder;
  return run_in(folder, arguments, input, environment);
}

}  // namespace casimir::test

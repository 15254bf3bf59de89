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

namespace casimir::test {

/// What a run of the program left.
struct Outcome {
  int status = -1;  ///< exit status, or 128 + signal
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A folder of its own, removed with the object.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "casimir-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

using Environment = std::vector<std::pair<std::string, std::string>>;

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
  std::vector<std::string> words{CASIMIR_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(CASIMIR_PROGRAM, pointers.data());
  _exit(127);
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

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "codegen/compile.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::testing {

namespace fs = std::filesystem;

inline std::string answer(int number) {
  return "extern \"C\" int answer(void) { return " + std::to_string(number) + "; }\n";
}

inline int ask(const CompiledObject& object) { return entry<int()>(object.path, "answer")(); }

/// Sets an environment variable for the length of a test.
class Variable {
 public:
  Variable(std::string name, const char* value) : name_(std::move(name)) {
    if (const char* old = getenv(name_.c_str())) old_ = old;
    had_ = getenv(name_.c_str()) != nullptr;
    value ? setenv(name_.c_str(), value, 1) : unsetenv(name_.c_str());
  }
  ~Variable() { had_ ? setenv(name_.c_str(), old_.c_str(), 1) : unsetenv(name_.c_str()); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  std::string name_, old_;
  bool had_ = false;
};

inline std::set<std::string> names_in(const fs::path& folder, const std::string& beginning) {
  std::set<std::string> result;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(beginning)) result.insert(name);
  }
  return result;
}

/// A compiler that runs the given shell lines and then the real one.
inline std::string wrapper(const Folder& folder, const std::string& lines) {
  const fs::path path = folder.path() / "compiler";
  write(path, "#!/bin/sh\n" + lines + "\nexec c++ \"$@\"\n");
  fs::permissions(path, fs::perms::owner_all);
  return path.string();
}

/// A cache of its own for each test.
class Compiles : public ::testing::Test {
 protected:
  Folder folder_;
  fs::path cache_ = folder_.path() / "cache";

  CompiledObject make(const std::string& text, const std::string& compiler = "",
                      std::vector<std::string> flags = {}) const {
    return compile(text, {compiler, cache_, std::move(flags)});
  }
};

}  // namespace casimir::testing

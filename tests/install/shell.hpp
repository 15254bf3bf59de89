#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/program.hpp"

namespace casimir::test {

/// Runs a script of sh in a folder, with nothing of our environment but where programs are, and
/// with a cache of its own.
inline Outcome shell(const Folder& folder, const std::string& script) {
  folder.write(".script", script);
  const std::string command =
      "cd '" + folder.path().string() +
      "' && env -i PATH=/usr/local/bin:/usr/bin:/bin HOME=\"$PWD\" LC_ALL=C.UTF-8 "
      "CASIMIR_CACHE=\"$PWD/cache\" sh -eu .script >.out 2>.err </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, file_text(folder / ".out"),
          file_text(folder / ".err")};
}

/// A folder with the installed tree in `prefix`, which was moved there.
class Installed : public Folder {
 public:
  Installed() {
    const Outcome outcome = shell(*this, "'" CASIMIR_CMAKE "' --install '" CASIMIR_BUILD_DIR
                                         "' --prefix first\nmv first prefix\n");
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  }
  std::filesystem::path prefix() const { return path() / "prefix"; }
};

inline std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> result;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) result.push_back(entry.path());
  }
  return result;
}

inline bool shows(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace casimir::test

// What the program is not linked to, and loads when it is asked for.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

namespace fs = std::filesystem;

fs::path built_module(const std::string& name) {
  return fs::path(CASIMIR_PROGRAM).parent_path() / "modules" / (name + ".so");
}

/// A copy of the program without its modules, as somebody would make it.
TEST(Modules, AreAskedForBeforeAnyWork) {
  const Folder folder;
  fs::copy_file(CASIMIR_PROGRAM, folder.path() / "casimir");
  const std::string sweep =
      "./casimir sweep kovalevskaya --over r=1/2:3/2:3 --duration 1 --output s.h5 2> err.txt";
  const auto error_of = [&](const std::string& environment) {
    const int status = std::system(("cd '" + folder.path().string() + "' && CASIMIR_CASES='" +
                                    CASIMIR_SOURCE_DIR "/cases' " + environment + sweep)
                                       .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 4);
    return file_text(folder.path() / "err.txt");
  };
  if (fs::exists(built_module("casimir_hdf5"))) {
    const std::string error = error_of("");
    EXPECT_TRUE(has(error, "casimir_hdf5.so")) << error;
  }
  if (fs::exists(built_module("casimir_mpi"))) {
    const std::string error = error_of("OMPI_COMM_WORLD_SIZE=2 ");
    EXPECT_TRUE(has(error, "casimir_mpi.so")) << error;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "s.h5"));
}

}  // namespace
}  // namespace casimir::test

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace casimir::codegen {

/// A C++ compiler of this machine.
struct Compiler {
  std::filesystem::path program;       ///< absolute
  std::vector<std::string> arguments;  ///< that come before all others, as in CXX="ccache g++"
  std::string identity;                ///< changes when another version is installed
};

/// \param wanted  a command, or empty for $CXX, c++, g++, clang++.
/// \throws CompilerMissing
Compiler find_compiler(const std::string& wanted);

/// What `-march=native` depends on: the processor and its features, as the file has them (that of
/// Linux: /proc/cpuinfo) and, in case it has nothing, as the system tells every program.
std::string processor_identity(const std::filesystem::path& description);

/// How a run of the compiler ended.
struct CompilerRun {
  bool succeeded = false;
  bool timed_out = false;  ///< it was stopped since it took too long
  int signal = 0;          ///< that stopped it, or 0
  std::string messages;    ///< what it said
};

/// Runs the compiler in `folder`, which also takes its temporary files and its messages, as a
/// process group of its own: whatever it started ends with it, at the latest after `seconds`.
/// \throws CompilerMissing  if it cannot be started.
CompilerRun run_compiler(const Compiler& compiler, const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder, double seconds = 600);

/// What abandon_compile removes while the compiler runs: `folder` and the files in it. Empty:
/// nothing.
void set_abandoned_files(const std::filesystem::path& folder);

}  // namespace casimir::codegen

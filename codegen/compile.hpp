#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace casimir {

/// What the machine does not let us do: no compiler, nowhere to write. Not the user's input.
class EnvironmentError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// There is no C++ compiler; the text says what was looked for and what to install.
class CompilerMissing : public EnvironmentError {
  using EnvironmentError::EnvironmentError;
};

/// The compiler refused generated code, was stopped, took too long, or made nothing that can be
/// loaded; the text has its own message and says where the source is kept.
class CompileFailed : public EnvironmentError {
  using EnvironmentError::EnvironmentError;
};

/// The cache folder belongs to somebody else or others may write to it: its objects would be run.
class CacheUnsafe : public EnvironmentError {
  using EnvironmentError::EnvironmentError;
};

/// Nothing can be written, neither to the cache nor to a temporary folder.
class CacheUnusable : public EnvironmentError {
  using EnvironmentError::EnvironmentError;
};

/// With what is compiled, and where the objects are kept.
struct CompileOptions {
  /// The compiler and its first arguments; empty: $CXX, or the first of c++, g++, clang++ in $PATH.
  std::string compiler;
  /// The cache folder; empty: $CASIMIR_CACHE, $XDG_CACHE_HOME/casimir or ~/.cache/casimir, and a
  /// private folder for temporary files where none of these can be written.
  std::filesystem::path cache;
  /// Further arguments, after the usual ones.
  std::vector<std::string> flags = {};
  /// The text includes headers of the standard library: exceptions, type information and the
  /// start-up code that the usual text does without.
  bool standard_library = false;
  /// The compiler is stopped after so many seconds; 0: $CASIMIR_COMPILE_SECONDS, or ten minutes.
  double time_limit = 0;
  /// The file in which the system describes the processor that code is made for.
  std::filesystem::path processor = "/proc/cpuinfo";
};

/// What came of it.
struct CompiledObject {
  std::filesystem::path path;  ///< a shared object for dlopen
  bool from_cache = false;
  double seconds = 0;                       ///< what this call took
  std::shared_ptr<const void> in_use = {};  ///< until it is gone, no process makes room there
};

/// Compiles C++ text to a shared object, or finds it in the cache. The code is for this processor,
/// as far as the instructions that $CASIMIR_INSTRUCTIONS asks for (runtime/instruction_set.hpp).
/// The name of the object is a digest of the text, the compiler, its arguments and the processor;
/// a digest of its content is checked, and a damaged object is made again. Processes that want the
/// same object at the same time compile it once; one that is killed leaves nothing that matters.
/// The cache has at most $CASIMIR_CACHE_SIZE bytes (256M): what was unused for longest goes.
/// IEEE arithmetic is kept (products and sums may be fused). No shell is involved.
/// \throws EnvironmentError  one of the classes above.
CompiledObject compile(const std::string& text, const CompileOptions& options = {});

/// For a signal handler: stops the compiler that `compile` is running, if any, and removes its
/// files. Only async-signal-safe calls.
void abandon_compile() noexcept;

}  // namespace casimir

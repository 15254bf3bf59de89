#include "codegen/compile.hpp"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <utility>

#include "codegen/compile/cache.hpp"
#include "codegen/compile/compiler.hpp"
#include "codegen/compile/shared_object.hpp"
#include "runtime/instruction_set.hpp"

namespace casimir {

namespace {

namespace fs = std::filesystem;
using codegen::Cache;
using codegen::CachedObject;
using codegen::Compiler;
using codegen::CompilerRun;

/// -nostdlib and no unwind tables: half the time of the compiler goes into what these leave out.
/// The functions of the mathematical library are linked only if they are called.
const std::vector<std::string>& usual_flags() {
  static const std::vector<std::string> flags{"-x",
                                              "c++",
                                              "-std=c++20",
                                              "-O2",
                                              "-fno-math-errno",
                                              "-fno-exceptions",
                                              "-fno-rtti",
                                              "-fno-asynchronous-unwind-tables",
                                              "-fno-stack-protector",
                                              "-fPIC",
                                              "-shared",
                                              "-nostdlib",
                                              "-pipe",
                                              "-w",
                                              "-Wl,--build-id=none"};
  return flags;
}

/// For this processor, and no wider registers than those of the instruction set. The baseline is
/// that of all processors of the architecture.
std::vector<std::string> flags_of(InstructionSet set) {
  if (set == instruction_sets_here().front()) return {"-march=native"};
  if (set == InstructionSet::avx2) return {"-march=native", "-mno-avx512f"};
  return {"-march=x86-64", "-mtune=native"};
}

/// The arguments in front of the file names.
std::vector<std::string> flags_for(const CompileOptions& options) {
  std::vector<std::string> result = usual_flags();
  const std::vector<std::string> target = flags_of(chosen_instruction_set());
  result.insert(result.end(), target.begin(), target.end());
  if (options.standard_library) {
    for (const char* flag : {"-nostdlib", "-fno-exceptions", "-fno-rtti"}) std::erase(result, flag);
    result.emplace_back("-lstdc++");
  }
  result.insert(result.end(), options.flags.begin(), options.flags.end());
  return result;
}

std::vector<std::string> arguments_for(const CompileOptions& options, const fs::path& folder) {
  std::vector<std::string> result = flags_for(options);
  for (const std::string& last :
       {(folder / "source.cpp").string(), std::string("-x"), std::string("none"),
        std::string("-Wl,--as-needed"), std::string("-lm"), std::string("-o"),
        (folder / "object.so").string()}) {
    result.push_back(last);
  }
  return result;
}

std::string key_of(const std::string& text, const Compiler& compiler,
                   const CompileOptions& options) {
  std::vector<std::string> parts{text, compiler.identity,
                                 codegen::processor_identity(options.processor)};
  const std::vector<std::string> flags = flags_for(options);
  for (const auto* list : {&compiler.arguments, &flags}) {
    parts.push_back(std::to_string(list->size()));
    parts.insert(parts.end(), list->begin(), list->end());
  }
  return codegen::digest(parts);
}

constexpr double kLongestCompilation = 600;
constexpr off_t kRoomForCompiler = off_t{4} << 20;

/// \throws EnvironmentError  if the environment variable is no number of seconds.
double seconds_to_compile(const CompileOptions& options) {
  if (options.time_limit > 0) return options.time_limit;
  const char* text = std::getenv("CASIMIR_COMPILE_SECONDS");
  if (!text || !*text) return kLongestCompilation;
  char* end = nullptr;
  const double seconds = std::strtod(text, &end);
  if (*end || !std::isfinite(seconds) || seconds <= 0) {
    throw EnvironmentError(
        "the environment variable CASIMIR_COMPILE_SECONDS is no positive number of seconds");
  }
  return seconds;
}

/// A compiler that found no room says so in many ways, or in none where its messages had no room
/// either. \throws CacheUnusable  if the folder takes no more.
void check_room(const fs::path& folder) {
  const fs::path probe = folder / "room";
  const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const int reason = file < 0 ? errno : posix_fallocate(file, 0, kRoomForCompiler);
  if (file >= 0) close(file);
  unlink(probe.c_str());
  if (reason == ENOSPC || reason == EDQUOT || reason == EFBIG || reason == EROFS) {
    throw CacheUnusable("no room to compile in " + folder.parent_path().string() + ": " +
                        strerror(reason));
  }
}

/// Why a run of the compiler was no success. \throws EnvironmentError  always
[[noreturn]] void report(const CompilerRun& run, const Compiler& compiler, const Cache& cache,
                         const std::string& key, const std::string& text, double seconds) {
  const std::string name = "the C++ compiler " + compiler.program.string();
  if (run.messages.find("cc1plus") != std::string::npos &&
      run.messages.find("No such file") != std::string::npos) {
    throw CompilerMissing(
        "the compiler " + compiler.program.string() +
        " cannot compile C++; install it, for instance with: apt-get install g++\n" + run.messages);
  }
  const fs::path kept = cache.folder() / ("failed-" + key.substr(0, 16) + ".cpp");
  codegen::write_file(kept, text);
  std::ostringstream why;
  if (run.timed_out) {
    why << name << " was stopped after " << seconds
        << " s, which CASIMIR_COMPILE_SECONDS can change";
  } else if (run.signal != 0) {
    why << name << " was stopped by signal " << run.signal << " (" << strsignal(run.signal) << ")";
  } else if (run.succeeded) {
    why << name << " said that it succeeded, but what it made cannot be loaded";
  } else {
    why << name << " failed";
  }
  why << "; the source is kept in " << kept.string();
  if (!run.messages.empty()) why << '\n' << run.messages;
  throw CompileFailed(why.str());
}

/// Tells abandon_compile what to remove, while it lives.
struct Abandonable {
  explicit Abandonable(const fs::path& folder) { codegen::set_abandoned_files(folder); }
  ~Abandonable() { codegen::set_abandoned_files({}); }
  Abandonable(const Abandonable&) = delete;
  Abandonable& operator=(const Abandonable&) = delete;
};

CachedObject build(const std::string& text, const std::string& key, const Compiler& compiler,
                   const CompileOptions& options, const Cache& cache) {
  const double seconds = seconds_to_compile(options);
  const codegen::Workspace workspace(cache);
  const fs::path& folder = workspace.folder();
  const Abandonable abandonable(folder);
  codegen::write_file(folder / "source.cpp", text);
  CompilerRun run =
      codegen::run_compiler(compiler, arguments_for(options, folder), folder, seconds);
  // What cannot be loaded must not be kept as if it could.
  const std::string problem =
      run.succeeded ? codegen::loading_problem(folder / "object.so") : std::string();
  if (run.succeeded && problem.empty()) return cache.store(key, folder / "object.so");
  run.messages += problem;
  if (!run.timed_out) check_room(folder);
  report(run, compiler, cache, key, text, seconds);
}

/// The object and whether it was there.
std::pair<CachedObject, bool> find_or_build(const std::string& text, const std::string& key,
                                            const Compiler& compiler, const CompileOptions& options,
                                            const Cache& cache) {
  if (auto found = cache.find(key)) return {*found, true};
  const codegen::CacheLock lock(cache, key, seconds_to_compile(options));
  if (auto found = cache.find(key)) return {*found, true};  // made while we waited
  const std::uintmax_t most = codegen::cache_size_limit();
  cache.tidy(most);  // before, as there may be no room, and after, for the bound
  CachedObject made = build(text, key, compiler, options, cache);
  cache.tidy(most);
  return {std::move(made), false};
}

}  // namespace

CompiledObject compile(const std::string& text, const CompileOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const Compiler compiler = codegen::find_compiler(options.compiler);
  const std::string key = key_of(text, compiler, options);
  const codegen::CacheFolders choice = codegen::cache_folders(options.cache);
  std::string reasons;
  for (std::size_t i = 0; i < choice.folders.size(); ++i) {
    try {
      const Cache cache(choice.folders[i]);
      auto [object, known] = find_or_build(text, key, compiler, options, cache);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      return {std::move(object.path), known, taken.count(), std::move(object.in_use)};
    } catch (const CacheUnusable& e) {
      reasons += (reasons.empty() ? "" : "; ") + std::string(e.what());
    } catch (const CacheUnsafe& e) {
      if (choice.asked_for && i == 0) throw;
      reasons += (reasons.empty() ? "" : "; ") + std::string(e.what());
    }
  }
  throw CacheUnusable("there is no folder for compiled code: " + reasons);
}

}  // namespace casimir

#include "codegen/compile.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "codegen/cache.hpp"
#include "codegen/compiler.hpp"

namespace casimir {

namespace {

namespace fs = std::filesystem;
using codegen::Cache;
using codegen::Compiler;
using codegen::CompilerRun;

/// -nostdlib and no unwind tables: half the time of the compiler goes into what these leave out.
/// The functions of the mathematical library are linked only if they are called.
const std::vector<std::string>& usual_flags() {
  static const std::vector<std::string> flags{"-x",
                                              "c++",
                                              "-std=c++20",
                                              "-O2",
                                              "-march=native",
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

/// The arguments in front of the file names.
std::vector<std::string> flags_for(const CompileOptions& options) {
  std::vector<std::string> result = usual_flags();
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
  std::vector<std::string> parts{text, compiler.identity, codegen::processor_identity()};
  const std::vector<std::string> flags = flags_for(options);
  for (const auto* list : {&compiler.arguments, &flags}) {
    parts.push_back(std::to_string(list->size()));
    parts.insert(parts.end(), list->begin(), list->end());
  }
  return codegen::digest(parts);
}

[[noreturn]] void report(const CompilerRun& run, const Compiler& compiler, const Cache& cache,
                         const std::string& key, const std::string& text) {
  if (run.signal != 0) {
    throw CompileFailed("the C++ compiler was stopped by signal " + std::to_string(run.signal));
  }
  if (run.messages.find("cc1plus") != std::string::npos &&
      run.messages.find("No such file") != std::string::npos) {
    throw CompilerMissing(
        "the compiler " + compiler.program.string() +
        " cannot compile C++; install it, for instance with: apt-get install g++\n" + run.messages);
  }
  const fs::path kept = cache.folder() / ("failed-" + key.substr(0, 16) + ".cpp");
  codegen::write_file(kept, text);
  throw CompileFailed("the C++ compiler " + compiler.program.string() +
                      " failed; the source is kept in " + kept.string() + "\n" + run.messages);
}

/// Tells abandon_compile what to remove, while it lives.
struct Abandonable {
  explicit Abandonable(const fs::path& folder) { codegen::set_abandoned_files(folder); }
  ~Abandonable() { codegen::set_abandoned_files({}); }
  Abandonable(const Abandonable&) = delete;
  Abandonable& operator=(const Abandonable&) = delete;
};

fs::path build(const std::string& text, const std::string& key, const Compiler& compiler,
               const CompileOptions& options, const Cache& cache) {
  const codegen::Workspace workspace(cache);
  const Abandonable abandonable(workspace.folder());
  codegen::write_file(workspace.folder() / "source.cpp", text);
  const CompilerRun run = codegen::run_compiler(
      compiler, arguments_for(options, workspace.folder()), workspace.folder());
  if (!run.succeeded) report(run, compiler, cache, key, text);
  return cache.store(key, workspace.folder() / "object.so");
}

/// The object and whether it was there.
std::pair<fs::path, bool> find_or_build(const std::string& text, const std::string& key,
                                        const Compiler& compiler, const CompileOptions& options,
                                        const Cache& cache) {
  if (auto found = cache.find(key)) return {*found, true};
  const codegen::CacheLock lock(cache, key);
  if (auto found = cache.find(key)) return {*found, true};  // made while we waited
  cache.tidy();
  return {build(text, key, compiler, options, cache), false};
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
      auto [path, known] = find_or_build(text, key, compiler, options, cache);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      return {std::move(path), known, taken.count()};
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

#include "tests/traps/run.hpp"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "tests/folder.hpp"
#include "tests/traps/fixed.hpp"
#include "tests/traps/generate.hpp"
#include "tests/traps/judge.hpp"
#include "tests/traps/reference.hpp"

namespace casimir::traps {
namespace {

struct Numbered {
  std::string name;  ///< of the file that is kept
  Scene scene;
};

std::vector<Numbered> scenes_of(const Request& request) {
  std::vector<Numbered> result;
  const auto wanted = [&](const Scene& s) {
    return request.kind.empty() || request.kind == s.kind || request.kind == s.shape;
  };
  if (!request.fixed.empty()) {
    for (Scene& s : read_scenes(request.fixed))
      if (wanted(s)) result.push_back({s.shape, std::move(s)});
    return result;
  }
  // A kind takes its turn after eight others at most, a shape after a few hundred.
  const std::uint64_t end = request.first + 1000 * (request.count + 1);
  for (std::uint64_t i = request.first; result.size() < request.count && i < end; ++i)
    if (Scene s = generated(request.seed, i); wanted(s))
      result.push_back({fmt::format("{}-{}-{}", s.shape, request.seed, i), std::move(s)});
  return result;
}

/// One scene with the verdicts on every method.
struct Row {
  std::vector<Verdict> verdicts{};
  std::optional<Truth> truth{};
};

Row judged(const Request& request, const Scene& scene, const std::string& folder) {
  Row row;
  if (scene.exact)
    row.truth = Truth{*scene.exact, {}};
  else if (!scene.singular_at)
    row.truth = reference(scene);
  if (!row.truth && !scene.singular_at) {
    row.verdicts.resize(request.methods.size());
    return row;
  }
  const std::string file = folder + "/scene.toml";
  std::ofstream(file) << scene.text();
  for (const std::string& method : request.methods) {
    std::vector<std::string> words = {request.program, "integrate", file,  "--json",
                                      "--quiet",       "--method",  method};
    if (!request.folded && !scene.parameters.empty()) words.push_back("--keep-params");
    words.insert(words.end(), request.options.begin(), request.options.end());
    row.verdicts.push_back(judge(scene, row.truth, run_program(words, folder, request.seconds)));
  }
  return row;
}

std::vector<Row> judge_all(const Request& request, const std::vector<Numbered>& scenes) {
  std::vector<Row> rows(scenes.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    const test::Folder folder;
    for (std::size_t i; (i = next++) < scenes.size();)
      rows[i] = judged(request, scenes[i].scene, folder.path().string());
  };
  std::vector<std::jthread> workers;
  for (int k = 1; k < request.jobs; ++k) workers.emplace_back(work);
  work();
  workers.clear();
  return rows;
}

using Counts = std::array<int, kOutcomes>;
using Table = std::map<std::string, Counts>;

void print(const std::string& title, const Table& table) {
  fmt::print("{:<36}", title);
  for (std::size_t i = 0; i < kOutcomes; ++i)
    fmt::print(" {:>11}", to_string(static_cast<Outcome>(i)));
  fmt::print("\n");
  for (const auto& [name, counts] : table) {
    fmt::print("{:<36}", name);
    for (const int count : counts) fmt::print(" {:>11}", count == 0 ? "." : std::to_string(count));
    fmt::print("\n");
  }
  fmt::print("\n");
}

std::string line(const std::string& method, const Verdict& v) {
  return fmt::format("{:<8} {:<8} error {:.1e}, estimate {:.1e}; {}", method, to_string(v.outcome),
                     static_cast<double>(v.error), v.estimate, v.what);
}

/// The file with what was said of it, and what is so.
void keep(const Request& request, const Numbered& scene, const Row& row) {
  std::filesystem::create_directories(request.keep);
  std::ofstream file(std::filesystem::path(request.keep) / (scene.name + ".toml"));
  for (std::size_t m = 0; m < row.verdicts.size(); ++m)
    file << "# " << line(request.methods[m], row.verdicts[m]).substr(0, 200) << '\n';
  if (scene.scene.singular_at)
    file << fmt::format("# the solution ends at t = {:.12g}\n",
                        static_cast<double>(*scene.scene.singular_at));
  else if (row.truth)
    for (std::size_t i = 0; i < scene.scene.variables.size(); ++i)
      file << fmt::format("# truth: {} = {:.17g}\n", scene.scene.variables[i],
                          static_cast<double>(row.truth->state[i]));
  file << scene.scene.text();
}

bool report(const Request& request, const std::vector<Numbered>& scenes,
            const std::vector<Row>& rows) {
  Table by_kind, by_shape;
  bool failed = false;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i].scene;
    bool fails = false;
    for (std::size_t m = 0; m < request.methods.size(); ++m) {
      const Verdict& v = rows[i].verdicts[m];
      const auto column = static_cast<std::size_t>(v.outcome);
      ++by_kind[fmt::format("{:<18} {}", scene.kind, request.methods[m])][column];
      ++by_kind[fmt::format("{:<18} {}", "~ all", request.methods[m])][column];
      if (v.outcome != Outcome::right)
        ++by_shape[fmt::format("{:<26} {}", scene.shape, request.methods[m])][column];
      const bool wanted = to_string(v.outcome) == request.show;
      if (!is_failure(v.outcome) && !wanted) continue;
      fails = fails || is_failure(v.outcome);
      fmt::print("{:<32} {}\n", scenes[i].name, line(request.methods[m], v));
    }
    if (fails && !request.keep.empty()) keep(request, scenes[i], rows[i]);
    failed = failed || fails;
  }
  fmt::print("\n");
  print("shape and method, where not right", by_shape);
  print("kind and method", by_kind);
  return !failed;
}

}  // namespace

bool run(const Request& request) {
  const std::vector<Numbered> scenes = scenes_of(request);
  if (request.print) {
    for (const Numbered& s : scenes)
      fmt::print("# {} {}\n{}\n", s.scene.kind, s.name, s.scene.text());
    return true;
  }
  return report(request, scenes, judge_all(request, scenes));
}

}  // namespace casimir::traps

#include "tests/adversary/run.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>
#include <vector>

#include "tests/adversary/shrink.hpp"
#include "tests/adversary/worker.hpp"

namespace casimir::adversary {
namespace {

using Row = std::array<int, kOutcomes>;
using Table = std::map<std::string, Row>;

void print(const std::string& title, const Table& table) {
  fmt::print("{:<36}", title);
  for (std::size_t i = 0; i < kOutcomes; ++i)
    fmt::print(" {:>11.11}", to_string(static_cast<Outcome>(i)));
  fmt::print("\n");
  for (const auto& [name, row] : table) {
    fmt::print("{:<36}", name);
    for (const int count : row) fmt::print(" {:>11}", count == 0 ? "." : std::to_string(count));
    fmt::print("\n");
  }
  fmt::print("\n");
}

/// Failures are shown once for each sort; the rest is counted.
class Log {
 public:
  explicit Log(const Request& request) : request_(request) {}

  void operator()(std::uint64_t index, const Judgement& j) {
    if (!request_.family.empty() && j.family != request_.family) return;
    const std::size_t column = static_cast<std::size_t>(j.outcome);
    const std::string truth = to_string(j.truth);
    ++by_kind_[to_string(j.kind) + ", " + truth][column];
    ++by_family_[j.family + ", " + truth][column];
    ++all_["all"][column];
    if (j.outcome == Outcome::undecided && j.truth == Truth::yes && !request_.undecided.empty())
      undecided_[j.family + ", " + to_string(j.kind)].push_back(fmt::format(
          "# --seed {} --first {} --count 1\n# {}\n{}\n", request_.seed, index, j.what, j.file));
    if (!is_failure(j.outcome)) return;
    failed_ = true;
    const std::string sort = to_string(j.outcome) + " " + to_string(j.kind) + " " + j.family;
    if (++shown_[sort] > request_.show) return;
    fmt::print("# {}: {}, {}, {}\n# --seed {} --first {} --count 1\n# {}\n{}\n",
               to_string(j.outcome), to_string(j.kind), j.family, truth, request_.seed, index,
               j.what, j.file);
    if (request_.shrink > 0)
      fmt::print("# the same, made smaller:\n{}\n",
                 shrunk(request_.seed, index, j.outcome, request_.shrink));
    std::fflush(stdout);
  }

  bool finish() const {
    print("kind", by_kind_);
    print("family", by_family_);
    print("", all_);
    if (!request_.undecided.empty()) list_undecided();
    return !failed_;
  }

 private:
  /// The largest sort first.
  void list_undecided() const {
    std::ofstream file(request_.undecided);
    std::multimap<std::size_t, std::string, std::greater<>> by_size;
    for (const auto& [sort, claims] : undecided_) by_size.emplace(claims.size(), sort);
    for (const auto& [size, sort] : by_size) file << fmt::format("# {:>6} {}\n", size, sort);
    for (const auto& [size, sort] : by_size) {
      file << fmt::format("\n## {}\n", sort);
      for (const std::string& claim : undecided_.at(sort)) file << claim;
    }
    if (!file.flush()) throw std::runtime_error("cannot write " + request_.undecided);
  }

  const Request& request_;
  std::map<std::string, std::vector<std::string>> undecided_;
  Table by_kind_, by_family_, all_;
  std::map<std::string, int> shown_;
  bool failed_ = false;
};

}  // namespace

bool run(const Request& request) {
  if (request.print) {
    for (std::uint64_t i = request.first; i < request.first + request.count; ++i) {
      const Judgement j = unjudged(request.seed, i);
      fmt::print("# {} {} {} {}\n{}\n", i, to_string(j.kind), j.family, to_string(j.truth), j.file);
    }
    return true;
  }
  Log log(request);
  judge_all(request, [&](std::uint64_t index, const Judgement& j) { log(index, j); });
  return log.finish();
}

}  // namespace casimir::adversary

#include "tests/traps/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "tests/folder.hpp"
#include "tests/traps/program.hpp"

namespace casimir::traps {
namespace {

using Json = nlohmann::ordered_json;

/// What the rounding of the last state alone makes: estimates are not asked to be below it.
constexpr double kRounding = 0x1p-52;
constexpr double kThird = 1. / 3, kMostMedian = 30;
/// A state that is small at both ends is measured against this part of the largest.
constexpr double kSmallPart = 1e-3;

struct Place {
  std::string name, scene;
};

/// One run beside the truth.
struct Compared {
  std::string what;
  double error = 0, estimate = 0;
  bool warned = false;

  double ratio() const { return std::max(estimate, kRounding) / std::max(error, kRounding); }
};

Json said_json(const EstimateRequest& request, std::vector<std::string> words,
               const std::string& folder) {
  words.insert(words.begin(), request.program);
  const Said said = run_program(words, folder, request.seconds);
  if (!said.in_time || said.status != 0) return {};
  return Json::parse(said.out, nullptr, false);
}

std::vector<Place> places_of(const EstimateRequest& request, const std::string& folder) {
  const Json list = said_json(request, {"list", "--json"}, folder);
  std::vector<Place> all, result;
  for (const Json& entry : list.at("cases")) {
    const std::string name = entry.at("name");
    if (!request.only.empty() && name != request.only) continue;
    for (const Json& scene : entry.at("scenes")) all.push_back({name, scene});
  }
  for (std::size_t i = 0; i < all.size(); i += request.every) result.push_back(all[i]);
  return result;
}

using State = std::vector<long double>;

State state_of(const Json& json) {
  State state;
  for (const auto& [name, value] : json.at("state").items())
    state.push_back(std::strtold(value.get<std::string>().c_str(), nullptr));
  return state;
}

/// The states of one scene at both ends.
struct Ends {
  State start, truth;

  double error_of(const State& state) const {
    State sizes;
    for (std::size_t i = 0; i < truth.size(); ++i)
      sizes.push_back(std::max(std::abs(start[i]), std::abs(truth[i])));
    const long double large = *std::ranges::max_element(sizes);
    long double error = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const long double size = std::max(sizes[i], kSmallPart * large);
      const long double off = std::abs(state[i] - truth[i]);
      error = std::max(error, off == 0 ? 0 : off / size);
    }
    return static_cast<double>(error);
  }
};

std::optional<Ends> ends_of(const EstimateRequest& request, const Place& place,
                            const std::string& folder) {
  const std::vector<std::string> words = {"integrate", place.name, "--scene",  place.scene,
                                          "--json",    "--quiet",  "--digits", "20"};
  const Json truth = said_json(request, words, folder);
  if (!truth.is_object() || truth.at("status") != "ok") return std::nullopt;
  std::vector<std::string> none = words;
  none.insert(none.end(), {"--duration", "1e-30"});
  const Json start = said_json(request, none, folder);
  if (!start.is_object()) return std::nullopt;
  return Ends{state_of(start), state_of(truth)};
}

std::vector<Compared> compared(const EstimateRequest& request, const Place& place,
                               const std::string& folder) {
  std::vector<Compared> result;
  const std::optional<Ends> ends = ends_of(request, place, folder);
  if (!ends) return result;
  for (const std::string& method : request.methods) {
    for (const std::string& tolerance : request.tolerances) {
      const Json run = said_json(request,
                                 {"integrate", place.name, "--scene", place.scene, "--json",
                                  "--quiet", "--method", method, "--tolerance", tolerance},
                                 folder);
      if (!run.is_object() || run.at("trust").at("error_estimate").is_null()) continue;
      const State state = state_of(run);
      if (state.size() != ends->truth.size()) continue;
      const std::string estimate = run.at("trust").at("error_estimate");
      result.push_back(
          {.what = fmt::format("{} {} {} {}", place.name, place.scene, method, tolerance),
           .error = ends->error_of(state),
           .estimate = std::strtod(estimate.c_str(), nullptr),
           .warned = !run.at("warnings").empty()});
    }
  }
  return result;
}

std::vector<Compared> compare_all(const EstimateRequest& request,
                                  const std::vector<Place>& places) {
  std::vector<std::vector<Compared>> rows(places.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    const test::Folder folder;
    for (std::size_t i; (i = next++) < places.size();)
      rows[i] = compared(request, places[i], folder.path().string());
  };
  std::vector<std::jthread> workers;
  for (int k = 1; k < request.jobs; ++k) workers.emplace_back(work);
  work();
  workers.clear();
  std::vector<Compared> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace

bool compare_estimates(const EstimateRequest& request) {
  const test::Folder folder;
  std::vector<Compared> all = compare_all(request, places_of(request, folder.path().string()));
  if (all.empty()) {
    fmt::print("nothing to compare\n");
    return false;
  }
  std::ranges::sort(all, {}, &Compared::ratio);
  int below = 0, silent = 0;
  for (const Compared& run : all) {
    if (run.ratio() >= kThird) break;
    ++below;
    silent += run.warned ? 0 : 1;
    fmt::print("{:<60} error {:.1e}, estimate {:.1e}{}\n", run.what, run.error, run.estimate,
               run.warned ? ", warned" : "");
  }
  const auto quantile = [&](double part) {
    return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))].ratio();
  };
  fmt::print(
      "{} runs; estimate by true error: a tenth below {:.2g}, median {:.2g}, "
      "a tenth above {:.2g}\nbelow a third: {}, of these without a warning: {}\n",
      all.size(), quantile(0.1), quantile(0.5), quantile(0.9), below, silent);
  return silent == 0 && quantile(0.5) <= kMostMedian;
}

}  // namespace casimir::traps

#include "tools/section/map_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "symbolic/case/limits.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/section/map_orbits.hpp"
#include "tools/analysis/section/orbit_rotation.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/plot/gnuplot.hpp"
#include "tools/section/picture.hpp"
#include "tools/section/report.hpp"
#include "tools/section/seeds.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/files/ensemble_file.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

/// The pair of the command line, that of [section], or the first two variables.
std::vector<FunctionText> plotted_pair(const MapModel& map, const MapSectionRequest& request) {
  std::vector<FunctionText> pair;
  for (const std::string& text : request.pair)
    pair.push_back({map.base.parse(Text{text, {"--pair", 1, 1}, text}), text});
  if (pair.empty() && map.base.section && request.file.file.section) {
    for (std::size_t i = 0; i < map.base.section->plot.size(); ++i)
      pair.push_back({map.base.section->plot[i], request.file.file.section->plot.at(i).value});
  }
  if (!pair.empty()) return pair;
  if (map.base.variables.size() < 2)
    throw UsageError(
        "a map of one variable has no picture in a plane; --pair U V gives two functions");
  for (std::size_t i = 0; i < 2; ++i)
    pair.push_back({map.base.variables[i], map.base.variables[i].get_name()});
  return pair;
}

/// Starts that a file gives, a column for each variable.
std::vector<std::vector<double>> map_seeds(const std::string& path,
                                           const std::vector<std::string>& states,
                                           const Limits& limits) {
  const EnsembleFile file = read_seeds(path, states, limits);
  const std::vector<std::optional<std::size_t>> columns = columns_of(file, states);
  std::vector<std::vector<double>> seeds(file.rows());
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!columns[i])
      throw UsageError(
          fmt::format("{}: seeds of a map need a column for each variable, and '{}' "
                      "is missing",
                      printable(path, 200), states[i]));
    for (std::size_t row = 0; row < seeds.size(); ++row)
      seeds[row].push_back(file.values[row * file.columns.size() + *columns[i]]);
  }
  return seeds;
}

/// The orbits of a map, from the request to the report.
class MapSection {
 public:
  explicit MapSection(const MapSectionRequest& request)
      : request_(request),
        map_(map_model_of(request.file, request.common.parameter_values())),
        scene_(map_.base.scene(request.common.scene)),
        orbits_(map_, scene_, plotted_pair(map_, request), time_limit(request.common.time_limit)),
        plotted_(orbits_.plotted()) {
    for (std::size_t i = 0; i < request.labels.size(); ++i) plotted_[i].label = request.labels[i];
  }

  int run() {
    const Stopwatch watch;
    Progress progress(!request_.common.quiet);
    progress.begin(map_.base.name + ": orbits");
    if (std::string parts = unwatched_parts(map_.as_field(), scene_, States::apart); !parts.empty())
      warnings_.push_back(std::move(parts));
    const auto seeds =
        request_.seeds.empty()
            ? orbits_.spread(request_.orbits, request_.points)
            : map_seeds(request_.seeds, orbits_.specialisation().states, map_.base.limits);
    if (request_.seeds.empty() && seeds.size() < request_.orbits)
      warnings_.push_back(
          fmt::format("only {} of {} starts about the scene's orbit have orbits that stay near it",
                      seeds.size(), request_.orbits));
    for (std::size_t k = 0; k < seeds.size() && !orbits_.interrupted(); ++k) {
      reports_.push_back(orbits_.orbit(seeds[k], request_.points));
      progress.show(static_cast<double>(k + 1) / static_cast<double>(seeds.size()));
    }
    if (std::string lost = lost_places(reports_, "points"); !lost.empty())
      warnings_.push_back(std::move(lost));
    if (request_.rotation || request_.colour == "rotation")
      for (const OrbitReport& orbit : reports_) rotations_.push_back(rotation_of_map_orbit(orbit));
    seconds_ = watch.seconds();
    deliver();
    return verdict(seeds.size());
  }

 private:
  std::size_t count(bool chaotic) const {
    return static_cast<std::size_t>(std::ranges::count_if(reports_, [&](const OrbitReport& orbit) {
      return orbit.judged && orbit.chaotic == chaotic;
    }));
  }

  std::size_t points() const {
    std::size_t sum = 0;
    for (const OrbitReport& orbit : reports_) sum += orbit.places.size();
    return sum;
  }

  void write(const std::string& path) const {
    const auto& states = orbits_.specialisation().states;
    std::vector<std::int64_t> orbits, numbers;
    std::vector<double> u, v;
    std::vector<std::vector<double>> values(states.size());
    for (std::size_t k = 0; k < reports_.size(); ++k) {
      const OrbitReport& orbit = reports_[k];
      for (std::size_t i = 0; i < orbit.places.size(); ++i) {
        orbits.push_back(static_cast<std::int64_t>(k + 1));
        numbers.push_back(static_cast<std::int64_t>(i + 1));
        u.push_back(orbit.places[i][0]);
        v.push_back(orbit.places[i][1]);
        for (std::size_t j = 0; j < states.size(); ++j)
          values[j].push_back(orbit.orbit.states[i * states.size() + j]);
      }
    }
    Table table{{{"orbit", orbits}, {"n", numbers}, {"t", numbers}, {"u", u}, {"v", v}}};
    for (std::size_t j = 0; j < states.size(); ++j)
      table.columns.push_back({states[j], std::move(values[j])});
    write_table(path, table);
  }

  nlohmann::ordered_json json() const {
    nlohmann::ordered_json json{
        {"case", map_.base.name},
        {"scene", scene_.name},
        {"method", "map"},
        {"plot", {plotted_[0].text, plotted_[1].text}},
        {"orbits", nlohmann::ordered_json::array()},
        {"crossings", points()},
        {"regular", count(false)},
        {"chaotic", count(true)},
        {"seconds", {{"compile", orbits_.step().seconds}, {"integrate", seconds_}}},
        {"from_cache", orbits_.step().from_cache},
        {"warnings", warnings_}};
    for (std::size_t k = 0; k < reports_.size(); ++k) {
      const OrbitReport& orbit = reports_[k];
      nlohmann::ordered_json one{{"orbit", k + 1},
                                 {"status", to_string(orbit.orbit.status)},
                                 {"points", orbit.places.size()},
                                 {"exponent", exact_text(orbit.exponent)}};
      one["chaotic"] =
          orbit.judged ? nlohmann::ordered_json(orbit.chaotic) : nlohmann::ordered_json(nullptr);
      one["megno"] = orbit.judged ? nlohmann::ordered_json(exact_text(orbit.megno))
                                  : nlohmann::ordered_json(nullptr);
      if (!rotations_.empty()) one["rotation"] = tools::to_json(rotations_[k]);
      one["seed"] = nlohmann::ordered_json::object();
      const auto& states = orbits_.specialisation().states;
      for (std::size_t i = 0; i < states.size(); ++i)
        one["seed"][states[i]] = exact_text(orbit.seed[static_cast<Eigen::Index>(i)]);
      json["orbits"].push_back(std::move(one));
    }
    return json;
  }

  void print() const {
    fmt::print("{}, scene '{}', orbits of the map\n", map_.base.name, printable(scene_.name));
    fmt::print("  plotted  u = {}, v = {}\n", printable(plotted_[0].text, 200),
               printable(plotted_[1].text, 200));
    fmt::print("  {} orbits, {} points in {}\n", reports_.size(), points(),
               duration_text(seconds_));
    const std::size_t unknown = reports_.size() - count(true) - count(false);
    fmt::print("  {} regular, {} chaotic{}: by the growth of deviations, which is evidence\n",
               count(false), count(true),
               unknown > 0 ? fmt::format(", {} too short to tell", unknown) : "");
    if (!rotations_.empty()) print_rotations(rotations_);
    for (const std::string& warning : warnings_) fmt::print("  warning: {}\n", warning);
  }

  /// Tables first: pictures need a program that may be missing.
  void deliver() const {
    for (const std::string& path : request_.outputs)
      if (!is_picture_name(path)) write(path);
    if (request_.common.json)
      print_json(json());
    else if (!request_.common.quiet)
      print();
    std::cout.flush();
    const std::string& title = map_.base.title.empty() ? map_.base.name : map_.base.title;
    for (const std::string& path : request_.outputs) {
      if (is_picture_name(path))
        draw_section(plotted_, title, reports_, {}, request_.print.sheet(path),
                     colours_by(request_.colour, reports_, rotations_));
      if (!request_.common.quiet && !request_.common.json)
        fmt::print("  wrote {}\n", printable(path, 200));
    }
  }

  int verdict(std::size_t wanted) const {
    if (reports_.size() < wanted || orbits_.interrupted()) {
      std::cerr << "casimir: error: the time limit was reached before all was done\n";
      return kEnvironment;
    }
    const auto lost = std::ranges::find_if(reports_, [](const OrbitReport& orbit) {
      return orbit.orbit.status == Status::non_finite;
    });
    if (lost == reports_.end()) return kDone;
    std::cerr << fmt::format(
        "casimir: error: orbit {} ends after {} of {} steps: the next state is not finite\n",
        lost - reports_.begin() + 1, lost->orbit.size(), request_.points);
    return kNotContinued;
  }

  const MapSectionRequest& request_;
  const MapModel map_;
  const Scene& scene_;
  const MapOrbits orbits_;
  std::array<PlottedFunction, 2> plotted_;
  std::vector<OrbitReport> reports_;
  std::vector<Rotation> rotations_;  ///< one for each, or none
  double seconds_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace

int section_of_map(const MapSectionRequest& request) { return MapSection(request).run(); }

}  // namespace casimir::tools

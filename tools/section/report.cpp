#include "tools/section/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/tables/table.hpp"
#include "tools/text/runs/enclosure_report.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

const Specialisation& spec_of(const SectionReport& report) {
  return report.problem.run.specialisation;
}

std::string state_of(const OrbitReport& orbit) {
  if (orbit.leaves_level) return "drift_exceeded";
  if (!orbit.orbit.returns) return "no_return";
  return to_string(orbit.orbit.status);
}

Json pair_json(const std::array<double, 2>& place) {
  return {{"u", exact_text(place[0])}, {"v", exact_text(place[1])}};
}

Json to_json(const SectionReport& report, const OrbitReport& orbit, std::size_t number,
             bool points) {
  Json json = {{"orbit", number},
               {"status", state_of(orbit)},
               {"points", orbit.places.size()},
               {"t", exact_text(orbit.orbit.time)},
               {"exponent", orbit.judged ? Json(exact_text(orbit.exponent)) : Json(nullptr)},
               {"chaotic", orbit.judged ? Json(orbit.chaotic) : Json(nullptr)},
               {"closed", orbit.closed},
               {"megno", orbit.judged ? Json(exact_text(orbit.megno)) : Json(nullptr)},
               {"off_level", exact_text(orbit.off_level)},
               {"seed", Json::object()}};
  for (std::size_t i = 0; i < report.problem.states(); ++i)
    json["seed"][spec_of(report).states[i]] = exact_text(orbit.seed[static_cast<Eigen::Index>(i)]);
  if (!points) return json;
  json["crossings"] = Json::array();
  for (std::size_t i = 0; i < orbit.places.size(); ++i) {
    Json crossing = {{"n", i + 1}, {"t", exact_text(orbit.orbit.times[i])}};
    crossing.update(pair_json(orbit.places[i]));
    json["crossings"].push_back(std::move(crossing));
  }
  return json;
}

/// Null where it is not decided.
Json is_stable(const Cycle& cycle) {
  const SpectralStability stability = cycle.stability();
  if (stability == SpectralStability::undecided) return nullptr;
  return stability == SpectralStability::stable;
}

Json to_json(const SectionReport& report, const Cycle& cycle) {
  Json json = {{"length", cycle.length()},
               {"points", Json::array()},
               {"period", exact_text(cycle.period)},
               {"trace", exact_text(cycle.trace)},
               {"determinant", exact_text(cycle.determinant)},
               {"multipliers", Json::array()},
               {"kind", cycle.kind()},
               {"stable", is_stable(cycle)},
               {"stability", to_string(cycle.stability())},
               {"residual", exact_text(cycle.residual)}};
  for (const std::complex<double>& m : cycle.multipliers())
    json["multipliers"].push_back({exact_text(m.real()), exact_text(m.imag())});
  for (const PlacedPoint& point : cycle.points) {
    Json entry = pair_json(point.place);
    entry["state"] = Json::object();
    for (std::size_t i = 0; i < report.problem.states(); ++i)
      entry["state"][spec_of(report).states[i]] = exact_text(point.x[static_cast<Eigen::Index>(i)]);
    json["points"].push_back(std::move(entry));
  }
  return json;
}

Json ends_json(const RationalInterval& interval) {
  const auto [low, high] = decimal_ends(interval);
  return {low, high};
}

Json to_json(const SectionReport& report, const ProvedCycle& proof) {
  if (!proof.proved) return {{"verdict", "undecided"}, {"reason", proof.reason}};
  Json json = {{"verdict", "proved"},
               {"radius", decimal_above(proof.radius)},
               {"enclosure", Json::object()},
               {"period", ends_json(proof.period)},
               {"trace", ends_json(proof.trace)},
               {"kind", proof.kind()}};
  for (std::size_t i = 0; i < proof.state.size(); ++i)
    json["enclosure"][spec_of(report).states[i]] = ends_json(proof.state[i]);
  return json;
}

Json level_json(const SectionProblem& problem) {
  Json json = Json::object();
  for (std::size_t i = 0; i < problem.levels.size(); ++i)
    json[problem.level_names[i]] = exact_text(problem.levels[i]);
  return json;
}

void print(const ProvedCycle& proof, const std::string& ranges) {
  if (!proof.proved) {
    fmt::print("         not proved: {}\n", proof.reason);
    return;
  }
  const auto [low, high] = decimal_ends(proof.period, 13);
  const auto [least, most] = decimal_ends(proof.trace, 7);
  fmt::print(
      "         proved: {}one periodic orbit in a box of radius {}, and no other of this period "
      "near it\n"
      "         period in [{}, {}], trace in [{}, {}]: {}{}\n",
      ranges.empty() ? "" : fmt::format("for every {} ", ranges), power_of_ten_above(proof.radius),
      low, high, least, most, proof.kind(),
      proof.keeps_area ? ""
                       : ", since the Jacobi identity of the bracket is not proved, without which "
                         "the flow need not keep areas");
}

void print_cycles(const SectionReport& report) {
  if (report.cycles.cycles.empty() && report.cycles.degenerate == 0) return;
  const SectionProblem& problem = report.problem;
  const bool all_left_out = report.cycles.cycles.empty();
  if (!all_left_out)
    fmt::print("\n  cycle  {:>14}  {:>14}  {:>12}  {:>12}  kind\n",
               problem.plotted[0].period > 0 ? "u/pi" : "u",
               problem.plotted[1].period > 0 ? "v/pi" : "v", "period", "trace");
  for (std::size_t k = 0; k < report.cycles.cycles.size(); ++k) {
    const Cycle& cycle = report.cycles.cycles[k];
    for (std::size_t i = 0; i < cycle.length(); ++i) {
      std::array<double, 2> place = cycle.points[i].place;
      for (std::size_t j = 0; j < 2; ++j) {
        if (problem.plotted[j].period > 0) place[j] /= std::acos(-1.);
        if (std::abs(place[j]) < 5e-9) place[j] = 0;  // not -0.00000000
      }
      fmt::print("  {:>5}  {:>14.8f}  {:>14.8f}", i == 0 ? fmt::format("{}", cycle.length()) : "",
                 place[0], place[1]);
      if (i == 0)
        fmt::print("  {:>12.6f}  {:>12.6f}  {}, {}", cycle.period, cycle.trace, cycle.kind(),
                   to_string(cycle.stability()));
      fmt::print("\n");
    }
    if (!report.proofs.empty()) print(report.proofs[k], report.ranges);
  }
  const bool one = report.cycles.degenerate == 1;
  const char* const words =
      all_left_out ? (one ? "cycle was" : "cycles were") : (one ? "more was" : "more were");
  if (report.cycles.degenerate > 0)
    fmt::print(
        "  {} {} left out: an eigenvalue of the return is 1, to within {:g}, as those of "
        "families have it, in integrable systems\n",
        report.cycles.degenerate, words, kDegenerateCycle);
}

}  // namespace

std::string lost_places(const std::vector<OrbitReport>& orbits, const char* points) {
  std::size_t lost = 0, all = 0;
  for (const OrbitReport& orbit : orbits) {
    all += orbit.places.size();
    lost += static_cast<std::size_t>(
        std::ranges::count_if(orbit.places, [](const std::array<double, 2>& place) {
          return !std::isfinite(place[0]) || !std::isfinite(place[1]);
        }));
  }
  if (lost == 0) return {};
  return fmt::format("at {} of {} {} the plotted functions have no value: they are not drawn", lost,
                     all, points);
}

std::size_t SectionReport::crossings() const {
  std::size_t count = 0;
  for (const OrbitReport& orbit : orbits) count += orbit.places.size();
  return count;
}

std::size_t SectionReport::chaotic() const {
  return static_cast<std::size_t>(std::ranges::count(orbits, true, &OrbitReport::chaotic));
}

double SectionReport::off_level() const {
  double largest = 0;
  for (const OrbitReport& orbit : orbits) largest = std::max(largest, orbit.off_level);
  return largest;
}

unsigned long long SectionReport::steps() const {
  unsigned long long count = 0;
  for (const OrbitReport& orbit : orbits) count += orbit.orbit.steps;
  return count;
}

std::size_t SectionReport::proved() const {
  return static_cast<std::size_t>(std::ranges::count(proofs, true, &ProvedCycle::proved));
}

void write_crossings(const SectionReport& report, const std::string& path) {
  std::vector<std::int64_t> orbits, numbers;
  std::vector<double> times, u, v;
  const std::size_t n = report.problem.states();
  std::vector<std::vector<double>> states(n);
  for (std::size_t k = 0; k < report.orbits.size(); ++k) {
    const OrbitReport& orbit = report.orbits[k];
    for (std::size_t i = 0; i < orbit.places.size(); ++i) {
      orbits.push_back(static_cast<std::int64_t>(k) + 1);
      numbers.push_back(static_cast<std::int64_t>(i) + 1);
      times.push_back(orbit.orbit.times[i]);
      u.push_back(orbit.places[i][0]);
      v.push_back(orbit.places[i][1]);
      for (std::size_t j = 0; j < n; ++j) states[j].push_back(orbit.orbit.states[i * n + j]);
    }
  }
  Table table{{{"orbit", std::move(orbits)},
               {"n", std::move(numbers)},
               {"t", std::move(times)},
               {"u", std::move(u)},
               {"v", std::move(v)}},
              {{"case", spec_of(report).case_name},
               {"scene", spec_of(report).scene},
               {"level", report.problem.level_text()},
               {"plane", report.problem.plane_text}}};
  for (std::size_t j = 0; j < n; ++j)
    table.columns.push_back({spec_of(report).states[j], std::move(states[j])});
  write_table(path, table);
}

Json to_json(const Rotation& rotation) {
  const auto number = [](double x) {
    return std::isfinite(x) ? Json(exact_text(x)) : Json(nullptr);
  };
  const bool any = rotation.kind != Rotation::Kind::none;
  Json json = {{"kind", to_string(rotation.kind)},
               {"number", number(any ? rotation.number : NAN)},
               {"error", number(any ? rotation.error : NAN)},
               {"parts", rotation.parts},
               {"directed", rotation.directed}};
  if (rotation.kind == Rotation::Kind::islands) {
    json["inner"] = number(rotation.inner_number);
    json["inner_error"] = number(rotation.inner_error);
  }
  if (!rotation.reason.empty()) json["reason"] = rotation.reason;
  return json;
}

void print_rotations(const std::vector<Rotation>& rotations) {
  fmt::print(
      "\n  rotation numbers, in turns from one point to the next, up to whole turns\n"
      "  orbit  on        number               error\n");
  for (std::size_t k = 0; k < rotations.size(); ++k) {
    const Rotation& r = rotations[k];
    if (r.kind == Rotation::Kind::none) {
      fmt::print("  {:>5}  none      {}\n", k + 1, r.reason);
      continue;
    }
    const std::string number = std::isfinite(r.number) ? fmt::format("{:.15f}", r.number) : "-";
    fmt::print("  {:>5}  {:<8}  {:<19}  {:.0e}", k + 1, to_string(r.kind), number, r.error);
    if (r.kind == Rotation::Kind::islands)
      fmt::print("   {} islands, along each {:.15f} +- {:.0e}", r.parts, r.inner_number,
                 r.inner_error);
    if (r.kind == Rotation::Kind::cycle)
      fmt::print("   {}", r.parts == 1 ? "a fixed point" : fmt::format("length {}", r.parts));
    fmt::print("{}\n",
               r.directed ? "" : ", or the complement to 1: the curve has no direction here");
  }
}

Json to_json(const SectionReport& report, bool points) {
  const SectionProblem& problem = report.problem;
  Json json = {{"case", spec_of(report).case_name},
               {"scene", spec_of(report).scene},
               {"energy", exact_text(problem.levels[0])},
               {"level", level_json(problem)},
               {"plane", problem.plane_text},
               {"direction", problem.plane.upwards ? "up" : "down"},
               {"plot", {problem.plotted[0].text, problem.plotted[1].text}},
               {"tolerance", report.tolerance},
               {"orbits", Json::array()},
               {"cycles", Json::array()},
               {"degenerate_cycles", report.cycles.degenerate},
               {"crossings", report.crossings()},
               {"chaotic", problem.jumps ? Json(nullptr) : Json(report.chaotic())},
               {"off_level", exact_text(report.off_level())},
               {"steps", report.steps()},
               {"jobs", report.jobs},
               {"lanes", report.lanes},
               {"instruction_set", report.instruction_set},
               {"from_cache", report.from_cache},
               {"seconds",
                {{"generate", problem.run.generate_seconds},
                 {"compile", report.compile_seconds},
                 {"integrate", report.seconds}}},
               {"warnings", report.warnings}};
  for (std::size_t i = 0; i < report.orbits.size(); ++i) {
    json["orbits"].push_back(to_json(report, report.orbits[i], i + 1, points));
    if (!report.rotations.empty()) json["orbits"].back()["rotation"] = to_json(report.rotations[i]);
  }
  for (std::size_t k = 0; k < report.cycles.cycles.size(); ++k) {
    json["cycles"].push_back(to_json(report, report.cycles.cycles[k]));
    if (!report.proofs.empty())
      json["cycles"].back()["validated"] = to_json(report, report.proofs[k]);
  }
  if (!report.ranges.empty()) json["for_every"] = report.ranges;
  return json;
}

void print_text(const SectionReport& report) {
  const SectionProblem& problem = report.problem;
  const Specialisation& s = spec_of(report);
  // What is proved is so of a level that ten digits may miss.
  fmt::print("{}, scene '{}', Poincare section on the level {}\n", s.case_name, printable(s.scene),
             report.proofs.empty() ? problem.level_text() : problem.proved_level_text());
  fmt::print("  plane    {}{}, crossed {}\n", printable(problem.plane_text, 200),
             problem.plane_text.find('=') == std::string::npos ? " = 0" : "",
             problem.plane.upwards ? "upwards" : "downwards");
  fmt::print("  plotted  u = {}, v = {}\n", printable(problem.plotted[0].text, 200),
             printable(problem.plotted[1].text, 200));
  fmt::print("  {} orbits, {} crossings in {}: {} thread{}, {} orbits in a register\n",
             report.orbits.size(), report.crossings(), duration_text(report.seconds), report.jobs,
             report.jobs == 1 ? "" : "s", report.lanes);
  const auto unknown = std::ranges::count(report.orbits, false, &OrbitReport::judged);
  const auto closed = std::ranges::count_if(
      report.orbits, [](const OrbitReport& orbit) { return orbit.judged && orbit.closed; });
  if (problem.jumps)
    fmt::print(
        "  which are regular and which chaotic is not told: the equations jump, and the growth of "
        "deviations is not followed over that\n");
  else
    fmt::print("  {} regular, {} chaotic{}{} by the growth of deviations, which is evidence\n",
               report.orbits.size() - report.chaotic() - static_cast<std::size_t>(unknown),
               report.chaotic(),
               closed > 0 ? fmt::format(", {} of the regular ones closed", closed) : "",
               unknown > 0 ? fmt::format(", {} too short to tell or running away:", unknown) : ":");
  fmt::print("  every point on its level to {:.1e}\n", report.off_level());
  double largest = 0;
  for (const OrbitReport& orbit : report.orbits)
    if (orbit.chaotic) largest = std::max(largest, orbit.exponent);
  if (report.chaotic() > 0) fmt::print("  largest Lyapunov exponent {:.4f}\n", largest);
  if (!report.rotations.empty()) print_rotations(report.rotations);
  print_cycles(report);
  for (const std::string& warning : report.warnings) fmt::print("  warning: {}\n", warning);
}

}  // namespace casimir::tools

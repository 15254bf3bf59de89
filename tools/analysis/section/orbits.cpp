#include "tools/analysis/section/orbits.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/compile.hpp"

namespace casimir {
namespace {

using Vector = LevelSet::Vector;

/// More crossings than this take longer than a compiler.
constexpr std::size_t kWorthCompiling = 100000;
/// To find out whether orbits return: so often, and to a state not so many times larger.
constexpr std::size_t kReturnsOfSeed = 8;
constexpr double kEscaped = 10;
constexpr unsigned long long kStepsBetween = 20000, kStepsToReturn = 3000;

EnsembleKernel kernel_for(const SectionProblem& problem, std::size_t work) {
  EnsembleKernel kernel = ensemble_kernel(problem.deviating, *find_method("taylor"),
                                          work > kWorthCompiling ? work : 1, true);
  if (!kernel.lanes)
    throw EnvironmentError(
        "there is no C++ compiler, and the equations are not polynomials of degree two, which "
        "need none; install one, for instance with: apt-get install g++");
  return kernel;
}

void append(std::vector<double>& all, const Vector& x) {
  all.insert(all.end(), x.data(), x.data() + x.size());
}

}  // namespace

OrbitCutter::OrbitCutter(const SectionProblem& problem, const OrbitOptions& options,
                         std::size_t work)
    : problem_(problem), options_(options), kernel_(kernel_for(problem, work)) {}

SectionSettings OrbitCutter::settings(std::size_t points) const {
  SectionSettings settings;
  settings.points = points;
  settings.rtol = options_.tolerance;
  settings.atol = options_.tolerance * 1e-2;
  settings.jobs = options_.jobs;
  settings.steps_between = kStepsBetween;
  settings.states = problem_.states();
  settings.give_up = options_.give_up;
  return settings;
}

SectionResult OrbitCutter::orbits(const std::vector<Vector>& seeds, std::size_t points,
                                  const std::function<void(double)>& progress) const {
  SectionSettings how = settings(points);
  how.progress = progress;
  const auto n = static_cast<Eigen::Index>(problem_.states());
  // A direction that no symmetry singles out.
  Vector deviation(n);
  for (Eigen::Index i = 0; i < n; ++i) deviation[i] = std::sin(1 + 2.3 * static_cast<double>(i));
  deviation.normalize();
  std::vector<double> all;
  for (const Vector& seed : seeds) {
    append(all, seed);
    append(all, deviation);
  }
  return cut(*kernel_.lanes, problem_.plane, all, 2 * problem_.states(), how);
}

SectionResult OrbitCutter::with_deviations(const std::vector<Vector>& seeds,
                                           const std::vector<Vector>& deviations,
                                           std::size_t points) const {
  SectionSettings how = settings(points);
  how.keep_deviations = true;
  how.steps_between = kStepsToReturn;
  std::vector<double> all;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    append(all, seeds[i]);
    append(all, deviations[i]);
  }
  return cut(*kernel_.lanes, problem_.plane, all, 2 * problem_.states(), how);
}

Returning OrbitCutter::returning() const {
  return [this](const std::vector<PlacedPoint>& points) {
    std::vector<Vector> seeds;
    for (const PlacedPoint& point : points) seeds.push_back(point.x);
    const std::vector<Vector> none(seeds.size(),
                                   Vector::Zero(static_cast<Eigen::Index>(problem_.states())));
    std::vector<bool> result;
    for (const SectionOrbit& orbit : with_deviations(seeds, none, kReturnsOfSeed).orbits)
      result.push_back(orbit.status == Status::ok && stays(seeds[result.size()], orbit));
    return result;
  };
}

bool OrbitCutter::stays(const Vector& seed, const SectionOrbit& orbit) const {
  double before = 0, after = 0;
  for (std::size_t i = 0; i < problem_.states(); ++i) {
    if (problem_.angles[i]) continue;
    before = std::max(
        {before, std::abs(seed[static_cast<Eigen::Index>(i)]), std::abs(problem_.run.initial[i])});
    after = std::max(after, std::abs(orbit.state[i]));
  }
  return after <= kEscaped * before;
}

namespace {

/// Deviations of regular orbits grow like the time, at most like its third power.
constexpr double kLargestPower = 3;
constexpr std::size_t kFewestOrbits = 10;

/// Drops the crossings from the first that is off the level.
void check_level(const LevelSet& level, OrbitReport& report) {
  SectionOrbit& orbit = report.orbit;
  const std::size_t n = level.problem().states();
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const double distance = level.distance_from_level(orbit.states.data() + i * n);
    if (!(distance <= kOnLevel)) {
      report.leaves_level = true;
      orbit.times.resize(i);
      orbit.growth.resize(i);
      orbit.states.resize(i * n);
      return;
    }
    report.off_level = std::max(report.off_level, distance);
    report.places.push_back(level.plotted(orbit.states.data() + i * n));
  }
}

}  // namespace

namespace {

/// The mean over the time of (2/t) integral of s d log|v|, by trapezia between the crossings.
double megno_of(const SectionOrbit& orbit) {
  double integral = 0, mean = 0, time = 0, log = 0, y = 0;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const double step = orbit.times[i] - time;
    if (!(step > 0)) continue;
    integral += (log + orbit.growth[i]) / 2 * step;
    time = orbit.times[i];
    log = orbit.growth[i];
    const double before = y;
    y = 2 * (log - integral / time);
    mean += (before + y) / 2 * step;
  }
  return time > 0 ? mean / time : 0;
}

/// Whether the crossings repeat after some of them, all along: the orbit is a cycle, or nearer to
/// one than can be told.
bool is_closed(const std::vector<std::array<double, 2>>& places) {
  constexpr double kSame = 1e-9;
  constexpr std::size_t kLongest = 64, kRepetitions = 3;
  double size = 0;
  for (const auto& [u, v] : places) size = std::max({size, std::abs(u), std::abs(v)});
  const auto same = [&](std::size_t i, std::size_t k) {
    return std::abs(places[i][0] - places[k][0]) <= kSame * size &&
           std::abs(places[i][1] - places[k][1]) <= kSame * size;
  };
  for (std::size_t length = 1; length <= kLongest && kRepetitions * length <= places.size();
       ++length) {
    std::size_t i = length;
    while (i < places.size() && same(i, i - length)) ++i;
    if (i == places.size()) return true;
  }
  return false;
}

/// Whether the crossings run away: at the end they are far beyond all those of the first half. What
/// grows then is the orbit itself, whatever it does to others.
bool runs_away(const LevelSet& level, const SectionOrbit& orbit) {
  const std::size_t n = level.problem().states();
  const auto size = [&](std::size_t crossing) {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (!level.problem().angles[i])
        most = std::max(most, std::abs(orbit.states[crossing * n + i]));
    return most;
  };
  double before = 0;
  for (std::size_t k = 0; k < orbit.size() / 2; ++k) before = std::max(before, size(k));
  return orbit.size() > 1 && size(orbit.size() - 1) > kEscaped * before;
}

}  // namespace

void judge_growth(OrbitReport& report) {
  const SectionOrbit& orbit = report.orbit;
  report.closed = orbit.status == Status::ok && is_closed(report.places);
  // One that runs to infinity is neither regular nor chaotic.
  report.judged = orbit.size() >= kFewestOrbits &&
                  (orbit.status == Status::ok || orbit.status == Status::stopped);
  if (!report.judged) return;
  const std::size_t first = orbit.size() / 10;
  const double growth = orbit.growth.back() - orbit.growth[first],
               time = orbit.times.back() - orbit.times[first];
  report.exponent = growth / time;
  report.megno = megno_of(orbit);
  report.chaotic =
      !report.closed && growth > kLargestPower * std::log(orbit.times.back() / orbit.times[first]);
}

std::vector<OrbitReport> judged_orbits(const LevelSet& level, SectionResult result,
                                       const std::vector<Vector>& seeds) {
  std::vector<OrbitReport> reports;
  for (std::size_t i = 0; i < result.orbits.size(); ++i) {
    OrbitReport report;
    report.orbit = std::move(result.orbits[i]);
    report.seed = seeds[i];
    check_level(level, report);
    judge_growth(report);
    if (level.problem().jumps || runs_away(level, report.orbit))
      report.judged = report.chaotic = false;
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace casimir

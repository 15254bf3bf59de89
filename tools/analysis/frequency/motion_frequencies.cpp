#include "tools/analysis/frequency/motion_frequencies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace casimir {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
/// A line is strong by this share of the strongest one of its variable.
constexpr double kStrong = 1e-3;
/// Below this share of the strongest one a line is rounding.
constexpr double kRoundingLine = 1e-10;
/// The strong lines of a regular motion are told so much better than their width.
constexpr double kSettled = 0.02;
/// Whole numbers in combinations, and how many frequencies a base is tried with.
constexpr int kMostTimes = 12;
constexpr std::size_t kMostBase = 3, kMostTried = 12;

struct Known {
  double frequency, error;
};

/// Whole numbers with sum_i k_i base_i = f, of least sum of sizes.
std::optional<std::vector<int>> combination_of(const Known& f, const std::vector<Known>& base,
                                               double width) {
  std::vector<int> k(base.size(), -kMostTimes), best;
  int least = 0;
  for (;;) {
    double sum = 0, error = f.error;
    int size = 0;
    for (std::size_t i = 0; i < base.size(); ++i) {
      sum += k[i] * base[i].frequency;
      error += std::abs(k[i]) * base[i].error;
      size += std::abs(k[i]);
    }
    // Errors are estimates: some room, but far less than the width of a line.
    const double room = std::min(20 * error + 1e-12 * std::abs(f.frequency), 1e-3 * width);
    if (std::abs(sum - f.frequency) <= room && (best.empty() || size < least)) {
      best = k;
      least = size;
    }
    std::size_t i = 0;
    while (i < k.size() && k[i] == kMostTimes) k[i++] = -kMostTimes;
    if (i == k.size()) break;
    ++k[i];
  }
  if (best.empty()) return std::nullopt;
  return best;
}

/// The settled lines that are no mean, each once, the strongest first.
std::vector<Known> distinct_lines(const MotionFrequencies& all, double width) {
  std::vector<std::pair<double, Known>> lines;
  for (const VariableSpectrum& variable : all.variables) {
    double largest = 0;
    for (const MotionLine& line : variable.lines) largest = std::max(largest, line.amplitude);
    for (const MotionLine& line : variable.lines)
      // What is known no better than the width of a line says nothing of a base.
      if (line.settled && line.error <= kSettled * width &&
          line.amplitude > kRoundingLine * largest && std::abs(line.frequency) > width / 8)
        lines.push_back(
            {largest > 0 ? line.amplitude / largest : 0, {std::abs(line.frequency), line.error}});
  }
  std::ranges::stable_sort(lines, std::greater{}, [](const auto& line) { return line.first; });
  std::vector<Known> result;
  for (const auto& [size, line] : lines) {
    const auto same = std::ranges::find_if(result, [&, line = line](const Known& other) {
      return std::abs(other.frequency - line.frequency) < width / 4;
    });
    if (same == result.end())
      result.push_back(line);
    else if (line.error < same->error)
      *same = line;
  }
  return result;
}

bool explains(const std::vector<Known>& base, const std::vector<Known>& lines, double width) {
  return std::ranges::all_of(
      lines, [&](const Known& line) { return combination_of(line, base, width).has_value(); });
}

/// The smallest sets of lines, or halves of lines, that all lines are combinations of.
std::vector<Known> base_of(const std::vector<Known>& lines, double width) {
  std::vector<Known> tried;
  for (std::size_t i = 0; i < std::min(lines.size(), kMostTried); ++i) tried.push_back(lines[i]);
  const std::size_t whole = tried.size();
  for (std::size_t i = 0; i < whole; ++i)
    tried.push_back({tried[i].frequency / 2, tried[i].error / 2});
  for (std::size_t size = 1; size <= kMostBase; ++size) {
    // Halves make three too many sets of three.
    const std::size_t count = size < kMostBase ? tried.size() : std::min<std::size_t>(whole, 7);
    std::vector<std::size_t> pick(size);
    for (std::size_t i = 0; i < size; ++i) pick[i] = i;
    while (size <= count) {
      std::vector<Known> base;
      for (const std::size_t i : pick) base.push_back(tried[i]);
      if (explains(base, lines, width)) return base;
      std::size_t at = size;
      while (at > 0 && pick[at - 1] == count - size + at - 1) --at;
      if (at == 0) break;
      ++pick[at - 1];
      for (std::size_t i = at; i < size; ++i) pick[i] = pick[i - 1] + 1;
    }
  }
  return {};
}

VariableSpectrum variable_of(const SampledMotion& motion, std::size_t i, std::size_t lines,
                             MotionFrequencies& all) {
  VariableSpectrum result{.name = motion.names[i], .angle = motion.angles[i], .lines = {}};
  std::vector<std::complex<double>> signal;
  std::vector<double> real;
  for (const std::vector<double>& state : motion.states) {
    if (result.angle) signal.push_back(std::polar(1., state[i]));
    real.push_back(state[i]);
  }
  const Spectrum spectrum = result.angle
                                ? spectrum_of(std::span<const std::complex<double>>(signal), lines)
                                : spectrum_of(std::span<const double>(real), lines);
  all.near_folding = std::max(all.near_folding, spectrum.near_folding);
  result.rest = spectrum.size > 0 ? spectrum.rest / spectrum.size : 0;
  for (const SpectralLine& line : spectrum.lines) {
    const double unit = kFullTurn / motion.interval;
    const bool twice = !result.angle && line.frequency > 0;  // with its mirror image
    result.lines.push_back({.frequency = line.frequency * unit,
                            .amplitude = std::abs(line.amplitude) * (twice ? 2 : 1),
                            .phase = std::arg(line.amplitude),
                            .error = line.error * unit,
                            .settled = line.in_both_halves,
                            .combination = {}});
  }
  return result;
}

/// The variables whose strong lines wander.
std::vector<std::string> unsettled(const MotionFrequencies& all, double width) {
  std::vector<std::string> names;
  for (const VariableSpectrum& variable : all.variables) {
    const bool wanders = std::ranges::any_of(variable.lines, [&](const MotionLine& line) {
      return line.amplitude > kStrong * variable.lines.front().amplitude &&
             (!line.settled || line.error > kSettled * width);
    });
    if (wanders) names.push_back(variable.name);
  }
  return names;
}

/// Lines that are too near to each other, or to the mean, to be told apart.
bool has_near_lines(const MotionFrequencies& all, double width) {
  constexpr double kApart = 5;  // half the breadth of a line in Hanning's window of order 4
  for (const VariableSpectrum& variable : all.variables)
    for (const MotionLine& line : variable.lines) {
      if (line.amplitude < kStrong * variable.lines.front().amplitude) continue;
      if (!variable.angle && line.frequency > 0 && line.frequency < kApart * width) return true;
      for (const MotionLine& other : variable.lines) {
        const double difference = std::abs(other.frequency - line.frequency);
        // Of two lines that are nearer than the run can tell, one and a weak rest are found.
        if (&other != &line && difference < kApart * width &&
            other.amplitude > kRoundingLine * variable.lines.front().amplitude)
          return true;
      }
    }
  return false;
}

/// Whether a strong line that is known well is no combination of the base: it was taken for another
/// one that is near.
bool has_unexplained_lines(const MotionFrequencies& all, double width) {
  for (const VariableSpectrum& variable : all.variables)
    for (const MotionLine& line : variable.lines)
      if (line.settled && line.error <= kSettled * width && line.combination.empty() &&
          line.amplitude > kStrong * variable.lines.front().amplitude &&
          std::abs(line.frequency) > width / 8)
        return true;
  return false;
}

void warn(MotionFrequencies& all, double width) {
  std::string names;
  for (const std::string& name : unsettled(all, width)) names += (names.empty() ? "" : ", ") + name;
  all.settled = names.empty();
  if (!all.settled)
    all.warnings.push_back(fmt::format(
        "strong lines of {} are not the same in the first and in the second half: the motion is "
        "not quasi-periodic, or the duration too short to tell",
        names));
  if (has_near_lines(all, width))
    all.warnings.push_back(fmt::format(
        "some lines are nearer to each other, or to 0, than {:.2g}: with this duration they are "
        "told apart badly, and their errors may be larger than they seem",
        5 * width));
  if (all.near_folding > kFolded)
    all.warnings.push_back(fmt::format(
        "the spectrum has not ended at the highest frequency that the samples can tell, {:.4g}: "
        "lines from beyond may have been folded back",
        std::numbers::pi / all.interval));
}

}  // namespace

MotionFrequencies frequencies_of(const SampledMotion& motion, std::size_t lines) {
  MotionFrequencies all{.samples = motion.states.size(),
                        .interval = motion.interval,
                        .variables = {},
                        .base = {},
                        .base_errors = {},
                        .warnings = {}};
  for (std::size_t i = 0; i < motion.names.size(); ++i)
    all.variables.push_back(variable_of(motion, i, lines, all));
  const double width = kFullTurn / (motion.interval * static_cast<double>(all.samples));
  warn(all, width);
  if (!all.settled) return all;
  const std::vector<Known> base = base_of(distinct_lines(all, width), width);
  for (const Known& f : base) {
    all.base.push_back(f.frequency);
    all.base_errors.push_back(f.error);
  }
  if (base.empty()) return all;
  for (VariableSpectrum& variable : all.variables)
    for (MotionLine& line : variable.lines)
      if (line.settled)
        if (const auto k = combination_of({line.frequency, line.error}, base, width))
          line.combination = *k;
  if (has_unexplained_lines(all, width)) {
    all.base.clear();
    all.base_errors.clear();
    for (VariableSpectrum& variable : all.variables)
      for (MotionLine& line : variable.lines) line.combination.clear();
    all.warnings.push_back(
        "lines of different variables are nearer to each other than this duration can tell, and "
        "further apart than their errors: whether they are one frequency is not known, and no base "
        "is named; a longer run tells");
  }
  return all;
}

}  // namespace casimir

#include "tools/section/seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tools/analysis/section/orbits.hpp"
#include "tools/cli/errors.hpp"
#include "tools/tables/table.hpp"

namespace casimir::tools {
namespace {

using Vector = LevelSet::Vector;

constexpr std::size_t kTries = 12;

/// Of the tables that `section` writes, the states last.
std::vector<std::string> section_columns(const std::vector<std::string>& states) {
  std::vector<std::string> names{"orbit", "n", "t", "u", "v"};
  names.insert(names.end(), states.begin(), states.end());
  return distinct_names(names);
}

std::optional<std::size_t> column_of(const EnsembleFile& file, const std::string& name) {
  const auto found = std::ranges::find(file.columns, name);
  if (found == file.columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - file.columns.begin());
}

/// A state from the file, moved the last bit to the level.
Vector state_of(const LevelSet& level, Vector x, const std::string& where) {
  const double distance = level.distance_from_level(x.data());
  if (!(distance <= kSeedOnLevel)) {
    throw UsageError(fmt::format(
        "{}: the seed is not on the level {}, but off by {:.2g} of the size of its terms", where,
        level.problem().level_text(), distance));
  }
  return x;
}

Vector state_at(const LevelSet& level, std::vector<PlacedPoint> near,
                const std::array<double, 2>& pair, const std::string& where) {
  const auto distance = [&](const PlacedPoint& point) {
    double sum = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      double d = std::abs(point.place[k] - pair[k]);
      const double period = level.problem().plotted[k].period;
      if (period > 0) d = std::abs(d - period * std::round(d / period));
      sum += d * d;
    }
    return sum;
  };
  std::ranges::sort(near, {}, distance);
  for (std::size_t i = 0; i < std::min(kTries, near.size()); ++i) {
    Vector x = near[i].x;
    if (level.project(x, &pair) && level.speed(x) > 0) return x;
  }
  throw UsageError(
      fmt::format("{}: there is no motion on this level through u = {:.10g}, v = {:.10g}", where,
                  pair[0], pair[1]));
}

}  // namespace

EnsembleFile read_seeds(const std::string& path, const std::vector<std::string>& states,
                        const Limits& limits) {
  std::vector<std::string> known = section_columns(states);
  for (const std::string& name : states)
    if (!std::ranges::count(known, name)) known.push_back(name);
  return read_ensemble(path, known, limits);
}

std::vector<std::optional<std::size_t>> columns_of(const EnsembleFile& file,
                                                   const std::vector<std::string>& states) {
  const std::vector<std::string> written = section_columns(states);
  const std::size_t before = written.size() - states.size();
  std::vector<std::optional<std::size_t>> own, plain;
  for (std::size_t i = 0; i < states.size(); ++i) {
    own.push_back(column_of(file, written[before + i]));
    plain.push_back(column_of(file, states[i]));
  }
  const bool is_own = std::ranges::all_of(own, [](const auto& c) { return c.has_value(); });
  return is_own ? own : plain;
}

std::vector<Vector> seeds_of(const std::string& path, const LevelSet& level,
                             const std::function<std::vector<PlacedPoint>()>& near) {
  const std::vector<std::string>& states = level.problem().run.specialisation.states;
  const EnsembleFile file = read_seeds(path, states, level.problem().run.specialisation.limits);
  const auto u = column_of(file, "u"), v = column_of(file, "v");
  const std::vector<std::optional<std::size_t>> columns = columns_of(file, states);
  const bool whole =
      std::ranges::all_of(columns, [](const auto& column) { return column.has_value(); });
  if (!whole && !(u && v))
    throw UsageError(fmt::format(
        "{}: seeds need a column for each variable, or the columns u and v", printable(path, 200)));
  const std::vector<PlacedPoint> points = whole ? std::vector<PlacedPoint>{} : near();
  std::vector<Vector> seeds;
  for (std::size_t row = 0; row < file.rows(); ++row) {
    const double* const values = file.values.data() + row * file.columns.size();
    const std::string where = fmt::format("{}: seed {}", printable(path, 200), row + 1);
    if (!whole) {
      seeds.push_back(state_at(level, points, {values[*u], values[*v]}, where));
      continue;
    }
    Vector x(static_cast<Eigen::Index>(states.size()));
    for (std::size_t i = 0; i < states.size(); ++i)
      x[static_cast<Eigen::Index>(i)] = values[*columns[i]];
    seeds.push_back(state_of(level, x, where));
  }
  return seeds;
}

}  // namespace casimir::tools

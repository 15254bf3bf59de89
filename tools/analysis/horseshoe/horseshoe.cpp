#include "tools/analysis/horseshoe/horseshoe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/analysis/horseshoe/tangle.hpp"

namespace casimir {
namespace {

using namespace horseshoe;

/// Cycles that are tried, and attempts of a connection.
constexpr std::size_t kMostCycles = 6, kMostPairs = 4;

class HorseshoeSearch {
 public:
  HorseshoeSearch(const Model& model, const Scene& scene, const HorseshoeOptions& options)
      : options_(options),
        system_(section_system(model, scene, options.request)),
        map_(system_),
        coverings_(system_, map_, settings()) {}

  Horseshoe run() {
    tell("hyperbolic cycles", 0);
    cycles_ = hyperbolic_cycles(system_, map_, options_.longest_cycle, options_.give_up);
    result_.cycles = cycles_.size();
    if (cycles_.size() > kMostCycles) cycles_.resize(kMostCycles);
    measure();
    const bool done = homoclinic() || heteroclinic();
    if (!done) say_why();
    result_.system = system_;
    return std::move(result_);
  }

 private:
  CoveringSettings settings() const {
    CoveringSettings settings = options_.covering;
    settings.give_up = options_.give_up;
    return settings;
  }
  bool late() const { return options_.give_up && options_.give_up(); }
  void tell(const std::string& stage, double share) const {
    if (options_.progress) options_.progress(stage, share);
  }

  /// How far apart points of the section are.
  void measure() {
    for (const HyperbolicCycle& one : cycles_)
      for (const HyperbolicCycle& other : cycles_)
        size_ = std::max(size_, (one.points[0] - other.points[0]).norm());
    for (const HyperbolicCycle& one : cycles_) size_ = std::max(size_, 0.5 * one.points[0].norm());
  }

  bool homoclinic() {
    for (std::size_t c = 0; c < cycles_.size() && !late(); ++c) {
      tell("homoclinic orbits", static_cast<double>(c) / static_cast<double>(cycles_.size()));
      const std::vector<Connection> found =
          connections(map_, cycles_, c, {c}, size_, options_.give_up);
      result_.connections += found.size();
      for (const Connection& connection : found) {
        for (const Excursion& excursion : excursions(cycles_, connection, size_)) {
          if (late()) return false;
          if (attempt({excursion})) return true;
        }
      }
    }
    return false;
  }

  /// Between two cycles, there and back.
  bool heteroclinic() {
    for (std::size_t a = 0; a < std::min(cycles_.size(), kMostPairs); ++a) {
      for (std::size_t b = 0; b < a && !late(); ++b) {
        tell("heteroclinic orbits", static_cast<double>(a) / static_cast<double>(cycles_.size()));
        const auto there = connections(map_, cycles_, a, {b}, size_, options_.give_up);
        const auto back = connections(map_, cycles_, b, {a}, size_, options_.give_up);
        result_.connections += there.size() + back.size();
        for (const Connection& one : there)
          for (const Connection& other : back)
            if (attempt_both(one, other)) return true;
      }
    }
    return false;
  }

  bool attempt_both(const Connection& one, const Connection& other) {
    for (const Excursion& first : excursions(cycles_, one, size_))
      for (const Excursion& second : excursions(cycles_, other, size_)) {
        if (late()) return false;
        if (attempt({first, second})) return true;
      }
    return false;
  }

  bool attempt(const std::vector<Excursion>& chosen) {
    const auto plan = planned_tangle(map_, cycles_, chosen, size_);
    if (!plan) return false;
    ++result_.attempts;
    return prove(*plan);
  }

  bool prove(const PlannedTangle& plan) {
    std::vector<HSet> sets;
    for (const PlannedSet& one : plan.sets) {
      auto set = coverings_.chart().embed(one.name, one.centre, one.half_along * one.along,
                                          one.half_across * one.across, map_);
      if (!set) return missed(fmt::format("{} is not certain to lie on the surface", one.name));
      sets.push_back(std::move(*set));
    }
    for (std::size_t i = 0; i < sets.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!coverings_.chart().disjoint(sets[i], sets[j]))
          return missed(
              fmt::format("{} and {} are not certain to be disjoint", sets[j].name, sets[i].name));
    std::size_t parts = 0;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      tell("coverings", static_cast<double>(i) / static_cast<double>(sets.size()));
      std::vector<const HSet*> targets;
      for (const auto& [from, to] : plan.arrows)
        if (from == i) targets.push_back(&sets[to]);
      const CoveringOutcome outcome = coverings_.check(sets[i], targets);
      parts += outcome.parts;
      if (!outcome.proved) return missed(outcome.reason);
    }
    if (!strongly_connected(sets.size(), plan.arrows)) return missed("the graph is not connected");
    result_.radius = spectral_radius_above(sets.size(), plan.arrows);
    if (!(result_.radius > 1)) return missed("the graph has one cycle only");
    result_.entropy = logarithm_below(result_.radius);
    result_.sets = std::move(sets);
    result_.coverings = plan.arrows;
    result_.parts = parts;
    result_.proved = true;
    return true;
  }

  bool missed(std::string reason) {
    reason_ = std::move(reason);
    return false;
  }

  void say_why() {
    if (late())
      result_.reason = "no time was left";
    else if (cycles_.empty())
      result_.reason = "no hyperbolic cycle of the return map was found";
    else if (result_.connections == 0)
      result_.reason = "no orbit was found that leads from a hyperbolic cycle back to it";
    else if (result_.attempts == 0)
      result_.reason = "no h-sets could be placed that cover one another as far as orbits show";
    else
      result_.reason = "of the last attempt: " + reason_;
  }

  const HorseshoeOptions& options_;
  const SectionSystem system_;
  const NumericReturn map_;
  Coverings<> coverings_;
  std::vector<HyperbolicCycle> cycles_;
  double size_ = 1e-3;
  std::string reason_;
  Horseshoe result_;
};

}  // namespace

Horseshoe find_horseshoe(const Model& model, const Scene& scene, const HorseshoeOptions& options) {
  return HorseshoeSearch(model, scene, options).run();
}

}  // namespace casimir

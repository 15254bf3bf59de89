#include "tests/traps/reference.hpp"

#include <algorithm>
#include <cmath>

namespace casimir::traps {
namespace {

using State = std::vector<Real>;

/// An error in a state that is next to nothing.
constexpr Real kNothing = 1e-45L;
/// A part of the time in which no kink matters.
constexpr Real kUnseen = 1e-17L;

/// The right-hand side of a scene and its limit, with the parameters in place.
class Field {
 public:
  explicit Field(const Scene& scene)
      : n_(scene.variables.size()),
        rates_(formulas(scene, scene.equations)),
        limit_(formulas(scene, {scene.limit.empty() ? scene.duration : scene.limit})) {
    inputs_.resize(n_ + 1);
    for (const auto& [name, value] : scene.parameters) inputs_.push_back(constant(value));
    outputs_.resize(n_);
  }

  const State& operator()(Real t, const State& x) {
    evaluate(rates_, t, x, outputs_.data());
    return outputs_;
  }
  /// By formulas of its own: they often have a power, and are asked for once in a step.
  Real limit(Real t, const State& x) {
    Real result = 0;
    evaluate(limit_, t, x, &result);
    return result;
  }

  unsigned long long evaluations = 0;

 private:
  static Formulas formulas(const Scene& scene, const Texts& texts) {
    Texts symbols = scene.variables;
    symbols.push_back(scene.time.empty() ? "time_of_the_limit" : scene.time);
    for (const auto& entry : scene.parameters) symbols.push_back(entry.first);
    return Formulas(symbols, scene.definitions, texts);
  }

  void evaluate(Formulas& asked, Real t, const State& x, Real* results) {
    std::copy(x.begin(), x.end(), inputs_.begin());
    inputs_[n_] = t;
    asked(inputs_.data(), results);
    ++evaluations;
  }

  std::size_t n_;
  Formulas rates_, limit_;
  State inputs_, outputs_;
};

bool finite(const State& x) {
  return std::ranges::all_of(x, [](Real value) { return std::isfinite(value); });
}

/// Adds to a number with what rounding took from it before.
void add(Real& number, Real& carry, Real more) {
  const Real y = more + carry, sum = number + y;
  carry = y - (sum - number);
  number = sum;
}

class Extrapolation {
 public:
  Extrapolation(Field& field, const Pains& pains, std::size_t n)
      : field_(field), pains_(pains), n_(n) {}

  /// Tries a step; the error, 1 = just allowed, is not below 1 for one that failed.
  Real attempt(Real t, const State& x, Real h) {
    const State& rate = field_(t, x);
    rate_.assign(rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(n_));
    std::vector<State> row;
    State corner;
    for (int j = 1; j <= pains_.columns; ++j) {
      State value = midpoint(t, x, h, 2 * j);
      if (!finite(value)) return 1e30L;
      for (int k = 1; k < j; ++k) {
        const Real ratio = static_cast<Real>(j) / static_cast<Real>(j - k);
        State better(n_);
        for (std::size_t i = 0; i < n_; ++i)
          better[i] =
              value[i] + (value[i] - row[static_cast<std::size_t>(k - 1)][i]) / (ratio * ratio - 1);
        row[static_cast<std::size_t>(k - 1)] = std::move(value);
        value = std::move(better);
      }
      if (j == pains_.columns) corner = row.back();
      row.push_back(std::move(value));
    }
    gain = row.back();
    Real error = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const Real size = std::max(std::abs(x[i]), std::abs(x[i] + gain[i])) +
                        std::abs(h * rate_[i]) + pains_.least_size;
      error = std::max(error, std::abs(gain[i] - corner[i]) / (size * pains_.tolerance + kNothing));
    }
    return error;
  }

  State gain;  ///< what a good step adds to the state

 private:
  /// What the smoothed midpoint rule adds to the state. The last line is Gragg's: without it the
  /// rule asks for nothing in the last part of a step, and a kink there is passed unseen.
  State midpoint(Real t, const State& x, Real h, int pieces) {
    const Real step = h / static_cast<Real>(pieces);
    State before(n_), now(n_), at(n_);
    const auto rate_after = [&](int m) -> const State& {
      for (std::size_t i = 0; i < n_; ++i) at[i] = x[i] + now[i];
      return field_(t + static_cast<Real>(m) * step, at);
    };
    for (std::size_t i = 0; i < n_; ++i) now[i] = step * rate_[i];
    for (int m = 1; m < pieces; ++m) {
      const State& f = rate_after(m);
      for (std::size_t i = 0; i < n_; ++i) before[i] += 2 * step * f[i];
      std::swap(before, now);
    }
    const State& f = rate_after(pieces);
    for (std::size_t i = 0; i < n_; ++i) now[i] = (now[i] + before[i] + step * f[i]) / 2;
    return now;
  }

  Field& field_;
  const Pains& pains_;
  std::size_t n_;
  State rate_;
};

}  // namespace

std::optional<Truth> integrate(const Scene& scene, const Pains& pains) {
  Field field(scene);
  Truth truth;
  for (const std::string& text : scene.initial) truth.state.push_back(constant(text));
  truth.sizes.resize(truth.state.size());
  const auto note = [&] {
    for (std::size_t i = 0; i < truth.state.size(); ++i)
      truth.sizes[i] = std::max(truth.sizes[i], std::abs(truth.state[i]));
  };
  note();
  Extrapolation step(field, pains, truth.state.size());
  const Real end = constant(scene.duration);
  std::vector<Real> carries(truth.state.size());
  Real t = 0, carry = 0, wanted = end;
  while (t < end) {
    if (field.evaluations > pains.most_evaluations) return std::nullopt;
    Real h = std::min(wanted, pains.step * field.limit(t, truth.state));
    if (!(h > 1e-19L * std::max(t, 1e-30L))) return std::nullopt;
    const bool last = h >= end - t;
    if (last) h = end - t;
    const Real error = step.attempt(t, truth.state, h);
    const Real factor =
        0.8L * std::pow(std::max(error, 1e-10L), -1 / static_cast<Real>(2 * pains.columns - 1));
    wanted = h * std::clamp<Real>(factor, 0.05L, 3);
    if (!(error <= 1)) {
      // Across a kink no step is good; one that cannot be told from nothing does no harm.
      if (!(error < 1e29L) || h > kUnseen * end) continue;
      wanted = 3 * h;
    }
    for (std::size_t i = 0; i < carries.size(); ++i) add(truth.state[i], carries[i], step.gain[i]);
    note();
    add(t, carry, h);
    if (last) t = end;
  }
  return truth;
}

std::optional<Truth> reference(const Scene& scene, Real certain) {
  Pains once;
  if (scene.small_matters) once.least_size = 0;
  Pains twice = once;
  twice.step = once.step / 2;
  twice.tolerance = once.tolerance / 10;
  twice.columns = once.columns + 1;
  twice.most_evaluations = 4 * once.most_evaluations;
  const auto a = integrate(scene, once);
  const auto b = a ? integrate(scene, twice) : a;
  if (!b) return b;
  for (std::size_t i = 0; i < b->state.size(); ++i)
    if (!(std::abs(a->state[i] - b->state[i]) <= certain * std::max(b->sizes[i], 1e-300L)))
      return std::nullopt;
  return b;
}

}  // namespace casimir::traps

#include "runtime/validated/section_return.hpp"

#include <cmath>

namespace casimir::validated {
namespace {

/// Steps are multiples of this, so that times are sums without rounding.
constexpr double kGrid = 0x1p-36;
/// More than that is no time of a return.
constexpr double kLongest = 0x1p14;

double on_grid(double h) { return std::floor(h / kGrid) * kGrid; }

StepSettings step_settings(const ReturnSettings& settings) {
  StepSettings result;
  result.order = settings.order;
  result.log2_error = settings.log2_error;
  return result;
}

}  // namespace

template <class Ball>
Ball FirstReturn<Ball>::along_row(const std::vector<Ball>& row,
                                  const std::vector<double>& origin) const {
  Ball sum, rate;
  for (std::size_t i = 0; i < row.size(); ++i) {
    sum = sum + row[i] * (middle[i] - Ball(origin[i]));
    rate = rate + row[i] * rates[i];
  }
  const auto add = [&](const Matrix<Ball>& by, const std::vector<Ball>& parts) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      Ball factor;
      for (std::size_t i = 0; i < row.size(); ++i) factor = factor + row[i] * by(i, k);
      sum = sum + factor * parts[k];
    }
  };
  add(by_along, along);
  add(by_rest, rest);
  return sum + late * rate;
}

template <class Ball>
SectionReturn<Ball>::SectionReturn(const FlowProgram& flow, const std::vector<Integral>& integrals,
                                   std::vector<ArbBall> levels, const Program& plane,
                                   const ReturnSettings& settings)
    : plane_(plane),
      levels_(std::move(levels)),
      settings_(settings),
      lohner_(flow, integrals, step_settings(settings)),
      rates_(flow.rates),
      plane_function_(plane) {}

template <class Ball>
bool SectionReturn<Ball>::fail(std::string reason) {
  reason_ = std::move(reason);
  return false;
}

template <class Ball>
bool SectionReturn<Ball>::find(const AffineSet& set, double expected) {
  reason_.clear();
  done_ = false;
  try {
    if (!begin(set)) return false;
    for (int k = 0; k < settings_.max_steps; ++k) {
      if (!step(expected)) return false;
      if (done_) return true;
    }
  } catch (const std::domain_error& problem) {
    return fail(std::string("the equations are not certain to have a value: ") + problem.what());
  }
  return fail("it does not return within the steps that are allowed");
}

template <class Ball>
bool SectionReturn<Ball>::begin(const AffineSet& set) {
  elapsed_ = 0;
  Vector along, rest;
  for (const MidRad& s : set.along) along.push_back(Ball(s));
  for (const MidRad& r : set.rest) rest.push_back(Ball(r));
  lohner_.begin_on_levels(set.middle, set.directions, along, rest, levels_);
  crossings_.emplace(plane_, true, settings_.without_monotony);
  crossings_->begin(lohner_.box());
  const Ball rate = plane_function_(lohner_.box(), Ball())[1];
  if (!is_usable(rate) || contains_zero(rate) || approximate(rate) < 0)
    return fail("the surface is not certain to be crossed upwards where the set begins");
  return true;
}

/// The length of a step that is enclosed, or 0. One that would pass the expected return begins
/// anew a quarter of its length before it.
template <class Ball>
double SectionReturn<Ball>::enclosed_step(double proposed, double expected) {
  double h = on_grid(std::min(proposed, kLongest));
  const double before = expected - h / 4 - elapsed_;
  if (before > h / 8 && before < h) h = on_grid(before);
  bool full = true;
  constexpr int kTriesToReturn = 60;
  for (int k = 0; k < kTriesToReturn && h > 0; ++k) {
    const double by = lohner_.shortened_by(Ball(h), full);
    if (by == 0) return h;
    full = false;
    h = on_grid(h * std::exp2(-by));
  }
  return 0;
}

template <class Ball>
bool SectionReturn<Ball>::step(double expected) {
  const double log2_h = lohner_.prepare(Ball(elapsed_));
  if (std::isnan(log2_h)) return fail("the numbers have become too large");
  const double h = enclosed_step(std::exp2(std::min(log2_h, 20.)), expected);
  if (!(h > 0)) return fail("no step of any length can be enclosed");
  const std::size_t known = crossings_->found().size();
  if (!crossings_->step(lohner_, Ball(elapsed_), Ball(h)))
    return fail("a solution may touch the surface without crossing it");
  if (!crossings_->settle(lohner_.box_at(Ball(h)), Ball(elapsed_) + Ball(h)))
    return fail("a solution may touch the surface without crossing it");
  if (passes(h, known)) return true;
  if (!reason_.empty()) return false;
  if (lohner_.advance(Ball(h)) != StepOutcome::taken) return fail("the set has become too wide");
  elapsed_ += h;
  if (elapsed_ > kLongest) return fail("it does not return in the time that is allowed");
  return true;
}

template <class Ball>
bool SectionReturn<Ball>::passes(double h, std::size_t known) {
  const auto& found = crossings_->found();
  for (std::size_t k = known; k < found.size(); ++k)
    if (found[k].upwards) return describe(found[k], h);
  return false;
}

/// By the mean value theorem for each linear function of the state between t0 and the return.
template <class Ball>
bool SectionReturn<Ball>::describe(const Passage<Ball>& passage, double h) {
  const MidRad after = outwards(passage.time - Ball(elapsed_));
  const double reach = upwards(after.rad);
  if (!is_usable(after) || !(after.mid - 2 * reach > 0) || !(after.mid + 2 * reach < h))
    return fail("it returns where two steps meet");
  lohner_.pass(Ball(h));
  if (const auto name = lohner_.not_kept())
    return fail("'" + *name + "' is not certain to be smooth all the way: its value may jump");
  const Ball times(MidRad(after.mid, reach)), t0(after.mid);
  result_.time = passage.time;
  result_.states = lohner_.box_at(times);
  const auto form = lohner_.affine_at(t0);
  result_.middle = form.middle;
  result_.by_along = form.by_start;
  result_.by_rest = form.by_rest;
  result_.along = lohner_.set().start;
  result_.rest = lohner_.set().rest;
  result_.late = Ball(MidRad(0, reach));
  result_.rates = rates_(result_.states, Ball());
  done_ = true;
  return true;
}

template struct FirstReturn<MidRad>;
template struct FirstReturn<ArbBall>;
template class SectionReturn<MidRad>;
template class SectionReturn<ArbBall>;

}  // namespace casimir::validated

#include "runtime/exact/closed_form.hpp"

#include <cln/exception.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "runtime/exact/shapes.hpp"
#include "runtime/program/exact_number.hpp"

namespace casimir {
namespace exact {
namespace {

class AtRest : public ClosedForm {
 public:
  explicit AtRest(const Motion& of) {
    for (const cln::cl_F& x : of.initial) state_.push_back(cln::double_approx(x));
  }
  void at(const TwoDoubles&, double* x) const override {
    std::copy(state_.begin(), state_.end(), x);
  }
  double period() const override { return std::numeric_limits<double>::infinity(); }
  double horizon() const override { return std::numeric_limits<double>::infinity(); }
  double error() const override { return kRoundedError; }

 private:
  std::vector<double> state_;
};

}  // namespace

Recognised at_rest(const Motion& motion) { return {std::make_shared<AtRest>(motion), ""}; }

cln::cl_F undecided_part(const cln::cl_F& like) {
  return cln::scale_float(cln::cl_float(cln::cl_RA(1), like), -900);
}

cln::cl_F vanishing_part(const cln::cl_F& like) {
  return cln::scale_float(cln::cl_float(cln::cl_RA(1), like), -700);
}

bool same_field(const std::vector<ExactPolynomial>& a, const std::vector<ExactPolynomial>& b) {
  for (std::size_t rate = 0; rate < a.size(); ++rate) {
    cln::cl_F size = cln::cl_float(cln::cl_RA(0), cln::float_format(kExactDigits));
    ExactPolynomial rest = a[rate];
    for (const auto& [exponents, factor] : a[rate])
      size = std::max(size, cln::cl_F(cln::abs(factor)));
    for (const auto& [exponents, factor] : b[rate]) {
      size = std::max(size, cln::cl_F(cln::abs(factor)));
      const auto [at, fresh] = rest.try_emplace(exponents, -factor);
      if (!fresh) at->second = at->second - factor;
    }
    for (const auto& [exponents, factor] : rest)
      if (cln::abs(factor) > size * undecided_part(size)) return false;
  }
  return true;
}

std::vector<cln::cl_F> start_rates(const Motion& motion) {
  std::vector<cln::cl_F> rates;
  for (const ExactPolynomial& field : motion.field) {
    cln::cl_F sum = motion.zero();
    for (const auto& [exponents, factor] : field) {
      cln::cl_F term = factor;
      for (std::size_t i = 0; i < motion.states(); ++i)
        for (int e = 0; e < exponents[3 * i]; ++e) term = term * motion.initial[i];
      sum = sum + term;
    }
    rates.push_back(sum);
  }
  return rates;
}

bool rests(const Motion& motion) {
  const std::vector<cln::cl_F> rates = start_rates(motion);
  return std::all_of(rates.begin(), rates.end(),
                     [](const cln::cl_F& rate) { return cln::zerop(rate); });
}

}  // namespace exact

namespace {

/// What the observer of a run is shown, and how often.
constexpr double kShownInPeriod = 16, kMostShown = 4096;

/// The numbers with many digits that these doubles are.
std::vector<cln::cl_F> exactly(const double* x, const std::vector<cln::cl_F>& like) {
  std::vector<cln::cl_F> numbers;
  for (std::size_t i = 0; i < like.size(); ++i)
    numbers.push_back(cln::cl_float(exact_number(x[i]), like[i]));
  return numbers;
}

struct Shown {
  const ClosedForm& form;
  double begin;
};

void evaluate(const casimir_step* step, double t, double* x) {
  const Shown& shown = *static_cast<const Shown*>(step->data);
  shown.form.at(difference(t, shown.begin), x);
}

void run_along(const ClosedForm& form, std::size_t states, const casimir_run& run, double* x,
               casimir_outcome* out) {
  const double span = run.t_end - run.t_begin;
  if (std::abs(span) > form.horizon())
    throw std::invalid_argument(
        "exact: the motion is so close to a separatrix that its data do not say on which side it "
        "is "
        "for so long; another method or a shorter duration can be had");
  *out = {};
  out->t = run.t_begin;
  if (span == 0) return;
  double steps = 1;
  if (run.observe)
    steps = std::clamp(std::ceil(kShownInPeriod * std::abs(span) / form.period()), 1., kMostShown);
  std::vector<double> before;
  const Shown shown{form, run.t_begin};
  for (double k = 1; k <= steps; ++k) {
    const double t = k == steps ? run.t_end : run.t_begin + span * (k / steps);
    if (run.observe) before.assign(x, x + states);
    form.at(difference(t, run.t_begin), x);
    ++out->evaluations;
    ++out->steps;
    casimir_step step = {};
    step.t0 = out->t;
    step.t1 = out->t = t;
    step.x0 = before.data();
    step.x1 = x;
    step.dense = evaluate;
    step.data = &shown;
    if (run.observe && run.observe(run.observer, &step) != 0 && t != run.t_end) {
      out->status = CASIMIR_STOPPED;
      return;
    }
  }
}

/// Of numbers whose sizes are too different for the digits that there are, one may be lost, and be
/// divided by.
Recognised recognised_by(Recognised (*recognise)(const exact::Motion&),
                         const exact::Motion& motion) {
  try {
    return recognise(motion);
  } catch (const cln::runtime_exception&) {
    return {nullptr, "the sizes of the states and coefficients are too different"};
  }
}

}  // namespace

Recognised closed_form(const Program& rhs, const std::vector<cln::cl_F>& initial) {
  const auto field = polynomial_field(rhs);
  if (!field || initial.size() != rhs.outputs.size())
    return {nullptr,
            "the equations are no polynomials in the states and in their sines and cosines"};
  const exact::Motion motion{*field, initial};
  std::string reasons;
  for (const auto recognise : {exact::free_body, exact::gyrostat, exact::symmetric_top,
                               exact::pendulum, exact::polynomial_force}) {
    Recognised found = recognised_by(recognise, motion);
    if (found.form) return found;
    reasons += (reasons.empty() ? "" : "; ") + found.reason;
  }
  return {nullptr, reasons};
}

std::function<ModuleFunctions::Integration> exact_integration(
    const Program& rhs, const std::vector<cln::cl_F>& initial, std::vector<double> start,
    std::shared_ptr<const ClosedForm> form) {
  return [rhs, initial, start = std::move(start), form = std::move(form)](
             const casimir_run* run, double* x, casimir_outcome* out) {
    if (std::equal(start.begin(), start.end(), x))
      return run_along(*form, start.size(), *run, x, out);
    const Recognised other = closed_form(rhs, exactly(x, initial));
    if (!other.form) throw std::invalid_argument("exact: " + other.reason);
    run_along(*other.form, start.size(), *run, x, out);
  };
}

}  // namespace casimir

#include "tools/analysis/estimate/reference_state.hpp"

#include <cln/float_io.h>
#include <cln/integer_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "codegen/optimise/differentiate.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/methods.hpp"
#include "runtime/program/exact_number.hpp"
#include "runtime/reference.hpp"
#include "runtime/validated_run.hpp"
#include "symbolic/algebra/number_text.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

/// A reference with a larger error would show in the errors of good runs.
constexpr double kGood = 1e-17;

/// The end states of a scene in high precision.
struct EndState {
  std::vector<cln::cl_F> state = {};
  std::string reason = {};  ///< why there is none
  NoReference failure = NoReference::none;
  double error_bound = 0;
  int digits = 0;
  std::optional<double> singular_time = {};
};

/// The significant decimal digits of a number that the file writes as a decimal; 0 for one that is
/// exact in any other way.
int decimal_digits(const cln::cl_RA& value) {
  constexpr int kMostPlaces = 100;
  cln::cl_RA scaled = value;
  for (int places = 0; places < kMostPlaces; ++places, scaled = scaled * 10) {
    if (cln::denominator(scaled) != 1) continue;
    return static_cast<int>(rational_text(cln::abs(cln::numerator(scaled))).size());
  }
  return 0;
}

/// The reference state of the file, if it has one for all kept states at the end of this run.
std::optional<EndState> state_in_file(const Scene& scene, const PreparedScene& run) {
  const Specialisation& s = run.specialisation;
  if (scene.reference.empty() || rounded(start_values(s, kConstantDigits).back()) != run.duration)
    return std::nullopt;
  const Arithmetic<cln::cl_F> arithmetic(kConstantDigits);
  EndState end;
  for (const int i : s.state_indices) {
    const std::optional<GiNaC::ex>& value = scene.reference[static_cast<std::size_t>(i)];
    if (!value) return std::nullopt;
    if (!GiNaC::is_a<GiNaC::numeric>(*value) || !GiNaC::ex_to<GiNaC::numeric>(*value).is_real())
      throw ModelError("a reference state must be given by numbers");
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(*value);
    const auto real = cln::the<cln::cl_R>(number.to_cl_N());
    end.state.push_back(arithmetic.from(real));
    if (number.is_rational())
      end.digits = std::max(end.digits, decimal_digits(cln::the<cln::cl_RA>(real)));
  }
  end.error_bound = end.digits == 0 ? 0 : 0.5 * std::pow(10., -end.digits);
  return end;
}

EndState own_run(const PreparedScene& run, const ReferenceOptions& options) {
  const Specialisation& s = run.specialisation;
  const std::vector<cln::cl_F> values = start_values(s, options.digits + kConstantDigits);
  const auto n = static_cast<std::ptrdiff_t>(s.states.size());
  const std::vector<cln::cl_R> initial(values.begin(), values.begin() + n);
  const std::vector<cln::cl_R> parameters(values.begin() + n, values.end() - 1);
  // A duration from the command line is the double that the integrators get.
  const bool own = rounded(values.back()) == run.duration;
  const cln::cl_R duration = own ? cln::cl_R(values.back()) : cln::cl_R(exact_number(run.duration));
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(options.longest));
  bool out_of_time = false;
  const auto give_up = [&] {
    out_of_time = Clock::now() > end || (options.give_up && options.give_up());
    return out_of_time;
  };
  Reference reference =
      reference_solution(s.rhs, initial, duration, options.digits, parameters, give_up);
  EndState result{.error_bound = reference.error_bound, .digits = reference.digits};
  if (!reference.reached) {
    result.reason =
        fmt::format("there is no reference state: {} (t = {:.6g})",
                    out_of_time ? "the multiprecision run took too long" : reference.reason,
                    cln::double_approx(reference.time));
    result.failure = out_of_time ? NoReference::took_too_long : NoReference::not_reached;
    if (reference.singular) result.singular_time = cln::double_approx(reference.time);
  } else if (reference.error_bound > kGood) {
    result.reason =
        fmt::format("two multiprecision runs differ by {:.1e}: a reference needs more digits",
                    reference.error_bound);
    result.failure = NoReference::not_reached;
  } else {
    result.state = std::move(reference.state);
  }
  return result;
}

/// The middle of a box that provably contains the end state, in double precision: where a run in
/// high precision takes too long. Nothing where there is none that is narrow enough to be of use.
std::optional<EndState> enclosed(const PreparedScene& run, const ReferenceOptions& options,
                                 const std::vector<double>& scale) {
  constexpr double kNarrow = 1e-9, kSeconds = 5;
  const Specialisation& s = run.specialisation;
  if (!s.parameters.empty() || rounded(start_values(s, kConstantDigits).back()) != run.duration)
    return std::nullopt;
  ValidatedProblem problem;
  problem.rates = s.rhs;
  problem.start = s.start;
  const SparseProgram jacobian = codegen::jacobian(s.rhs, s.states.size());
  problem.jacobian = jacobian.program;
  problem.entries = jacobian.entries;
  ValidatedSettings settings;
  const auto late = time_limit(std::max(options.longest, kSeconds));
  settings.give_up = [&](double) { return late() || (options.give_up && options.give_up()); };
  try {
    const ValidatedRun box = validated_run(problem, settings);
    if (box.status != ValidatedStatus::ok) return std::nullopt;
    const Arithmetic<cln::cl_F> arithmetic(kConstantDigits);
    EndState end;
    for (std::size_t i = 0; i < scale.size(); ++i) {
      const RationalInterval& x = box.end.states[i];
      end.state.push_back(arithmetic.from(cln::cl_RA((x.low + x.high) / 2)));
      end.error_bound =
          std::max(end.error_bound, cln::double_approx((x.high - x.low) / 2) / scale[i]);
    }
    if (!(end.error_bound < kNarrow)) return std::nullopt;
    end.digits = static_cast<int>(-std::log10(std::max(end.error_bound, 1e-17)));
    return end;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

double distance(const std::vector<cln::cl_F>& a, const std::vector<cln::cl_F>& b,
                const std::vector<double>& scale) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(cln::double_approx(a[i] - b[i])) / scale[i]);
  return largest;
}

/// The file's state, with what our own run says about it.
ReferenceStateOrReason compared(EndState& in_file, const EndState& own,
                                const std::vector<double>& scale) {
  ReferenceStateOrReason result{.error_bound = in_file.error_bound, .digits = in_file.digits};
  if (own.state.empty()) {
    result.source = fmt::format("the case file, {} digits, not checked", in_file.digits);
    return result;
  }
  const double apart = distance(in_file.state, own.state, scale);
  if (!(apart < kGood)) {
    result.reason = fmt::format(
        "the reference state in the case file is {:.1e} off what a run with {} digits ends in",
        apart, own.digits);
    result.failure = NoReference::contradicted;
    return result;
  }
  result.error_bound = apart + own.error_bound;
  result.source = fmt::format("the case file, {} digits, checked by our own run with {}",
                              in_file.digits, own.digits);
  return result;
}

}  // namespace

ReferenceStateOrReason reference_state_of(const Scene& scene, const PreparedScene& run,
                                          const ReferenceOptions& options) {
  std::optional<EndState> in_file = state_in_file(scene, run);
  if (!in_file && options.only_the_file)
    return {.reason = "the case file has no reference state of all states that are integrated",
            .failure = NoReference::not_reached};
  const std::vector<double> scale = state_sizes(run);
  EndState own;
  if (!in_file || options.check_the_file) own = own_run(run, options);
  ReferenceStateOrReason result;
  if (in_file) {
    result = compared(*in_file, own, scale);
  } else {
    result = {.source = fmt::format("our own Taylor series with {} digits", own.digits),
              .error_bound = own.error_bound,
              .digits = own.digits,
              .reason = own.reason,
              .failure = own.failure,
              .singular_time = own.singular_time};
  }
  if (result.failure == NoReference::took_too_long) {
    if (auto box = enclosed(run, options, scale)) {
      own = std::move(*box);
      result = {.source = "the middle of a box that is proved to contain it, in double precision",
                .error_bound = own.error_bound,
                .digits = own.digits};
    }
  }
  if (!result.reason.empty()) return result;
  ReferenceState truth;
  for (const cln::cl_F& x : in_file ? in_file->state : own.state) {
    truth.state.push_back(rounded(x));
    truth.rest.push_back(remainder(x, truth.state.back()));
  }
  truth.scale = scale;
  result.truth = std::move(truth);
  return result;
}

namespace {

/// What the sizes of the states are taken from: a run like this is no more exact than that.
Settings coarse_settings(const PreparedScene& run) {
  Settings settings;
  settings.duration = run.duration;
  settings.rtol = 1e-8;
  double largest = 0;
  for (const double x : run.initial) largest = std::max(largest, std::abs(x));
  settings.atol = std::max(1e-8 * largest, 1e-300);
  settings.sample_every = std::abs(run.duration) / 200;
  settings.monitor = false;
  return settings;
}

/// Methods for stiff equations damp; those that keep quadratic invariants cannot.
bool for_stiff_equations(const Method& method) {
  return method.implicit && !method.preserves_quadratic;
}

}  // namespace

GoodRun good_run(const PreparedScene& run, const Settings& settings) {
  // A second or so of Taylor series, and of a method that has few steps to take, or none.
  constexpr unsigned long long kMostSteps = 1'000'000, kMostStiffSteps = 50'000;
  Settings limited = settings;
  limited.max_steps = kMostSteps;
  const auto with = [&](const Method& method) {
    CompiledModule compiled = compile_for(run, method);
    Trajectory trajectory =
        integrate(compiled.module, method, limited, run.initial, run.parameters);
    return GoodRun{&method, std::move(compiled), std::move(trajectory)};
  };
  GoodRun first = with(*find_method("taylor"));
  if (first.trajectory.status != Status::max_steps) return first;
  limited.max_steps = kMostStiffSteps;
  for (const Method& method : methods()) {
    if (!for_stiff_equations(method)) continue;
    try {
      GoodRun other = with(method);
      if (other.trajectory.status == Status::ok) return other;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      // A library that is not there, or a tolerance that it does not take: the next one, then.
    }
  }
  return first;
}

std::vector<double> state_sizes(const PreparedScene& run) {
  const Trajectory trajectory = good_run(run, coarse_settings(run)).trajectory;
  std::vector<double> sizes(run.initial.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::abs(run.initial[i]);
  for (const std::vector<double>& x : trajectory.samples) {
    for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::max(sizes[i], std::abs(x[i]));
  }
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  for (double& size : sizes) size = largest == 0 ? 1 : std::max(size, 1e-6 * largest);
  return sizes;
}

double growth_of(const PreparedScene& run, const ReferenceState& truth) {
  constexpr double kTolerance = 1e-13, kStiffTolerance = 1e-10, kSeconds = 3;
  Settings settings = coarse_settings(run);
  settings.sample_every = 0;
  GoodRun good = good_run(run, settings);
  const bool stiff = for_stiff_equations(*good.method);
  const double size = settings.atol / settings.rtol;
  settings.rtol = stiff ? kStiffTolerance : kTolerance;
  settings.atol = std::max(settings.rtol * size * 1e-3, 1e-300);
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(kSeconds));
  settings.give_up = [end] { return Clock::now() > end; };
  const Entrant entrant{&good.compiled.module, good.method,    settings,
                        run.initial,           run.parameters, {}};
  return run.specialisation.uses_time ? conditioning(entrant, truth, 1)
                                      : conditioning(entrant, truth);
}

}  // namespace casimir

// casimir integrate --digits: one scene in multiprecision.
#include "tools/runs/digits_run.hpp"

#include <cln/rational_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <iostream>

#include "runtime/digits/agreed_run.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/run/exact_values.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/text/runs/digits_report.hpp"

namespace casimir::tools {
namespace {

[[noreturn]] void does_not_go(const std::string& option, const std::string& why) {
  throw UsageError(fmt::format("{} does not go with --digits: {}", option, why));
}

void check(const DigitsRequest& request) {
  if (request.digits < kLeastDigits) {
    throw UsageError(
        fmt::format("--digits {}: double precision has as many; give {} or more, or leave it out",
                    request.digits, kLeastDigits));
  }
  if (request.digits > kMostDigits)
    throw UsageError(fmt::format("--digits {}: at most {}", request.digits, kMostDigits));
  if (request.method != "auto" && request.method != "taylor")
    does_not_go("--method " + request.method, "only taylor has any number of digits");
  const RunRequest& run = request.run.asked;
  if (run.rtol || run.atol || run.tolerance)
    does_not_go("a tolerance", "the digits are the tolerance");
  if (run.step) does_not_go("--step", "the steps follow from the digits");
  if (!request.as.empty()) does_not_go("--as", "it converts doubles; see --in");
  if (request.every > 0 && request.output.empty())
    throw UsageError("--every needs --output FILE.csv");
}

/// The value of `--duration` to some digits; a rational number is exact.
cln::cl_R duration_value(const std::string& text, int digits, const Limits& limits) {
  const auto before = static_cast<long>(GiNaC::Digits);
  GiNaC::Digits = digits;
  const GiNaC::ex exact = parse_constant({text, {"--duration", 1, 1}, text}, limits);
  std::optional<GiNaC::numeric> value = real_decimal(exact, limits.bits);
  GiNaC::Digits = before;
  if (!value)
    throw UsageError(fmt::format("--duration '{}': expected a real number", printable(text)));
  if (GiNaC::is_a<GiNaC::numeric>(exact)) value = GiNaC::ex_to<GiNaC::numeric>(exact);
  return cln::the<cln::cl_R>(value->to_cl_N());
}

/// The decimal that was written for a double: the shortest that reads back as it.
cln::cl_RA as_written(double value, const Limits& limits) {
  std::string text = fmt::format("{}", value);
  if (const std::size_t e = text.find('e'); e != std::string::npos)
    text = fmt::format("{}*10^({})", text.substr(0, e), std::stoi(text.substr(e + 1)));
  return cln::rational(duration_value(text, kLeastDigits, limits));
}

PreciseProblem problem_of(const DigitsRequest& request, const Specialisation& s) {
  PreciseProblem problem;
  problem.rhs = &s.rhs;
  problem.invariants = s.invariant_names.empty() ? nullptr : &s.invariants;
  problem.max_steps = request.run.asked.max_steps;
  problem.start = [&](int digits) {
    const std::vector<cln::cl_F> values = start_values(s, digits);
    std::vector<cln::cl_R> start(values.begin(), values.end());
    if (request.run.duration)
      start.back() = duration_value(*request.run.duration, digits, s.limits);
    return start;
  };
  if (!request.output.empty()) {
    // A thousandth of the duration, unless it is given.
    constexpr int kSamples = 1000, kMostSamples = 10000000;
    const cln::cl_RA duration = cln::rational(cln::abs(problem.start(request.digits).back()));
    problem.sample_every =
        request.every > 0 ? as_written(request.every, s.limits) : duration / kSamples;
    if (duration > problem.sample_every * kMostSamples)
      throw UsageError(
          fmt::format("--every {}: more than {} samples", request.every, kMostSamples));
  }
  return problem;
}

AgreedRun run(const DigitsRequest& request, const Specialisation& s) {
  Progress progress(!request.common.quiet);
  PreciseProblem problem = problem_of(request, s);
  problem.give_up = [&progress, out_of_time = time_limit(request.common.time_limit)](double share) {
    progress.show(share);
    return out_of_time && out_of_time();
  };
  return agreed_run(std::move(problem), request.digits, [&](int digits) {
    progress.begin(fmt::format("{}: a run with {} digits", s.case_name, digits));
  });
}

int say_if_it_stopped(const DigitsReport& report) {
  if (report.status() == Status::ok) return kDone;
  std::cout.flush();
  std::cerr << fmt::format("casimir: error: the integration stopped at t = {}: {}\n  hint: {}\n",
                           report.stop_time(), report.reason(), report.advice());
  return report.status() == Status::stopped ? kEnvironment : kNotContinued;
}

}  // namespace

int integrate_with_digits(const DigitsRequest& request) {
  check(request);
  const Stopwatch generating;
  const Model model = in_variables(
      request.kept.model_of(request.start.in(load_case(request.case_name, request.common.limits)),
                            request.common.parameter_values()),
      request.in);
  SpecialiseOptions what;
  what.fold_parameters = request.how.fold_parameters;
  what.keep_parameters = request.how.keep_parameters;
  what.observe = request.how.observe;
  what.jacobian = false;
  const Scene& scene = model.scene(request.common.scene);
  require_exact_values(model, scene, "a run with more digits");
  const Specialisation s = specialise(model, scene, what);
  if (!request.run.duration) require_duration(scene);
  const double generated = generating.seconds();
  const Stopwatch watch;
  const AgreedRun agreed = run(request, s);
  const DigitsReport report{.spec = s,
                            .agreed = agreed,
                            .digits = request.digits,
                            .generate_seconds = generated,
                            .seconds = watch.seconds(),
                            .doubt = unwatched_parts(model, scene)};
  if (!request.output.empty()) write_samples(request.output, report);
  if (request.common.json) {
    print_json(to_json(report));
  } else if (!request.common.quiet) {
    print_text(report);
    for (const std::string& warning : report.warnings()) fmt::print("  warning: {}\n", warning);
    if (!request.output.empty())
      fmt::print("  wrote {} states to {}\n", agreed.run.samples.size(),
                 printable(request.output, 200));
  }
  return say_if_it_stopped(report);
}

}  // namespace casimir::tools

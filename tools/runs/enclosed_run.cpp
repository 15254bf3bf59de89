// casimir integrate --validated: boxes that provably contain the states.
#include "tools/runs/enclosed_run.hpp"

#include <cln/rational_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/run/validated.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/certified_motion.hpp"
#include "tools/runs/digits_run.hpp"
#include "tools/text/runs/certificate_report.hpp"
#include "tools/text/runs/enclosure_report.hpp"

namespace casimir::tools {
namespace {

constexpr const char* kRangeMark = "..";

[[noreturn]] void does_not_go_with_boxes(const std::string& option, const std::string& why) {
  throw UsageError(fmt::format("{} does not go with --validated: {}", option, why));
}

void check_enclosed(const EnclosedRequest& request) {
  if (request.digits && (*request.digits < kLeastDigits || *request.digits > kMostDigits))
    throw UsageError(fmt::format("--digits {}: expected {} to {}, or nothing for double precision",
                                 *request.digits, kLeastDigits, kMostDigits));
  if (request.method != "auto" && request.method != "taylor")
    does_not_go_with_boxes("--method " + request.method, "enclosures are made by Taylor series");
  const RunRequest& run = request.run.asked;
  if (run.rtol || run.atol || run.tolerance)
    does_not_go_with_boxes("a tolerance", "the width of the box says what is known");
  if (run.step) does_not_go_with_boxes("--step", "a step is as long as it can be enclosed");
  if (run.projects())
    does_not_go_with_boxes("--project", "every proved integral makes the box smaller");
  if (!request.as.empty())
    does_not_go_with_boxes("--as", "it converts states, not boxes; see --in");
  if (request.every > 0 && request.output.empty())
    throw UsageError("--every needs --output FILE.csv");
}

/// A rational number from the command line.
cln::cl_RA rational_value(const Text& text, const Limits& limits) {
  const GiNaC::ex value = parse_real_constant(text, limits);
  if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
    throw text.error("expected a rational number");
  return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
}

Text part_of(const Text& whole, std::size_t from, std::size_t length) {
  Text part = whole;
  part.value = whole.value.substr(from, length);
  part.where.column += static_cast<int>(from);
  return part;
}

/// The decimal that was written for a double: the shortest that reads back as it.
cln::cl_RA exact_interval(double value, const Limits& limits) {
  std::string text = fmt::format("{}", value);
  if (const std::size_t e = text.find('e'); e != std::string::npos)
    text = fmt::format("{}*10^({})", text.substr(0, e), std::stoi(text.substr(e + 1)));
  return rational_value({text, {"--every", 1, 1}, text}, limits);
}

/// Time between the boxes of a file: a thousandth of the duration, unless it is given.
cln::cl_RA sampling(const EnclosedRequest& request, const ValidatedOptions& options,
                    const Scene& scene, const Limits& limits) {
  if (request.output.empty()) return 0;
  if (request.every > 0) return exact_interval(request.every, limits);
  const GiNaC::ex duration = options.duration ? *options.duration : scene.duration.value_or(0);
  const GiNaC::ex value = duration.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value) || value.is_zero()) return 0;
  const double size = std::abs(GiNaC::ex_to<GiNaC::numeric>(value).to_double());
  return exact_interval(size / 1000, limits);
}

int say_if_it_stopped(const EnclosureReport& report) {
  const ValidatedRun& run = report.motion.run;
  if (run.status == ValidatedStatus::ok) return kDone;
  std::cout.flush();
  std::cerr << fmt::format("casimir: error: enclosed up to t = {} only: {}\n  hint: {}\n",
                           report.time(), run.reason, report.advice());
  return run.status == ValidatedStatus::stopped ? kEnvironment : kNotContinued;
}

/// Nobody is handed a certificate that does not pass. \return  kDone, or another exit status, and
/// says why, where none was written.
int write_certificate(const std::string& path, const RunCertificate& certificate,
                      const std::function<bool()>& late) {
  const CheckedCertificate checked = check_certificate(certificate, late);
  if (checked.check.fault == TraceFault::stopped) {
    std::cerr << fmt::format(
        "casimir: no certificate was written: the time limit came when {} of {} steps were "
        "verified\n"
        "  hint: the check takes up to twenty times as long as the run; --time-limit is for both\n",
        checked.check.step - 1, certificate.trace.steps.size());
    return kEnvironment;
  }
  if (!checked.holds()) {
    std::cerr << fmt::format(
        "casimir: no certificate was written: it could not be verified in other arithmetic: {}\n"
        "  hint: a smaller start may help; the box itself is proved\n",
        CertificateReport{certificate, checked}.reason());
    return kFailed;
  }
  OutputFile file(path);
  file.stream() << certificate_text(certificate);
  file.commit();
  return kDone;
}

}  // namespace

ParameterValues without_ranges(const ParameterValues& given, CaseFile& file,
                               ParameterRanges& ranges) {
  ParameterValues others;
  for (const auto& [name, value] : given) {
    const std::size_t mark = value.value.find(kRangeMark);
    if (mark == std::string::npos) {
      others.emplace_back(name, value);
      continue;
    }
    std::vector<std::string> known;
    for (const ParameterText& parameter : file.parameters) known.push_back(parameter.name.value);
    if (std::ranges::count(known, name.value) == 0)
      throw name.error(fmt::format("'{}' is not a parameter of this case", printable(name.value)),
                       0, suggest_or_list(name.value, known, "parameters"));
    const cln::cl_RA low = rational_value(part_of(value, 0, mark), file.limits);
    const cln::cl_RA high =
        rational_value(part_of(value, mark + 2, std::string::npos), file.limits);
    if (low > high) throw value.error("a range goes from the lower end to the higher one");
    Text middle = value;
    middle.value = rational_text((low + high) / 2);
    set_in_scenes(file, &SceneText::parameters, name, middle);
    ranges.emplace_back(name.value, (high - low) / 2);
  }
  return others;
}

std::string ranges_text(const ParameterValues& given) {
  std::string result;
  for (const auto& [name, value] : given) {
    const std::size_t mark = value.value.find(kRangeMark);
    if (mark == std::string::npos) continue;
    result += fmt::format("{}{} in [{}, {}]", result.empty() ? "" : ", ", printable(name.value),
                          printable(value.value.substr(0, mark)),
                          printable(value.value.substr(mark + 2)));
  }
  return result;
}

bool is_range(const std::string& word) { return word.find(kRangeMark) != std::string::npos; }

int integrate_validated(const EnclosedRequest& request) {
  check_enclosed(request);
  const Stopwatch watch;
  ValidatedOptions options;
  CaseFile file = request.start.in(load_case(request.case_name, request.common.limits));
  const ParameterValues values =
      without_ranges(request.common.parameter_values(), file, options.ranges);
  const Model model = in_variables(request.kept.model_of(file, values), request.in);
  const Scene& scene = model.scene(request.common.scene);
  if (request.initial_radius) {
    options.initial_radius = rational_value(
        {*request.initial_radius, {"--initial-radius", 1, 1}, *request.initial_radius},
        model.limits);
    if (cln::minusp(options.initial_radius))
      throw UsageError("--initial-radius: expected a number that is not negative");
  }
  if (request.run.duration)
    options.duration = parse_real_constant(
        {*request.run.duration, {"--duration", 1, 1}, *request.run.duration}, model.limits);
  if (!request.observe.empty()) options.observe = request.observe;
  options.run.digits = request.digits.value_or(0);
  options.run.max_steps = request.run.asked.max_steps;
  options.run.sample_every = sampling(request, options, scene, model.limits);
  Progress progress(!request.common.quiet);
  progress.begin(fmt::format("{}: enclosing", model.name));
  const std::function<bool()> late = time_limit(request.common.time_limit);
  options.run.give_up = [&progress, late](double share) {
    progress.show(share);
    return late && late();
  };
  RunCertificate certificate;
  const ValidatedMotion motion = request.certificate.empty()
                                     ? enclose(model, scene, options)
                                     : certified_motion(model, scene, options, certificate);
  const EnclosureReport report{
      .motion = motion, .digits = request.digits, .seconds = watch.seconds()};
  if (!request.output.empty()) write_boxes(request.output, report);
  const bool wanted = !request.certificate.empty() && motion.run.status == ValidatedStatus::ok;
  const int written = wanted ? write_certificate(request.certificate, certificate, late) : kDone;
  const bool certified = wanted && written == kDone;
  if (request.common.json) {
    nlohmann::ordered_json json = to_json(report);
    if (certified) json["certificate"] = request.certificate;
    print_json(json);
  } else if (!request.common.quiet) {
    print_text(report);
    if (!request.output.empty())
      fmt::print("  wrote {} boxes to {}\n", motion.run.samples.size(),
                 printable(request.output, 200));
    if (certified)
      fmt::print("  wrote {} steps to {}\n", certificate.trace.steps.size(),
                 printable(request.certificate, 200));
  }
  if (wanted && !certified) return written;
  return say_if_it_stopped(report);
}

}  // namespace casimir::tools

// casimir check: verifies a certificate of an enclosure, step by step.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/text/runs/certificate_report.hpp"

namespace casimir::tools {
namespace {

struct CheckOptions {
  Common common;
  std::string file;
};

std::string text_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::error_code problem;
  if (!stream || std::filesystem::is_directory(path, problem))
    throw CaseError({path}, "the certificate does not exist or cannot be read");
  constexpr std::size_t kPart = std::size_t{1} << 20, kMost = std::size_t{1} << 29;
  std::string text;
  while (stream && text.size() <= kMost) {
    const std::size_t before = text.size();
    text.resize(before + kPart);
    stream.read(text.data() + before, static_cast<std::streamsize>(kPart));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  return text;
}

/// Prints the report. \return  the exit status
template <class Report>
int answered(const CheckOptions& options, const Report& report, bool holds, bool stopped) {
  if (options.common.json)
    print_json(to_json(report));
  else if (!options.common.quiet)
    print_text(report);
  if (holds) return kDone;
  return stopped ? kEnvironment : kFailed;
}

int check_cycles(const CheckOptions& options, const std::vector<CycleCertificate>& cycles) {
  const Stopwatch watch;
  const auto late = time_limit(options.common.time_limit);
  CyclesReport report{cycles, {}, 0};
  for (const CycleCertificate& cycle : cycles) report.checked.push_back(check_cycle(cycle, late));
  report.seconds = watch.seconds();
  return answered(options, report, report.holds(), late && late());
}

int check_run(const CheckOptions& options, const RunCertificate& certificate) {
  const Stopwatch watch;
  const CheckedCertificate checked =
      check_certificate(certificate, time_limit(options.common.time_limit));
  const CertificateReport report{certificate, checked, watch.seconds()};
  return answered(options, report, checked.holds(), checked.check.fault == TraceFault::stopped);
}

int check_chaos(const CheckOptions& options, const HorseshoeCertificate& certificate) {
  const Stopwatch watch;
  const CheckedHorseshoe checked =
      check_horseshoe(certificate, time_limit(options.common.time_limit));
  const CheckedHorseshoeReport report{certificate, checked, watch.seconds()};
  return answered(options, report, checked.holds(), checked.stopped);
}

int check_certificate_file(const CheckOptions& options) {
  if (!options.common.params.empty() || options.common.scene_given)
    throw UsageError(
        "--param and --scene have no meaning here: the certificate says what it is of");
  const CertificateFile file =
      read_certificate(text_of_file(options.file), options.file, options.common.limits);
  if (file.run) return check_run(options, *file.run);
  if (file.horseshoe) return check_chaos(options, *file.horseshoe);
  return check_cycles(options, file.cycles);
}

}  // namespace

void register_check(CLI::App& program, Action& action) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      program.add_subcommand("check", "Verify the certificate of an enclosure, step by step");
  command->footer(
      "Nothing in the file is believed: integrals are proved again, and every step is verified in\n"
      "Arb's arithmetic; of chaos every covering, with the flow that it rests on. Exit status 0:\n"
      "all of it is proved; 1: it is not, and what fails first is named; 2: the file is "
      "malformed.");
  add_common(*command, options->common);
  command
      ->add_option("FILE", options->file, "What --certificate has written, of integrate or section")
      ->required();
  command->callback([options, &action] { action = action_of(options, check_certificate_file); });
}

}  // namespace casimir::tools

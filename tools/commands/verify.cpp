// casimir verify: proves or refutes the claims of a case, or candidates typed on the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include "symbolic/certificate.hpp"
#include "tools/analysis/proof/prove_in_process.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/certificate_name.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/further_integral.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/proofs/verify_report.hpp"
#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

struct VerifyArguments {
  Common common;
  std::string case_name;
  std::string in, tag;
  bool all = false, obstruct = false;
  std::vector<std::string> integrals, casimirs, invariant_relations, identities, on;
  std::string certificate;
};

std::vector<Text> texts(const std::vector<std::string>& values, const std::string& option) {
  std::vector<Text> result;
  for (const std::string& value : values) result.push_back({value, {option, 1, 1}, value});
  return result;
}

Candidates candidates_of(const VerifyArguments& options) {
  return {texts(options.integrals, "--integral"),
          texts(options.casimirs, "--casimir"),
          texts(options.invariant_relations, "--invariant-relation"),
          texts(options.identities, "--identity"),
          texts(options.on, "--on"),
          {}};
}

struct Verified {
  CaseOutcome outcome;
  nlohmann::ordered_json json;
};

/// Only what is proved has a certificate. What is said of it in JSON: null where none was written.
nlohmann::ordered_json write_certificate(const Model& model, const VerifyArguments& options,
                                         const std::vector<Proof>& proofs) {
  if (overall(model, proofs) != Verdict::proved) {
    std::cerr << "casimir: no certificate was written: not every claim is proved\n";
    return nullptr;
  }
  const Certificate certificate = coq_certificate(model, candidates_of(options), proofs);
  OutputFile file(options.certificate);
  file.stream() << certificate.text;
  file.commit();
  nlohmann::ordered_json left_out = nlohmann::ordered_json::array();
  for (const Uncertified& claim : certificate.left_out) {
    std::cerr << fmt::format("casimir: proved, but not in the certificate: {} {} ({})\n",
                             to_string(claim.kind), printable(claim.name), claim.reason);
    left_out.push_back({{"kind", to_string(claim.kind)},
                        {"name", printable(claim.name, 1000)},
                        {"reason", claim.reason}});
  }
  return {{"file", printable(options.certificate, 1000)}, {"left_out", left_out}};
}

/// Whether an integral that Liouville's count lacks is excluded; null where it lacks none.
nlohmann::ordered_json exclude_further(const Model& model, const VerifyArguments& options,
                                       const std::vector<Proof>& proofs, bool lines) {
  constexpr double kSeconds = 10;
  const double limit = options.common.time_limit;
  const auto answer = further_integral(model, options.common.scene, proofs,
                                       limit > 0 ? std::min(limit, kSeconds) : kSeconds);
  if (lines && answer) {
    for (const std::string& line :
         wrapped("further integral: " + further_integral_text(*answer), output_width()))
      fmt::print("{}\n", line);
  }
  if (!answer) return nullptr;
  nlohmann::ordered_json json{{"verdict", answer->proved ? "proved" : "undecided"}};
  if (answer->proved) {
    json["along"] = answer->examined.back().along;
    json["level"] = answer->examined.back().level;
    json["nve"] = answer->examined.back().nve;
    json["theorem"] = answer->theorem;
    json["excluded"] = answer->excluded;
  } else {
    json["reason"] = answer->reason;
  }
  return json;
}

/// Proves one case; its lines appear as they are decided, unless only a summary or JSON is wanted.
/// \param motion  the model, or the map that it is the base of
template <class Motion>
Verified verify_motion(const Model& model, const Motion& motion, const VerifyArguments& options,
                       double time_limit, bool lines) {
  if (options.common.scene_given) model.scene(options.common.scene);
  const Stopwatch watch;
  std::optional<CaseReport> report;
  if (lines) report.emplace(model, pending(motion, candidates_of(options)));
  const std::vector<Proof> proofs =
      prove_within(time_limit, motion, candidates_of(options), [&](const Proof& proof) {
        if (report) report->row(proof);
      });
  const double seconds = watch.seconds();
  if (report) report->end(proofs, seconds);
  const CaseOutcome outcome = outcome_of(model, proofs, seconds);
  nlohmann::ordered_json json = to_json(model, proofs, seconds);
  if (options.obstruct) json["further_integral"] = exclude_further(model, options, proofs, lines);
  if (!options.certificate.empty()) json["certificate"] = write_certificate(model, options, proofs);
  return {outcome, std::move(json)};
}

Verified verify_one(const AnyCaseFile& file, const VerifyArguments& options, double time_limit,
                    bool lines) {
  const ParameterValues fixed = options.common.parameter_values();
  if (const auto* map_file = std::get_if<MapCaseFile>(&file)) {
    if (!options.in.empty()) throw UsageError("--in changes the variables of a flow, not of a map");
    if (!options.certificate.empty())
      throw UsageError("--certificate is about flows: there is none for the case of a map");
    const MapModel map = map_model_of(*map_file, fixed);
    return verify_motion(map.base, map, options, time_limit, lines);
  }
  const Model model = in_variables(model_of(std::get<CaseFile>(file), fixed), options.in);
  return verify_motion(model, model, options, time_limit, lines);
}

int exit_status(Verdict verdict) {
  return verdict == Verdict::proved ? kDone : verdict == Verdict::refuted ? kFailed : kUndecided;
}

int verify_all(const VerifyArguments& options) {
  const Stopwatch watch;
  const std::vector<std::filesystem::path> paths = listed_cases(options.tag, options.common.limits);
  if (paths.empty())
    throw SystemError("no bundled cases were found; CASIMIR_CASES can name their folder");
  std::optional<AllReport> report;
  if (!options.common.json && !options.common.quiet) report.emplace(paths);
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  Verdict worst = Verdict::proved;
  for (const std::filesystem::path& path : paths) {
    double left = 0;
    if (options.common.time_limit > 0)
      left = std::max(options.common.time_limit - watch.seconds(), 1e-3);
    const Verified result =
        verify_one(read_any_case(path, options.common.limits), options, left, false);
    if (result.outcome.verdict == Verdict::refuted) worst = Verdict::refuted;
    if (result.outcome.verdict == Verdict::undecided && worst == Verdict::proved)
      worst = Verdict::undecided;
    if (report) report->row(result.outcome);
    cases.push_back(result.json);
  }
  if (report) report->end(worst, watch.seconds());
  if (options.common.json) {
    print_json(nlohmann::ordered_json{
        {"cases", cases}, {"verdict", to_string(worst)}, {"seconds", watch.seconds()}});
  }
  return exit_status(worst);
}

int verify(const VerifyArguments& options) {
  if (options.all && !options.case_name.empty()) throw UsageError("--all takes no CASE");
  if (!options.all && options.case_name.empty()) throw UsageError("verify needs a CASE, or --all");
  if (!options.all && !options.tag.empty()) throw UsageError("--tag needs --all");
  if (options.all && !options.in.empty()) throw UsageError("--in needs a CASE");
  if (options.all && !candidates_of(options).empty())
    throw UsageError("--all verifies the claims of the files; candidates need a CASE");
  if (candidates_of(options).empty() && !options.on.empty()) {
    throw UsageError(
        "--on needs a candidate: --integral, --casimir, --invariant-relation or --identity");
  }
  if (options.all && options.obstruct) throw UsageError("--obstruct needs a CASE");
  if (options.all && !options.certificate.empty()) throw UsageError("--certificate needs a CASE");
  if (!options.certificate.empty()) check_certificate_name(options.certificate);
  if (options.all) return verify_all(options);
  const bool lines = !options.common.json && !options.common.quiet;
  const Verified result = verify_one(load_any_case(options.case_name, options.common.limits),
                                     options, options.common.time_limit, lines);
  if (options.common.json) print_json(result.json);
  return exit_status(result.outcome.verdict);
}

}  // namespace

void register_verify(CLI::App& program, Action& action) {
  auto options = std::make_shared<VerifyArguments>();
  CLI::App* command =
      program.add_subcommand("verify", "Prove or refute the claims of a case, or candidates");
  add_common(*command, options->common);
  add_in(*command, options->in);
  command->add_option("CASE", options->case_name, kCaseText);
  add_all(*command, options->all, options->tag, "Every bundled case; maps with --tag map");
  const auto repeatable = [&](const char* name, std::vector<std::string>& target,
                              const char* text) {
    command->add_option(name, target, text)->allow_extra_args(false)->type_name("EXPR");
  };
  repeatable("--integral", options->integrals,
             "Test this as a first integral instead (repeatable)");
  repeatable("--casimir", options->casimirs,
             "Test this as a Casimir function instead (repeatable)");
  repeatable("--invariant-relation", options->invariant_relations,
             "Test whether its zero level is invariant (repeatable)");
  repeatable("--identity", options->identities,
             "Test whether LEFT = RIGHT; {F, G} is the bracket, rate(F) is dF/dt (repeatable)");
  repeatable("--on", options->on, "Only on the common zero level of these (repeatable)");
  command->add_flag("--obstruct", options->obstruct,
                    "Where integrals are missing, whether there is a proof that there are none");
  command
      ->add_option("--certificate", options->certificate,
                   "Write a proof that coqc accepts, if every claim is proved")
      ->type_name("FILE.v");
  command->callback([options, &action] { action = action_of(options, verify); });
}

}  // namespace casimir::tools

// casimir obstruct: proofs that a case has no further integral.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "symbolic/obstruction/certificate/coq_linear_algebra.hpp"
#include "symbolic/obstruction/obstruct.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/certificate_name.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/search_options.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/text/proofs/obstruction_report.hpp"

namespace casimir::tools {
namespace {

struct ObstructArguments {
  Common common;
  std::string case_name, in, free;
  std::vector<std::string> along;
  std::string certificate;
  unsigned order = 3;
  bool evidence = false;
};

bool is_parameter(const Model& model, const std::string& name) {
  return std::any_of(model.parameters.begin(), model.parameters.end(),
                     [&](const GiNaC::symbol& p) { return p.get_name() == name; });
}

/// Every name is a parameter, and no two are the same.
void check_free(const Model& model, const std::string& list) {
  std::set<std::string> seen;
  std::istringstream names(list);
  for (std::string name; std::getline(names, name, ',');) {
    if (!is_parameter(model, name))
      throw UsageError(fmt::format("--free: {} is no parameter of {} without a value",
                                   printable(name), model.name));
    if (!seen.insert(name).second) throw UsageError(fmt::format("--free: {} is given twice", name));
  }
}

/// Writes the linear algebra of the proof. What is said of it in JSON: null where none was written.
nlohmann::ordered_json write_certificate(const obstruction::Obstruction& answer,
                                         const std::string& path) {
  try {
    const obstruction::LinearCertificate certificate = obstruction::linear_certificate(answer);
    OutputFile file(path);
    file.stream() << certificate.text;
    file.commit();
    for (const std::string& line : certificate.left_out)
      std::cerr << "casimir: not in the certificate: " << line << '\n';
    return {{"file", printable(path, 1000)}, {"left_out", certificate.left_out}};
  } catch (const obstruction::NoCertificate& problem) {
    std::cerr << "casimir: no certificate was written: " << problem.what() << '\n';
    return nullptr;
  }
}

int obstruct(const ObstructArguments& options) {
  if (!options.certificate.empty()) check_certificate_name(options.certificate);
  const Model model = in_variables(model_of(load_case(options.case_name, options.common.limits),
                                            options.common.parameter_values()),
                                   options.in);
  if (options.common.scene_given) model.scene(options.common.scene);
  check_free(model, options.free);
  return with_search_errors(options.common, options.case_name, [&] {
    SearchWatch watch(options.common, model.name);
    const obstruction::Obstruction answer = obstruction::find_obstruction(
        model,
        {options.common.scene, texts_of(options.along, "--along"), options.free, options.order},
        watch.watch());
    const double seconds = watch.end();
    nlohmann::ordered_json json = to_json(model, answer, seconds);
    if (!options.common.json && !options.common.quiet)
      print(model, answer, seconds, options.evidence);
    if (!options.certificate.empty())
      json["certificate"] = write_certificate(answer, options.certificate);
    if (options.common.json) print_json(json);
    return answer.proved ? kDone : kUndecided;
  });
}

}  // namespace

void register_obstruct(CLI::App& program, Action& action) {
  auto options = std::make_shared<ObstructArguments>();
  CLI::App* command = program.add_subcommand(
      "obstruct", "Prove that there is no further integral, for the parameters of a scene");
  add_common(*command, options->common);
  add_in(*command, options->in);
  add_case(*command, options->case_name);
  command
      ->add_option("--along", options->along,
                   "An equation of the invariant surface with the curve, such as \"x = 0\" "
                   "(repeatable); what follows from it is added")
      ->allow_extra_args(false)
      ->type_name("EQ");
  command
      ->add_option(
          "--free", options->free,
          "Parameters that keep their symbols: which of their real values are not excluded?")
      ->type_name("NAME[,NAME]");
  command
      ->add_option("--order", options->order,
                   "The highest order of variational equations that are examined, 1 to 7")
      ->check(CLI::Range(1U, 7U))
      ->capture_default_str();
  command
      ->add_option("--certificate", options->certificate,
                   "Write the linear algebra of the proof for coqc, if there is one")
      ->type_name("FILE.v");
  command->add_flag("--evidence", options->evidence, "The evidence of what did not decide, too");
  command->callback([options, &action] { action = action_of(options, obstruct); });
}

}  // namespace casimir::tools

// casimir generate: a self-contained C++ or C header specialised to one scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "codegen/emit_cpp.hpp"
#include "codegen/specialise_map.hpp"
#include "symbolic/discrete/map_inverse.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/choices.hpp"
#include "tools/cli/options/kept_parameters.hpp"
#include "tools/cli/output.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/text/files/generated_report.hpp"

namespace casimir::tools {
namespace {

const std::map<std::string, Scalar> kScalars = {{"double", Scalar::real64},
                                                {"float", Scalar::real32},
                                                {"long-double", Scalar::long_double},
                                                {"float128", Scalar::float128},
                                                {"template", Scalar::templated}};

const std::map<std::string, Language> kLanguages = {{"c++", Language::cpp}, {"c", Language::c}};

struct GenerateArguments {
  Common common;
  KeptParameters kept;
  OtherStart start;
  std::string case_name, output;
  std::optional<std::string> name;
  std::string in;
  std::vector<std::string> with{"rhs", "invariants", "jacobian"};
  bool with_given = false;
  std::vector<std::string> observe;
  Scalar scalar = Scalar::real64;
  Language language = Language::cpp;
};

const std::vector<std::string> kParts = {"rhs",      "invariants",      "gradients",
                                         "jacobian", "sparse-jacobian", "variational",
                                         "taylor",   "inverse"};

/// One of these names; the help has them in its text already, and shells that complete find them
/// in the name of the check.
template <class Value>
CLI::Validator key_of(const std::map<std::string, Value>& values) {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : values) names.push_back(name);
  const auto check = [values, names](std::string& text) -> std::string {
    const auto found = values.find(CLI::detail::to_lower(text));
    if (found == values.end()) return none_of_them(text, names);
    text = std::to_string(static_cast<int>(found->second));
    return "";
  };
  return {check, "", fmt::format("{{{}}}", fmt::join(names, ","))};
}

bool wants(const GenerateArguments& options, const char* name) {
  return std::find(options.with.begin(), options.with.end(), name) != options.with.end();
}

SpecialiseOptions parts_of(const GenerateArguments& options) {
  const auto wanted = [&](const char* name) { return wants(options, name); };
  auto what = options.kept.in<SpecialiseOptions>();
  what.gradients = wanted("gradients");
  what.invariants = wanted("invariants") || what.gradients;
  what.jacobian = wanted("jacobian") || wanted("sparse-jacobian");
  what.taylor = wanted("taylor");
  what.variational = wanted("variational");
  if (!options.observe.empty()) what.observe = options.observe;
  return what;
}

Specialisation of_flow(const CaseFile& file, const GenerateArguments& options) {
  if (wants(options, "inverse"))
    throw UsageError("--with inverse is for maps: a flow is followed backwards by a negative time");
  const Model model = in_variables(
      options.kept.model_of(options.start.in(file), options.common.parameter_values()), options.in);
  return specialise(model, model.scene(options.common.scene), parts_of(options));
}

/// The step, its inverse where one is found and proved, and its Jacobian.
Specialisation of_map(MapCaseFile file, const GenerateArguments& options) {
  if (!options.in.empty()) throw UsageError("--in is for flows: a map stays in its variables");
  if (wants(options, "taylor"))
    throw UsageError("--with taylor is for flows: the time of a map is whole numbers");
  file.file = options.start.in(file.file);
  const MapModel map = options.kept.map_model_of(file, options.common.parameter_values());
  const Scene& scene = map.base.scene(options.common.scene);
  std::optional<std::vector<GiNaC::ex>> inverse;
  const bool every_state = options.observe.empty() && scene.observe.empty();
  // Where it was not asked for, it shall not take longer than all else.
  constexpr double kFewTerms = 1000;
  if (wants(options, "inverse"))
    inverse = discrete::proved_inverse(map);
  else if (!options.with_given && every_state)
    inverse = discrete::proved_inverse(map, kFewTerms);
  if (wants(options, "inverse") && !inverse)
    throw UsageError(
        "no inverse of this map was found, which does not say that there is none: a [[symmetry]] "
        "with reverses = true gives one, or leave 'inverse' out of --with");
  try {
    return specialise_map(map, scene, parts_of(options), inverse);
  } catch (const ModelError&) {
    // Henon's map has no inverse at b = 0, and its step is computed without a division.
    if (!inverse || wants(options, "inverse")) throw;
    return specialise_map(map, scene, parts_of(options), std::nullopt);
  }
}

int generate(const GenerateArguments& options) {
  if (options.output.empty() && options.common.json)
    throw UsageError("generate --json needs --output FILE for the header");
  const AnyCaseFile any = load_any_case(options.case_name, options.common.limits);
  const auto* map = std::get_if<MapCaseFile>(&any);
  const Specialisation specialisation =
      map ? of_map(*map, options) : of_flow(std::get<CaseFile>(any), options);
  const std::string header =
      emit_header(specialisation, {.scalar = options.scalar,
                                   .sparse_jacobian = wants(options, "sparse-jacobian"),
                                   .language = options.language,
                                   .name = options.name});
  if (options.output.empty()) {
    std::cout << header;
    return kDone;
  }
  OutputFile file(options.output);
  file.stream() << header;
  file.commit();
  if (options.common.json) {
    print_json(nlohmann::ordered_json{{"case", specialisation.case_name},
                                      {"scene", specialisation.scene},
                                      {"file", options.output},
                                      {"operations",
                                       {{"general", to_json(specialisation.general)},
                                        {"specialised", to_json(specialisation.specialised)}}},
                                      {"functions", functions_json(specialisation)},
                                      {"left_out", left_out_json(specialisation)}});
  } else if (!options.common.quiet) {
    fmt::print("wrote {}\n{}", printable(options.output, 200), generated_text(specialisation));
  }
  return kDone;
}

}  // namespace

void register_generate(CLI::App& program, Action& action) {
  auto options = std::make_shared<GenerateArguments>();
  CLI::App* command = program.add_subcommand(
      "generate", "Write a self-contained C++20 or C99 header specialised to a scene");
  add_common(*command, options->common);
  add_in(*command, options->in);
  options->start.add_to(*command);
  add_case(*command, options->case_name);
  command
      ->add_option("-o,--output", options->output, "The header to write (default: standard output)")
      ->type_name("FILE");
  CLI::Option* with =
      command
          ->add_option(
              "--with", options->with,
              "Of rhs, invariants, gradients (of the invariants, which come with them), "
              "jacobian (dense, with its pattern), sparse-jacobian (its entries as well), "
              "variational, taylor, and for maps inverse (default: rhs,invariants,jacobian, of "
              "a map the inverse too where one is found; rhs, the step of a map, always)")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->check(one_of(kParts).description("").name(one_of(kParts).get_description()))
          ->type_name("A,B");
  command
      ->add_option("--observe", options->observe,
                   "States that must be computed; what they do not need is left out")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
  command
      ->add_option("--scalar", options->scalar,
                   "Number type: double, float, long-double, float128 or template")
      ->transform(key_of(kScalars))
      ->type_name("TYPE");
  command
      ->add_option(
          "--language", options->language,
          "c++ (default): C++20, with adapters for Boost.Odeint and SUNDIALS; c: C99, with "
          "the name of the case in front of every name, in double, float or long-double "
          "and without taylor")
      ->transform(key_of(kLanguages))
      ->type_name("LANGUAGE");
  command
      ->add_option("--name", options->name,
                   "Name of the namespace, the include guard and the prefix of C, so that several "
                   "headers go into one program (default: that of the case)")
      ->type_name("IDENT");
  options->kept.add_to(*command);
  command->callback([options, with, &action] {
    options->with_given = with->count() > 0;
    action = action_of(options, generate);
  });
}

}  // namespace casimir::tools

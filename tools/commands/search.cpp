// casimir search: finds the polynomial integrals of a case up to a degree, and other structure.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "symbolic/discrete/map_darboux.hpp"
#include "symbolic/discrete/search_map.hpp"
#include "symbolic/search/conditions/darboux_conditions.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/search/search.hpp"
#include "symbolic/structure/brackets.hpp"
#include "symbolic/structure/conformal.hpp"
#include "symbolic/structure/orbital.hpp"
#include "symbolic/structure/separation.hpp"
#include "symbolic/structure/tensors.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/search_options.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/resources.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/text/proofs/constraints_note.hpp"
#include "tools/text/proofs/map_search_report.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/proofs/search_report.hpp"
#include "tools/text/proofs/separation_report.hpp"
#include "tools/text/proofs/structure_report.hpp"

namespace casimir::tools {
namespace {

struct SearchArguments {
  Common common;
  std::string case_name, in;
  int degree = -1;  ///< none given
  bool casimirs = false, darboux = false, rational = false;
  int tensors = 0;  ///< their rank, where it is given
  bool orbits = false, conformal = false;
  bool fields = false, bivectors = false, forms = false, hamiltonian = false, bihamiltonian = false;
  bool separation = false;
  std::vector<std::string> on, functions, weights, degree_in, free;
  std::string roots;   ///< a polynomial, or empty
  std::string output;  ///< of the case with the map to separated variables
};

/// How many of the options that ask for something else than integrals were given.
int kinds_of(const SearchArguments& o) {
  return int{o.darboux} + int{o.rational} + int{o.casimirs} + int{o.fields} + int{o.bivectors} +
         int{o.hamiltonian} + int{o.bihamiltonian} + int{o.separation} +
         int{o.forms || o.tensors > 0};
}

bool is_structure(const SearchArguments& o) {
  return o.fields || o.bivectors || o.forms || o.tensors > 0 || o.hamiltonian || o.bihamiltonian;
}

/// Whether integrals are limited in a way that other searches do not know.
bool is_narrow(const SearchArguments& o) {
  return !o.on.empty() || !o.functions.empty() || !o.weights.empty() || !o.degree_in.empty();
}

/// See the other one.
std::vector<std::string> constraints_left_out(const SearchArguments& options, const Model& model) {
  std::vector<GiNaC::ex> level;
  for (const Text& function : texts_of(options.on, "--on")) level.push_back(model.parse(function));
  return tools::constraints_left_out(model, level);
}

/// What is said of the constraints below the answer; empty where the answer says it.
template <class Report>
std::string note_of(const SearchArguments& options, const Report& report,
                    const std::vector<std::string>& constraints) {
  if (constraints.empty()) return {};
  if (!options.on.empty())
    return fmt::format(
        "This is about the level in the whole space of the variables; on the constraints as well: "
        "--on '{}'\n",
        fmt::join(constraints, "' --on '"));
  if constexpr (std::is_same_v<Report, search::Report>) {
    // Of integrals it says with which options they are found there.
    if (report.kind == ClaimKind::integral) return {};
  }
  return whole_space_note(constraints);
}

template <class Report>
int answer(const SearchArguments& options, const Model& model, const Report& report,
           SearchWatch& watch) {
  const double seconds = watch.end();
  const std::vector<std::string> beside = constraints_left_out(options, model);
  if (options.common.json) {
    nlohmann::ordered_json json = to_json(model, options.degree, report, seconds);
    if (!beside.empty()) json["not_on"] = beside;
    print_json(json);
  } else if (!options.common.quiet) {
    print(model, options.degree, report, seconds);
    fmt::print("{}", note_of(options, report, beside));
  }
  return report.complete ? kDone : kUndecided;
}

/// Of a map: what `search` asks of flows beyond the degree has no meaning there.
int search_map_case(const MapCaseFile& file, const SearchArguments& options) {
  if (!options.in.empty() || options.casimirs || options.rational || is_structure(options) ||
      options.separation || is_narrow(options) || !options.free.empty())
    throw UsageError("a search of a map takes --degree, --darboux and --param only");
  const MapModel map = map_model_of(file, options.common.parameter_values());
  SearchWatch watch(options.common, map.base.name, memory_allowed().value_or(2e9));
  if (options.darboux) {
    const discrete::MapDarboux found =
        discrete::find_map_darboux(map, options.degree, watch.watch());
    const double seconds = watch.end();
    if (options.common.json)
      print_json(to_json(map.base, options.degree, found, seconds));
    else if (!options.common.quiet)
      print(map.base, options.degree, found, seconds);
    return found.complete ? kDone : kUndecided;
  }
  const discrete::MapSearch found = discrete::search_map(map, options.degree, watch.watch());
  const double seconds = watch.end();
  if (options.common.json)
    print_json(to_json(map.base, options.degree, found, seconds));
  else if (!options.common.quiet)
    print(map.base, options.degree, found, seconds);
  return found.reason.empty() ? kDone : kUndecided;
}

/// Tensors and brackets.
int search_structure(const SearchArguments& options, const Model& model, SearchWatch& watch) {
  if (options.hamiltonian)
    return answer(options, model, structure::find_brackets(model, options.degree, watch.watch()),
                  watch);
  if (options.bihamiltonian)
    return answer(options, model,
                  structure::find_second_brackets(model, options.degree, watch.watch()), watch);
  if (options.orbits)
    return answer(options, model,
                  structure::find_orbital_symmetries(model, options.degree, watch.watch()), watch);
  structure::TensorType type{options.tensors, options.forms};
  if (options.fields || (options.forms && options.tensors == 0)) type.rank = 1;
  if (options.bivectors) type.rank = 2;
  if (options.conformal)
    return answer(options, model,
                  structure::find_conformal_tensors(model, type, options.degree, watch.watch()),
                  watch);
  return answer(options, model, structure::find_tensors(model, type, options.degree, watch.watch()),
                watch);
}

/// Why there is no case with a map to write; empty where there is one.
std::string why_no_map(const structure::SeparationReport& report) {
  if (report.found.empty()) return "no variables that separate were found";
  const structure::Separation& own = report.found.front();
  if (!own.map_case.empty()) return {};
  return own.no_map.empty() ? "the integrals are not shown to separate" : own.no_map;
}

/// Done where variables were found, or where none are needed or it is proved that there is no
/// bivector of this degree that would give them; failed where roots that were given are refuted.
/// A file that was asked for and cannot be made leaves the question open.
int search_separation(const SearchArguments& options, const Model& model, SearchWatch& watch) {
  structure::SeparationRequest request{
      std::max(options.degree, 0), texts_of(options.on, "--on"), {}};
  if (!options.roots.empty()) request.roots = texts_of({options.roots}, "--roots").front();
  // A place that cannot be written is told before the search.
  std::optional<OutputFile> file;
  if (!options.output.empty()) file.emplace(options.output);
  const structure::SeparationReport report =
      structure::find_separation(model, request, watch.watch());
  const double seconds = watch.end();
  const std::string obstacle = why_no_map(report);
  const bool writes = file && obstacle.empty();
  if (writes) {
    file->stream() << report.found.front().map_case;
    file->commit();
  }
  if (options.common.json) {
    nlohmann::ordered_json json = to_json(model, report, seconds);
    if (writes) json["file"] = options.output;
    print_json(json);
  } else if (!options.common.quiet) {
    print(model, report, seconds);
    if (writes) fmt::print("wrote {}\n", printable(options.output, 200));
  }
  if (file && !writes)
    fmt::print(stderr,
               "casimir: '{}' is not written, as no map to separated variables was made: {}\n",
               printable(options.output, 200), obstacle);
  const Verdict verdict = verdict_of(report);
  if (verdict == Verdict::refuted) return kFailed;
  return verdict == Verdict::proved && (!file || writes) ? kDone : kUndecided;
}

search::Request request_of(const SearchArguments& options) {
  search::Request request;
  request.degree = options.degree;
  request.casimirs = options.casimirs;
  request.on = texts_of(options.on, "--on");
  request.functions = texts_of(options.functions, "--functions");
  request.degree_in = degree_in_of(options.degree_in);
  request.own_weights = options.weights == std::vector<std::string>{"auto"};
  if (!request.own_weights) request.weights = weights_of(options.weights);
  return request;
}

int search_case(const SearchArguments& options) {
  const AnyCaseFile file = load_any_case(options.case_name, options.common.limits);
  if (const auto* map = std::get_if<MapCaseFile>(&file)) return search_map_case(*map, options);
  const Model model = in_variables(
      model_of(std::get<CaseFile>(file), options.common.parameter_values()), options.in);
  if (options.common.scene_given) model.scene(options.common.scene);
  SearchWatch watch(options.common, model.name, memory_allowed().value_or(2e9));
  if (is_structure(options)) return search_structure(options, model, watch);
  if (options.separation) return search_separation(options, model, watch);
  if (options.rational)
    return answer(options, model, search::find_rational(model, options.degree, watch.watch()),
                  watch);
  if (options.darboux && !options.free.empty()) {
    return answer(options, model,
                  search::find_darboux_conditions(
                      model, options.degree, texts_of(options.free, "--free", true), watch.watch()),
                  watch);
  }
  if (options.darboux) {
    return answer(options, model, search::find_darboux(model, options.degree, watch.watch()),
                  watch);
  }
  search::Request request = request_of(options);
  request.denominators = options.free.empty();
  if (options.free.empty())
    return answer(options, model, search::find_integrals(model, request, watch.watch()), watch);
  const std::vector<Text> free = texts_of(options.free, "--free", true);
  return answer(options, model, search::find_conditions(model, request, free, watch.watch()),
                watch);
}

int search(const SearchArguments& options) {
  if (kinds_of(options) > 1)
    throw UsageError(
        "of --casimirs, --darboux, --rational, --fields, --bivectors, --tensors (with --forms), "
        "--hamiltonian, --bihamiltonian and --separation only one is possible");
  if (is_structure(options) && (!options.free.empty() || is_narrow(options)))
    throw UsageError("a search for tensors or brackets takes --degree and --param only");
  if (options.separation && (!options.free.empty() || !options.functions.empty() ||
                             !options.weights.empty() || !options.degree_in.empty()))
    throw UsageError("--separation takes --degree, --on, --roots and --param only");
  if (!options.roots.empty() && !options.separation)
    throw UsageError("--roots goes with --separation");
  if (!options.output.empty() && !options.separation)
    throw UsageError("--output goes with --separation");
  if (options.orbits && !options.fields) throw UsageError("--orbits goes with --fields");
  const bool tensors = options.fields || options.bivectors || options.forms || options.tensors > 0;
  if (options.conformal && (!tensors || options.orbits))
    throw UsageError("--conformal goes with --fields, --bivectors, --forms or --tensors");
  if (options.degree < 0 && options.roots.empty() && options.degree_in.empty())
    throw UsageError("--degree is required");
  const bool has_degree = options.degree >= 0 || options.degree_in.empty();
  if (!is_structure(options) && !options.separation && has_degree && options.degree < 1)
    throw UsageError("--degree has to be 1 at least");
  if (options.casimirs && !options.on.empty())
    throw UsageError("--casimirs and --on do not go together");
  if (options.casimirs && !options.free.empty())
    throw UsageError("--casimirs and --free do not go together");
  const bool automatic = std::ranges::count(options.weights, "auto") > 0;
  if (automatic && options.weights.size() > 1)
    throw UsageError("--weights auto stands alone: it takes the weights of the equations");
  if (automatic && !options.free.empty()) throw UsageError("--free takes weights that are numbers");
  if (options.darboux && is_narrow(options))
    throw UsageError("--darboux takes --degree, --free and --param only");
  if (options.rational && (is_narrow(options) || !options.free.empty()))
    throw UsageError("--rational takes --degree and --param only");
  return with_search_errors(options.common, options.case_name,
                            [&] { return search_case(options); });
}

void add_structure_options(CLI::App& command, SearchArguments& options) {
  command.add_flag("--fields", options.fields, "Vector fields that commute with the motion");
  command.add_flag("--orbits", options.orbits,
                   "With --fields: fields that take orbits to orbits, [X, Y] = g*X");
  command.add_flag("--conformal", options.conformal,
                   "With --fields, --bivectors, --forms or --tensors: those that the motion "
                   "multiplies, L_X T = f*T");
  command.add_flag("--bivectors", options.bivectors, "Bivectors that the motion keeps");
  command
      .add_option("--tensors", options.tensors,
                  "Skew tensors with K indices that the motion keeps: K = 2 are bivectors")
      ->type_name("K")
      ->check(CLI::Range(1, 12));
  command.add_flag("--forms", options.forms,
                   "1-forms that the motion keeps; with --tensors K those of degree K");
  command.add_flag("--hamiltonian", options.hamiltonian,
                   "Poisson brackets and Hamiltonians of the equations of motion alone");
  command.add_flag("--bihamiltonian", options.bihamiltonian,
                   "Second Poisson brackets, compatible with that of the case");
  command
      .add_option(
          "--roots", options.roots,
          "With --separation: a polynomial in u whose roots are to be examined, instead of a "
          "search")
      ->type_name("EXPR");
  command
      .add_option("-o,--output", options.output,
                  "With --separation: write a case with the map to the separated variables here")
      ->type_name("FILE")
      ->check([](const std::string& name) {
        return name.empty() ? std::string("a name of a file is needed") : std::string();
      });
  command.add_flag("--separation", options.separation,
                   "Variables in which the integrals separate: the roots of det(P' - u*P) for a "
                   "second bivector P' of that degree");
}

}  // namespace

void register_search(CLI::App& program, Action& action) {
  auto options = std::make_shared<SearchArguments>();
  CLI::App* command =
      program.add_subcommand("search", "Find all polynomial integrals up to a degree");
  add_common(*command, options->common);
  add_in(*command, options->in);
  add_case(*command, options->case_name);
  command->add_option("--degree", options->degree, "Highest degree (weighted, with --weights)")
      ->type_name("N")
      ->check(CLI::Range(0, 1000));
  command->add_flag("--casimirs", options->casimirs, "Casimir functions instead of integrals");
  command
      ->add_option("--on", options->on,
                   "Integrals on the common zero level of these, with polynomial cofactors "
                   "(repeatable)")
      ->allow_extra_args(false)
      ->type_name("EXPR");
  command
      ->add_option("--functions", options->functions,
                   "A further function that the integrals may be polynomials in, such as \"1/g3\", "
                   "beside those of the equations (repeatable)")
      ->allow_extra_args(false)
      ->type_name("EXPR");
  add_weights(*command, options->weights,
              "; auto: those by which the equations of motion are quasi-homogeneous");
  add_degree_in(*command, options->degree_in);
  command
      ->add_option(
          "--free", options->free,
          "Find the values of these parameters at which there is an additional integral, or "
          "with --darboux a polynomial of that kind")
      ->allow_extra_args(false)
      ->type_name("NAME,..");
  command->add_flag("--darboux", options->darboux,
                    "Polynomials whose zero level is invariant, instead of integrals");
  command->add_flag("--rational", options->rational,
                    "Integrals that are quotients of polynomials, by their factors");
  add_structure_options(*command, *options);
  command->callback([options, &action] { action = action_of(options, search); });
}

}  // namespace casimir::tools

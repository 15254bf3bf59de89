// casimir degrees: how the degrees of the iterates of a rational map grow.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "symbolic/discrete/confinement.hpp"
#include "symbolic/discrete/degrees.hpp"
#include "symbolic/discrete/growth.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/text/files/marked_file.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

using discrete::Growth;

struct DegreesArguments {
  Common common;
  std::string case_name;
  std::string tag, output;
  int iterates = 0;
  bool kahan = false, all = false;
};

std::string growth_words(const Growth& growth) {
  switch (growth.kind) {
    case Growth::Kind::polynomial:
      return growth.formula.empty()
                 ? fmt::format("polynomial, like n^{}{}", *growth.degree,
                               growth.recurrence.empty() ? "" : ": " + growth.recurrence)
                 : fmt::format("polynomial: d(n) = {}", growth.formula);
    case Growth::Kind::exponential:
      return fmt::format("exponential{}; entropy about log({:.6g}) = {:.6g}",
                         growth.recurrence.empty() ? "" : ": " + growth.recurrence, *growth.ratio,
                         std::log(*growth.ratio));
    case Growth::Kind::unclear:
      break;
  }
  return "not clear from these iterates (--iterates computes more)";
}

void print_degrees(const std::string& name, const std::vector<int>& degrees, const Growth& growth,
                   bool kahan) {
  fmt::print("{}{}: degrees of the iterates on a general line\n", name,
             kahan ? ", Kahan's map" : "");
  fmt::print("  {}\n", fmt::join(degrees, " "));
  fmt::print("growth: {}\n", growth_words(growth));
}

nlohmann::ordered_json degrees_json(const std::string& name, const std::vector<int>& degrees,
                                    const Growth& growth, bool kahan, double seconds) {
  nlohmann::ordered_json json{
      {"case", name},
      {"map", kahan ? "kahan" : "case"},
      {"degrees", degrees},
      {"growth", to_string(growth.kind)},
  };
  if (growth.degree) json["growth_degree"] = *growth.degree;
  if (!growth.formula.empty()) json["formula"] = growth.formula;
  if (!growth.recurrence.empty()) json["recurrence"] = growth.recurrence;
  if (growth.ratio) {
    json["ratio"] = exact_text(*growth.ratio);
    json["entropy"] = exact_text(std::log(*growth.ratio));
  } else if (growth.kind == Growth::Kind::polynomial) {
    json["entropy"] = "0";
  }
  json["verdict"] = "evidence";
  json["seconds"] = seconds;
  return json;
}

std::string confinement_words(const discrete::Confinement& found) {
  using Kind = discrete::Confinement::Kind;
  int longest = 0;
  for (const discrete::SingularOrbit& orbit : found.orbits)
    longest = std::max(longest, orbit.recovered.value_or(found.steps) - orbit.lost + 1);
  switch (found.kind) {
    case Kind::none:
      return "none was met on random lines";
    case Kind::confined:
      return fmt::format("confined, after at most {} steps", longest);
    case Kind::not_confined:
      return fmt::format("not confined within {} steps", found.steps);
    case Kind::unclear:
      break;
  }
  return "not clear: of one there are no points over the field, the map is too large, or it is "
         "invertible nowhere";
}

/// Beside the growth of the degrees: maps that are confined and have entropy are known.
void print_confinement(const discrete::Confinement& found, const Growth& growth) {
  fmt::print("singularities: {}\n", confinement_words(found));
  for (const discrete::SingularOrbit& orbit : found.orbits)
    fmt::print("  {} {} lost in iterate {}, {}\n", orbit.points,
               orbit.points == 1 ? "point:" : "points:", orbit.lost,
               orbit.recovered ? fmt::format("recovered in iterate {}", *orbit.recovered)
                               : fmt::format("not recovered up to iterate {}", orbit.until));
  if (found.kind == discrete::Confinement::Kind::confined &&
      growth.kind == Growth::Kind::exponential)
    fmt::print(
        "  confinement alone is no sign of integrability: maps with entropy can be confined, as "
        "that of Hietarinta and Viallet\n");
}

void add_confinement(nlohmann::ordered_json& json, const discrete::Confinement& found) {
  json["confinement"] = to_string(found.kind);
  json["confinement_steps"] = found.steps;
  json["singularities"] = nlohmann::ordered_json::array();
  for (const discrete::SingularOrbit& orbit : found.orbits) {
    nlohmann::ordered_json row{{"lost", orbit.lost}};
    if (orbit.recovered) row["recovered"] = *orbit.recovered;
    row["until"] = orbit.until;
    row["points"] = orbit.points;
    json["singularities"].push_back(row);
  }
}

/// Where the time is up, what is known of the degrees is still said.
discrete::Confinement confinement(const std::function<discrete::Confinement()>& find) {
  try {
    return find();
  } catch (const search::NoAnswer&) {
    return {};
  }
}

/// A row of the table of all bundled flows; none for one that Kahan's map is not defined for.
std::optional<nlohmann::ordered_json> kahan_row(const CaseFile& file,
                                                const DegreesArguments& options,
                                                const search::Watch& watch) {
  std::vector<int> found;
  const auto start = std::chrono::steady_clock::now();
  try {
    discrete::DegreeRequest request;
    if (options.iterates > 0) request.iterates = options.iterates;
    found = discrete::degrees_of_kahan_iterates(model_of(file), request, watch);
  } catch (const ModelError&) {
    return std::nullopt;
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return degrees_json(file.name, found, discrete::growth_of(found), true, seconds.count());
}

std::string degrees_text(const nlohmann::ordered_json& row) {
  return fmt::format("{}", fmt::join(row.at("degrees").get<std::vector<int>>(), " "));
}

/// The table for a page: first the maps that grow slowly.
std::string kahan_page(const nlohmann::ordered_json& rows, std::size_t left_out) {
  std::string text =
      "| case | Kahan's map | growth of the degrees | degrees of its iterates |\n"
      "| --- | --- | --- | --- |\n";
  const std::pair<const char*, const char*> groups[] = {
      {"polynomial", "integrable, it seems"},
      {"unclear", "not clear"},
      {"exponential", "not integrable, it seems"}};
  std::map<std::string, std::size_t> counts;
  for (const auto& [growth, words] : groups)
    for (const auto& row : rows) {
      if (row.at("growth") != growth) continue;
      ++counts[growth];
      std::string how = row.contains("formula") ? row.at("formula").get<std::string>() : "";
      if (how.empty() && row.contains("growth_degree"))
        how = fmt::format("like n^{}", row.at("growth_degree").get<int>());
      if (row.contains("ratio"))
        how = fmt::format("like {:.4g}^n", std::stod(row.at("ratio").get<std::string>()));
      text += fmt::format("| {} | {} | {} | {} |\n", row.at("case").get<std::string>(), words, how,
                          degrees_text(row));
    }
  return text +
         fmt::format(
             "\nOf {} quadratic flows the degrees grow polynomially for {}, exponentially for "
             "{}; for {} the iterates are too few to tell. {} other cases are not quadratic, or "
             "have an equation between parameters. Evidence and no proof.\n",
             rows.size(), counts["polynomial"], counts["exponential"], counts["unclear"], left_out);
}

/// Which of the bundled flows seem to keep their integrability under Kahan's map.
int all_degrees(const DegreesArguments& options) {
  if (!options.kahan) throw UsageError("--all is about flows: it needs --kahan");
  std::optional<MarkedFile> page;
  if (!options.output.empty()) {
    if (!options.output.ends_with(".md"))
      throw UsageError(
          fmt::format("'{}': the table goes into a .md file, between the marks <!-- kahan "
                      "--> and <!-- /kahan -->",
                      printable(options.output, 200)));
    page.emplace(options.output, "kahan");
  }
  SearchWatch watch(options.common, "all cases");
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  std::size_t left_out = 0;
  if (!options.common.json && !options.common.quiet)
    fmt::print("{:<28} {:<12} {}\n", "case", "growth", "degrees of the iterates of Kahan's map");
  for (const CaseFile& file : tagged_cases(options.tag, options.common.limits)) {
    const auto row = kahan_row(file, options, watch.watch());
    if (!row) {
      ++left_out;
      continue;
    }
    rows.push_back(*row);
    if (options.common.json || options.common.quiet) continue;
    const std::string growth = row->at("growth");
    const bool polynomial = growth == "polynomial";
    fmt::print("{:<28} {:<12} {}\n", file.name,
               polynomial ? fmt::format("n^{}", row->at("growth_degree").get<int>()) : growth,
               fmt::join(row->at("degrees").get<std::vector<int>>(), " "));
  }
  const double seconds = watch.end();
  if (page) page->write(kahan_page(rows, left_out));
  if (options.common.json)
    print_json(nlohmann::ordered_json{
        {"rows", rows}, {"left_out", left_out}, {"verdict", "evidence"}, {"seconds", seconds}});
  else if (!options.common.quiet)
    fmt::print(
        "{} cases, and {} without Kahan's map: not quadratic, or with an equation between "
        "parameters; "
        "evidence and no proof; {:.3f} s\n",
        rows.size(), left_out, seconds);
  return kDone;
}

int degrees(const DegreesArguments& options) {
  if (options.all == !options.case_name.empty())
    throw UsageError("degrees needs either a CASE or --all");
  if (!options.all && !options.tag.empty()) throw UsageError("--tag needs --all");
  if (!options.all && !options.output.empty()) throw UsageError("--output needs --all");
  if (options.all)
    return with_search_errors(options.common, "all", [&] { return all_degrees(options); });
  const AnyCaseFile file = load_any_case(options.case_name, options.common.limits);
  const ParameterValues fixed = options.common.parameter_values();
  return with_search_errors(options.common, options.case_name, [&] {
    SearchWatch watch(options.common, common_part(file).name);
    discrete::DegreeRequest request;
    if (options.iterates > 0) request.iterates = options.iterates;
    const auto* map = std::get_if<MapCaseFile>(&file);
    if (map && options.kahan)
      throw UsageError("--kahan makes a map of a flow, and this case is a map");
    if (!map && !options.kahan)
      throw UsageError(
          "degrees are those of the iterates of a map, and this case is a flow: --kahan takes the "
          "map that Kahan's method makes of it");
    const std::vector<int> found =
        map ? discrete::degrees_of_iterates(map_model_of(*map, fixed), request, watch.watch())
            : discrete::degrees_of_kahan_iterates(model_of(std::get<CaseFile>(file), fixed),
                                                  request, watch.watch());
    const discrete::Confinement singular = confinement([&] {
      return map ? discrete::confinement_of(map_model_of(*map, fixed), watch.watch())
                 : discrete::confinement_of_kahan(model_of(std::get<CaseFile>(file), fixed),
                                                  watch.watch());
    });
    const double seconds = watch.end();
    const Growth growth = discrete::growth_of(found);
    const std::string name = common_part(file).name;
    if (options.common.json) {
      nlohmann::ordered_json json = degrees_json(name, found, growth, options.kahan, seconds);
      add_confinement(json, singular);
      print_json(json);
    } else if (!options.common.quiet) {
      print_degrees(name, found, growth, options.kahan);
      print_confinement(singular, growth);
      fmt::print(
          "evidence and no proof: computed modulo primes of 61 bits for random parameters, and the "
          "next degree is not known; {:.3f} s\n",
          seconds);
    }
    return kDone;
  });
}

}  // namespace

void register_degrees(CLI::App& program, Action& action) {
  auto options = std::make_shared<DegreesArguments>();
  CLI::App* command = program.add_subcommand(
      "degrees", "Growth of degrees and singularities of a map, as evidence of integrability");
  add_common(*command, options->common);
  command->add_option("CASE", options->case_name, kCaseText);
  add_all(*command, options->all, options->tag, "A table of every bundled flow, with --kahan");
  command
      ->add_option("--iterates", options->iterates,
                   "So many iterates; without it up to a degree of 300, at most 14")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option(
          "--output", options->output,
          "With --all: write the table into this Markdown file, between the marks <!-- kahan "
          "--> and <!-- /kahan -->")
      ->type_name("FILE.md");
  command->add_flag("--kahan", options->kahan, "Of Kahan's map of a flow, with a general step");
  command->callback([options, &action] { action = action_of(options, degrees); });
}

}  // namespace casimir::tools

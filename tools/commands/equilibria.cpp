// casimir equilibria: equilibria and relative equilibria of a scene, with their linear stability.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/analysis/equilibria/equilibria.hpp"
#include "tools/analysis/equilibria/validated_equilibria.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/search_watch.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/enclosed_run.hpp"
#include "tools/text/runs/enclosure_report.hpp"

namespace casimir::tools {
namespace {

struct EquilibriaArguments {
  Common common;
  std::string case_name, in;
  bool validated = false;
};

/// What was found, and with `--validated` what is proved of each.
struct EquilibriaAnswer {
  EquilibriumReport report;
  std::vector<ProvedEquilibrium> proofs;  ///< one for each, or none
  std::string ranges;                     ///< of parameters that the proofs are for, or empty
  std::string warning = {};               ///< of parts that are not looked at, or empty

  const ProvedEquilibrium* proof(std::size_t k) const {
    return proofs.empty() ? nullptr : &proofs[k];
  }
  std::size_t proved() const {
    return static_cast<std::size_t>(std::ranges::count_if(proofs, &ProvedEquilibrium::proved));
  }
};

std::string full_text(double value) { return fmt::format("{:.17g}", value); }

nlohmann::ordered_json ends(const RationalInterval& interval) {
  const auto [low, high] = decimal_ends(interval);
  return {low, high};
}

nlohmann::ordered_json equilibria_json(const Model& model, const ProvedEquilibrium& proof) {
  if (!proof.proved) return {{"verdict", "undecided"}, {"reason", proof.reason}};
  nlohmann::ordered_json json{{"verdict", "proved"},
                              {"radius", decimal_above(proof.radius)},
                              {"enclosure", nlohmann::ordered_json::object()},
                              {"velocities", nlohmann::ordered_json::array()},
                              {"stability", to_string(proof.stability)}};
  for (std::size_t i = 0; i < proof.state.size(); ++i)
    json["enclosure"][model.variables[i].get_name()] = ends(proof.state[i]);
  for (const RationalInterval& velocity : proof.velocities)
    json["velocities"].push_back(ends(velocity));
  return json;
}

nlohmann::ordered_json equilibria_json(const Model& model, const Scene& scene,
                                       const EquilibriaAnswer& answer, double seconds) {
  const EquilibriumReport& report = answer.report;
  nlohmann::ordered_json json{{"case", model.name},
                              {"scene", scene.name},
                              {"symmetries", report.symmetries},
                              {"level", report.level},
                              {"equilibria", nlohmann::ordered_json::array()},
                              {"outside", report.outside},
                              {"starts", report.starts},
                              {"seconds", seconds}};
  if (!answer.ranges.empty()) json["for_every"] = answer.ranges;
  if (!answer.warning.empty()) json["warnings"] = {answer.warning};
  for (std::size_t k = 0; k < report.equilibria.size(); ++k) {
    const Equilibrium& e = report.equilibria[k];
    nlohmann::ordered_json own{{"kind", e.velocities.empty() ? "equilibrium" : "relative"},
                               {"state", nlohmann::ordered_json::object()}};
    for (std::size_t i = 0; i < e.state.size(); ++i)
      own["state"][model.variables[i].get_name()] = full_text(e.state[i]);
    own["velocities"] = nlohmann::ordered_json::array();
    for (const double v : e.velocities) own["velocities"].push_back(full_text(v));
    own["eigenvalues"] = nlohmann::ordered_json::array();
    for (const auto& value : e.eigenvalues)
      own["eigenvalues"].push_back({full_text(value.real()), full_text(value.imag())});
    own["stability"] = to_string(e.stability);
    own["growth"] = full_text(e.growth());
    own["family"] = e.family;
    own["degenerate"] = e.degenerate;
    own["residual"] = full_text(e.residual);
    if (const ProvedEquilibrium* proof = answer.proof(k))
      own["validated"] = equilibria_json(model, *proof);
    json["equilibria"].push_back(own);
  }
  return json;
}

/// A rounded number for a table; what is nothing but rounding is 0.
std::string significant(double value, double scale) {
  return std::abs(value) <= 1e-12 * scale ? "0" : fmt::format("{:.6g}", value);
}

/// The same of a state; where it is proved to be small and not 0, it is not rounding.
std::string state_text(double value, double scale, const ProvedEquilibrium* proof) {
  const bool known =
      proof != nullptr && proof->proved && std::abs(value) > cln::double_approx(proof->radius);
  return known ? fmt::format("{:.6g}", value) : significant(value, scale);
}

void print_equilibria(const ProvedEquilibrium& proof, const std::string& ranges) {
  if (!proof.proved) {
    fmt::print("  not proved: {}\n", proof.reason);
    return;
  }
  fmt::print("  proved: {}there is one, and no other in a box of radius {} around it; {}\n",
             ranges.empty() ? "" : fmt::format("for every {} ", ranges),
             power_of_ten_above(proof.radius),
             proof.stability == ProvedStability::undecided
                 ? "its stability is not decided"
                 : fmt::format("proved to be {}", to_string(proof.stability)));
}

/// \param values  the eigenvalues
std::string stability_text(const Equilibrium& e, const std::string& values) {
  switch (e.stability) {
    case SpectralStability::no_derivative:
      return "the equations have no derivative here: stability is not told";
    case SpectralStability::undecided:
      return fmt::format(
          "eigenvalues {}: not decided, rounding may have moved one over the imaginary "
          "axis",
          values);
    default:
      return fmt::format("eigenvalues {}: {}", values, to_string(e.stability));
  }
}

void print_equilibria(const Model& model, const Scene& scene, const EquilibriaAnswer& answer,
                      double seconds) {
  const EquilibriumReport& report = answer.report;
  constexpr std::size_t kMost = 12;
  fmt::print("{}, scene '{}'{}{}\n", model.name, scene.name,
             report.level.empty() ? "" : ": on the level of ", fmt::join(report.level, ", "));
  if (!report.symmetries.empty())
    fmt::print("relative equilibria move with the flow of {}\n",
               fmt::join(report.symmetries, ", "));
  if (!answer.ranges.empty())
    fmt::print(
        "states, eigenvalues and what these say are of the middle of {}; proofs are of all\n",
        answer.ranges);
  std::size_t shown = 0;
  for (const Equilibrium& e : report.equilibria) {
    if (shown == kMost) break;
    const ProvedEquilibrium* proof = answer.proof(shown++);
    std::string state, values;
    for (std::size_t i = 0; i < e.state.size(); ++i)
      state += fmt::format("{}{} = {}", i > 0 ? ", " : "", model.variables[i].get_name(),
                           state_text(e.state[i], report.size, proof));
    for (const auto& value : e.eigenvalues) {  // what may be rounding is 0 already
      const std::string real = significant(value.real(), 0),
                        imaginary = significant(value.imag(), 0);
      values += (values.empty() ? "" : ", ") +
                (imaginary == "0" ? real
                 : real == "0"    ? imaginary + "i"
                                  : real + (imaginary[0] == '-' ? "" : "+") + imaginary + "i");
    }
    fmt::print("{}{}\n  {}\n", e.velocities.empty() ? "equilibrium" : "relative equilibrium",
               e.family > 0 ? fmt::format(", one of a family of dimension {}", e.family)
               : e.degenerate
                   ? ", degenerate: a multiple root as far as doubles tell, known to few digits"
                   : "",
               state);
    if (!e.velocities.empty()) fmt::print("  velocity {:.6g}\n", fmt::join(e.velocities, ", "));
    fmt::print("  {}\n", stability_text(e, values));
    if (proof != nullptr) print_equilibria(*proof, answer.ranges);
  }
  if (report.equilibria.size() > kMost)
    fmt::print("... and {} more; --json has them all\n", report.equilibria.size() - kMost);
  fmt::print("{} found from {} random starts, which does not exclude others; {:.3f} s\n",
             report.equilibria.size(), report.starts, seconds);
  if (report.outside > 0)
    fmt::print("{} more outside of the domain of the case, left out\n", report.outside);
  if (!answer.proofs.empty()) fmt::print("{} of them proved to exist\n", answer.proved());
  if (!answer.warning.empty()) fmt::print("warning: {}\n", answer.warning);
}

int equilibria(const EquilibriaArguments& options) {
  CaseFile file = load_case(options.case_name, options.common.limits);
  ParameterRanges ranges;
  const ParameterValues given = options.common.parameter_values();
  const ParameterValues values = options.validated ? without_ranges(given, file, ranges) : given;
  for (const std::string& word : options.common.params)
    if (is_range(word) && !options.validated)
      throw UsageError("--param with a range of values needs --validated");
  const Model model = in_variables(model_of(file, values), options.in);
  const Scene& scene = model.scene(options.common.scene);
  return with_search_errors(options.common, options.case_name, [&] {
    SearchWatch watch(options.common, model.name);
    watch.watch().begin("equilibria");
    EquilibriaAnswer answer{
        find_equilibria(model, scene, watch.watch().tick), {}, ranges_text(given)};
    answer.warning = unwatched_parts(model, scene);
    if (options.validated) answer.proofs = enclose_equilibria(model, scene, answer.report, ranges);
    take_proved(answer.proofs, answer.report);
    const double seconds = watch.end();
    if (options.common.json)
      print_json(equilibria_json(model, scene, answer, seconds));
    else if (!options.common.quiet)
      print_equilibria(model, scene, answer, seconds);
    return answer.proofs.empty() || answer.proved() > 0 ? kDone : kNotContinued;
  });
}

}  // namespace

void register_equilibria(CLI::App& program, Action& action) {
  auto options = std::make_shared<EquilibriaArguments>();
  CLI::App* command = program.add_subcommand(
      "equilibria", "Equilibria and relative equilibria of a scene, with eigenvalues");
  add_common(*command, options->common);
  add_in(*command, options->in);
  add_case(*command, options->case_name);
  command->add_flag("--validated", options->validated,
                    "Prove that each exists, that it is the only one nearby, and its stability");
  command->callback([options, &action] { action = action_of(options, equilibria); });
}

}  // namespace casimir::tools

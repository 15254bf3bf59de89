// casimir show: the system itself: bracket, Hamiltonian, equations of motion, claims, scenes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/canonical.hpp"
#include "symbolic/prove.hpp"
#include "tools/case_library.hpp"
#include "tools/cli.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  Common common;
  std::string case_name;
  std::string format = "text";
};

/// Expressions of a case as text that is the same in every run.
class Printer {
 public:
  explicit Printer(const Model& model) : dag_(symbols(model), model.variables.size()) {}
  std::string operator()(const GiNaC::ex& e) { return dag_.text(dag_.convert(e)); }
  std::string latex(const GiNaC::ex& e) { return dag_.latex(dag_.convert(e)); }

 private:
  static std::vector<GiNaC::symbol> symbols(const Model& model) {
    std::vector<GiNaC::symbol> all = model.variables;
    all.insert(all.end(), model.parameters.begin(), model.parameters.end());
    if (model.time) all.push_back(*model.time);
    return all;
  }
  codegen::Dag dag_;
};

/// Everything that `show` tells, once, for every format.
Json describe(const Model& model) {
  Printer print(model);
  Json json = {{"case", model.name},
               {"title", model.title},
               {"source", model.source},
               {"phase_space", model.phase_space}};
  for (const GiNaC::symbol& x : model.variables) json["variables"].push_back(x.get_name());
  json["parameters"] = Json::array();
  for (const GiNaC::symbol& p : model.parameters) json["parameters"].push_back(p.get_name());
  json["assumptions"] = Json::array();
  for (const Assumption& a : model.assumptions) json["assumptions"].push_back(a.text);
  if (model.poisson) {
    Json brackets = Json::object();
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
      for (std::size_t j = i + 1; j < model.variables.size(); ++j) {
        const GiNaC::ex value = (*model.poisson)(i, j);
        if (!value.is_zero())
          brackets[model.variables[i].get_name() + "," + model.variables[j].get_name()] =
              print(value);
      }
    }
    json["brackets"] = brackets;
    Candidates rank;
    rank.only = "rank";
    for (const Proof& proof : prove(model, rank)) {
      json["rank"] = proof.name;
      json["rank_evidence"] = proof.evidence.empty() ? proof.reason : proof.evidence;
    }
    json["hamiltonian"] = print(*model.hamiltonian);
  }
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    json["equations"][model.variables[i].get_name()] = print(model.field[i].expand());
  const auto named = [&](const char* key, const std::vector<NamedExpression>& list) {
    for (const NamedExpression& f : list) json[key][f.name] = print(f.value);
  };
  named("casimirs", model.casimirs);
  named("integrals", model.integrals);
  const auto levels = [&](const char* key, const std::vector<LevelClaim>& list) {
    for (const LevelClaim& claim : list) {
      Json entry = {{"name", claim.expression.name}, {"expression", print(claim.expression.value)}};
      for (const NamedExpression& f : claim.on) entry["on"].push_back(print(f.value));
      json[key].push_back(entry);
    }
  };
  levels("conditional", model.conditionals);
  levels("invariant_relation", model.invariant_relations);
  for (const Scene& scene : model.scenes) json["scenes"].push_back(scene.name);
  return json;
}

void print_text(const Json& json) {
  fmt::print("{}\n", printable(json["title"].get<std::string>(), 200));
  if (!json["source"].get<std::string>().empty())
    fmt::print("source       {}\n", printable(json["source"].get<std::string>(), 200));
  fmt::print("phase space  {} in {}\n", json["phase_space"].get<std::string>(),
             fmt::join(json["variables"].get<std::vector<std::string>>(), " "));
  if (!json["parameters"].empty())
    fmt::print("parameters   {}\n",
               fmt::join(json["parameters"].get<std::vector<std::string>>(), " "));
  if (!json["assumptions"].empty())
    fmt::print("assuming     {}\n",
               fmt::join(json["assumptions"].get<std::vector<std::string>>(), ", "));
  const auto table = [&](const char* key, const char* title, const char* format) {
    if (!json.contains(key) || json[key].empty()) return;
    fmt::print("{}\n", title);
    for (const auto& [name, value] : json[key].items())
      fmt::print(fmt::runtime(format), name, value.get<std::string>());
  };
  if (json.contains("brackets")) {
    table("brackets", "brackets (the others are zero or follow by skew symmetry)",
          "  {{{}}} = {}\n");
    fmt::print("{}: {}\n", json.value("rank", "rank"), json.value("rank_evidence", ""));
    fmt::print("Hamiltonian\n  H = {}\n", json["hamiltonian"].get<std::string>());
  }
  table("equations", "equations of motion", "  d{}/dt = {}\n");
  table("casimirs", "Casimir functions", "  {} = {}\n");
  table("integrals", "integrals", "  {} = {}\n");
  for (const char* key : {"conditional", "invariant_relation"}) {
    if (!json.contains(key)) continue;
    fmt::print("{}\n",
               std::string(key) == "conditional" ? "integrals on a level" : "invariant relations");
    for (const auto& entry : json[key]) {
      fmt::print("  {} = {}", entry["name"].get<std::string>(),
                 entry["expression"].get<std::string>());
      if (entry.contains("on"))
        fmt::print("  on {} = 0", fmt::join(entry["on"].get<std::vector<std::string>>(), " = "));
      fmt::print("\n");
    }
  }
  if (json.contains("scenes"))
    fmt::print("scenes       {}\n",
               fmt::join(json["scenes"].get<std::vector<std::string>>(), "; "));
}

void print_latex(const Model& model) {
  Printer print(model);
  const auto name = [](const GiNaC::symbol& s) { return codegen::latex_name(s.get_name()); };
  fmt::print("\\begin{{align*}}\n");
  if (model.poisson) {
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
      for (std::size_t j = i + 1; j < model.variables.size(); ++j) {
        const GiNaC::ex value = (*model.poisson)(i, j);
        if (!value.is_zero())
          fmt::print("\\{{{}, {}\\}} &= {} \\\\\n", name(model.variables[i]),
                     name(model.variables[j]), print.latex(value));
      }
    }
    fmt::print("H &= {} \\\\\n", print.latex(*model.hamiltonian));
  }
  const auto dotted = [](const std::string& symbol) {
    const std::size_t index = symbol.find('_');
    return "\\dot{" + symbol.substr(0, index) + "}" +
           (index == std::string::npos ? "" : symbol.substr(index));
  };
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    fmt::print("{} &= {} \\\\\n", dotted(name(model.variables[i])),
               print.latex(model.field[i].expand()));
  }
  for (const auto* list : {&model.casimirs, &model.integrals}) {
    for (const NamedExpression& f : *list)
      fmt::print("{} &= {} \\\\\n", codegen::latex_name(f.name), print.latex(f.value));
  }
  fmt::print("\\end{{align*}}\n");
}

int show(const Options& options) {
  const Model model = model_of(load_case(options.case_name), options.common.parameter_values());
  if (options.format == "latex" && !options.common.json) {
    print_latex(model);
    return kDone;
  }
  const Json json = describe(model);
  if (options.common.json || options.format == "json") {
    std::cout << json.dump(2) << '\n';
  } else if (!options.common.quiet) {
    print_text(json);
  }
  return kDone;
}

}  // namespace

void register_show(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "show", "The bracket, the Hamiltonian, the equations, what is claimed");
  add_common(*command, options->common);
  command
      ->add_option("CASE", options->case_name,
                   "A bundled case, a case file, or - for standard input")
      ->required();
  command->add_option("--format", options->format, "text, latex or json")
      ->check(CLI::IsMember({"text", "latex", "json"}));
  command->callback([options, &action] { action = [options] { return show(*options); }; });
}

}  // namespace casimir::tools

// casimir new: a commented case file to start from.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "symbolic/expression.hpp"
#include "tools/cli.hpp"
#include "tools/output.hpp"

namespace casimir::tools {
namespace {

constexpr const char* kTemplate =
    R"case(# A case file: a system, what is claimed about it, and scenes to integrate.
# Expressions are strings: + - * / ^, exact numbers (0.5 is 1/2), sqrt sin cos tan exp log atan2
# asin acos, Pi. This one is the Euler top; 'casimir verify {0}.toml' proves its claims.
title = "{0}"
source = "where the formulas come from"
tags = []
# integrable = true           # claims Liouville integrability: involution and independence count

hamiltonian = "(a1*M1^2 + a2*M2^2 + a3*M3^2)/2"

[phase_space]
variables = ["M1", "M2", "M3"]
algebra = "so(3)"             # or: canonical = true, or a table [phase_space.brackets] of
                              # "M1,M2" = "-M3", ..; or no bracket and a table [equations]

[parameters]                  # stay symbolic in proofs
a1 = {{ assume = "a1 > 0" }}
a2 = {{ assume = "a2 > 0" }}
a3 = {{ assume = "a3 > 0" }}

[casimirs]                    # {{x, F1}} = 0 for every coordinate x
F1 = "M1^2 + M2^2 + M3^2"

[integrals]                   # constant along the flow; the Hamiltonian is known to be
G2 = "M1^2 + M2^2 + M3^2"

[[scene]]
name = "default"
parameters = {{ a1 = "1", a2 = "1/2", a3 = "1/3" }}
initial = {{ M1 = "1", M2 = "1/2", M3 = "1/3" }}
duration = "100"
)case";

struct Options {
  Common common;
  std::string name;
};

int create(const Options& options) {
  std::string stem = options.name;
  if (stem.ends_with(".toml")) stem.resize(stem.size() - 5);
  const bool plain =
      !stem.empty() &&
      stem.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
          std::string::npos;
  if (!plain)
    throw UsageError(
        fmt::format("'{}' cannot name a case: letters, digits, '_' and '-' only", printable(stem)));
  const std::filesystem::path path = stem + ".toml";
  if (std::filesystem::exists(path))
    throw UsageError(fmt::format("'{}' exists already", path.string()));
  OutputFile file(path);
  file.stream() << fmt::format(kTemplate, stem);
  file.commit();
  if (options.common.json) {
    std::cout << nlohmann::ordered_json{{"file", path.string()}}.dump(2) << '\n';
  } else if (!options.common.quiet)
    fmt::print("wrote {0}; next: casimir verify {0}\n", path.string());
  return kDone;
}

}  // namespace

void register_new(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("new", "Write a commented case file to start from");
  add_common(*command, options->common);
  command->add_option("NAME", options->name, "Name of the new case")->required();
  command->callback([options, &action] { action = [options] { return create(*options); }; });
}

}  // namespace casimir::tools

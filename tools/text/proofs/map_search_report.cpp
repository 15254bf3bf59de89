#include "tools/text/proofs/map_search_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/cli/output.hpp"
#include "tools/text/proofs/constraints_note.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/proofs/search_report.hpp"

namespace casimir::tools {

nlohmann::ordered_json to_json(const Model& base, int degree, const discrete::MapSearch& found,
                               double seconds) {
  nlohmann::ordered_json json{{"case", base.name}, {"degree", degree}};
  json["integrals"] = nlohmann::ordered_json::array();
  for (const discrete::FoundOfMap& f : found.integrals) json["integrals"].push_back(f.text);
  json["densities"] = nlohmann::ordered_json::array();
  for (const discrete::FoundOfMap& f : found.densities) json["densities"].push_back(f.text);
  json["density_evidence"] = nlohmann::ordered_json::array();
  for (const discrete::FoundOfMap& f : found.densities)
    json["density_evidence"].push_back(f.evidence);
  json["trivial"] = 1;
  json["at_most"] = {{"polynomials", found.polynomials},
                     {"relations", found.relations},
                     {"densities", found.density_space}};
  json["none"] = {{"polynomial", found.no_polynomial ? "proved" : "undecided"},
                  {"rational", found.no_fraction ? "proved" : "undecided"}};
  if (!found.generic.empty()) json["generic"] = found.generic;
  if (!base.constraints.empty()) json["not_on"] = names_of(base.constraints);
  if (!found.reason.empty()) json["reason"] = found.reason;
  json["seconds"] = seconds;
  return json;
}

namespace {

/// What the dimensions say, which are upper bounds.
void print_bounds(const discrete::MapSearch& found) {
  const std::string generic = found.generic.empty() ? ""
                                                    : fmt::format(" (for generic values of {})",
                                                                  fmt::join(found.generic, ", "));
  if (found.no_polynomial)
    fmt::print("no polynomial integral of this degree: proved{}\n", generic);
  else
    fmt::print("at most {} linearly independent polynomial integrals, with powers and products{}\n",
               found.polynomials, generic);
  if (found.no_fraction)
    fmt::print("no rational integral of this degree: proved{}\n", generic);
  else
    fmt::print("a general orbit lies on at most {} independent hypersurfaces of this degree{}\n",
               found.relations, generic);
  if (found.density_space > found.densities.size())
    fmt::print("at most {} linearly independent polynomials P with a density 1/P{}\n",
               found.density_space, generic);
}

}  // namespace

void print(const Model& base, int degree, const discrete::MapSearch& found, double seconds) {
  fmt::print("{}: integrals of the map that are quotients of polynomials up to degree {}\n",
             base.name, degree);
  for (const discrete::FoundOfMap& f : found.integrals) fmt::print("  proved  {}\n", f.text);
  if (found.integrals.empty()) fmt::print("  none was found\n");
  for (const discrete::FoundOfMap& f : found.densities) {
    fmt::print("density {}: proved\n", f.text);
    if (!f.evidence.empty()) fmt::print("  {}\n", f.evidence);
  }
  if (found.not_generic.empty()) print_bounds(found);
  fmt::print("{}", whole_space_note(names_of(base.constraints)));
  if (!found.reason.empty()) fmt::print("{}\n", found.reason);
  fmt::print("{} found, {:.3f} s\n", found.integrals.size(), seconds);
}

nlohmann::ordered_json to_json(const Model& base, int degree, const discrete::MapDarboux& found,
                               double seconds) {
  search::DarbouxReport report;
  report.found = found.found;
  report.combinations = found.combinations;
  report.complete = found.complete;
  report.has_conjugates = true;
  report.reason = found.reason;
  nlohmann::ordered_json json = to_json(base, degree, report, seconds);
  json["factors"] = found.factors;
  json["has_jacobian"] = found.has_jacobian;
  if (!base.constraints.empty()) json["not_on"] = names_of(base.constraints);
  return json;
}

void print(const Model& base, int degree, const discrete::MapDarboux& found, double seconds) {
  const bool colour = may_colour(1);
  const std::string proved = verdict_text(Verdict::proved, colour);
  fmt::print("{}: polynomials P up to degree {} with P(x') = C*P, which are no integrals\n",
             base.name, degree);
  fmt::print("C made of the factors of the denominators{}: {}\n",
             found.has_jacobian ? " and of the Jacobian determinant"
                                : " (the Jacobian determinant is too long)",
             found.factors.empty() ? "none" : fmt::format("{}", fmt::join(found.factors, "; ")));
  for (const search::DarbouxPolynomial& own : found.found)
    fmt::print("  P = {}   C = {}   {}\n", own.text, own.cofactor, proved);
  if (found.complete)
    fmt::print(
        "No others with rational coefficients and such a C, beside their products with each other "
        "and with integrals and sums of those with one C: {}\n{}",
        proved,
        found.has_conjugates
            ? "There seem to be some with coefficients that are algebraic numbers, real or "
              "complex, which are not shown.\n"
            : "");
  else
    fmt::print("Whether there are others is {}: {}\n", verdict_text(Verdict::undecided, colour),
               found.reason);
  if (!found.combinations.empty()) fmt::print("what they give:\n");
  for (const search::DarbouxCombination& own : found.combinations)
    fmt::print("  {}   {}   {}\n",
               own.kind == search::DarbouxCombination::Kind::multiplier ? "density" : "integral",
               own.text, verdict_text(own.verdict, colour));
  for (const search::DarbouxCombination& own : found.combinations)
    if (!own.evidence.empty()) fmt::print("    {}: {}\n", own.text, own.evidence);
  fmt::print("{}", whole_space_note(names_of(base.constraints)));
  fmt::print("{} found, {:.3f} s\n", found.found.size(), seconds);
}

}  // namespace casimir::tools

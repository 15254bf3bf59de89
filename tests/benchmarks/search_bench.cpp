// The search for integrals beside dense elimination of the same matrix by FLINT.
//
//   search_bench [--quick] [NAME ..]
//
// For each problem: the whole search (equations, elimination, Casimir functions, reconstruction,
// proof), the elimination of its largest matrix alone, and FLINT's nmod_mat_rref on that matrix
// where it is small enough. Times are processor times, the least of some interleaved runs; they
// are printed, never judged. The answers are: --quick checks only these.
#include <flint/nmod_mat.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <optional>
#include <random>

#include "symbolic/case_file.hpp"
#include "symbolic/search/modular/echelon.hpp"
#include "symbolic/search/modular/linear_map.hpp"
#include "symbolic/search/search.hpp"
#include "symbolic/search/system.hpp"

namespace {

using namespace casimir;

struct Problem {
  std::string name, toml;
  int degree;
  std::size_t found;  ///< integrals that there are
  bool quick;
  int runs;
};

std::string e3(const std::string& hamiltonian) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
         "algebra = \"e(3)\"\n";
}

const std::string kKovalevskaya = "(M1^2 + M2^2 + 2*M3^2)/2 - g1";

/// A polynomial of degree 2 with every term, so that nothing is conserved but what has to be.
std::string generic_quadratic(const std::vector<std::string>& names) {
  std::mt19937 random(4);
  const auto number = [&] { return std::to_string(1 + random() % 97); };
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i > 0 ? " + " : "") + number() + "*" + names[i];
    for (std::size_t j = i; j < names.size(); ++j)
      text += " + " + number() + "*" + names[i] + "*" + names[j];
  }
  return text;
}

std::vector<std::string> names_of(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(fmt::format("{}{}", "Mabc"[i / 3], i % 3 + 1));
  return names;
}

std::string semidirect(std::size_t fields, const std::string& hamiltonian) {
  std::string variables;
  for (const std::string& name : names_of(3 * (fields + 1)))
    variables += (variables.empty() ? "\"" : ", \"") + name + "\"";
  return fmt::format("hamiltonian = \"{}\"\n[phase_space]\nvariables = [{}]\nalgebra = \"{}\"\n",
                     hamiltonian, variables,
                     fields == 1 ? std::string("e(3)") : fmt::format("so(3)+{}*R3", fields));
}

std::vector<Problem> problems() {
  return {
      {"e3-4", e3(kKovalevskaya), 4, 1, true, 20},
      {"e3-6", e3(kKovalevskaya), 6, 1, true, 20},
      {"e3-8", e3(kKovalevskaya), 8, 1, false, 10},
      {"9-variables-6", semidirect(2, "(M1^2 + M2^2 + 2*M3^2)/2 - a1 - b2"), 6, 2, false, 5},
      {"12-variables-6", semidirect(3, "(M1^2 + M2^2 + 2*M3^2)/2 - a1 - b2"), 6, 3, false, 3},
      {"6-without-symmetry-4", semidirect(1, generic_quadratic(names_of(6))), 4, 0, true, 3},
      {"6-without-symmetry-6", semidirect(1, generic_quadratic(names_of(6))), 6, 0, false, 3},
      {"9-without-symmetry-6", semidirect(2, generic_quadratic(names_of(9))), 6, 0, false, 1},
  };
}

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double milliseconds(const std::function<void()>& work) {
  const double start = processor_time();
  work();
  return 1e3 * (processor_time() - start);
}

/// The equations for the integrals of a case up to a degree, at one point of its parameters.
search::Equations equations_of(const Model& model, int degree, const search::Modulus& modulus) {
  const search::System system(model, {}, {});
  search::Fields fields;
  for (std::size_t i = 0; i < model.variables.size(); ++i) fields.places.push_back(i);
  fields.rates = {system.flow()};
  const search::Monomials monomials =
      search::all_monomials(std::vector<int>(fields.places.size(), 1), degree);
  return search::make_equations(fields, monomials, {}, search::Point(system.ring().size(), 1),
                                modulus);
}

std::size_t own_nullity(const search::Equations& equations, const search::Modulus& modulus) {
  std::size_t nullity = 0;
  for (search::Block& block : search::split(equations))
    nullity += search::Echelon(modulus, std::move(block.rows), block.columns.size(), {}).nullity();
  return nullity;
}

std::size_t flint_nullity(const search::Equations& equations, const search::Modulus& modulus) {
  nmod_mat_t matrix;
  nmod_mat_init(matrix, static_cast<slong>(equations.rows()), static_cast<slong>(equations.columns),
                modulus.prime());
  for (std::size_t r = 0; r < equations.rows(); ++r)
    for (std::size_t i = equations.starts[r]; i < equations.starts[r + 1]; ++i)
      nmod_mat_entry(matrix, r, equations.entries[i].column) = equations.entries[i].value;
  const auto rank = static_cast<std::size_t>(nmod_mat_rref(matrix));
  nmod_mat_clear(matrix);
  return equations.columns - rank;
}

bool run(const Problem& problem, bool quick) {
  const Model model = build_model(parse_case(problem.toml, problem.name));
  const search::Modulus modulus = search::Modulus::nth(0);
  search::Request request;
  request.degree = problem.degree;
  search::Report report;
  std::size_t nullity = 0, dense = 0;
  double whole = 1e300, elimination = 1e300, flint = 1e300;
  const search::Equations equations = equations_of(model, problem.degree, modulus);
  const double entries =
      static_cast<double>(equations.rows()) * static_cast<double>(equations.columns);
  constexpr double kSmallEnough = 4e7;  // entries: 320 MB and some seconds
  const bool with_flint = entries < kSmallEnough;
  const int runs = quick ? 1 : problem.runs;
  for (int i = 0; i < runs; ++i) {
    whole = std::min(whole, milliseconds([&] { report = search::find_integrals(model, request); }));
    elimination =
        std::min(elimination, milliseconds([&] { nullity = own_nullity(equations, modulus); }));
    if (with_flint && i == 0)
      flint = milliseconds([&] { dense = flint_nullity(equations, modulus); });
  }
  const bool right =
      report.complete && report.found.size() == problem.found && (!with_flint || dense == nullity);
  if (!quick) {
    fmt::print(
        "{:<22} {:>6} {:>7} {:>10.2f} {:>10.2f} {:>10} {:>8}  {}\n", problem.name, report.unknowns,
        report.largest_block, whole, elimination, with_flint ? fmt::format("{:.1f}", flint) : "-",
        with_flint ? fmt::format("{:.0f}", flint / elimination) : "-", right ? "right" : "WRONG");
    std::fflush(stdout);
  } else if (!right) {
    fmt::print("{}: {} found, {} expected, {}; nullity {} and by FLINT {}\n", problem.name,
               report.found.size(), problem.found, report.complete ? "complete" : report.reason,
               nullity, dense);
  }
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool quick = std::find(words.begin(), words.end(), "--quick") != words.end();
  bool right = true;
  if (!quick)
    fmt::print("{:<22} {:>6} {:>7} {:>10} {:>10} {:>10} {:>8}\n", "problem", "size", "block",
               "search ms", "elimin. ms", "FLINT ms", "ratio");
  for (const Problem& problem : problems()) {
    if (quick
            ? !problem.quick
            : !words.empty() && std::find(words.begin(), words.end(), problem.name) == words.end())
      continue;
    right = run(problem, quick) && right;
  }
  return right ? 0 : 1;
}

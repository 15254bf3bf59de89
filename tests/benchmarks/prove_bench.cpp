// How long the proof engine takes, and how long plain GiNaC takes for the same identities.
//
//   prove_bench [--quick] [--giants] [--only TEXT] [FOLDER]
//
// --quick checks the verdicts of the small problems, --giants lets GiNaC try the large ones, --only
// takes the problems whose name has TEXT in it, FOLDER adds all claims of its case files.
//
// A time is CPU time from GiNaC's expression trees to the verdict: building the ring, converting
// every expression to polynomials, differentiation, multiplication and the test for zero are in it;
// reading the text of the case is not, except in the last row. Each repetition starts with trees
// that no one has touched. GiNaC's time, taken in turn with it, is that of diff, expand and, where
// there are angles and roots, the reduction by their relations. No time is given for a wrong
// verdict: the program fails then.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "symbolic/functions/function_ring.hpp"
#include "symbolic/prove.hpp"
#include "tests/benchmarks/prove_problems.hpp"

namespace casimir::test {
namespace {

using GiNaC::ex;

/// CPU time of this process in milliseconds.
double cpu() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Starts a new peak, where the system allows that.
void reset_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// Megabytes resident at the peak.
double peak() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return kilobytes / 1024;
  }
  return 0;
}

double median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                   times.end());
  return times[times.size() / 2];
}

/// By GiNaC alone: sines, cosines and roots by symbols of their own, which obey the relations.
class Relations : public GiNaC::map_function {
 public:
  ex operator()(const ex& e) override {
    if (GiNaC::is_a<GiNaC::function>(e)) {
      const ex angle = e.op(0);
      const bool sine = e.is_equal(GiNaC::sin(angle));
      const auto it = angles_.find(angle);
      const std::pair<ex, ex> names =
          it != angles_.end() ? it->second : std::pair<ex, ex>(GiNaC::symbol(), GiNaC::symbol());
      if (it == angles_.end()) {
        angles_.emplace(angle, names);
        relations_.emplace_back(names.second,
                                GiNaC::pow(names.first, 2) + pow(names.second, 2) - 1);
      }
      return sine ? names.first : names.second;
    }
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).denom().is_equal(2)) {
      const ex radicand = (*this)(e.op(0));
      auto it = roots_.find(radicand);
      if (it == roots_.end()) {
        it = roots_.emplace(radicand, GiNaC::symbol()).first;
        relations_.emplace_back(it->second,
                                (GiNaC::pow(it->second, 2) - radicand).normal().numer());
      }
      return GiNaC::pow(it->second, e.op(1).numer());
    }
    return e.map(*this);
  }

  bool vanishes(const ex& e) {
    ex rest = (*this)(e);
    rest = relations_.empty() ? rest.expand() : rest.normal().numer().expand();
    for (auto it = relations_.rbegin(); it != relations_.rend() && !rest.is_zero(); ++it)
      rest = GiNaC::prem(rest, it->second, it->first).expand();
    return rest.is_zero();
  }

 private:
  std::map<ex, std::pair<ex, ex>, GiNaC::ex_is_less> angles_;
  std::map<ex, ex, GiNaC::ex_is_less> roots_;
  std::vector<std::pair<ex, ex>> relations_;  ///< unknown and polynomial
};

bool holds_by_ginac(const Model& model, ClaimKind kind) {
  if (kind == ClaimKind::jacobi) {
    const std::size_t n = model.variables.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        for (std::size_t k = j + 1; k < n; ++k) {
          if (!model.poisson->jacobi_defect(i, j, k).expand().is_zero()) return false;
        }
      }
    }
    return true;
  }
  return Relations().vanishes(model.poisson->bracket(model.integrals[0].value, *model.hamiltonian));
}

std::vector<GiNaC::symbol> symbols_of(const Model& model) {
  std::vector<GiNaC::symbol> symbols = model.variables;
  symbols.insert(symbols.end(), model.parameters.begin(), model.parameters.end());
  return symbols;
}

Model fresh_model(const std::string& toml, bool flat) {
  Model model = build_model(parse_case(toml, "problem.toml"));
  if (flat) {
    ex& value = model.integrals[0].value;
    FunctionRing ring(symbols_of(model), {}, {value}, model.limits);
    value = ring.expression(ring.convert(value));
  }
  return model;
}

/// Terms of the integral when multiplied out, or non-zero brackets.
std::size_t terms_of(const Problem& problem) {
  const Model model = fresh_model(problem.toml, false);
  if (problem.kind == ClaimKind::integral) {
    const ex value = model.integrals[0].value;
    FunctionRing ring(symbols_of(model), {}, {value}, model.limits);
    return ring.convert(value).terms();
  }
  std::size_t brackets = 0;
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) brackets += (*model.poisson)(i, j).is_zero() ? 0 : 1;
  }
  return brackets;
}

Verdict verdict_of(const Model& model, ClaimKind kind) {
  Candidates only;
  only.only = kind;
  return overall(model, prove(model, only));
}

struct Options {
  bool quick = false;
  bool giants = false;
  std::string folder, only;
};

bool fail(const std::string& text) {
  fmt::print("WRONG: {}\n", text);
  return false;
}

/// One row; false if a verdict is wrong.
bool run(const Problem& problem, const Options& options) {
  if (verdict_of(fresh_model(problem.bent, problem.flat), problem.kind) != Verdict::refuted)
    return fail(problem.name + ": the bent twin is not refuted");
  const bool with_ginac = !options.quick && (problem.size == Size::small ||
                                             (problem.size == Size::large && options.giants));
  const double enough = options.quick ? 0 : 1500;
  std::vector<double> own, plain;
  double memory = 0;
  for (const double start = cpu(); own.empty() || (cpu() - start < enough && own.size() < 101);) {
    const Model model = fresh_model(problem.toml, problem.flat);
    reset_peak();
    double before = cpu();
    const Verdict verdict = verdict_of(model, problem.kind);
    own.push_back(cpu() - before);
    memory = peak();
    if (verdict != Verdict::proved) return fail(problem.name + ": " + to_string(verdict));
    if (!with_ginac) continue;
    const Model other = fresh_model(problem.toml, false);
    before = cpu();
    const bool holds = holds_by_ginac(other, problem.kind);
    plain.push_back(cpu() - before);
    if (!holds) return fail(problem.name + ": GiNaC does not see it");
  }
  const double time = median(own);
  const std::string ginac = plain.empty() ? "-" : fmt::format("{:.3f}", median(plain));
  const std::string ratio = plain.empty() ? "-" : fmt::format("{:.1f}", median(plain) / time);
  fmt::print("{:<42} {:>7} {:>9.3f} {:>9} {:>11} {:>7} {:>6.0f} {}\n", problem.name,
             terms_of(problem), time, problem.limit, ginac, ratio, memory,
             time <= problem.limit ? "" : "over");
  std::cout << std::flush;
  return true;
}

/// All claims of all cases of a folder, the reading of the files included.
bool run_folder(const std::string& folder, bool quick) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<double> totals, claims;
  bool right = true;
  std::size_t facts = 0;
  const int repeats = quick ? 1 : 5;
  for (int k = 0; k < repeats; ++k) {
    const double before = cpu();
    claims.clear();
    facts = 0;
    for (const auto& file : files) {
      const Model model = build_model(read_case(file.string()));
      const std::vector<Proof> proofs = prove(model);
      if (overall(model, proofs) != Verdict::proved) right = fail(file.string());
      for (const Proof& proof : proofs) {
        if (!proof.fact) claims.push_back(1e3 * proof.seconds);
        facts += proof.fact ? 1 : 0;
      }
    }
    totals.push_back(cpu() - before);
  }
  std::sort(claims.begin(), claims.end());
  fmt::print("{} cases, {} claims and {} facts with reading: {:.1f} ms\n", files.size(),
             claims.size(), facts, median(totals));
  if (!claims.empty()) {
    fmt::print("one claim, ring given: nine of ten under {:.3f} ms, none over {:.3f} ms\n",
               claims[claims.size() * 9 / 10], claims.back());
  }
  return right;
}

bool run_all(const Options& options) {
  fmt::print("{:<42} {:>7} {:>9} {:>9} {:>11} {:>7} {:>6}\n", "problem", "terms", "ms", "limit",
             "GiNaC ms", "ratio", "MB");
  bool right = true;
  for (const Problem& problem : prove_problems()) {
    if (options.quick && problem.size != Size::small) continue;
    if (problem.name.find(options.only) == std::string::npos) continue;
    right = run(problem, options) && right;
  }
  return (options.folder.empty() || run_folder(options.folder, options.quick)) && right;
}

}  // namespace
}  // namespace casimir::test

int main(int argc, char** argv) {
  casimir::test::Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick")
      options.quick = true;
    else if (argument == "--giants")
      options.giants = true;
    else if (argument == "--only" && i + 1 < argc)
      options.only = argv[++i];
    else
      options.folder = argument;
  }
  return casimir::test::run_all(options) ? 0 : 1;
}

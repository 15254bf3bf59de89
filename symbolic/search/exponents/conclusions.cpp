#include "symbolic/search/exponents/conclusions.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace casimir::search {
namespace {

/// The least power N of t - t0 for which x_i = c_i (t - t0)^(-g_i) has whole powers of its root.
long root_of_time(const LeadingPart& leading) {
  long result = 1;
  for (std::size_t i = 0; i < leading.dimension(); ++i)
    result = std::lcm(result, cln::cl_I_to_long(cln::denominator(leading.weight(i))));
  return result;
}

/// Whether a coordinate of a balance that is not zero has a broken power of t - t0.
bool branches_itself(const LeadingPart& leading, const Balance& balance) {
  for (std::size_t i = 0; i < leading.dimension(); ++i)
    if (cln::denominator(leading.weight(i)) != 1 && balance.is_nonzero[i]) return true;
  return false;
}

/// The exponents that are not integers, by what follows from them.
struct Outliers {
  std::vector<std::string> rational, irrational, parametric;
  bool all_integer = false;
  bool branches = false;  ///< a balance itself
};

Outliers outliers(const LeadingPart& leading, const ExponentReport& report) {
  // Variations of a balance are (t - t0)^(rho - g_i) times constants, in Jordan blocks times
  // logarithms. Solutions without branches have variations without (Lyapunov); where weights are
  // broken, the balance itself may branch, and rho - g_i is whole where rho is not.
  const long root = root_of_time(leading);
  Outliers result;
  result.all_integer = report.complete;
  for (const Balance& balance : report.balances) {
    result.branches = result.branches || branches_itself(leading, balance);
    for (const Exponent& e : balance.exponents) {
      if (e.kind == Exponent::Kind::integer) continue;
      result.all_integer = false;
      const bool of_root =
          e.kind == Exponent::Kind::rational && cln::denominator(e.value * cln::cl_RA(root)) == 1;
      if (of_root && root > 1) continue;
      const bool open = e.kind == Exponent::Kind::parametric && !e.is_irrational;
      auto& list = e.kind == Exponent::Kind::rational ? result.rational
                   : open                             ? result.parametric
                                                      : result.irrational;
      const bool is_root = e.kind == Exponent::Kind::algebraic || e.is_root;
      const std::string entry = is_root ? e.text + " = 0" : e.text;
      if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
    }
  }
  return result;
}

}  // namespace

void conclude(const LeadingPart& leading, ExponentReport& report) {
  const long root = root_of_time(leading);
  const auto [rational, irrational, parametric, all_integer, branches] = outliers(leading, report);
  auto& out = report.conclusions;
  if (report.balances.empty() && report.complete)
    out.push_back("there is no balance with these weights: the test says nothing");
  if (!irrational.empty()) {
    out.push_back(fmt::format(
        "exponents that are not rational ({}): the leading system is not algebraically integrable, "
        "that is, has no {} independent algebraic integrals (Yoshida 1983, Goriely 1996: all "
        "Kovalevskaya exponents of a quasi-homogeneous system that has are rational), and its "
        "general solution branches infinitely often",
        fmt::join(irrational, "; "), leading.dimension() - 1));
  }
  if (!rational.empty()) {
    out.push_back(fmt::format(
        "rational exponents that are not {} ({}): the general solution is not single-valued in "
        "complex time (Kovalevskaya 1889, Lyapunov 1894); an algebraic integral is not excluded",
        root == 1 ? "integers" : fmt::format("multiples of 1/{}, as the weights are", root),
        fmt::join(rational, "; ")));
  }
  if (!parametric.empty()) {
    out.push_back(fmt::format(
        "exponents that depend on parameters ({}): where one is not rational, the leading system "
        "is not algebraically integrable, that is, has no {} independent algebraic integrals "
        "(Yoshida 1983, Goriely 1996); where one is not {}, the general solution is not "
        "single-valued (Kovalevskaya 1889, Lyapunov 1894)",
        fmt::join(parametric, "; "), leading.dimension() - 1,
        root == 1 ? "an integer" : fmt::format("a multiple of 1/{}, as the weights are", root)));
  }
  if (branches)
    out.push_back(
        "a balance has broken powers of t - t0: it is not single-valued in complex time, whatever "
        "the exponents");
  if (all_integer && !report.balances.empty() && root == 1)
    out.push_back(
        "all exponents are integers: Kovalevskaya's necessary condition for single-valued general "
        "solutions holds for these balances; that excludes no logarithms and alone proves no "
        "integrability");
  say_what_of_constraints(leading.system().model(), report);
}

void say_what_of_constraints(const Model& model, ExponentReport& report) {
  if (model.constraints.empty()) return;
  report.conclusions.push_back(
      fmt::format("all this is about the whole space of the variables, and not about the "
                  "constraints alone, on which there may be fewer exponents and more integrals: {}",
                  fmt::join(names_of(model.constraints), ", ")));
}

}  // namespace casimir::search

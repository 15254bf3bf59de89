#include "tests/adversary/judge_search.hpp"

#include <algorithm>

#include "symbolic/search/search.hpp"
#include "tests/adversary/judge.hpp"
#include "tests/adversary/oracle.hpp"
#include "tests/adversary/parser.hpp"
#include "tests/adversary/ranks.hpp"
#include "tests/adversary/sampler.hpp"

namespace casimir::adversary {
namespace {

Text text_of(const std::string& value) { return {value, {"search", 1, 1}, value}; }

search::Request request_of(const SearchCase& claim) {
  search::Request request;
  request.degree = claim.degree;
  for (const Expr& f : claim.functions) request.functions.push_back(text_of(f.text()));
  for (const OnLevel& level : claim.base.conditionals) {
    for (const Expr& f : level.on) request.on.push_back(text_of(f.text()));
  }
  return request;
}

/// The case with numbers, or other parameters, for some of its parameters.
Case at_values(const Case& base, const Substitution& values) {
  Case result = base;
  System& s = result.system;
  s.hamiltonian = substitute(s.hamiltonian, values);
  for (Expr& e : s.equations) e = substitute(e, values);
  for (auto& [place, entry] : s.entries) entry = substitute(entry, values);
  std::erase_if(s.parameters, [&](const Parameter& p) { return values.contains(p.name); });
  return result;
}

/// The claim that a function is an integral (on the level, where the search is about one).
Case claim_of(const Case& base, const Expr& f) {
  Case claim = base;
  if (claim.kind == Kind::conditional) {
    claim.conditionals.front().expression = f;
    return claim;
  }
  claim.kind = Kind::integral;
  claim.integrals = {{"F", f}};
  claim.name = "F";
  return claim;
}

/// Whether the last function depends on the others at a random point; of one alone, whether it is
/// constant.
Finding depends_at(const Case& free, const std::vector<Expr>& functions, Random& random) {
  Sampler sampler(free, {}, true, random);
  constexpr int kTries = 60;
  for (int k = 0; k < kTries; ++k) {
    const auto point = sampler.draw();
    if (!point) continue;
    try {
      const At at(free, *point);
      std::vector<std::vector<Ball>> slopes;
      for (const Expr& f : functions) slopes.push_back(at.gradient(f));
      const std::size_t all = rank(slopes);
      slopes.pop_back();
      return rank(slopes) == all ? Finding::holds : Finding::fails;
    } catch (const NotReal&) {
    } catch (const Unknown&) {
    }
  }
  return Finding::unclear;
}

/// The same, on every part of the level if the search is about one: it holds on all or fails.
Finding depends(const Case& base, const std::vector<Expr>& functions, Random& random) {
  Case free = base;
  free.kind = Kind::integral;
  free.pieces.clear();
  if (base.pieces.empty()) return depends_at(free, functions, random);
  Finding worst = Finding::holds;
  for (const Substitution& piece : base.pieces) {
    std::vector<Expr> there;
    for (const Expr& f : functions) there.push_back(substitute(f, piece));
    const Finding finding = depends_at(free, there, random);
    if (finding != Finding::holds) worst = finding;
  }
  return worst;
}

std::vector<Expr> functions_in(const search::Report& report, const Case& base) {
  std::vector<Expr> functions;
  for (const auto* list : {&report.found, &report.casimirs}) {
    for (const search::Found& f : *list) functions.push_back(parse(f.text));
  }
  if (report.hamiltonian) functions.push_back(base.system.hamiltonian);
  return functions;
}

/// What is wrong with what was found; empty if nothing is.
std::string wrong_finding(const Case& base, const std::vector<search::Found>& found,
                          Random& random) {
  for (const search::Found& f : found) {
    if (f.verdict == Verdict::refuted) return "its own finding is refuted: " + f.text;
    if (f.verdict != Verdict::proved) continue;
    const Expr function = parse(f.text);
    if (examine(claim_of(base, function), random) == Finding::fails)
      return "no integral, though said to be proved: " + f.text;
    if (depends(base, {function}, random) == Finding::holds)
      return "a constant, or zero on the level: " + f.text;
  }
  return {};
}

Outcome judge_plain(const SearchCase& claim, const Model& model, Random& random,
                    std::string& what) {
  const search::Report report = search::find_integrals(model, request_of(claim));
  what = wrong_finding(claim.base, report.found, random);
  if (!what.empty()) return Outcome::false_proof;
  if (!report.complete) return Outcome::undecided;
  for (const Special& s : claim.specials) {
    std::vector<Expr> functions = functions_in(report, claim.base);
    functions.push_back(s.function);
    if (depends(claim.base, functions, random) != Finding::fails) continue;
    what = "said to be complete, without " + s.function.text();
    return Outcome::false_proof;
  }
  return Outcome::proved;
}

/// Whether a condition that was found holds at the special values, the other parameters being
/// generic.
bool covers(const search::Condition& condition, const SearchCase& claim, const Special& special,
            Random& random) {
  Case numbers = claim.base;
  numbers.pieces.clear();
  numbers.kind = Kind::integral;
  Point point;
  for (auto drawn = Sampler(numbers, {}, true, random).draw(); drawn; drawn.reset()) point = *drawn;
  const Point generic = point;
  for (const auto& [name, e] : special.values) point[name] = value(e, generic);
  if (!condition.relation.empty() && !value(parse(condition.relation), point).is_tiny())
    return false;
  return std::all_of(condition.parameters.begin(), condition.parameters.end(), [&](const auto& p) {
    return (value(parse(p.second), point) - point.at(p.first)).is_tiny();
  });
}

Substitution values_of(const search::Condition& condition) {
  Substitution values;
  for (const auto& [name, text] : condition.parameters) values.emplace(name, parse(text));
  return values;
}

Outcome judge_free(const SearchCase& claim, const Model& model, Random& random, std::string& what) {
  std::vector<Text> free;
  for (const std::string& name : claim.free) free.push_back(text_of(name));
  const search::ConditionReport report = search::find_conditions(model, request_of(claim), free);
  for (const search::Condition& c : report.conditions) {
    if (c.parameters.empty()) continue;
    what = wrong_finding(at_values(claim.base, values_of(c)), c.found, random);
    if (!what.empty()) return Outcome::false_proof;
  }
  if (!report.complete) return Outcome::undecided;
  for (const Special& s : claim.specials) {
    if (std::any_of(report.conditions.begin(), report.conditions.end(),
                    [&](const auto& c) { return covers(c, claim, s, random); }))
      continue;
    what = "said to be complete, without";
    for (const auto& [name, e] : s.values) what += " " + name + " = " + e.text();
    return Outcome::false_proof;
  }
  return Outcome::proved;
}

/// What the construction says is there has to be there.
bool is_confirmed(const SearchCase& claim, Random& random) {
  return std::all_of(claim.specials.begin(), claim.specials.end(), [&](const Special& s) {
    return examine(claim_of(at_values(claim.base, s.values), substitute(s.function, s.values)),
                   random) == Finding::holds;
  });
}

}  // namespace

Outcome judge_search(const SearchCase& claim, Random& random, std::string& what) {
  if (!is_confirmed(claim, random)) return Outcome::unconfirmed;
  Case plain = claim.base;
  plain.conditionals.clear();
  const Model model = build_model(parse_case(plain.text(), "claim.toml", limits_of_a_claim()));
  return claim.is_free() ? judge_free(claim, model, random, what)
                         : judge_plain(claim, model, random, what);
}

}  // namespace casimir::adversary

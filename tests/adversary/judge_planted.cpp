#include "tests/adversary/judge_planted.hpp"

#include <algorithm>

#include "symbolic/search/darboux.hpp"
#include "symbolic/search/exponents.hpp"
#include "tests/adversary/judge.hpp"
#include "tests/adversary/judge_certificate.hpp"
#include "tests/adversary/parser.hpp"
#include "tests/adversary/ranks.hpp"
#include "tests/adversary/sampler.hpp"

namespace casimir::adversary {
namespace {

using search::Balance;
using search::Exponent;

std::vector<Point> points_of(const Case& base, std::size_t count, Random& random) {
  Sampler sampler(base, {}, true, random);
  std::vector<Point> points;
  for (std::size_t tries = 0; tries < 100 * count && points.size() < count; ++tries)
    if (auto point = sampler.draw()) points.push_back(std::move(*point));
  if (points.size() < count) throw Unknown();
  return points;
}

bool is_plain(const Balance& balance) {
  return balance.relations.empty() && balance.free.empty() &&
         std::all_of(balance.exponents.begin(), balance.exponents.end(), [](const Exponent& e) {
           return !e.is_root && e.solutions == 1 && e.kind != Exponent::Kind::numeric;
         });
}

/// What is wrong with a balance and its exponents where the parameters have these values.
std::string wrong_balance(const PlantedCase& claim, const Balance& balance,
                          const std::vector<Ball>& weights, Point point) {
  for (const auto& [name, text] : balance.coefficients) point[name] = value(parse(text), point);
  const At at(claim.base, point);
  const std::vector<Ball> field = at.field();
  std::vector<std::vector<Ball>> slopes;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const std::string& name = claim.base.system.variables[i];
    if (!(field[i] + weights[i] * point.at(name)).is_tiny())
      return "no balance: the rate of " + name;
    slopes.push_back(at.gradient(claim.base.system.equations[i]));
    slopes.back().resize(field.size());
  }
  unsigned long count = 0;
  for (const Exponent& e : balance.exponents) {
    count += e.multiplicity;
    std::vector<std::vector<Ball>> shifted = slopes;
    for (std::size_t i = 0; i < field.size(); ++i)
      shifted[i][i] = shifted[i][i] + weights[i] - value(parse(e.text), point);
    if (rank(shifted) == field.size()) return "no exponent: " + e.text;
  }
  return count == field.size() ? "" : "a wrong number of exponents";
}

/// Whether the exponents are these, each as often.
bool agrees(const std::vector<Exponent>& found, const std::vector<Expr>& wanted,
            const Point& point) {
  std::vector<Ball> left;
  for (const Expr& e : wanted) left.push_back(value(e, point));
  for (const Exponent& e : found) {
    const Ball own = value(parse(e.text), point);
    for (unsigned long k = 0; k < e.multiplicity; ++k) {
      const auto same = std::find_if(left.begin(), left.end(),
                                     [&](const Ball& b) { return (b - own).is_tiny(); });
      if (same == left.end()) return false;
      left.erase(same);
    }
  }
  return left.empty();
}

/// Coefficients with relations or free ones are not looked at; those of such a balance are.
bool has_simple_exponents(const Balance& balance) {
  return std::all_of(balance.exponents.begin(), balance.exponents.end(), [](const Exponent& e) {
    return !e.is_root && e.solutions == 1 && e.kind != Exponent::Kind::numeric;
  });
}

bool are_integers(const PlantedCase& claim) {
  return !claim.exponents.empty() && claim.base.system.parameters.empty() &&
         std::all_of(claim.exponents.begin(), claim.exponents.end(), [](const auto& list) {
           return std::all_of(list.begin(), list.end(), [](const Expr& e) {
             return e.is_number() && e.node().denominator == 1;
           });
         });
}

Outcome judge_exponents(const PlantedCase& claim, const Model& model, Random& random,
                        std::string& what) {
  const search::ExponentReport report = search::kovalevskaya_exponents(model, {});
  const Point point = points_of(claim.base, 1, random).front();
  std::vector<Ball> weights;
  for (const auto& [name, text] : report.weights) weights.push_back(value(parse(text), {}));
  for (const Balance& balance : report.balances) {
    if (is_plain(balance)) what = wrong_balance(claim, balance, weights, point);
    if (!what.empty()) return Outcome::false_proof;
    if (claim.exponents.empty() || !has_simple_exponents(balance)) continue;
    if (std::none_of(claim.exponents.begin(), claim.exponents.end(),
                     [&](const auto& e) { return agrees(balance.exponents, e, point); })) {
      what = "a balance with other exponents than there are";
      return Outcome::false_proof;
    }
  }
  for (const std::string& conclusion : report.conclusions) {
    if (are_integers(claim) && conclusion.find("not single-valued") != std::string::npos) {
      what = "the exponents are integers, but: " + conclusion;
      return Outcome::false_proof;
    }
  }
  what = report.reason;
  if (!report.complete) return Outcome::undecided;
  for (const auto& wanted : claim.exponents) {
    if (std::any_of(report.balances.begin(), report.balances.end(), [&](const Balance& b) {
          return !has_simple_exponents(b) || agrees(b.exponents, wanted, point);
        }))
      continue;
    what = "said to be complete, without a balance that there is";
    return Outcome::false_proof;
  }
  return Outcome::proved;
}

/// f is a multiple of g by a number: their quotient is the same at two points with the same
/// parameters.
bool is_multiple(const Case& base, const Expr& f, const Expr& g, const Point& first, Point second) {
  for (const Parameter& p : base.system.parameters) second[p.name] = first.at(p.name);
  return (value(f, first) * value(g, second) - value(f, second) * value(g, first)).is_tiny();
}

Outcome judge_darboux(const PlantedCase& claim, const Model& model, Random& random,
                      std::string& what) {
  const search::DarbouxReport report = search::find_darboux(model, claim.degree);
  const std::vector<Point> points = points_of(claim.base, 4, random);
  for (const search::DarbouxPolynomial& found : report.found) {
    const Expr f = parse(found.text), cofactor = parse(found.cofactor);
    bool constant = true, zero = true;
    for (const Point& point : points) {
      const At at(claim.base, point);
      if (!(at.rate(f) - at.value(cofactor) * at.value(f)).is_tiny()) {
        what = "no Darboux polynomial: " + found.text;
        return Outcome::false_proof;
      }
      zero = zero && at.value(cofactor).is_tiny();
      for (const Ball& slope : at.gradient(f)) constant = constant && slope.is_tiny();
    }
    if (!constant && !zero && found.verdict != Verdict::refuted) continue;
    what = "an integral or a constant, or refuted by itself: " + found.text;
    return Outcome::false_proof;
  }
  what = report.reason;
  if (!report.complete) return Outcome::undecided;
  for (const Expr& wanted : claim.darboux) {
    if (std::any_of(report.found.begin(), report.found.end(), [&](const auto& found) {
          return is_multiple(claim.base, parse(found.text), wanted, points[0], points[1]);
        }))
      continue;
    what = "said to be complete, without " + wanted.text();
    return Outcome::false_proof;
  }
  return Outcome::proved;
}

}  // namespace

Outcome judge_planted(const PlantedCase& claim, Random& random, std::string& what) {
  const Model model = build_model(parse_case(claim.base.text(), "claim.toml", limits_of_a_claim()));
  switch (claim.base.kind) {
    case Kind::exponents:
      return judge_exponents(claim, model, random, what);
    case Kind::darboux:
      return judge_darboux(claim, model, random, what);
    default:
      return judge_certificate(claim.base, model, random, what);
  }
}

}  // namespace casimir::adversary

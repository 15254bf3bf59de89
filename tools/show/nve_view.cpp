// Curves of motion and their normal variational equations.
#include "tools/show/nve_view.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/show/notation.hpp"
#include "tools/text/text_layout.hpp"
#include "tools/typeset/latex.hpp"

namespace casimir::tools {
namespace {

using typeset::Kind;
using typeset::Math;

/// The unknown with so many primes.
Written primed(const std::string& unknown, int primes) {
  Written result{unknown + std::string(static_cast<std::size_t>(primes), '\''),
                 typeset::letter(unknown)};
  for (int i = 0; i < primes; ++i) result.math = {Kind::primed, {}, {result.math}};
  return result;
}

/// factor * unknown.
Written times(const Written& factor, const Written& unknown) {
  const bool compound = factor.math.kind == Kind::sum;
  return {
      fmt::format("({})*{}", factor.text, unknown.text),
      typeset::product({compound ? typeset::in_brackets(factor.math) : factor.math, unknown.math})};
}

Formula equation(Notation& notation, const obstruction::CurveExpressions& e) {
  Written left = primed(e.unknown, 2);
  Math sum{Kind::sum, {}, {}};
  typeset::add_term(sum, left.math);
  const auto add = [&](const GiNaC::ex& coefficient, int primes) {
    if (coefficient.is_zero()) return;
    const Written term = times(notation.components(coefficient), primed(e.unknown, primes));
    left.text += " + " + term.text;
    typeset::add_term(sum, term.math);
  };
  add(e.p, 1);
  add(e.q, 0);
  left.math = sum.parts.size() == 1 ? sum.parts.front() : sum;
  return {left, {"0", typeset::number("0")}};
}

NveView view_of(Notation& notation, const obstruction::Examined& examined) {
  NveView result{examined.along, examined.level, {}, {}, examined.outcome};
  if (!examined.expressions) {
    result.nve = examined.nve;
    return result;
  }
  const obstruction::CurveExpressions& e = *examined.expressions;
  for (const auto& [left, right] : e.curve)
    result.formulas.push_back({notation.components(left), notation.components(right)});
  result.formulas.push_back(equation(notation, e));
  result.formulas.push_back(
      {primed(e.unknown, 2), times(notation.components(e.reduced), primed(e.unknown, 0))});
  return result;
}

}  // namespace

std::vector<NveView> nve_views(const Model& model, const obstruction::Obstruction& answer) {
  Notation notation(model);
  std::vector<NveView> result;
  for (const obstruction::Examined& examined : answer.examined)
    result.push_back(view_of(notation, examined));
  return result;
}

nlohmann::ordered_json nve_json(const Model& model, const obstruction::Obstruction& answer) {
  nlohmann::ordered_json json{{"case", model.name}};
  json["nve"] = nlohmann::ordered_json::array();
  for (const NveView& view : nve_views(model, answer)) {
    nlohmann::ordered_json own{{"along", view.along}, {"level", view.level}};
    own["formulas"] = nlohmann::ordered_json::array();
    for (const Formula& f : view.formulas)
      own["formulas"].push_back({{"text", f.left.text + " = " + f.right.text},
                                 {"latex", latex(f.left.math) + " = " + latex(f.right.math)}});
    if (!view.nve.empty()) own["nve"] = view.nve;
    own["group"] = view.outcome;
    json["nve"].push_back(std::move(own));
  }
  json["left_out"] = answer.left_out;
  if (!answer.reason.empty()) json["reason"] = answer.reason;
  return json;
}

void nve_text(const Model& model, const obstruction::Obstruction& answer) {
  const std::vector<NveView> views = nve_views(model, answer);
  if (views.empty()) fmt::print("{}: {}\n", model.name, answer.reason);
  for (const NveView& view : views) {
    fmt::print("along {}\n  level  {}\n", view.along, view.level);
    for (const Formula& f : view.formulas) fmt::print("  {} = {}\n", f.left.text, f.right.text);
    if (!view.nve.empty()) fmt::print("  {}\n", view.nve);
    fmt::print("  group  {}\n", view.outcome);
  }
}

void nve_latex(const Model& model, const obstruction::Obstruction& answer) {
  for (const NveView& view : nve_views(model, answer)) {
    if (view.formulas.empty()) continue;
    fmt::print("\\begin{{align*}}\n");
    for (std::size_t i = 0; i < view.formulas.size(); ++i)
      fmt::print("{} &= {}{}\n", typeset::latex(view.formulas[i].left.math),
                 typeset::latex(view.formulas[i].right.math),
                 i + 1 < view.formulas.size() ? " \\\\" : "");
    fmt::print("\\end{{align*}}\n");
  }
}

}  // namespace casimir::tools

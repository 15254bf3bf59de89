#include "tools/show/system_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/expression/expression_size.hpp"
#include "symbolic/prove.hpp"
#include "tools/text/proofs/claim_words.hpp"

namespace casimir::tools {
namespace {

using GiNaC::ex;
using typeset::Math;

/// A polynomial in the parameters with their common powers taken out: a1*s*(a2 - a3).
ex without_common_powers(const ex& sum, const std::vector<GiNaC::symbol>& parameters) {
  ex common = 1;
  for (const GiNaC::symbol& p : parameters) {
    if (!sum.is_polynomial(p)) return sum;
    common *= GiNaC::pow(p, sum.ldegree(p));
  }
  return common * (sum / common).expand();
}

/// A polynomial as a sum over the monomials in the variables, each once; none for other functions.
std::optional<ex> grouped(const ex& expanded, const Model& model) {
  for (const GiNaC::symbol& x : model.variables) {
    if (!expanded.is_polynomial(x)) return std::nullopt;
  }
  GiNaC::exmap coefficients;
  const ex terms = GiNaC::is_a<GiNaC::add>(expanded) ? expanded : GiNaC::lst{expanded};
  for (const ex& term : terms) {
    ex monomial = 1;
    for (const GiNaC::symbol& x : model.variables) monomial *= GiNaC::pow(x, term.degree(x));
    coefficients[monomial] += term / monomial;
  }
  ex sum = 0;
  for (const auto& [monomial, coefficient] : coefficients)
    sum += without_common_powers(coefficient, model.parameters) * monomial;
  return sum;
}

Written bracket(const Written& a, const Written& b, const char* text_gap = "") {
  return {"{" + a.text + "," + text_gap + b.text + "}",
          {typeset::Kind::poisson, {}, {typeset::list({a.math, b.math})}}};
}

Written tuple(const std::vector<Written>& entries) {
  std::string text;
  for (const std::string& entry : texts(entries)) text += (text.empty() ? "" : ", ") + entry;
  return {"(" + text + ")", typeset::in_brackets(typeset::list(maths(entries)))};
}

Written next_of(const Written& letter) {
  return {letter.text + "'", {typeset::Kind::primed, {}, {letter.math}}};
}

/// The letter with a dot, or d(letter)/dt.
Written rate(const Written& letter) {
  return {"d" + letter.text + "/dt", typeset::rate(letter.math)};
}

/// Names of claims are words; those that are no identifiers are set as text.
Written claim_name(const std::string& name) {
  const auto of_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  const bool word = !name.empty() && std::ranges::all_of(name, of_word);
  return {name, word ? typeset::name(name) : typeset::prose(name)};
}

/// Writes the parts of the view.
class Writer {
 public:
  Writer(const Model& model, Notation& notation) : model_(model), notation_(notation) {}

  void add_bracket(SystemView& view) const;
  void add_vector_brackets(SystemView& view) const;
  void add_motion(SystemView& view) const;
  void add_vector_motion(SystemView& view) const;
  void add_claims(SystemView& view) const;
  void add_lax_pairs(SystemView& view) const;

 private:
  const Block& block(std::size_t i) const { return notation_.vectors()->blocks[i]; }
  Written shown(std::size_t i) const { return notation_.block(block(i)); }
  /// {A_i, B_j} or {A_i, t} or {t, u}.
  Written index_bracket(const BlockBracket& b) const;
  Written index_value(const BlockBracket& b) const;
  Phrase gradient(std::size_t i) const;
  Phrase flow_phrase(std::size_t target, const FlowTerm& term) const;
  bool has_gradient(std::size_t i) const;
  ex readable(const ex& field) const;
  std::vector<Written> expressions(const std::vector<NamedExpression>& list) const;
  Formula named(const NamedExpression& f) const {
    return {claim_name(f.name), notation_.expression(f.value)};
  }
  WrittenMatrix matrix(const GiNaC::matrix& m) const;

  const Model& model_;
  Notation& notation_;
};

void Writer::add_bracket(SystemView& view) const {
  const std::size_t n = model_.variables.size();
  for (std::size_t i = 0; i < n; ++i) {
    auto& row = view.structure_matrix.emplace_back();
    for (std::size_t j = 0; j < n; ++j) {
      const ex value = (*model_.poisson)(i, j);
      row.push_back(notation_.components(value));
      if (j > i && !value.is_zero())
        view.brackets.push_back({bracket(view.variables[i], view.variables[j]), row.back()});
    }
  }
}

Written Writer::index_bracket(const BlockBracket& b) const {
  const auto entry = [&](std::size_t i, const char* index) {
    return block(i).is_vector() ? notation_.component(block(i), index) : shown(i);
  };
  return bracket(entry(b.a, "i"), entry(b.b, block(b.a).is_vector() ? "j" : "i"), " ");
}

Written Writer::index_value(const BlockBracket& b) const {
  const bool vectors = block(b.a).is_vector() && block(b.b).is_vector();
  if (!block(b.a).is_vector()) return notation_.expression(b.s);
  std::vector<std::pair<ex, Phrase>> terms;
  for (const BlockTerm& term : b.v) {
    Written entry = notation_.component(block(term.block), vectors ? "k" : "i");
    if (vectors) {
      const Math epsilon =
          typeset::with_index(typeset::symbol("varepsilon"), typeset::letter("ijk"));
      entry = {"eps_ijk " + entry.text, typeset::product({epsilon, entry.math})};
    }
    terms.push_back({term.coefficient, {entry}});
  }
  if (!b.s.is_zero()) {
    const Math delta = typeset::with_index(typeset::letter("delta"), typeset::letter("ij"));
    terms.push_back({b.s, {{"delta_ij", delta}}});
  }
  return notation_.combination(terms);
}

void Writer::add_vector_brackets(SystemView& view) const {
  if (!notation_.vectors()) return;
  for (const BlockBracket& b : notation_.vectors()->brackets) {
    (b.is_zero() ? view.zero_brackets : view.vector_brackets)
        .push_back({index_bracket(b), index_value(b)});
  }
}

/// The right side of an equation as it is best read: a polynomial by its monomials, any other
/// function in the shorter of two forms.
ex Writer::readable(const ex& field) const {
  if (most_terms(field) > kMostTermsShown) return field;
  const ex expanded = field.expand();
  if (const auto polynomial = grouped(expanded, model_)) return *polynomial;
  const auto length = [&](const ex& e) { return notation_.case_text(e).size(); };
  return length(field) < length(expanded) ? field : expanded;
}

void Writer::add_motion(SystemView& view) const {
  if (model_.hamiltonian) view.hamiltonian = notation_.expression(*model_.hamiltonian);
  for (std::size_t i = 0; i < model_.field.size(); ++i) {
    view.equations.push_back(
        {rate(view.variables[i]), notation_.components(readable(model_.field[i]))});
  }
}

Phrase Writer::gradient(std::size_t i) const {
  const Written x = shown(i);
  const Math partial = typeset::symbol("partial");
  return {{"dH/d" + x.text, typeset::fraction(typeset::product({partial, typeset::letter("H")}),
                                              typeset::product({partial, x.math}))},
          true};
}

bool Writer::has_gradient(std::size_t i) const {
  return std::ranges::any_of(block(i).coordinates, [&](std::size_t c) {
    return !model_.hamiltonian->diff(model_.variables[c]).is_zero();
  });
}

Phrase Writer::flow_phrase(std::size_t target, const FlowTerm& term) const {
  const Phrase slope = gradient(term.gradient);
  if (!term.left) return slope;
  const Written left = shown(*term.left);
  const Written& right = slope.written;
  if (!block(target).is_vector()) {
    return {{"(" + left.text + ", " + right.text + ")",
             typeset::in_brackets(typeset::list({left.math, right.math}))}};
  }
  if (!block(term.gradient).is_vector())
    return {{"(" + right.text + ") " + left.text, typeset::product({right.math, left.math})}, true};
  return {{left.text + " x " + right.text, {typeset::Kind::cross, {}, {left.math, right.math}}},
          true};
}

void Writer::add_vector_motion(SystemView& view) const {
  if (!notation_.vectors()) return;
  const VectorForm& form = *notation_.vectors();
  std::vector<bool> occurs(form.blocks.size());
  for (std::size_t target = 0; target < form.blocks.size(); ++target) {
    std::vector<std::pair<ex, Phrase>> terms;
    for (const FlowTerm& term : form.flows[target]) {
      if (!has_gradient(term.gradient)) continue;
      occurs[term.gradient] = true;
      terms.emplace_back(term.coefficient, flow_phrase(target, term));
    }
    view.vector_equations.push_back({rate(shown(target)), notation_.combination(terms)});
  }
  for (std::size_t i = 0; i < form.blocks.size(); ++i) {
    if (!occurs[i]) continue;
    std::vector<Written> entries;
    for (const std::size_t c : form.blocks[i].coordinates)
      entries.push_back(notation_.expression(model_.hamiltonian->diff(model_.variables[c])));
    view.gradients.push_back(
        {gradient(i).written, form.blocks[i].is_vector() ? tuple(entries) : entries.front()});
  }
}

std::vector<Written> Writer::expressions(const std::vector<NamedExpression>& list) const {
  std::vector<Written> result;
  for (const NamedExpression& f : list) result.push_back(notation_.expression(f.value));
  return result;
}

void Writer::add_claims(SystemView& view) const {
  const auto add = [&](ClaimKind kind, const auto& list, const auto& formula) {
    if (list.empty()) return;
    view.claims.push_back({claim_words(kind).heading, {}});
    for (const auto& claim : list) view.claims.back().formulas.push_back(formula(claim));
  };
  const auto function = [&](const NamedExpression& f) { return named(f); };
  const auto level = [&](const LevelClaim& claim) {
    Formula formula = named(claim.expression);
    formula.on = expressions(claim.on);
    return formula;
  };
  if (!model_.constraints.empty()) view.claims.push_back({"constraints", {}});
  for (const NamedExpression& c : model_.constraints)
    view.claims.back().formulas.push_back(
        {notation_.expression(c.value), {"0", typeset::number("0")}});
  add(ClaimKind::casimir, model_.casimirs, function);
  add(ClaimKind::integral, model_.integrals, function);
  add(ClaimKind::conditional, model_.conditionals, level);
  add(ClaimKind::invariant_relation, model_.invariant_relations, level);
  add(ClaimKind::measure, model_.measures, [&](const Measure& measure) {
    return Formula{{"rho", typeset::letter("rho")}, notation_.expression(measure.density.value)};
  });
  add(ClaimKind::identity, model_.identities, [&](const Identity& identity) {
    return Formula{notation_.expression(identity.left), notation_.expression(identity.right),
                   expressions(identity.on)};
  });
  for (const PoissonMap& map : model_.maps) {
    view.claims.push_back({(map.sign < 0 ? "anti-Poisson map " : "Poisson map ") + map.name, {}});
    const auto& y = map.target.coordinates();
    for (std::size_t i = 0; i < y.size(); ++i) {
      view.claims.back().formulas.push_back(
          {notation_.name(y[i]), notation_.expression(map.expressions[i]), expressions(map.on)});
    }
  }
}

WrittenMatrix Writer::matrix(const GiNaC::matrix& m) const {
  WrittenMatrix result(m.rows());
  for (unsigned i = 0; i < m.rows(); ++i) {
    for (unsigned j = 0; j < m.cols(); ++j) result[i].push_back(notation_.components(m(i, j)));
  }
  return result;
}

void Writer::add_lax_pairs(SystemView& view) const {
  for (const LaxPair& pair : model_.lax_pairs) {
    LaxView& shown = view.lax_pairs.emplace_back();
    if (pair.spectral) shown.spectral = notation_.name(*pair.spectral);
    shown.l = matrix(pair.l);
    shown.a = matrix(pair.a);
    shown.on = expressions(pair.on);
  }
}

}  // namespace

SystemView view_of(const Model& model, Notation& notation) {
  SystemView view;
  const Writer writer(model, notation);
  for (const GiNaC::symbol& x : model.variables) view.variables.push_back(notation.name(x));
  if (model.poisson) writer.add_bracket(view);
  writer.add_vector_brackets(view);
  writer.add_motion(view);
  writer.add_vector_motion(view);
  writer.add_claims(view);
  writer.add_lax_pairs(view);
  view.vectors = notation.vector_entries();  // last: now it is known which occur
  return view;
}

SystemView view_of(const MapModel& map, Notation& notation) {
  SystemView view = view_of(map.base, notation);
  for (std::size_t i = 0; i < map.next.size(); ++i)
    view.map.push_back({next_of(view.variables[i]), notation.components(map.next[i])});
  for (const MapSymmetry& symmetry : map.symmetries) {
    FormulaGroup& group = view.claims.emplace_back();
    group.title = (symmetry.reverses ? "reversal " : "symmetry ") + symmetry.name;
    const auto add = [&](const std::vector<GiNaC::symbol>& names, const std::vector<ex>& values) {
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (!values[i].is_equal(names[i]))
          group.formulas.push_back({notation.name(names[i]), notation.components(values[i])});
      }
    };
    add(map.base.variables, symmetry.variables);
    add(map.base.parameters, symmetry.parameters);
  }
  for (const MapConjugacy& conjugacy : map.conjugacies) {
    FormulaGroup& group = view.claims.emplace_back();
    group.title =
        (conjugacy.reverses ? "conjugacy to an inverse, " : "conjugacy ") + conjugacy.name;
    for (std::size_t i = 0; i < conjugacy.coordinates.size(); ++i)
      group.formulas.push_back(
          {notation.name(conjugacy.coordinates[i]), notation.components(conjugacy.expressions[i])});
  }
  return view;
}

std::vector<std::string> texts(const std::vector<Written>& list) {
  std::vector<std::string> result;
  for (const Written& one : list) result.push_back(one.text);
  return result;
}

std::vector<Math> maths(const std::vector<Written>& list) {
  std::vector<Math> result;
  for (const Written& one : list) result.push_back(one.math);
  return result;
}

std::vector<std::vector<std::string>> texts(const WrittenMatrix& matrix) {
  std::vector<std::vector<std::string>> result;
  for (const std::vector<Written>& row : matrix) result.push_back(texts(row));
  return result;
}

typeset::MathMatrix maths(const WrittenMatrix& matrix) {
  typeset::MathMatrix result;
  for (const std::vector<Written>& row : matrix) result.push_back(maths(row));
  return result;
}

std::optional<RankView> rank_of(const Model& model) {
  if (!model.poisson) return std::nullopt;
  Candidates only;
  only.only = ClaimKind::rank;
  for (const Proof& proof : prove(model, only)) {
    RankView rank{proof.name, proof.evidence.empty() ? proof.reason : proof.evidence, {}};
    if (proof.verdict == Verdict::proved) rank.rank = proof.rank;
    return rank;
  }
  return std::nullopt;
}

}  // namespace casimir::tools

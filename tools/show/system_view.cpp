#include "tools/show/system_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/case/expression_size.hpp"
#include "symbolic/prove.hpp"

namespace casimir::tools {
namespace {

using GiNaC::ex;

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

/// Writes the parts of the view in one markup.
class Writer {
 public:
  Writer(const Model& model, Notation& notation, Markup markup)
      : model_(model), notation_(notation), markup_(markup) {}

  void add_bracket(SystemView& view) const;
  void add_vector_brackets(SystemView& view) const;
  void add_motion(SystemView& view) const;
  void add_vector_motion(SystemView& view) const;
  void add_claims(SystemView& view) const;
  void add_lax_pairs(SystemView& view) const;

 private:
  bool latex() const { return markup_ == Markup::latex; }
  const Block& block(std::size_t i) const { return notation_.vectors()->blocks[i]; }
  std::string shown(const Block& b) const { return notation_.block(b, markup_); }
  std::string bracket(const std::string& a, const std::string& b, const char* text_gap = "") const {
    return latex() ? "\\{" + a + ", " + b + "\\}" : "{" + a + "," + text_gap + b + "}";
  }
  /// {A_i, B_j} or {A_i, t} or {t, u}.
  std::string index_bracket(const BlockBracket& b) const;
  std::string index_value(const BlockBracket& b) const;
  /// The letter with a dot, or d(letter)/dt.
  std::string rate(const std::string& letter) const;
  Phrase gradient(std::size_t i) const;
  Phrase flow_phrase(std::size_t target, const FlowTerm& term) const;
  bool has_gradient(std::size_t i) const;
  ex readable(const ex& field) const;
  std::string claim_name(const std::string& name) const;
  std::vector<std::string> expressions(const std::vector<NamedExpression>& list) const;
  Formula named(const NamedExpression& f) const {
    return {claim_name(f.name), notation_.expression(f.value, markup_)};
  }
  StringMatrix matrix(const GiNaC::matrix& m) const;

  const Model& model_;
  Notation& notation_;
  Markup markup_;
};

void Writer::add_bracket(SystemView& view) const {
  const std::size_t n = model_.variables.size();
  for (std::size_t i = 0; i < n; ++i) {
    auto& row = view.structure_matrix.emplace_back();
    for (std::size_t j = 0; j < n; ++j) {
      const ex value = (*model_.poisson)(i, j);
      row.push_back(notation_.components(value, markup_));
      if (j > i && !value.is_zero())
        view.brackets.push_back({bracket(view.variables[i], view.variables[j]), row.back()});
    }
  }
}

std::string Writer::index_bracket(const BlockBracket& b) const {
  const auto entry = [&](std::size_t i, const char* index) {
    return block(i).is_vector() ? notation_.component(block(i), index, markup_) : shown(block(i));
  };
  return bracket(entry(b.a, "i"), entry(b.b, block(b.a).is_vector() ? "j" : "i"), " ");
}

std::string Writer::index_value(const BlockBracket& b) const {
  const bool vectors = block(b.a).is_vector() && block(b.b).is_vector();
  if (!block(b.a).is_vector()) return notation_.expression(b.s, markup_);
  std::vector<std::pair<ex, Phrase>> terms;
  const auto component = [&](std::size_t i, const char* index) {
    return Phrase{notation_.component(block(i), index, Markup::text),
                  notation_.component(block(i), index, Markup::latex)};
  };
  for (const BlockTerm& term : b.v) {
    const Phrase entry = component(term.block, vectors ? "k" : "i");
    terms.emplace_back(
        term.coefficient,
        vectors ? Phrase{"eps_ijk " + entry.text, "\\varepsilon_{ijk} " + entry.latex} : entry);
  }
  if (!b.s.is_zero()) terms.emplace_back(b.s, Phrase{"delta_ij", "\\delta_{ij}"});
  return notation_.combination(terms, markup_);
}

void Writer::add_vector_brackets(SystemView& view) const {
  if (!notation_.vectors()) return;
  for (const BlockBracket& b : notation_.vectors()->brackets) {
    (b.is_zero() ? view.zero_brackets : view.vector_brackets)
        .push_back({index_bracket(b), index_value(b)});
  }
}

std::string Writer::rate(const std::string& letter) const {
  if (!latex()) return "d" + letter + "/dt";
  const bool vector = letter.starts_with("\\boldsymbol");
  const std::size_t index = vector ? std::string::npos : letter.find('_');
  return "\\dot{" + letter.substr(0, index) + "}" +
         (index == std::string::npos ? "" : letter.substr(index));
}

/// The right side of an equation as it is best read: a polynomial by its monomials, any other
/// function in the shorter of two forms.
ex Writer::readable(const ex& field) const {
  if (most_terms(field) > kMostTermsShown) return field;
  const ex expanded = field.expand();
  if (const auto polynomial = grouped(expanded, model_)) return *polynomial;
  const auto length = [&](const ex& e) { return notation_.components(e, Markup::text).size(); };
  return length(field) < length(expanded) ? field : expanded;
}

void Writer::add_motion(SystemView& view) const {
  if (model_.hamiltonian) view.hamiltonian = notation_.expression(*model_.hamiltonian, markup_);
  for (std::size_t i = 0; i < model_.field.size(); ++i) {
    view.equations.push_back(
        {rate(view.variables[i]), notation_.components(readable(model_.field[i]), markup_)});
  }
}

Phrase Writer::gradient(std::size_t i) const {
  return {"dH/d" + notation_.block(block(i), Markup::text),
          "\\frac{\\partial H}{\\partial " + notation_.block(block(i), Markup::latex) + "}"};
}

bool Writer::has_gradient(std::size_t i) const {
  return std::ranges::any_of(block(i).coordinates, [&](std::size_t c) {
    return !model_.hamiltonian->diff(model_.variables[c]).is_zero();
  });
}

Phrase Writer::flow_phrase(std::size_t target, const FlowTerm& term) const {
  const Phrase slope = gradient(term.gradient);
  if (!term.left) return slope;
  const std::string text = notation_.block(block(*term.left), Markup::text);
  const std::string latex = notation_.block(block(*term.left), Markup::latex);
  if (!block(target).is_vector()) {
    return {"(" + text + ", " + slope.text + ")",
            "\\left(" + latex + ", " + slope.latex + "\\right)"};
  }
  if (!block(term.gradient).is_vector())
    return {"(" + slope.text + ") " + text, slope.latex + " " + latex};
  return {text + " x " + slope.text, latex + " \\times " + slope.latex};
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
    view.vector_equations.push_back(
        {rate(shown(block(target))), notation_.combination(terms, markup_)});
  }
  for (std::size_t i = 0; i < form.blocks.size(); ++i) {
    if (!occurs[i]) continue;
    std::string entries;
    for (const std::size_t c : form.blocks[i].coordinates) {
      const ex slope = model_.hamiltonian->diff(model_.variables[c]);
      entries += (entries.empty() ? "" : ", ") + notation_.expression(slope, markup_);
    }
    if (form.blocks[i].is_vector())
      entries = latex() ? "\\left(" + entries + "\\right)" : "(" + entries + ")";
    view.gradients.push_back({gradient(i).in(markup_), entries});
  }
}

/// Names of claims are words; in LaTeX those that are no identifiers are set as text.
std::string Writer::claim_name(const std::string& name) const {
  if (!latex()) return name;
  const auto of_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (!name.empty() && std::ranges::all_of(name, of_word)) return codegen::latex_name(name);
  std::string text;
  for (const char c : name) {
    if (std::string("\\{}~^").find(c) != std::string::npos) continue;
    if (std::string("#$%&_").find(c) != std::string::npos) text += '\\';
    text += c;
  }
  return "\\text{" + text + "}";
}

std::vector<std::string> Writer::expressions(const std::vector<NamedExpression>& list) const {
  std::vector<std::string> result;
  for (const NamedExpression& f : list) result.push_back(notation_.expression(f.value, markup_));
  return result;
}

void Writer::add_claims(SystemView& view) const {
  const auto add = [&](const char* title, const auto& list, const auto& formula) {
    if (list.empty()) return;
    view.claims.push_back({title, {}});
    for (const auto& claim : list) view.claims.back().formulas.push_back(formula(claim));
  };
  const auto function = [&](const NamedExpression& f) { return named(f); };
  const auto level = [&](const LevelClaim& claim) {
    Formula formula = named(claim.expression);
    formula.on = expressions(claim.on);
    return formula;
  };
  add("Casimir functions", model_.casimirs, function);
  add("integrals", model_.integrals, function);
  add("integrals on a level", model_.conditionals, level);
  add("invariant relations", model_.invariant_relations, level);
  add("densities of invariant measures", model_.measures, [&](const Measure& measure) {
    const std::string rho = latex() ? "\\rho" : "rho";
    return Formula{rho, notation_.expression(measure.density.value, markup_)};
  });
  add("identities", model_.identities, [&](const Identity& identity) {
    return Formula{notation_.expression(identity.left, markup_),
                   notation_.expression(identity.right, markup_), expressions(identity.on)};
  });
  for (const PoissonMap& map : model_.maps) {
    view.claims.push_back({(map.sign < 0 ? "anti-Poisson map " : "Poisson map ") + map.name, {}});
    const auto& y = map.target.coordinates();
    for (std::size_t i = 0; i < y.size(); ++i) {
      view.claims.back().formulas.push_back({notation_.name(y[i], markup_),
                                             notation_.expression(map.expressions[i], markup_),
                                             expressions(map.on)});
    }
  }
}

StringMatrix Writer::matrix(const GiNaC::matrix& m) const {
  StringMatrix result(m.rows());
  for (unsigned i = 0; i < m.rows(); ++i) {
    for (unsigned j = 0; j < m.cols(); ++j)
      result[i].push_back(notation_.components(m(i, j), markup_));
  }
  return result;
}

void Writer::add_lax_pairs(SystemView& view) const {
  for (const LaxPair& pair : model_.lax_pairs) {
    view.lax_pairs.push_back({pair.spectral ? notation_.name(*pair.spectral, markup_) : "",
                              matrix(pair.l), matrix(pair.a)});
  }
}

}  // namespace

SystemView view_of(const Model& model, Notation& notation, Markup markup) {
  SystemView view;
  const Writer writer(model, notation, markup);
  for (const GiNaC::symbol& x : model.variables) view.variables.push_back(notation.name(x, markup));
  if (model.poisson) writer.add_bracket(view);
  writer.add_vector_brackets(view);
  writer.add_motion(view);
  writer.add_vector_motion(view);
  writer.add_claims(view);
  writer.add_lax_pairs(view);
  view.vectors = notation.vector_entries(markup);  // last: now it is known which occur
  return view;
}

SystemView view_of(const MapModel& map, Notation& notation, Markup markup) {
  SystemView view = view_of(map.base, notation, markup);
  for (std::size_t i = 0; i < map.next.size(); ++i)
    view.map.push_back({view.variables[i] + "'", notation.components(map.next[i], markup)});
  for (const MapSymmetry& symmetry : map.symmetries) {
    FormulaGroup& group = view.claims.emplace_back();
    group.title = (symmetry.reverses ? "reversal " : "symmetry ") + symmetry.name;
    const auto add = [&](const std::vector<GiNaC::symbol>& names, const std::vector<ex>& values) {
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (!values[i].is_equal(names[i]))
          group.formulas.push_back(
              {notation.name(names[i], markup), notation.components(values[i], markup)});
      }
    };
    add(map.base.variables, symmetry.variables);
    add(map.base.parameters, symmetry.parameters);
  }
  return view;
}

std::optional<RankView> rank_of(const Model& model) {
  if (!model.poisson) return std::nullopt;
  Candidates only;
  only.only = ClaimKind::rank;
  for (const Proof& proof : prove(model, only)) {
    RankView rank{proof.name, proof.evidence.empty() ? proof.reason : proof.evidence, {}};
    const std::size_t digits = proof.name.find_last_not_of("0123456789") + 1;
    if (proof.verdict == Verdict::proved && digits > 0 && digits < proof.name.size())
      rank.rank = std::stoi(proof.name.substr(digits));
    return rank;
  }
  return std::nullopt;
}

}  // namespace casimir::tools

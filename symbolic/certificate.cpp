#include "symbolic/certificate.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "symbolic/prover.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Words that Coq keeps for itself, and what the file defines.
bool is_reserved(const std::string& name) {
  static const std::set<std::string> kWords = {
      "as",      "at",     "cofix",      "else",   "end", "exists", "exists2", "fix",
      "for",     "forall", "fun",        "if",     "IF",  "in",     "let",     "match",
      "mod",     "open",   "Prop",       "return", "Set", "SProp",  "then",    "Type",
      "using",   "where",  "with",       "by",     "h",   "Z",      "True",    "False",
      "Theorem", "Lemma",  "Definition", "Proof",  "Qed"};
  return kWords.contains(name);
}

/// A polynomial function of the coordinates, with integer coefficients.
struct Function {
  std::string name;
  Polynomial value;
  cln::cl_I scale;  ///< value = scale * the function of the case
};

cln::cl_I common_denominator(const Polynomial& p) {
  cln::cl_I result = 1;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    result = cln::lcm(result, cln::denominator(coefficient));
  }
  return result;
}

class Writer {
 public:
  Writer(const Model& model, const std::vector<ex>& further) : prover_(model, further) {
    if (!model.poisson) throw ModelError("a certificate needs a bracket");
    for (const GiNaC::symbol& s : prover_.ring().symbols()) {
      const std::string name = s.get_name();
      names_.push_back(is_reserved(name) ? name + "_" : name);
      arguments_ += " " + names_.back();
    }
    text_ = fmt::format(
        "(* Written by casimir for the case {0}. Check it with: coqc FILE.v\n"
        "   Functions of {1}, with integer coefficients: denominators are cleared. For each "
        "function\n"
        "   f and coordinate x a lemma shows that f_d_x is the derivative:\n"
        "     f(x + h) - f(x) = h * f_d_x(x) + h * h * (a polynomial).\n"
        "   The theorems are identities in all variables and parameters. *)\n"
        "Require Import ZArith Ring.\nOpen Scope Z_scope.\n\n",
        model.name, arguments_.substr(1));
  }

  std::string take() && { return std::move(text_); }
  Prover& prover() { return prover_; }

  /// Defines the brackets {x_i, x_j}, i < j, multiplied by one common number.
  void define_brackets() {
    const std::size_t n = prover_.dimension();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        bracket_scale_ = cln::lcm(bracket_scale_, common_denominator(prover_.bracket_entry(i, j)));
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        if (prover_.bracket_entry(i, j).is_zero()) continue;
        define({fmt::format("bracket_{}_{}", names_[i], names_[j]),
                prover_.bracket_entry(i, j).scaled(bracket_scale_), bracket_scale_});
      }
    }
  }

  /// The function as the file has it, with its derivatives.
  Function define(const std::string& name, const ex& value) {
    const Polynomial p = prover_.ring().convert(value);
    const cln::cl_I scale = common_denominator(p);
    const Function f{name, p.scaled(scale), scale};
    define(f);
    return f;
  }

  /// {x_i, {x_j, x_k}} + cyclic = 0.
  void prove_jacobi() {
    const std::size_t n = prover_.dimension();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        for (std::size_t k = j + 1; k < n; ++k) {
          std::string sum;
          const std::size_t cyclic[3][3] = {{i, j, k}, {j, k, i}, {k, i, j}};
          for (const auto& [a, b, c] : cyclic) {
            for (std::size_t l = 0; l < n; ++l) add(sum, bracket(a, l), bracket_slope(b, c, l));
          }
          if (sum.empty()) continue;
          theorem(fmt::format("jacobi_{}_{}_{}", names_[i], names_[j], names_[k]), sum, "0");
        }
      }
    }
  }

  /// {x_i, f} = 0 for every coordinate.
  void prove_casimir(const Function& f) {
    for (std::size_t i = 0; i < prover_.dimension(); ++i) {
      std::string sum;
      for (std::size_t j = 0; j < prover_.dimension(); ++j) add(sum, bracket(i, j), slope(f, j));
      if (!sum.empty()) theorem(fmt::format("casimir_{}_{}", f.name, names_[i]), sum, "0");
    }
  }

  /// {f, H} = sum of cofactor * relation.
  void prove_rate(const std::string& name, const Function& f, const Function& h,
                  const std::vector<Function>& level) {
    std::string sum;
    for (std::size_t i = 0; i < prover_.dimension(); ++i) {
      for (std::size_t j = 0; j < prover_.dimension(); ++j) {
        const std::string first = slope(f, i);
        const std::string second = slope(h, j);
        if (!first.empty() && !second.empty()) add(sum, bracket(i, j), first + " * " + second);
      }
    }
    if (sum.empty()) return;
    const std::string right = cofactors(f, h, level, sum);
    theorem(name, sum, right);
  }

 private:
  std::string number(const cln::cl_I& value) const {
    std::ostringstream stream;
    stream << value;
    return stream.str();
  }

  std::string polynomial(const Polynomial& p) const {
    std::string result;
    for (const auto& [coefficient, exponents] : p.term_list()) {
      std::string factors;
      for (std::size_t i = 0; i < exponents.size(); ++i) {
        for (unsigned long k = 0; k < exponents[i]; ++k) {
          factors += (factors.empty() ? "" : "*") + names_[i];
        }
      }
      const cln::cl_I size = cln::abs(cln::numerator(coefficient));
      const bool minus = cln::minusp(coefficient);
      if (result.empty())
        result = minus ? "- " : "";
      else
        result += minus ? " - " : " + ";
      if (factors.empty())
        result += number(size);
      else
        result += (size == 1 ? "" : number(size) + "*") + factors;
    }
    return result.empty() ? "0" : result;
  }

  std::string call(const std::string& function) const { return "(" + function + arguments_ + ")"; }

  void define(const Function& f) {
    text_ += fmt::format("Definition {} ({} : Z) : Z :=\n  {}.\n", f.name, arguments_.substr(1),
                         polynomial(f.value));
    unfolded_.push_back(f.name);
    for (std::size_t i = 0; i < prover_.dimension(); ++i) {
      if (f.value.uses(i)) define_slope(f, i);
    }
    text_ += "\n";
    defined_.push_back(f);
  }

  void define_slope(const Function& f, std::size_t i) {
    const std::string name = fmt::format("{}_d_{}", f.name, names_[i]);
    text_ += fmt::format("Definition {} ({} : Z) : Z :=\n  {}.\n", name, arguments_.substr(1),
                         polynomial(f.value.derivative(i)));
    unfolded_.push_back(name);
    // Taylor's formula: the rest after the first two terms, divided by h^2.
    std::string rest;
    std::string powers = "1";
    Polynomial term = f.value.derivative(i);
    for (long k = 2; !term.is_zero(); ++k) {
      term = term.derivative(i).scaled(cln::cl_RA(1) / k);
      if (term.is_zero()) break;
      rest += (rest.empty() ? "" : " + ") + fmt::format("{}*({})", powers, polynomial(term));
      powers += "*h";
    }
    std::string moved;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      moved += k == i ? fmt::format(" ({} + h)", names_[k]) : " " + names_[k];
    }
    text_ += fmt::format(
        "Lemma {0}_is_derivative : forall{1} h : Z,\n  {2}{3} - {2}{1} = h * {0}{1} + h * h * "
        "({4}).\n"
        "Proof. intros; unfold {2}, {0}; ring. Qed.\n",
        name, arguments_, f.name, moved, rest.empty() ? "0" : rest);
  }

  /// The bracket of two coordinates, or empty if it is zero.
  std::string bracket(std::size_t i, std::size_t j) const {
    if (i == j || prover_.bracket_entry(i, j).is_zero()) return "";
    if (i > j) return "(- " + bracket(j, i) + ")";
    return call(fmt::format("bracket_{}_{}", names_[i], names_[j]));
  }

  std::string bracket_slope(std::size_t i, std::size_t j, std::size_t l) const {
    if (i == j || !prover_.bracket_entry(i, j).uses(l)) return "";
    if (i > j) return "(- " + bracket_slope(j, i, l) + ")";
    return call(fmt::format("bracket_{}_{}_d_{}", names_[i], names_[j], names_[l]));
  }

  std::string slope(const Function& f, std::size_t i) const {
    return f.value.uses(i) ? call(fmt::format("{}_d_{}", f.name, names_[i])) : "";
  }

  static void add(std::string& sum, const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return;
    sum += fmt::format("{}{} * {}", sum.empty() ? "" : "\n  + ", a, b);
  }

  /// {f, H}, all scaled, as a combination of the level's functions; `left` is the text of {f, H}
  /// and is multiplied by what the denominators of the cofactors ask for.
  std::string cofactors(const Function& f, const Function& h, const std::vector<Function>& level,
                        std::string& left) {
    const Polynomial rate = prover_.bracket(f.value, h.value).scaled(bracket_scale_);
    if (rate.is_zero()) return "0";
    std::vector<Polynomial> relations;
    for (const Function& g : level) relations.push_back(g.value);
    std::vector<Polynomial> quotients;
    if (level.empty() || !rate.remainder(relations, &quotients).is_zero()) {
      throw ModelError(fmt::format("no certificate: {} has no polynomial cofactors", f.name));
    }
    cln::cl_I scale = 1;
    for (const Polynomial& quotient : quotients)
      scale = cln::lcm(scale, common_denominator(quotient));
    if (scale != 1) left = fmt::format("{} * ({})", number(scale), left);
    std::string sum;
    for (std::size_t k = 0; k < level.size(); ++k) {
      if (quotients[k].is_zero()) continue;
      add(sum, "(" + polynomial(quotients[k].scaled(scale)) + ")", call(level[k].name));
    }
    return sum;
  }

  void theorem(const std::string& name, const std::string& left, const std::string& right) {
    std::string unfold;
    const std::string statement = left + right;
    for (const std::string& function : unfolded_) {
      if (statement.find("(" + function + " ") != std::string::npos) {
        unfold += (unfold.empty() ? "" : ", ") + function;
      }
    }
    text_ += fmt::format(
        "Theorem {} : forall{} : Z,\n  {}\n  = {}.\nProof. intros; unfold {}; ring. Qed.\n\n", name,
        arguments_, left, right, unfold);
  }

  Prover prover_;
  std::vector<std::string> names_;
  std::string arguments_;  ///< " M1 M2 .. r"
  cln::cl_I bracket_scale_ = 1;
  std::vector<std::string> unfolded_;
  std::vector<Function> defined_;
  std::string text_;
};

std::vector<NamedExpression> read(const Model& model, const std::vector<Text>& texts,
                                  const std::string& prefix) {
  std::vector<NamedExpression> result;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    result.push_back({fmt::format("{}{}", prefix, i + 1), model.parse(texts[i]), texts[i].where});
  }
  return result;
}

/// What is to be certified, from the file or from the command line.
struct Statements {
  std::vector<NamedExpression> casimirs, integrals;
  std::vector<LevelClaim> conditionals, invariant_relations;
};

Statements statements_of(const Model& model, const Candidates& candidates) {
  if (candidates.empty()) {
    return {model.casimirs, model.integrals, model.conditionals, model.invariant_relations};
  }
  Statements s;
  const std::vector<NamedExpression> on = read(model, candidates.on, "on");
  s.casimirs = read(model, candidates.casimirs, "C");
  for (NamedExpression& f : read(model, candidates.integrals, "F")) {
    if (on.empty())
      s.integrals.push_back(std::move(f));
    else
      s.conditionals.push_back({std::move(f), on});
  }
  for (NamedExpression& f : read(model, candidates.invariant_relations, "R")) {
    s.invariant_relations.push_back({std::move(f), on});
  }
  return s;
}

/// Claims that are proved but have no theorem in the file, as "lax Lax pair".
std::vector<std::string> left_out(const Model& model, const Candidates& candidates) {
  static const std::set<std::string> kCovered = {"skew",     "jacobi",      "casimir",
                                                 "integral", "conditional", "invariant_relation"};
  std::vector<std::string> result;
  for (const Proof& proof : prove(model, candidates)) {
    if (proof.fact || proof.note) continue;
    if (proof.verdict != Verdict::proved) {
      throw ModelError(fmt::format("no certificate: the claim '{}' is {}", proof.name,
                                   to_string(proof.verdict)));
    }
    if (!kCovered.contains(proof.kind)) result.push_back(proof.kind + " " + proof.name);
  }
  return result;
}

}  // namespace

namespace {

/// Text that cannot end the comment it stands in.
std::string comment(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '*' || c == '"' || c == '(' || c == ')'; },
      ' ');
  return printable(text, 200);
}

}  // namespace

Certificate coq_certificate(const Model& model, const Candidates& candidates) {
  Certificate certificate{{}, left_out(model, candidates)};
  const Statements statements = statements_of(model, candidates);
  std::vector<ex> further;
  for (const auto* list : {&statements.casimirs, &statements.integrals}) {
    for (const NamedExpression& f : *list) further.push_back(f.value);
  }
  for (const auto* list : {&statements.conditionals, &statements.invariant_relations}) {
    for (const LevelClaim& claim : *list) {
      further.push_back(claim.expression.value);
      for (const NamedExpression& f : claim.on) further.push_back(f.value);
    }
  }
  Writer writer(model, further);
  if (!writer.prover().ring().is_polynomial() || model.time) {
    throw ModelError("no certificate: it covers polynomials that do not depend on time");
  }
  writer.define_brackets();
  writer.prove_jacobi();
  const Function h = writer.define("hamiltonian", *model.hamiltonian);
  for (const NamedExpression& f : statements.casimirs)
    writer.prove_casimir(writer.define("casimir_" + f.name, f.value));
  for (const NamedExpression& f : statements.integrals) {
    const Function function = writer.define("integral_" + f.name, f.value);
    writer.prove_rate(function.name + "_is_conserved", function, h, {});
  }
  const auto on_levels = [&](const std::vector<LevelClaim>& claims, const std::string& kind,
                             bool own) {
    for (std::size_t c = 0; c < claims.size(); ++c) {
      const std::string name = fmt::format("{}_{}", kind, claims[c].expression.name);
      const Function f = writer.define(name, claims[c].expression.value);
      std::vector<Function> level;
      for (std::size_t k = 0; k < claims[c].on.size(); ++k) {
        level.push_back(
            writer.define(fmt::format("{}_level_{}", name, k + 1), claims[c].on[k].value));
      }
      if (own) level.push_back(f);
      writer.prove_rate(name + "_on_its_level", f, h, level);
      for (const Function& g : level) {
        if (g.name != f.name) writer.prove_rate(g.name + "_is_invariant", g, h, level);
      }
    }
  };
  on_levels(statements.conditionals, "conditional", false);
  on_levels(statements.invariant_relations, "relation", true);
  certificate.text = std::move(writer).take();
  for (const std::string& claim : certificate.left_out)
    certificate.text += "(* Proved, but not certified here: " + comment(claim) + " *)\n";
  return certificate;
}

}  // namespace casimir

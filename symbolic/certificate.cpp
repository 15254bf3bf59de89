#include "symbolic/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "symbolic/case/limits.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/coq_file.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// A polynomial as it stands, with rational coefficients: nothing has to be known or assumed to
/// read it as one.
bool is_plain_polynomial(const ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return true;
  if (GiNaC::is_a<GiNaC::numeric>(e)) return GiNaC::ex_to<GiNaC::numeric>(e).is_rational();
  if (GiNaC::is_a<GiNaC::power>(e)) {
    return is_plain_polynomial(e.op(0)) && GiNaC::is_a<GiNaC::numeric>(e.op(1)) &&
           GiNaC::ex_to<GiNaC::numeric>(e.op(1)).is_nonneg_integer();
  }
  if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return false;
  return std::all_of(e.begin(), e.end(), is_plain_polynomial);
}

/// Why a claim has no theorem.
class NotCovered : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A claim that the file may state.
struct Statement {
  NamedExpression function;
  std::vector<NamedExpression> on;
};

/// By the kind of claim, in the order in which `prove` reports them.
using Statements = std::map<ClaimKind, std::vector<Statement>>;

Statements statements_of(const Model& model, const Candidates& candidates) {
  Statements result;
  const auto add = [&](ClaimKind kind, const std::vector<NamedExpression>& functions,
                       const std::vector<NamedExpression>& on) {
    for (const NamedExpression& f : functions) result[kind].push_back({f, on});
  };
  if (candidates.empty()) {
    add(ClaimKind::casimir, model.casimirs, {});
    add(ClaimKind::integral, model.integrals, {});
    for (const LevelClaim& claim : model.conditionals)
      add(ClaimKind::conditional, {claim.expression}, claim.on);
    if (!model.constraints.empty()) {
      add(ClaimKind::invariant_relation, {model.constraints.back()},
          {model.constraints.begin(), model.constraints.end() - 1});
    }
    for (const LevelClaim& claim : model.invariant_relations)
      add(ClaimKind::invariant_relation, {claim.expression}, claim.on);
    return result;
  }
  const auto read = [&](const std::vector<Text>& texts, const char* prefix) {
    std::vector<NamedExpression> functions;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      functions.push_back(
          {fmt::format("{}{}", prefix, i + 1), model.parse(texts[i]), texts[i].where});
    }
    return functions;
  };
  const std::vector<NamedExpression> on = read(candidates.on, "on");
  add(ClaimKind::casimir, read(candidates.casimirs, "C"), on);
  add(ClaimKind::integral, read(candidates.integrals, "F"), on);
  add(ClaimKind::invariant_relation, read(candidates.invariant_relations, "R"), on);
  return result;
}

std::vector<GiNaC::symbol> symbols_of(const Model& model) {
  std::vector<GiNaC::symbol> symbols = model.variables;
  symbols.insert(symbols.end(), model.parameters.begin(), model.parameters.end());
  return symbols;
}

/// The plain polynomials among what the file may be about.
std::vector<ex> polynomials_of(const Model& model, const Statements& statements) {
  std::vector<ex> all{*model.hamiltonian};
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    for (std::size_t j = i + 1; j < model.variables.size(); ++j)
      all.push_back((*model.poisson)(i, j));
  }
  for (const auto& [kind, list] : statements) {
    for (const Statement& s : list) {
      all.push_back(s.function.value);
      for (const NamedExpression& g : s.on) all.push_back(g.value);
    }
  }
  std::erase_if(all, [](const ex& e) { return !is_plain_polynomial(e); });
  return all;
}

class Writer {
 public:
  Writer(const Model& model, const Statements& statements)
      : model_(model),
        // Without the assumptions of the case: what they would simplify is not what the file says.
        ring_(symbols_of(model), {}, polynomials_of(model, statements)),
        file_(symbols_of(model), model.variables.size()) {
    file_.begin_part("The bracket and the Hamiltonian");
    std::vector<Polynomial> upper;
    for (std::size_t i = 0; i < dimension(); ++i) {
      for (std::size_t j = i + 1; j < dimension(); ++j)
        upper.push_back(polynomial((*model.poisson)(i, j)));
    }
    file_.define_bracket(upper);
    field_.assign(dimension() * dimension(), Polynomial(ring_.ring()));
    for (std::size_t i = 0, entry = 0; i < dimension(); ++i) {
      for (std::size_t j = i + 1; j < dimension(); ++j, ++entry) {
        field_[i * dimension() + j] = upper[entry];
        field_[j * dimension() + i] = -upper[entry];
      }
    }
    hamiltonian_.emplace(file_.define("hamiltonian", polynomial(*model.hamiltonian)));
  }

  const CoqFile& file() const { return file_; }

  /// \throws NotCovered, TooLarge  nothing is written then
  void state(ClaimKind kind, const Statement* statement, std::size_t number) {
    if (kind == ClaimKind::skew) {
      file_.begin_part("skew: the bracket is skew symmetric");
      file_.state_skew_symmetry();
    } else if (kind == ClaimKind::jacobi) {
      check_jacobi();
      file_.begin_part("jacobi: the Jacobi identity");
      file_.state_jacobi();
    } else if (kind == ClaimKind::casimir) {
      state_casimir(*statement, number);
    } else {
      state_rates(kind, *statement, number);
    }
  }

  /// Beside candidates: their statements do not need it.
  void state_bracket_if_poisson() {
    try {
      state(ClaimKind::skew, nullptr, 1);
      state(ClaimKind::jacobi, nullptr, 1);
    } catch (const NotCovered&) {  // the bracket is one of the case all the same
    }
  }

  void leave_out(const std::string& claim, const std::string& reason) {
    file_.end_with(fmt::format("Proved, but not certified here: {}: {}", claim, reason));
  }

  /// How the file speaks of a claim. Names that are no identifiers do not get into it.
  static std::string title(ClaimKind kind, const std::string& name, std::size_t number) {
    const std::string place = fmt::format("{} no. {}", to_string(kind), number);
    return is_coq_name(name) ? fmt::format("{}, {}", place, name) : place;
  }

 private:
  std::size_t dimension() const { return model_.variables.size(); }

  Polynomial polynomial(const ex& e) {
    if (!is_plain_polynomial(e))
      throw NotCovered("it is not about polynomials with rational coefficients");
    return ring_.convert(e);
  }

  Polynomial bracket(const Polynomial& f, const Polynomial& g) const {
    SumOfProducts sum(ring_.ring());
    for (std::size_t i = 0; i < dimension(); ++i) {
      if (f.uses(i)) sum.add(f.derivative(i), flow(i, g));
    }
    return sum.finish();
  }

  /// {x_i, g}
  Polynomial flow(std::size_t i, const Polynomial& g) const {
    SumOfProducts sum(ring_.ring());
    for (std::size_t j = 0; j < dimension(); ++j) {
      if (g.uses(j)) sum.add(field_[i * dimension() + j], g.derivative(j));
    }
    return sum.finish();
  }

  /// The polynomials q_k with p = sum q_k level_k.
  static std::vector<Polynomial> cofactors(const Polynomial& p,
                                           const std::vector<Polynomial>& level) {
    std::vector<Polynomial> quotients(level.size(), Polynomial(p.ring()));
    if (p.is_zero()) return quotients;
    if (level.empty()) throw NotCovered("it is no identity of polynomials without assumptions");
    if (!p.remainder(level, &quotients).is_zero())
      throw NotCovered("division by the functions of the level gave no polynomial cofactors");
    return quotients;
  }

  void check_jacobi() const {
    const auto twice = [&](std::size_t i, std::size_t j, std::size_t k) {
      return flow(i, field_[j * dimension() + k]);
    };
    for (std::size_t i = 0; i < dimension(); ++i) {
      for (std::size_t j = i + 1; j < dimension(); ++j) {
        for (std::size_t k = j + 1; k < dimension(); ++k) {
          if (!(twice(i, j, k) + twice(j, k, i) + twice(k, i, j)).is_zero())
            throw NotCovered("it is no identity of polynomials without assumptions");
        }
      }
    }
  }

  /// The functions of a statement, before any of them is written.
  struct Parts {
    Polynomial function;
    std::vector<Polynomial> level;
  };

  Parts parts(const Statement& statement) {
    Parts result{polynomial(statement.function.value), {}};
    for (const NamedExpression& g : statement.on) result.level.push_back(polynomial(g.value));
    return result;
  }

  /// Where the name of the case is an identifier and names one claim, the claim is called that.
  static std::string identifier(ClaimKind kind, const Statement& statement, std::size_t number) {
    const bool unique = kind == ClaimKind::casimir || kind == ClaimKind::integral;
    if (unique) return fmt::format("{}_{}", to_string(kind), coq_name(statement.function.name));
    return fmt::format("{}_{}", kind == ClaimKind::conditional ? "conditional" : "relation",
                       number);
  }

  std::vector<CoqFunction> define_level(const std::string& name,
                                        const std::vector<Polynomial>& functions) {
    std::vector<CoqFunction> level;
    for (std::size_t k = 0; k < functions.size(); ++k)
      level.push_back(file_.define(fmt::format("{}_level_{}", name, k + 1), functions[k]));
    return level;
  }

  void state_casimir(const Statement& statement, std::size_t number) {
    const Parts p = parts(statement);
    std::vector<std::vector<Polynomial>> all;
    for (std::size_t i = 0; i < dimension(); ++i)
      all.push_back(cofactors(flow(i, p.function), p.level));
    file_.begin_part(title(ClaimKind::casimir, statement.function.name, number));
    const std::string name = identifier(ClaimKind::casimir, statement, number);
    const CoqFunction f = file_.define(name, p.function);
    if (p.level.empty()) {
      file_.state_commutes_with_all(name + "_commutes_with_all", f);
      return;
    }
    const std::vector<CoqFunction> level = define_level(name, p.level);
    for (std::size_t i = 0; i < dimension(); ++i)
      file_.state_bracket(name + "_commutes_on_its_level_with", i, f, level, all[i]);
  }

  /// df/dt and the rates of the functions of its level lie in the ideal of the level; that of an
  /// invariant relation contains the function itself.
  void state_rates(ClaimKind kind, const Statement& statement, std::size_t number) {
    const bool relation = kind == ClaimKind::invariant_relation;
    const Parts p = parts(statement);
    std::vector<Polynomial> zero = p.level;
    if (relation) zero.push_back(p.function);
    const auto rate = [&](const Polynomial& f) {
      return cofactors(bracket(f, hamiltonian_->value), zero);
    };
    const std::vector<Polynomial> own = rate(p.function);
    std::vector<std::vector<Polynomial>> others;
    for (const Polynomial& g : p.level) others.push_back(rate(g));

    file_.begin_part(title(kind, statement.function.name, number));
    const std::string name = identifier(kind, statement, number);
    const CoqFunction f = file_.define(name, p.function);
    std::vector<CoqFunction> level = define_level(name, p.level);
    if (relation) level.push_back(f);
    const char* const what = relation          ? "_is_invariant"
                             : p.level.empty() ? "_is_conserved"
                                               : "_is_conserved_on_its_level";
    file_.state_bracket(name + what, f, *hamiltonian_, level, own);
    for (std::size_t k = 0; k < others.size(); ++k)
      file_.state_bracket(level[k].name + "_is_invariant", level[k], *hamiltonian_, level,
                          others[k]);
  }

  const Model& model_;
  FunctionRing ring_;
  CoqFile file_;
  std::vector<Polynomial> field_;  ///< {x_i, x_j}
  std::optional<CoqFunction> hamiltonian_;
};

/// As the bundled cases have them: words joined by dashes.
bool is_file_name(std::string name) {
  std::erase(name, '-');
  return is_coq_name(name);
}

std::string head(const Model& model) {
  return fmt::format(
      "Written by casimir for the case {}. Check it with: coqc FILE.v\n"
      "   Variables and parameters NAME are called x_NAME; each underscore of a name of the case "
      "is\n"
      "   doubled. Over the rational numbers Q:\n"
      "   bracket_A_and_B is the bracket of the coordinates A and B, A before B; pairs without a\n"
      "   definition have the bracket zero. row_A is the bracket of A with a function of gradient\n"
      "   g_1, g_2, .., and poisson that of two functions of gradients f and g. The motion is "
      "that\n"
      "   of the hamiltonian: the derivative of F by time is poisson of F and the hamiltonian.\n"
      "   For each function f and coordinate A a lemma shows that f_d_A is the derivative:\n"
      "   f at A + h, less f, is h f_d_A plus h h times a polynomial. Of a bracket only those are\n"
      "   defined that are not zero; 0 stands for the others.\n"
      "   The theorems are identities of polynomials: no assumption of the case is used, and they\n"
      "   hold over the real numbers too. On a level, the bracket is stated as a combination of "
      "the\n"
      "   functions that vanish there",
      is_file_name(model.name) ? model.name : "whose name is no identifier");
}

}  // namespace

Certificate coq_certificate(const Model& model, const Candidates& candidates,
                            const std::vector<Proof>& proofs) {
  for (const Proof& proof : proofs) {
    if (!proof.note && !(proof.fact && !counts(model, proof)) && proof.verdict != Verdict::proved) {
      throw ModelError(fmt::format("no certificate: the claim '{}' is {}", printable(proof.name),
                                   to_string(proof.verdict)));
    }
  }
  if (!model.poisson) throw ModelError("a certificate needs a bracket");
  if (has_arbitrary_functions(model))
    throw ModelError("no certificate: it covers functions that are given, and some are arbitrary");
  if (model.time)
    throw ModelError("no certificate: it covers polynomials that do not depend on time");
  const WorkMeter meter;
  const Statements statements = statements_of(model, candidates);
  std::optional<Writer> writer;
  try {
    writer.emplace(model, statements);
  } catch (const NotCovered&) {
    throw ModelError(
        "no certificate: it covers polynomials, and the bracket or the Hamiltonian is none");
  }
  Certificate certificate;
  if (!candidates.empty()) writer->state_bracket_if_poisson();
  std::map<ClaimKind, std::size_t> seen;
  for (const Proof& proof : proofs) {
    if (!counts(model, proof)) continue;
    const std::size_t number = ++seen[proof.kind];
    std::string reason;
    try {
      const auto list = statements.find(proof.kind);
      if (list != statements.end() && number <= list->second.size())
        writer->state(proof.kind, &list->second[number - 1], number);
      else if (proof.kind == ClaimKind::skew || proof.kind == ClaimKind::jacobi)
        writer->state(proof.kind, nullptr, number);
      else
        reason = "claims of this kind have no theorem";
    } catch (const NotCovered& problem) {
      reason = problem.what();
    } catch (const TooLarge& problem) {
      reason = problem.what();
    }
    if (reason.empty()) continue;
    writer->leave_out(Writer::title(proof.kind, proof.name, number), reason);
    certificate.left_out.push_back({proof.kind, proof.name, reason});
  }
  certificate.text = writer->file().text(head(model));
  return certificate;
}

}  // namespace casimir

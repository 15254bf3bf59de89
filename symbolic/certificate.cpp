#include "symbolic/certificate.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/certificate_writer.hpp"
#include "symbolic/proof/claims/claim_kinds.hpp"

namespace casimir {
namespace {

/// By the kind of claim, in the order in which `prove` reports them.
using Statements = std::map<ClaimKind, std::vector<Statement>>;

Statements statements_of(const Model& model, const Candidates& candidates) {
  const auto read = [&](const std::vector<Text>& texts, const char* prefix) {
    std::vector<NamedExpression> functions;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      functions.push_back(
          {fmt::format("{}{}", prefix, i + 1), model.parse(texts[i]), texts[i].where});
    }
    return functions;
  };
  const std::vector<NamedExpression> on = read(candidates.on, "on");
  Statements result;
  for (const ClaimRow& row : claim_rows()) {
    if (!row.certify) continue;
    const auto add = [&](std::optional<LevelClaim> function) {
      std::vector<Statement>& list = result[row.kind];
      list.push_back({row.kind, std::move(function), list.size() + 1});
    };
    if (candidates.empty()) {
      for (Claim& claim : row.read(model)) add(std::move(claim.function));
    } else if (row.candidates) {
      for (const NamedExpression& f : read(candidates.*row.candidates, row.letter))
        add(LevelClaim{f, on});
    }
  }
  return result;
}

/// What they are about.
std::vector<GiNaC::ex> functions_of(const Statements& statements) {
  std::vector<GiNaC::ex> all;
  for (const auto& [kind, list] : statements) {
    for (const Statement& s : list) {
      if (!s.function) continue;
      all.push_back(s.function->expression.value);
      for (const NamedExpression& g : s.function->on) all.push_back(g.value);
    }
  }
  return all;
}

/// Beside candidates: their statements do not need it.
void state_bracket_if_poisson(CertificateWriter& writer) {
  try {
    for (const ClaimKind kind : {ClaimKind::skew, ClaimKind::jacobi})
      claim_row(kind).certify(writer, {kind, std::nullopt});
  } catch (const NotCovered&) {  // the bracket is one of the case all the same
  }
}

/// Why the claim, the one of that number of its kind, has no theorem; empty where it has one now.
std::string stated(CertificateWriter& writer, const Statements& statements, ClaimKind kind,
                   std::size_t number) {
  const auto list = statements.find(kind);
  if (list == statements.end() || number > list->second.size())
    return "claims of this kind have no theorem";
  try {
    claim_row(kind).certify(writer, list->second[number - 1]);
  } catch (const NotCovered& problem) {
    return problem.what();
  } catch (const TooLarge& problem) {
    return problem.what();
  }
  return {};
}

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
  const WorkMeter meter(model.limits);
  const Statements statements = statements_of(model, candidates);
  std::optional<CertificateWriter> writer;
  try {
    writer.emplace(model, functions_of(statements));
  } catch (const NotCovered&) {
    throw ModelError(
        "no certificate: it covers polynomials, and the bracket or the Hamiltonian is none");
  }
  Certificate certificate;
  if (!candidates.empty()) state_bracket_if_poisson(*writer);
  std::map<ClaimKind, std::size_t> seen;
  for (const Proof& proof : proofs) {
    if (!counts(model, proof)) continue;
    const std::size_t number = ++seen[proof.kind];
    const std::string reason = stated(*writer, statements, proof.kind, number);
    if (reason.empty()) continue;
    writer->file().end_with(fmt::format("Proved, but not certified here: {}: {}",
                                        claim_title(proof.kind, proof.name, number), reason));
    certificate.left_out.push_back({proof.kind, proof.name, reason});
  }
  certificate.text = writer->file().text(head(model));
  return certificate;
}

}  // namespace casimir

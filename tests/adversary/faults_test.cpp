// Answers that were once false, one file each: what must never be said of them again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "symbolic/certificate.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/search.hpp"
#include "tests/adversary/parser.hpp"
#include "tests/adversary/residuals.hpp"

namespace casimir::adversary {
namespace {

Model model_of(const std::string& name) {
  const std::filesystem::path folder = CASIMIR_SOURCE_DIR "/tests/adversary/faults";
  return build_model(read_case(folder / (name + ".toml")));
}

Text fault_text(const std::string& value) { return {value, {"fault", 1, 1}, value}; }

std::string plain(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// What is so of a claim, by its file.
struct Known {
  const char *file, *kind, *name;  ///< of any name, if that is empty
  Truth truth;
};

class Fault : public testing::TestWithParam<Known> {};

/// The conditions that a proof names, so that it claims nothing elsewhere.
template <typename AnyProof>
bool is_conditional(const AnyProof& proof) {
  if constexpr (requires { proof.where; }) return !proof.where.empty();
  return false;
}

TEST_P(Fault, IsJudgedRightly) {
  const Known& known = GetParam();
  const Model model = model_of(known.file);
  bool met = false;
  for (const Proof& proof : prove(model)) {
    if (proof.note || to_string(proof.kind) != known.kind) continue;
    met = true;
    if (*known.name != '\0' && proof.name != known.name) continue;
    if (known.truth == Truth::yes)
      EXPECT_NE(proof.verdict, Verdict::refuted) << proof.residual;
    else
      EXPECT_TRUE(proof.verdict != Verdict::proved || is_conditional(proof)) << proof.evidence;
  }
  EXPECT_TRUE(met);
}

constexpr Known kFaults[] = {
    {"complex-inverse-root", "identity", "root of 1/x", Truth::no},
    {"complex-inverse-root", "identity", "root of L^2 y", Truth::no},
    {"crash-on-simpler-level", "invariant_relation", "R", Truth::yes},
    {"crash-on-zero", "conditional", "C", Truth::no},
    {"number-of-62-bits", "invariant_relation", "R", Truth::no},
    {"definition-named-H", "integral", "F", Truth::no},
    {"facts-abs", "liouville", "", Truth::no},
    {"facts-asin-acos", "independence", "", Truth::no},
    {"facts-asin-acos", "liouville", "", Truth::no},
    {"facts-half-angle-natural", "independence", "", Truth::no},
    {"facts-half-angle-natural", "liouville", "", Truth::no},
    {"level-abs-rotation", "conditional", "C", Truth::no},
    {"level-denominator-root", "conditional", "F", Truth::no},
    {"level-lead-function", "conditional", "A", Truth::no},
    {"level-lead-function", "conditional", "B", Truth::no},
    {"level-lead-function", "conditional", "C", Truth::no},
    {"level-lead-function", "conditional", "D", Truth::no},
    {"level-lead-function", "conditional", "E", Truth::no},
    {"level-lead-function", "conditional", "G", Truth::no},
    {"level-lead-function", "conditional", "H2", Truth::no},
    {"level-lead-function", "conditional", "K", Truth::no},
    {"level-nonlipschitz", "invariant_relation", "R", Truth::no},
    {"level-parameter-lead", "conditional", "C", Truth::no},
    {"measure-zero", "measure", "", Truth::nothing},
    {"rank-half-angle", "rank", "rank 2", Truth::no},
    {"refuted-outside-real-domain", "integral", "F", Truth::yes},
    {"refuted-outside-real-domain", "integral", "G", Truth::yes},
    {"refuted-outside-real-domain", "integral", "K", Truth::yes},
    {"refuted-outside-real-domain", "identity", "on the real domain", Truth::yes},
    {"sign-nonstrict-level", "conditional", "C", Truth::no},
    {"sign-nonstrict-param", "integral", "F", Truth::no},
    {"thin-domain", "integral", "F", Truth::no},
    {"thin-domain", "identity", "sign", Truth::no},
    {"level-outside-domain", "conditional", "C", Truth::nothing},
    {"facts-log-root", "independence", "", Truth::no},
    {"facts-nested-root", "independence", "", Truth::no},
    {"facts-constant", "rank", "rank 2", Truth::no},
    {"level-lead-identity", "identity", "part", Truth::no},
    {"level-nonlipschitz-conditional", "conditional", "C", Truth::no},
    {"refuted-by-implied-sign", "integral", "F", Truth::yes},
    {"refuted-by-implied-sign", "integral", "G", Truth::yes},
    {"refuted-by-implied-sign", "identity", "on the real domain", Truth::yes},
    {"empty-domain-roots", "identity", "roots", Truth::nothing},
    {"empty-domain-roots", "identity", "logarithms", Truth::nothing},
    {"empty-domain-assumed", "integral", "F", Truth::nothing},
    {"empty-domain-assumed", "identity", "sign", Truth::nothing},
    {"vacuous-real-domain", "integral", "K", Truth::nothing},
    {"vacuous-real-domain", "identity", "log", Truth::nothing},
    {"cut-angle-difference", "invariant_relation", "R", Truth::no},
    {"cut-angle-difference", "conditional", "C", Truth::no},
    {"cut-double-angle", "invariant_relation", "R", Truth::no},
    {"cut-double-angle", "conditional", "C", Truth::no},
    {"domain-identity-from-hamiltonian", "identity", "ID", Truth::no},
    {"domain-identity-from-hamiltonian", "casimir", "C", Truth::no},
    {"domain-jacobi-from-hamiltonian", "jacobi", "", Truth::no},
    {"domain-lax-from-integrals", "lax", "", Truth::no},
    {"domain-map-from-hamiltonian", "map", "M", Truth::no},
    {"domain-measure-every-hamiltonian", "measure", "", Truth::no},
    {"domain-rank-from-casimir", "rank", "", Truth::no},
    {"domain-rank-from-hamiltonian", "rank", "", Truth::no},
    {"facts-vacuous-constant", "independence", "", Truth::nothing},
    {"identity-domain-cancels", "identity", "true1", Truth::yes},
    {"identity-domain-cancels", "identity", "true2", Truth::yes},
    {"identity-vacuous-cancels", "identity", "v1", Truth::nothing},
    {"identity-vacuous-cancels", "identity", "v2", Truth::nothing},
    {"imaginary-elsewhere", "integral", "F", Truth::yes},
    {"imaginary-elsewhere", "identity", "real1", Truth::yes},
    {"imaginary-elsewhere", "identity", "real2", Truth::yes},
    {"imaginary-exponent", "identity", "plain", Truth::yes},
    {"level-cut-field", "invariant_relation", "R", Truth::no},
    {"level-sign-function", "conditional", "C", Truth::no},
    {"level-sign-function", "invariant_relation", "R", Truth::no},
    {"parser-domain-lost", "identity", "s1", Truth::yes},
    {"parser-domain-lost", "identity", "s2", Truth::yes},
    {"parser-domain-lost", "identity", "s3", Truth::yes},
    {"parser-domain-lost", "identity", "s4", Truth::yes},
    {"parser-vacuous", "identity", "v3", Truth::nothing},
    {"parser-vacuous", "identity", "v4", Truth::nothing},
    {"time-branch-refuted", "invariant_relation", "R", Truth::yes},
    {"zerodivisor-casimir", "casimir", "C", Truth::no},
    {"zerodivisor-half-angle", "integral", "F", Truth::no},
    {"zerodivisor-integral", "integral", "F", Truth::no},
    {"zerodivisor-integral", "integral", "G", Truth::no},
    {"zerodivisor-involution", "involution", "", Truth::no},
    {"zerodivisor-jacobi", "jacobi", "", Truth::no},
    {"zerodivisor-measure", "measure", "", Truth::no},
    {"zerodivisor-nested-root", "integral", "F", Truth::no},
};

INSTANTIATE_TEST_SUITE_P(Proofs, Fault, testing::ValuesIn(kFaults), [](const auto& known) {
  const Known& k = known.param;
  return plain(std::string(k.file) + "_" + k.kind + "_" + k.name);
});

/// A search that has to find something, or to leave open whether it is there.
struct Sought {
  const char* file;
  int degree;
  const char *on, *functions;
  const char* part;  ///< of the text of what is there
};

class SearchFault : public testing::TestWithParam<Sought> {};

TEST_P(SearchFault, IsFoundOrLeftOpen) {
  const Sought& sought = GetParam();
  search::Request request;
  request.degree = sought.degree;
  if (*sought.on != '\0') request.on = {fault_text(sought.on)};
  if (*sought.functions != '\0') request.functions = {fault_text(sought.functions)};
  const search::Report report = search::find_integrals(model_of(sought.file), request);
  EXPECT_TRUE(!report.complete ||
              std::any_of(report.found.begin(), report.found.end(), [&](const auto& f) {
                return f.text.find(sought.part) != std::string::npos;
              }));
  for (const search::Found& f : report.found) EXPECT_NE(f.verdict, Verdict::refuted) << f.text;
}

INSTANTIATE_TEST_SUITE_P(Searches, SearchFault,
                         testing::Values(Sought{"search-half-angle", 2, "", "", "p2"},
                                         Sought{"search-on-real-level", 1, "q1^2+p1^2", "", "p2"},
                                         Sought{"search-real-level-linear", 1, "x^2 + y^2", "",
                                                "z"},
                                         Sought{"functions-degree", 2, "", "exp(4*t)", "exp(4*t)"},
                                         Sought{"power-of-root", 3, "", "x^(2/3)", "x"}),
                         [](const auto& sought) { return plain(sought.param.file); });

/// Values of parameters that have to be found, or left open.
struct SoughtValue {
  const char* file;
  int degree;
  std::vector<std::string> free;
  std::string value;  ///< of a parameter, or empty for two at once
};

class FreeFault : public testing::TestWithParam<SoughtValue> {};

search::ConditionReport report_of(const SoughtValue& sought) {
  search::Request request;
  request.degree = sought.degree;
  std::vector<Text> free;
  for (const std::string& name : sought.free) free.push_back(fault_text(name));
  return search::find_conditions(model_of(sought.file), request, free);
}

bool has_value(const search::ConditionReport& report, const std::string& value) {
  return std::any_of(report.conditions.begin(), report.conditions.end(), [&](const auto& c) {
    return std::any_of(c.parameters.begin(), c.parameters.end(),
                       [&](const auto& p) { return p.second == value; });
  });
}

/// Two parameters are given at once.
bool has_two_values(const search::ConditionReport& report) {
  return std::any_of(report.conditions.begin(), report.conditions.end(),
                     [](const auto& c) { return c.parameters.size() > 1; });
}

TEST_P(FreeFault, IsFoundOrLeftOpen) {
  const search::ConditionReport report = report_of(GetParam());
  const std::string& value = GetParam().value;
  EXPECT_TRUE(!report.complete ||
              (value.empty() ? has_two_values(report) : has_value(report, value)));
}

INSTANTIATE_TEST_SUITE_P(
    Searches, FreeFault,
    testing::Values(SoughtValue{"free-central-force", 2, {"n"}, "1"},
                    SoughtValue{"free-exp", 1, {"n"}, "2"}, SoughtValue{"free-cos", 1, {"n"}, "2"},
                    SoughtValue{"free-atan", 1, {"n"}, "1"},
                    SoughtValue{"free-casimir-missed", 2, {"d"}, "-1"},
                    SoughtValue{"free-three-parameters", 3, {"A", "B", "d"}, ""},
                    SoughtValue{"free-exponent-even", 2, {"n"}, "1/2"},
                    SoughtValue{"free-isotropic", 2, {"A", "B", "d"}, ""},
                    SoughtValue{"rattleback-equations", 3, {"lam"}, "2"},
                    SoughtValue{"rattleback-bracket", 3, {"lam"}, "1"},
                    SoughtValue{"rattleback-bracket", 3, {"lam"}, "2"}),
    [](const auto& sought) { return plain(std::string(sought.param.file) + sought.param.value); });

TEST(FreeFaults, NothingIsShownWhereTheAdditionalFunctionIsZero) {
  EXPECT_FALSE(has_value(report_of({"free-atan", 1, {"n"}, ""}), "-1"));
}

TEST(LaxFaults, WitnessHasTheParameterOfItsOwnPair) {
  const Model model = model_of("lax-witness-two-lambdas");
  std::vector<Proof> pairs;
  for (const Proof& proof : prove(model)) {
    if (proof.kind == ClaimKind::lax) pairs.push_back(proof);
  }
  ASSERT_EQ(pairs.size(), 5U);
  ASSERT_EQ(pairs[1].verdict, Verdict::refuted);
  ASSERT_TRUE(pairs[1].witness.has_value());
  const Expr q{"q"}, p{"p"}, lambda{"lambda"};
  Case claim;
  claim.kind = Kind::lax;
  claim.system.variables = {"q", "p"};
  claim.system.bracket = Bracket::canonical;
  claim.system.hamiltonian = (pow(p, 2) + pow(q, 2)) / 2;
  claim.lax = {
      {"lambda", {{p, q * lambda}, {q / lambda, -p}}, {{0, -lambda / 2}, {Expr(1, 2), 0}}}};
  Point point;
  for (const auto& [name, text] : pairs[1].witness->point) point[name] = value(parse(text), {});
  const Ball shown = value(parse(pairs[1].witness->value), {});
  const std::vector<Ball> residuals = At(claim, point).residuals();
  EXPECT_TRUE(std::any_of(residuals.begin(), residuals.end(),
                          [&](const Ball& r) { return (r - shown).is_tiny(); }));
}

/// The certificate, or nothing where the library refuses to write one.
std::optional<Certificate> certificate_of(const std::string& name) {
  try {
    const Model model = model_of(name);
    return coq_certificate(model, {}, prove(model));
  } catch (const CaseError&) {
  } catch (const ModelError&) {
  }
  return std::nullopt;
}

/// Without what stands in comments.
std::string vernacular(const std::string& text) {
  std::string result;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "(*") == 0) ++depth;
    if (depth == 0) result += text[i];
    if (i > 0 && text.compare(i - 1, 2, "*)") == 0 && depth > 0) --depth;
  }
  return result;
}

TEST(CertificateFaults, ANameIsNoVernacular) {
  const auto certificate = certificate_of("certificate-injection");
  if (certificate) {
    EXPECT_EQ(vernacular(certificate->text).find("Axiom"), std::string::npos);
  }
}

TEST(CertificateFaults, EveryClaimIsStatedOrLeftOut) {
  const auto certificate = certificate_of("certificate-vacuous");
  if (!certificate) return;
  const auto stated_or_left_out = [&](const std::string& theorem, const std::string& name) {
    return certificate->text.find("Theorem " + theorem) != std::string::npos ||
           std::any_of(certificate->left_out.begin(), certificate->left_out.end(),
                       [&](const Uncertified& c) { return c.name == name; });
  };
  EXPECT_TRUE(stated_or_left_out("integral_G", "G"));
  EXPECT_TRUE(stated_or_left_out("casimir_C", "C"));
  // F is what is stated of it only where q1 > 0.
  EXPECT_TRUE(certificate->text.find("Theorem integral_F") == std::string::npos ||
              certificate->text.find("q1 > 0") != std::string::npos);
}

}  // namespace
}  // namespace casimir::adversary

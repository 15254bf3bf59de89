// Certificates: Coq accepts those of true claims and rejects them when one coefficient is changed.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <span>
#include <sstream>

#include "symbolic/model.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/tools/commands/coq_reader.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using GiNaC::ex;

/// Exit status of coqc on a file of the folder; what it prints goes to the file "said".
int coqc(const Folder& folder, const std::string& file) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.path().c_str()) != 0) _exit(126);
    const int said = open("said", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(said, STDOUT_FILENO);
    dup2(said, STDERR_FILENO);
    execlp("coqc", "coqc", file.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// Coq accepts the certificate STEM.v, and nothing that it states rests on an axiom.
void expect_proved(const Folder& folder, const std::string& stem, const CoqReader& reader) {
  ASSERT_EQ(coqc(folder, stem + ".v"), 0) << file_text(folder.path() / "said");
  // All in one: asked about each by itself, Coq goes through its library again for each.
  std::string all;
  for (const auto* names : {&reader.theorems(), &reader.lemmas()}) {
    for (const std::string& name : *names) all += (all.empty() ? "@" : ", @") + name;
  }
  EXPECT_NE(all, "");
  folder.write("assumptions.v", "Require Import " + stem + ".\nDefinition everything := (" + all +
                                    ").\nPrint Assumptions everything.\n");
  ASSERT_EQ(coqc(folder, "assumptions.v"), 0) << file_text(folder.path() / "said");
  EXPECT_EQ(file_text(folder.path() / "said"), "Closed under the global context\n");
}

/// "NAME" as part of an identifier.
std::string doubled(const std::string& name) {
  std::string result;
  for (const char c : name) result += c == '_' ? std::string("__") : std::string(1, c);
  return result;
}

/// The words of a text with single spaces.
std::string joined(const std::string& text) {
  std::istringstream stream(text);
  std::string result;
  for (std::string word; stream >> word;) result += (result.empty() ? "" : " ") + word;
  return result;
}

/// A certificate beside the case that it has to be about.
struct Compared {
  const Model& model;
  const CoqReader& file;
  std::vector<ex> symbols;
  CoqReader::Names names;
  std::string arguments;

  Compared(const Model& of, const CoqReader& with) : model(of), file(with) {
    for (const auto* list : {&model.variables, &model.parameters}) {
      for (const GiNaC::symbol& s : *list) {
        const std::string name = "x_" + doubled(s.get_name());
        symbols.push_back(s);
        names[name] = s;
        arguments += " " + name;
      }
    }
  }

  void function(const std::string& name, const ex& expected) const {
    ASSERT_TRUE(file.defines(name)) << name;
    EXPECT_EQ((file.value(name, symbols) - expected).expand(), 0) << name;
  }

  /// The function, its derivatives, and the lemmas that say so.
  void function_with_slopes(const std::string& name, const ex& expected) const {
    function(name, expected);
    for (const GiNaC::symbol& x : model.variables) {
      const std::string slope = name + "_d_" + doubled(x.get_name());
      function(slope, expected.diff(x));
      const CoqReader::Statement& lemma = file.statements().at(slope + "_is_derivative");
      CoqReader::Names with_h = names;
      const GiNaC::symbol h("h");
      with_h["h"] = h;
      const ex step = expected.subs(x == x + h) - expected;
      EXPECT_EQ((file.value(lemma.left, with_h) - step).expand(), 0) << slope;
      EXPECT_EQ(joined(lemma.right).rfind("h * " + slope + arguments + " + h * h * (", 0), 0U)
          << lemma.right;
    }
  }

  std::string gradient(const std::string& name) const {
    std::string result;
    for (const GiNaC::symbol& x : model.variables)
      result += " (" + name + "_d_" + doubled(x.get_name()) + arguments + ")";
    return result;
  }

  void kinematics() const {
    const std::size_t n = model.variables.size();
    std::vector<ex> all;
    ex sum = 0;
    for (const char* prefix : {"f_", "g_"}) {
      for (std::size_t i = 0; i < n; ++i)
        all.push_back(GiNaC::symbol(prefix + std::to_string(i + 1)));
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        sum += all[i] * (*model.poisson)(i, j) * all[n + j];
        const std::string name = "bracket_" + doubled(model.variables[i].get_name()) + "_and_" +
                                 doubled(model.variables[j].get_name());
        const bool needed = i < j && !(*model.poisson)(i, j).is_zero();
        EXPECT_EQ(file.defines(name), needed) << name;
        if (needed) function(name, (*model.poisson)(i, j));
      }
    }
    all.insert(all.end(), symbols.begin(), symbols.end());
    EXPECT_EQ((file.value("poisson", all) - sum).expand(), 0);
    function_with_slopes("hamiltonian", *model.hamiltonian);
  }

  void casimir(const std::string& name, const ex& f) const {
    function_with_slopes(name, f);
    const CoqReader::Statement& theorem = file.statements().at(name + "_commutes_with_all");
    std::string g;
    for (std::size_t i = 1; i <= model.variables.size(); ++i) g += " g_" + std::to_string(i);
    EXPECT_EQ(joined(theorem.left), "poisson" + gradient(name) + g + arguments);
    EXPECT_EQ(joined(theorem.right), "0");
  }

  void rate(const std::string& theorem_name, const std::string& name,
            const std::set<std::string>& level) const {
    const CoqReader::Statement& theorem = file.statements().at(theorem_name);
    EXPECT_EQ(joined(theorem.left),
              "poisson" + gradient(name) + gradient("hamiltonian") + arguments);
    EXPECT_EQ(file.value(theorem.right, names, level), 0) << theorem.right;
    if (level.empty()) {
      EXPECT_EQ(joined(theorem.right), "0");
    }
  }

  void on_level(const std::string& name, const LevelClaim& claim, bool relation) const {
    function_with_slopes(name, claim.expression.value);
    std::set<std::string> level;
    for (std::size_t k = 0; k < claim.on.size(); ++k) {
      level.insert(name + "_level_" + std::to_string(k + 1));
      function_with_slopes(name + "_level_" + std::to_string(k + 1), claim.on[k].value);
    }
    if (relation) level.insert(name);
    rate(name + (relation ? "_is_invariant" : "_is_conserved_on_its_level"), name, level);
    for (const std::string& g : level) rate(g + "_is_invariant", g, level);
  }

  void everything() const {
    kinematics();
    for (const NamedExpression& f : model.casimirs) casimir("casimir_" + doubled(f.name), f.value);
    for (const NamedExpression& f : model.integrals) {
      const std::string name = "integral_" + doubled(f.name);
      function_with_slopes(name, f.value);
      rate(name + "_is_conserved", name, {});
    }
    for (std::size_t i = 0; i < model.conditionals.size(); ++i)
      on_level("conditional_" + std::to_string(i + 1), model.conditionals[i], false);
    // What restricts the scenes is the first relation that the case claims.
    std::vector<LevelClaim> relations;
    if (!model.constraints.empty()) {
      relations.push_back(
          {model.constraints.back(), {model.constraints.begin(), model.constraints.end() - 1}});
    }
    relations.insert(relations.end(), model.invariant_relations.begin(),
                     model.invariant_relations.end());
    for (std::size_t i = 0; i < relations.size(); ++i)
      on_level("relation_" + std::to_string(i + 1), relations[i], true);
  }
};

/// Writes the certificate of a case and reads it back.
CoqReader certificate_of(const Folder& folder, const std::string& name, Outcome* outcome = nullptr,
                         const std::string& input = {}) {
  const Outcome of = run_in(folder, {"verify", name, "--quiet", "--certificate", "right.v"}, input);
  EXPECT_EQ(of.status, 0) << of.err;
  if (outcome != nullptr) *outcome = of;
  return CoqReader(file_text(folder.path() / "right.v"));
}

/// With claims of every kind that Coq is given; the last three take Coq as long as all other tests
/// of it.
constexpr std::array kCertified = {"goryachev-chaplygin", "henon-heiles", "hess-principal",
                                   "kovalevskaya",        "clebsch",      "steklov"};

TEST(EveryCase, OfTheCertifiedIsAcceptedByCoqAndRejectedWhenTamperedWith) {
  for (const char* name : std::span(kCertified).first(wants_every_case() ? kCertified.size() : 3)) {
    SCOPED_TRACE(name);
    const Folder folder;
    expect_proved(folder, "right", certificate_of(folder, name));
    // One sign in the last function that is defined: its derivatives are no longer what they say.
    std::string text = file_text(folder.path() / "right.v");
    const std::size_t place = text.find(" + ", text.rfind("Definition hamiltonian "));
    text.replace(place, 3, " - ");
    folder.write("wrong.v", text);
    EXPECT_EQ(coqc(folder, "wrong.v"), 1);
  }
}

TEST(Certificate, StatesWhatTheCaseSays) {
  for (const std::string name : kCertified) {
    SCOPED_TRACE(name);
    const Folder folder;
    const CoqReader reader = certificate_of(folder, name);
    const Model model = build_model(read_case(CASIMIR_SOURCE_DIR "/cases/" + name + ".toml"));
    Compared(model, reader).everything();
  }
}

TEST(CertificateOf, CandidateOnALevel) {
  const Folder folder;
  ASSERT_EQ(run_in(folder,
                   {"verify", "goryachev-chaplygin", "--integral", "M3*(M1^2 + M2^2)/3 + r*M1*g3/3",
                    "--on", "M1*g1 + M2*g2 + M3*g3", "--certificate", "g.v"})
                .status,
            0);
  EXPECT_EQ(coqc(folder, "g.v"), 0);
}

TEST(CertificateOf, FunctionsOfALevelThatAreZeroAreNoDivisors) {
  const Folder folder;
  folder.write(
      "zero.toml",
      "hamiltonian = \"p^2/2\"\n[phase_space]\nvariables = [\"q\",\"p\"]\ncanonical = true\n"
      "[[conditional]]\nname = \"C\"\nexpression = \"p^2*q\"\non = [\"p\", \"q - q\"]\n");
  ASSERT_EQ(run_in(folder, {"verify", "zero.toml", "--certificate", "zero.v"}).status, 0);
  EXPECT_EQ(coqc(folder, "zero.v"), 0);
}

TEST(CertificateOf, FalseClaimIsNotWritten) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"verify", "euler", "--integral", "M1", "--certificate", "false.v"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("no certificate was written"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.files(), 0U);
}

TEST(CertificateOf, ProvedClaimsOfOtherKindsAreSaidToBeLeftOut) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"verify", "euler", "--casimir", "M1^2 + M2^2 + M3^2", "--identity",
                      "{M1, M2} = -M3", "--certificate", "part.v"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("not in the certificate: identity {M1, M2} = -M3"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(coqc(folder, "part.v"), 0);
}

TEST(CertificateOf, WhatIsNotCoveredIsRefused) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"verify", "lagrange-euler-angles", "--quiet", "--certificate", "angles.v"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("no certificate: it covers polynomials"), std::string::npos);
  EXPECT_EQ(run_in(folder, {"verify", "euler", "--certificate", "a-b.v"}).status, 2);
  EXPECT_EQ(folder.files(), 0U);
}

TEST(CertificateOf, NamesOfClaimsDoNotReachCoqUnlessTheyAreIdentifiers) {
  std::string toml =
      "hamiltonian = \"p^2/2 + q^2/3\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n"
      "canonical = true\n";
  for (const std::string name :
       {"x : Z := 0. Axiom bad : False. Definition y", "a-b", "two words",
        "end *) Axiom no : False. (*", "\\n.\\nRedirect", "\\\"", "Q", "forall", "hamiltonian",
        "\\u00e9\\u0301", "poisson", "1", "_", "level_1", "(* \\\"", "", "twice", "twice"}) {
    toml += "[[invariant_relation]]\nname = \"" + name +
            "\"\nexpression = \"p^2/2 + q^2/3 - 1\"\n[[conditional]]\nname = \"" + name +
            "\"\nexpression = \"p\"\non = [\"p\", \"q\"]\n";
  }
  const Folder folder;
  const CoqReader reader = certificate_of(folder, "-", nullptr, toml);
  expect_proved(folder, "right", reader);
  const std::string text = file_text(folder.path() / "right.v");
  EXPECT_EQ(text.find("Axiom"), std::string::npos);
  EXPECT_EQ(text.find("Redirect"), std::string::npos);
  const Model model = build_model(parse_case(toml, "-"));
  EXPECT_EQ(model.invariant_relations.size(), 18U);
  Compared(model, reader).everything();
}

TEST(CertificateOf, NamesThatCoqKnowsAndThoseThatLookAlikeStayApart) {
  // Keywords and identifiers of Coq, names that the file makes itself, and such as would collide if
  // parts were joined without care.
  const std::vector<std::string> names = {
      "Z",       "Q",   "nat",     "O",       "S",       "list", "fun",   "forall",
      "Prop",    "h",   "f_1",     "g_1",     "poisson", "ring", "x_Z",   "hamiltonian",
      "Type",    "end", "bracket", "a_and_b", "a",       "b",    "and_b", "a_and",
      "F_d_nat", "F",   "a_",      "_b",      "__",      "_d_",  "row_Z", "Qeq"};
  std::string variables, integrals = "[integrals]\n", parameters = "[parameters]\n";
  std::string hamiltonian;
  for (std::size_t i = 0; i < names.size(); ++i) {
    variables += (i == 0 ? "\"" : ", \"") + names[i] + "\"";
    if (i >= names.size() / 2) {
      hamiltonian += (hamiltonian.empty() ? "" : " + ") + names[i] + "^2/" + std::to_string(i + 1);
      integrals += names[i] + "_d_Z = \"" + names[i] + "\"\n";
    }
  }
  const std::string toml = "hamiltonian = \"" + hamiltonian + "\"\n" + integrals +
                           "[parameters]\nx_h = {}\nQarith = {}\n[phase_space]\nvariables = [" +
                           variables + "]\ncanonical = true\n";
  // 4960 Jacobi identities would keep Coq busy for long: the statements alone are compared.
  const Folder folder;
  const CoqReader reader = certificate_of(folder, "-", nullptr, toml);
  Compared(build_model(parse_case(toml, "-")), reader).everything();
}

TEST(CertificateOf, CoqAcceptsItsOwnWordsAsNamesOfACase) {
  const std::string toml =
      "hamiltonian = \"(nat^2 + forall^2*h + Qeq)/2\"\n"
      "[phase_space]\nvariables = [\"O\", \"S\", \"nat\", \"forall\"]\ncanonical = true\n"
      "[parameters]\nh = {}\nQeq = {}\nf_1 = {}\n"
      "[integrals]\nring = \"nat\"\nO_d_S = \"forall\"\nO = \"nat*forall\"\nFalse = \"f_1\"\n";
  EXPECT_EQ(run({"verify", "-"}, toml).status, 2) << "O is a variable, and not nat*forall";
  const Folder folder;
  std::string fixed = toml;
  fixed.replace(fixed.find("\nO = "), 5, "\nO_ = ");
  const CoqReader reader = certificate_of(folder, "-", nullptr, fixed);
  Compared(build_model(parse_case(fixed, "-")), reader).everything();
  expect_proved(folder, "right", reader);
}

TEST(CertificateOf, NothingIsSimplifiedUnderAssumptionsAndTrivialClaimsHaveTheirTheorem) {
  const std::string toml =
      "hamiltonian = \"p1^2/2 + p2^2/2\"\n"
      "[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\", \"z\"]\n"
      "domain = [\"q1 > 0\"]\n[phase_space.brackets]\n\"q1,p1\" = \"1\"\n\"q2,p2\" = \"1\"\n"
      "[casimirs]\nC = \"z\"\n"
      "[integrals]\nF = \"q1*p2 - q2*p1 + sqrt(q1^2) - q1\"\nG = \"p1\"\nN = \"3\"\n";
  const Folder folder;
  Outcome outcome;
  const CoqReader reader = certificate_of(folder, "-", &outcome, toml);
  expect_proved(folder, "right", reader);
  EXPECT_NE(outcome.err.find("not in the certificate: integral F (it is not about polynomials"),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(reader.defines("integral_F"));
  EXPECT_NE(file_text(folder.path() / "right.v").find("not certified here: integral no. 1, F:"),
            std::string::npos);
  const Model model = build_model(parse_case(toml, "-"));
  const Compared compared(model, reader);
  compared.kinematics();
  compared.casimir("casimir_C", model.casimirs[0].value);
  for (const char* name : {"integral_G", "integral_N"}) {
    compared.function_with_slopes(name,
                                  model.integrals[name == std::string("integral_N") ? 2 : 1].value);
    compared.rate(std::string(name) + "_is_conserved", name, {});
  }
}

TEST(CertificateOf, FactsThatCountAreSaidToBeLeftOut) {
  const Folder folder;
  Outcome outcome;
  certificate_of(folder, "kovalevskaya", &outcome);
  EXPECT_NE(outcome.err.find("not in the certificate: liouville"), std::string::npos)
      << outcome.err;
  const Outcome json =
      run_in(folder, {"verify", "kovalevskaya", "--json", "--certificate", "right.v"});
  EXPECT_EQ(json.json().at("certificate").at("file"), "right.v");
  EXPECT_FALSE(json.json().at("certificate").at("left_out").empty());
}

TEST(CertificateOf, CasimirCandidateOnALevelIsStatedOnIt) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"verify", "euler", "--casimir", "(M1^2 + M2^2 + M3^2 - 1)*M1", "--on",
                      "M1^2 + M2^2 + M3^2 - 1", "--certificate", "level.v"});
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  const CoqReader reader(file_text(folder.path() / "level.v"));
  expect_proved(folder, "level", reader);
  EXPECT_TRUE(reader.statements().contains("casimir_C1_commutes_on_its_level_with_M1"));
}

}  // namespace
}  // namespace casimir::test

// Sections 1.1 to 1.6 of Borisov & Mamaev, Rigid Body Dynamics (2019), formula by formula: each
// file of tests/symbolic/book states what the book claims, and every claim is decided.
//
// A claim whose name starts with "printed:" is a formula as printed where the print is wrong, one
// that starts with "false:" drops a condition or bends a sign; both must be refuted by a witness.
// Everything else must be proved. Comments of a file name what is not a claim of its own:
//
//   # expect: rank 6             a fact or note of that name is proved
//   # refuted: measure 1         the claim of that kind (and name) is refuted by a witness
//
// Not stated, since it is no identity: the caption of Fig. 1.5 (moments of inertia); which branch
// an inverse function takes, as in the arcsine that never reaches pi/2 (its derivatives are
// tested); the triangle inequality of the moments of inertia (I1 + I2 - I3 = 2*J33 is proved); that
// every rank is even (ranks of examples are); and the flux of a magnetic field as an integral (the
// end values of its potential are proved).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "symbolic/prove.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

const std::filesystem::path kFolder = CASIMIR_SOURCE_DIR "/tests/symbolic/book";

/// True claims that the prover leaves undecided, or false ones without a witness. Each is a
/// weakness of the prover: whoever removes it removes the entry, as the test then demands.
const std::vector<std::pair<std::string, std::string>> kKnownUndecided = {};

/// What follows `mark` on the lines that begin with it.
std::vector<std::string> marked_lines(const std::filesystem::path& path, const std::string& mark) {
  std::vector<std::string> result;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(mark)) result.push_back(line.substr(mark.size()));
  }
  return result;
}

bool is_known_undecided(const std::filesystem::path& path, const Proof& proof) {
  return std::find(kKnownUndecided.begin(), kKnownUndecided.end(),
                   std::pair(path.stem().string(), proof.name)) != kKnownUndecided.end();
}

bool says_that_it_is_wrong(const std::string& name) {
  return name.starts_with("printed: ") || name.starts_with("false: ");
}

class BookFile : public testing::TestWithParam<std::filesystem::path> {
 protected:
  bool is_listed_as_refuted(const Proof& proof) {
    for (auto& [text, found] : refuted_) {
      const std::string kind = to_string(proof.kind);
      if (text != kind && text != kind + " " + proof.name) continue;
      found = true;
      return true;
    }
    return false;
  }

  void read_marks() {
    for (const std::string& text : marked_lines(GetParam(), "# refuted: ")) refuted_[text] = false;
  }

  std::map<std::string, bool> refuted_;  ///< and whether there is such a claim
};

TEST_P(BookFile, IsProvedAndItsErrorsAreRefuted) {
  read_marks();
  const Model model = build_model(read_case(GetParam()));
  const std::vector<Proof> proofs = prove(model);
  int stated = 0;  // skew symmetry and Jacobi's identity are claimed by every bracket
  for (const Proof& proof : proofs) {
    if (proof.fact || proof.note) continue;
    if (proof.kind != ClaimKind::skew && proof.kind != ClaimKind::jacobi) ++stated;
    SCOPED_TRACE(to_string(proof.kind) + " '" + proof.name + "': " + proof.reason + ' ' +
                 proof.residual);
    if (is_known_undecided(GetParam(), proof)) {
      EXPECT_EQ(proof.verdict, Verdict::undecided) << "decided now: take it off kKnownUndecided";
    } else if (says_that_it_is_wrong(proof.name) || is_listed_as_refuted(proof)) {
      EXPECT_EQ(proof.verdict, Verdict::refuted);
      ASSERT_TRUE(proof.witness.has_value());
      EXPECT_NE(proof.witness->value, "0");
    } else {
      EXPECT_EQ(proof.verdict, Verdict::proved);
    }
  }
  EXPECT_GT(stated, 0) << "the file claims nothing";
  for (const auto& [text, found] : refuted_) EXPECT_TRUE(found) << "no claim is a " << text;
  for (const std::string& name : marked_lines(GetParam(), "# expect: ")) {
    EXPECT_TRUE(std::any_of(proofs.begin(), proofs.end(), [&](const Proof& proof) {
      return (proof.fact || proof.note) && proof.name == name && proof.verdict == Verdict::proved;
    })) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, BookFile, testing::ValuesIn(case_files(kFolder)),
                         [](const auto& file) { return test_name_of(file.param); });

TEST(Book, EveryFormulaOfChapterOneIsTheSourceOfAFile) {
  std::set<int> covered;
  for (const std::filesystem::path& path : case_files(kFolder)) {
    // "after (1.10)" is about what follows that formula.
    const std::string source =
        std::regex_replace(read_case(path).source, std::regex(R"((after|before) \(1\.\d+\))"), "");
    const std::regex number(R"(\(1\.(\d+)\))");
    for (std::sregex_iterator it(source.begin(), source.end(), number), end; it != end; ++it)
      covered.insert(std::stoi((*it)[1]));
  }
  std::set<int> expected;
  for (int formula = 1; formula <= 78; ++formula) expected.insert(formula);
  EXPECT_EQ(covered, expected);
}

// Where the print is wrong, with the file that refutes it and proves what is right.
TEST(Book, EveryMisprintHasAFileThatRefutesIt) {
  const std::vector<std::pair<std::string, std::string>> misprints = {
      {"bivector before (1.9)", "1.05-bracket-in-coordinates"},
      {"sum over i, j in the symplectic form", "1.06-canonical-form"},
      {"form on a leaf", "1.06-canonical-form"},
      {"(1.21)", "1.21-quasi-velocities"},
      {"after (1.21)", "1.21-contraction"},
      {"(1.25)", "1.25-frame-of-two"},
      {"(1.26), first line", "1.26-linear-fields"},
      {"after (1.27)", "1.27-exponential"},
      {"after (1.31)", "1.28-euler-angles"},
      {"before (1.33), dy/dt", "1.33-stereographic"},
      {"after (1.41), index form", "1.41-quaternion"},
      {"(1.43)", "1.43-andoyer-printed"},
      {"after (1.43), inverse for g", "1.43-andoyer-vertical"},
      {"after (1.50), matrix form", "1.50-poincare-so3"},
      {"(1.63)", "1.63-fixed-frame"},
      {"(1.78)", "1.78-kinetic-energy"},
  };
  for (const auto& [place, file] : misprints) {
    const CaseFile text = read_case(kFolder / (file + ".toml"));
    const auto printed = std::count_if(
        text.identities.begin(), text.identities.end(),
        [](const IdentityText& identity) { return identity.name.value.starts_with("printed: "); });
    EXPECT_GT(printed, 0) << place;
    EXPECT_LT(printed, static_cast<std::ptrdiff_t>(text.identities.size())) << place;
  }
}

TEST(Book, KnownUndecidedClaimsExist) {
  for (const auto& [file, name] : kKnownUndecided) {
    const std::vector<Proof> claims = pending(build_model(read_case(kFolder / (file + ".toml"))));
    EXPECT_TRUE(
        std::any_of(claims.begin(), claims.end(),
                    [&, expected = name](const Proof& claim) { return claim.name == expected; }))
        << file << ": " << name;
  }
}

}  // namespace
}  // namespace casimir::test

// Certificates: Coq accepts those of true claims and rejects them when one coefficient is changed.
#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// Exit status of coqc on a file of the folder.
int coqc(const Folder& folder, const std::string& file) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.path().c_str()) != 0) _exit(126);
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    execlp("coqc", "coqc", file.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

class Certificate : public testing::TestWithParam<const char*> {};

TEST_P(Certificate, IsAcceptedByCoqAndRejectedWhenTamperedWith) {
  const Folder folder;
  ASSERT_EQ(run_in(folder, {"verify", GetParam(), "--quiet", "--certificate", "right.v"}).status,
            0);
  EXPECT_EQ(coqc(folder, "right.v"), 0);
  // One sign in the last function that is defined: its derivatives are no longer what they say.
  std::string text = file_text(folder.path() / "right.v");
  const std::size_t place = text.find(" + ", text.rfind("Definition hamiltonian "));
  text.replace(place, 3, " - ");
  folder.write("wrong.v", text);
  EXPECT_EQ(coqc(folder, "wrong.v"), 1);
}

INSTANTIATE_TEST_SUITE_P(Cases, Certificate,
                         testing::Values("kovalevskaya", "clebsch", "steklov",
                                         "goryachev-chaplygin", "henon-heiles"),
                         [](const auto& name) {
                           std::string text = name.param;
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

TEST(CertificateOf, CandidateOnALevel) {
  const Folder folder;
  ASSERT_EQ(run_in(folder,
                   {"verify", "goryachev-chaplygin", "--integral", "M3*(M1^2 + M2^2)/3 + r*M1*g3/3",
                    "--on", "M1*g1 + M2*g2 + M3*g3", "--certificate", "g.v"})
                .status,
            0);
  EXPECT_EQ(coqc(folder, "g.v"), 0);
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

}  // namespace
}  // namespace casimir::test

// Claims that have no meaning, since what they are about has a value nowhere.
#include <gtest/gtest.h>

#include <string>

#include "symbolic/error.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

const std::string kTwoDegrees =
    "[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n";

Proof integral_named(const Model& model, const std::string& name) {
  for (const Proof& proof : prove(model))
    if (proof.name == name) return proof;
  ADD_FAILURE() << "no claim is called " << name;
  return {};
}

// sin^2 + cos^2 is 1 by a relation, which the reader of the file does not see.
TEST(MeaninglessClaim, IsUndecidedAndTheOthersOfTheFileAreDecided) {
  const Model model =
      model_of("hamiltonian = \"(px^2 + py^2)/2\"\nintegrable = true\n" + kTwoDegrees +
               "[integrals]\nnowhere = \"py/(sin(x)^2 + cos(x)^2 - 1)\"\n"
               "logarithm = \"log(sin(x)^2 + cos(x)^2 - 1)\"\nF = \"py\"\nG = \"x*py\"\n");
  for (const char* name : {"nowhere", "logarithm"}) {
    const Proof proof = integral_named(model, name);
    EXPECT_EQ(proof.verdict, Verdict::undecided) << name;
    EXPECT_NE(proof.reason.find("value nowhere"), std::string::npos) << proof.reason;
  }
  EXPECT_EQ(integral_named(model, "F").verdict, Verdict::proved);
  EXPECT_EQ(integral_named(model, "G").verdict, Verdict::refuted);
}

TEST(MeaninglessClaim, ThatIsAskedForIsAnError) {
  const Model model = model_of("hamiltonian = \"(px^2 + py^2)/2\"\n" + kTwoDegrees);
  Candidates candidates;
  candidates.integrals = {{"1/(sin(x)^2 + cos(x)^2 - 1)", {"test", 1, 1}, "f"}};
  EXPECT_THROW(prove(model, candidates), NoValue);
}

TEST(MeaninglessClaim, OfTheFileLeavesCandidatesDecided) {
  const Model model = model_of("hamiltonian = \"(px^2 + py^2)/2\"\n" + kTwoDegrees +
                               "[integrals]\nnowhere = \"1/(sin(x)^2 + cos(x)^2 - 1)\"\n");
  Candidates candidates;
  candidates.integrals = {{"py", {"test", 1, 1}, "py"}};
  EXPECT_EQ(prove(model, candidates).at(0).verdict, Verdict::proved);
}

TEST(MeaninglessClaim, OfACaseWithoutMeaningIsAnError) {
  const Model model = model_of("hamiltonian = \"px^2/(sin(x)^2 + cos(x)^2 - 1)\"\n" + kTwoDegrees +
                               "[integrals]\nF = \"py\"\n");
  EXPECT_THROW(prove(model), ModelError);
}

}  // namespace
}  // namespace casimir::test

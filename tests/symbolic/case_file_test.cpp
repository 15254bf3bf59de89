// What a case file says of itself by its expressions.
#include "symbolic/case_file.hpp"

#include <gtest/gtest.h>

namespace casimir::test {
namespace {

bool is_complex(const std::string& before, const std::string& after = "", const char* rate = "-x") {
  return parse_case(
             before + "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\ny = \"" +
                 rate + "\"\n" + after,
             "test.toml")
      .complex_numbers;
}

// A title, a name and a comment are words; a key is none of them.
TEST(ImaginaryUnit, IsThatOfExpressions) {
  EXPECT_FALSE(is_complex("title = \"Appendix I\"\nsource = 'I'\ntags = [\"I\"]\n"));
  EXPECT_FALSE(
      is_complex("", "[[conditional]]\nname = \"I\"\nexpression = \"x\"  # I\non = [\"y\"]\n"));
  EXPECT_FALSE(is_complex("", "[integrals]\nF = \"Ix + x_I\"\n", "I1"));
  EXPECT_FALSE(is_complex(
      "", "[section]\nfunction = \"x\"\nplot = [\"x\", \"y\"]\nlabels = [\"I\", \"L\"]\n"));
  EXPECT_TRUE(is_complex(
      "", "[section]\nfunction = \"x\"\nplot = [\"I*x\", \"y\"]\nlabels = [\"l\", \"L\"]\n"));
  EXPECT_TRUE(is_complex("", "[integrals]\nlabels = \"I*x\"\n"));
  EXPECT_TRUE(is_complex("", "", "I*x"));
  EXPECT_TRUE(is_complex("", "[integrals]\ntitle = \"I*x\"\n"));
  EXPECT_TRUE(is_complex("", "[integrals]\nF = '''x # \\\\\n  + I'''\n"));
  EXPECT_TRUE(
      is_complex("", "[[conditional]]\nname = \"\\\\\"\nexpression = \"I*x\"\non = [\"y\"]\n"));
}

}  // namespace
}  // namespace casimir::test

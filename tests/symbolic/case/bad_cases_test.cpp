// Each file of tests/bad_cases says on its first line where its error is and what it must say.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/bundled_cases.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

struct Expected {
  std::string line, column, fragment;
};

Expected expectation(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::string head;
  std::getline(stream, head);
  const std::string mark = "# expect: ";
  if (!head.starts_with(mark)) return {};
  head.erase(0, mark.size());
  const std::size_t first = head.find(':');
  const std::size_t second = head.find(':', first + 1);
  return {head.substr(0, first), head.substr(first + 1, second - first - 1),
          head.substr(second + 2)};
}

class BadCase : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(BadCase, IsRefusedWithThePlaceOfTheError) {
  const Expected expected = expectation(GetParam());
  ASSERT_FALSE(expected.fragment.empty())
      << "the file must begin with '# expect: LINE:COLUMN: text'";
  try {
    build_model(read_case(GetParam()));
    FAIL() << "accepted";
  } catch (const CaseError& error) {
    if (expected.line != "*") {
      EXPECT_EQ(std::to_string(error.where().line), expected.line) << error.what();
    }
    if (expected.column != "*") {
      EXPECT_EQ(std::to_string(error.where().column), expected.column) << error.what();
    }
    EXPECT_NE(std::string(error.what()).find(expected.fragment), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Files, BadCase,
                         testing::ValuesIn(case_files(CASIMIR_SOURCE_DIR "/tests/bad_cases")),
                         [](const auto& file) { return test_name_of(file.param); });

TEST(ReadCase, NamesTheFileThatDoesNotExist) {
  try {
    read_case("/no/such/case.toml");
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_STREQ(error.what(),
                 "/no/such/case.toml: error: the case file does not exist or cannot be read");
  }
}

TEST(ReadCase, ShowsTheLineAndAMarkBelowThePlace) {
  try {
    euler_with("[integrals]\nF = \"M1^2 + M4\"");
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_STREQ(error.what(),
                 "test.toml:3:13: error: 'M4' is not declared\n"
                 "  F = \"M1^2 + M4\"\n"
                 "              ^\n"
                 "  hint: did you mean 'M1'?");
  }
}

}  // namespace
}  // namespace casimir::test

// Case files to start from: each is proved as it stands, and nothing is written over.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "symbolic/lie_algebra.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// Every named algebra of the library; of families some members.
std::vector<std::string> algebras() {
  std::vector<std::string> result;
  for (const std::string& name : lie_algebra_names()) {
    if (name.find_first_of("nk") == std::string::npos) {
      result.push_back(name);
      continue;
    }
    for (const char* number : {"1", "2", "3", "5", "8"}) {
      const std::string member = std::regex_replace(name, std::regex("[nk]"), number);
      if (find_lie_algebra(member)) result.push_back(member);
    }
  }
  return result;
}

TEST(New, EveryNamedAlgebraHasAFileThatIsProved) {
  ASSERT_GE(algebras().size(), 16U);
  for (const std::string& algebra : algebras()) {
    const Folder folder;
    ASSERT_EQ(run_in(folder, {"new", "mine", "--algebra", algebra}).status, 0) << algebra;
    const Outcome outcome = run_in(folder, {"verify", "mine.toml", "--json"});
    ASSERT_EQ(outcome.status, 0) << algebra << outcome.err;
    std::size_t casimirs = 0;
    const auto json = outcome.json();
    for (const auto& claim : json.at("claims")) casimirs += claim.at("kind") == "casimir" ? 1 : 0;
    EXPECT_GE(casimirs, 1U) << algebra;
  }
}

TEST(New, WritesACaseThatIsProved) {
  const Folder folder;
  EXPECT_EQ(run_in(folder, {"new", "mine"}).status, 0);
  EXPECT_EQ(run_in(folder, {"verify", "mine.toml"}).status, 0);
  EXPECT_EQ(run_in(folder, {"conserve", "./mine.toml"}).status, 0);
  EXPECT_EQ(run_in(folder, {"new", "mine"}).status, 2) << "must not overwrite";
  EXPECT_EQ(run_in(folder, {"new", "../mine"}).status, 2);
}

TEST(New, InvariantsStayConstant) {
  for (const std::string algebra : {"e(3)", "so(3,1)", "l(7)", "so(5)"}) {
    const Folder folder;
    run_in(folder, {"new", "mine", "--algebra", algebra, "--quiet"});
    const Outcome outcome =
        run_in(folder, {"conserve", "mine.toml", "--method", "taylor", "--json"});
    EXPECT_EQ(outcome.status, 0) << algebra << outcome.out << outcome.err;
  }
}

TEST(New, OtherPhaseSpaces) {
  const std::vector<std::vector<std::string>> spaces{
      {"--canonical", "1"}, {"--canonical", "3"}, {"--equations", "2"}, {"--equations", "5"}};
  for (const auto& space : spaces) {
    const Folder folder;
    ASSERT_EQ(run_in(folder, {"new", "mine", space[0], space[1]}).status, 0) << space[0];
    const Outcome outcome = run_in(folder, {"verify", "mine.toml", "--json"});
    EXPECT_EQ(outcome.status, 0) << space[0] << outcome.err;
    EXPECT_NE(outcome.out.find("\"integral\""), std::string::npos);
    EXPECT_EQ(run_in(folder, {"conserve", "mine.toml", "--method", "taylor"}).status, 0);
  }
  EXPECT_EQ(run({"new", "mine", "--canonical", "0"}).status, 2);
  EXPECT_EQ(run({"new", "mine", "--equations", "1"}).status, 2);
  EXPECT_EQ(run({"new", "mine", "--canonical", "2", "--algebra", "e(3)"}).status, 2);
}

TEST(New, KeysThatAreCommentedOutCanBeSwitchedOn) {
  const std::regex key(R"((^|\n)# ((\[\[\w+\]\]|(?!integrable)\w+ =)))");
  const std::vector<std::vector<std::string>> spaces{
      {"--algebra", "e(3)"}, {"--algebra", "so(4)"}, {"--canonical", "2"}, {"--equations", "3"}};
  for (const auto& space : spaces) {
    const Folder folder;
    run_in(folder, {"new", "mine", space[0], space[1], "--quiet"});
    const std::string plain = file_text(folder.path() / "mine.toml");
    const std::string all = std::regex_replace(plain, key, "$1$2");
    EXPECT_EQ(plain.size() - all.size(), 2 * std::size_t{9}) << all;
    folder.write("mine.toml", all);
    const Outcome outcome = run_in(folder, {"verify", "mine.toml", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const auto json = outcome.json();
    EXPECT_EQ(json.at("verdict"), "proved") << space[1];
    EXPECT_NE(json.dump().find("\"conditional\""), std::string::npos);
  }
}

TEST(New, NothingIsWrittenOver) {
  const Folder folder;
  folder.write("mine.toml", "precious");
  const Outcome outcome = run_in(folder, {"new", "mine", "--algebra", "e(3)"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("--force"), std::string::npos) << outcome.err;
  EXPECT_EQ(file_text(folder.path() / "mine.toml"), "precious");
  EXPECT_EQ(run_in(folder, {"new", "other", "--output", "mine.toml"}).status, 2);
  EXPECT_EQ(file_text(folder.path() / "mine.toml"), "precious");
  EXPECT_EQ(run_in(folder, {"new", "other", "--output", "mine.toml", "--force"}).status, 0);
  EXPECT_EQ(run_in(folder, {"verify", "./mine.toml"}).status, 0);
  EXPECT_EQ(folder.files(), 1U);
}

TEST(New, AnUnknownAlgebraIsAnErrorWithTheNearest) {
  const Folder folder;
  for (const auto& [given, nearest] : {std::pair("e3", "'e(3)'"), std::pair("SO(4)", "'so(4)'"),
                                       std::pair("so(3;1)", "'so(3,1)'")}) {
    const Outcome outcome = run_in(folder, {"new", "mine", "--algebra", given});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(nearest), std::string::npos) << outcome.err;
  }
  EXPECT_NE(run_in(folder, {"new", "mine", "--algebra", "octonions"}).err.find("l(7)"),
            std::string::npos);
  EXPECT_EQ(folder.files(), 0U);
}

}  // namespace
}  // namespace casimir::test

// The survey: what it counts, in which order, and which files it writes or refuses to write.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

const Environment kBundled{{"CASIMIR_CASES", CASIMIR_SOURCE_DIR "/cases"}};

/// A case of that section of the book; `more` are lines of its file.
std::string oscillator(const std::string& book, const std::string& more = {}) {
  return "title = \"a | b\"\nbook = \"" + book +
         "\"\ntags = [\"oscillators\"]\nhamiltonian = \"(p^2 + w*q^2)/2\"\n[phase_space]\n"
         "variables = [\"q\", \"p\"]\ncanonical = true\n[parameters]\nw = {}\n" +
         more +
         "\n[[scene]]\nname = \"default\"\nparameters = { w = \"1\" }\ninitial = { q = \"1\", p = "
         "\"0\" }\nduration = \"1\"\n";
}

const char* const kRefuted = "[integrals]\nF = \"p\"\n";

TEST(Survey, TheTableOfTheCasesIsWhatTheToolWrites) {
  const std::string path = CASIMIR_SOURCE_DIR "/cases/README.md";
  const Folder folder;
  folder.write("README.md", file_text(path));
  const Outcome outcome = run_in(folder, {"survey", "--output", "README.md"}, {}, kBundled);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(file_text(folder.path() / "README.md"), file_text(path))
      << "the cases have changed; run: build/casimir survey --output cases/README.md";
}

TEST(Survey, TagsOfTheTableAreThoseOfTheCases) {
  const std::string text = file_text(CASIMIR_SOURCE_DIR "/cases/README.md");
  const std::size_t begin = text.find("| tag | systems |");
  const std::string table = text.substr(begin, text.find("## Survey") - begin);
  std::set<std::string> explained, used;
  const std::regex kTag("`([^`]+)`");
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    const std::string first = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator it(first.begin(), first.end(), kTag), end; it != end; ++it)
      explained.insert((*it)[1]);
  }
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"list", "--json"}, {"list", "--tag", "map", "--json"}}) {
    const auto list = run(arguments).json();
    for (const auto& entry : list.at("cases"))
      for (const auto& tag : entry.at("tags")) used.insert(tag.get<std::string>());
  }
  for (const std::string& tag : explained) EXPECT_TRUE(used.contains(tag)) << tag;
  for (const std::string& tag : used) {
    const bool of_the_book = tag.starts_with("chapter-") || tag.starts_with("appendix-");
    EXPECT_TRUE(of_the_book || explained.contains(tag)) << tag;
  }
}

TEST(Survey, RowsStandInTheOrderOfTheBook) {
  const Folder folder;
  std::vector<std::string> arguments{"survey", "--json"};
  const std::vector<std::pair<std::string, std::string>> cases{{"none", ""},
                                                               {"appendix-g", "G"},
                                                               {"section-2-10", "2.10"},
                                                               {"section-2-4b", "2.4"},
                                                               {"alone", ""},
                                                               {"appendix-b", "B"},
                                                               {"section-2-4a", "2.4"},
                                                               {"section-10-1", "10.1"},
                                                               {"whole-2", "2"},
                                                               {"appendix-b-2", "B.2"},
                                                               {"section-2-4-1", "2.4.1"}};
  for (const auto& [name, book] : cases)
    arguments.push_back(folder.write(name + ".toml", oscillator(book)));
  const Outcome outcome = run(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::vector<std::string> order;
  const auto json = outcome.json();
  for (const auto& row : json.at("rows")) order.push_back(row.at("case"));
  EXPECT_EQ(order,
            (std::vector<std::string>{"whole-2", "section-2-4a", "section-2-4b", "section-2-4-1",
                                      "section-2-10", "section-10-1", "appendix-b", "appendix-b-2",
                                      "appendix-g", "alone", "none"}));
}

TEST(Survey, CountsAsVerifyAndGenerateDo) {
  const Folder folder;
  const auto json = run({"survey", "kovalevskaya", "--json"}).json();
  EXPECT_EQ(json.at("failed"), 0);
  const auto row = json.at("rows").at(0);
  EXPECT_EQ(row.at("case"), "kovalevskaya");
  EXPECT_TRUE(row.contains("book"));
  EXPECT_EQ(row.at("title"), "Kovalevskaya top");
  EXPECT_EQ(row.at("dimension"), 6);
  EXPECT_EQ(row.at("phase_space"), "e(3)");
  EXPECT_EQ(row.at("verdict"), "proved");
  EXPECT_EQ(row.at("scenes").at(0), "default");
  EXPECT_EQ(row.at("scene"), "default");
  EXPECT_EQ(row.at("states"), (nlohmann::ordered_json{{"all", 6}, {"kept", 6}}));
  const auto verified = run({"verify", "kovalevskaya", "--json"}).json();
  EXPECT_EQ(row.at("claims").at("counted"),
            verified.at("claims").size() + verified.at("facts").size());
  EXPECT_EQ(row.at("claims").at("proved"), row.at("claims").at("counted"));
  const auto generated = run_in(folder, {"generate", "kovalevskaya", "-o", "k.hpp", "--json"});
  EXPECT_EQ(row.at("operations").at("general"), generated.json().at("operations").at("general"));
  EXPECT_EQ(row.at("operations").at("specialised"),
            generated.json().at("operations").at("specialised"));
}

TEST(Survey, ARefutedOrUndecidedClaimIsSeen) {
  const Folder folder;
  const std::string good = folder.write("good.toml", oscillator("1.1"));
  const std::string bad = folder.write("bad.toml", oscillator("1.2", kRefuted));
  const std::string open = folder.write(
      "open.toml", oscillator("1.3", "[integrals]\nF = \"(p + q + w + p*q + p*w + 1)^300\"\n"));
  const Outcome refuted = run({"survey", good, bad, open, "--json"});
  EXPECT_EQ(refuted.status, 1) << refuted.err;
  EXPECT_EQ(refuted.json().at("failed"), 2);
  EXPECT_EQ(refuted.json().at("rows").at(1).at("claims").at("refuted"), 1);
  EXPECT_EQ(run({"survey", good, open}).status, 3);
  EXPECT_NE(run({"survey", bad}).out.find("2 of 3"), std::string::npos) << run({"survey", bad}).out;
}

TEST(Survey, ACaseWithoutScenesHasNoOperations) {
  const Folder folder;
  const std::string text = oscillator("1.1");
  const std::string path = folder.write("still.toml", text.substr(0, text.find("[[scene]]")));
  const Outcome outcome = run({"survey", path, "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(outcome.json().at("rows").at(0).contains("operations"));
  EXPECT_TRUE(outcome.json().at("rows").at(0).at("scenes").empty());
  EXPECT_EQ(run({"survey", path, "--scene", "default"}).status, 2);
}

TEST(Survey, OnlyWhatStandsBetweenTheMarksIsReplaced) {
  const Folder folder;
  folder.write("a.toml", oscillator("1.1"));
  const std::string before = "# Mine\n`<!-- survey -->` is a mark\n<!-- survey -->\n";
  const std::string after = "<!-- /survey -->\nno line at the end";
  folder.write("page.md", before + "old\n" + after);
  const Outcome outcome = run_in(folder, {"survey", "./a.toml", "--output", "page.md"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = file_text(folder.path() / "page.md");
  EXPECT_TRUE(page.starts_with(before)) << page;
  EXPECT_TRUE(page.ends_with(after)) << page;
  EXPECT_EQ(page.find("old"), std::string::npos);
  EXPECT_NE(page.find("| a | 1.1 | a \\| b | canonical | 2 | "), std::string::npos) << page;
  run_in(folder, {"survey", "./a.toml", "--output", "page.md"});
  EXPECT_EQ(file_text(folder.path() / "page.md"), page) << "the second time nothing changes";
}

TEST(Survey, APageWithoutMarksIsRefusedAndANewOneHasThem) {
  const Folder folder;
  folder.write("a.toml", oscillator("1.1"));
  for (const char* text : {"mine\n", "<!-- survey -->\n", "<!-- /survey -->\n<!-- survey -->\n",
                           "<!-- survey -->\n<!-- survey -->\n<!-- /survey -->\n"}) {
    folder.write("page.md", text);
    const Outcome outcome = run_in(folder, {"survey", "./a.toml", "--output", "page.md"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("<!-- /survey -->"), std::string::npos) << outcome.err;
    EXPECT_EQ(file_text(folder.path() / "page.md"), text);
  }
  EXPECT_EQ(run_in(folder, {"survey", "./a.toml", "--output", "new.md"}).status, 0);
  EXPECT_EQ(run_in(folder, {"survey", "./a.toml", "--output", "new.md"}).status, 0);
  EXPECT_EQ(run_in(folder, {"survey", "./a.toml", "--output", "new.md", "--format", "csv"}).status,
            2);
  EXPECT_EQ(run_in(folder, {"survey", "./a.toml", "--output", "no/such/folder.md"}).status, 4);
  EXPECT_EQ(folder.files(), 3U);
}

TEST(Survey, CsvHasOneLineACase) {
  const Folder folder;
  folder.write("a.toml", oscillator("1.1"));
  ASSERT_EQ(run_in(folder, {"survey", "./a.toml", "--output", "s.csv"}).status, 0);
  std::istringstream csv(file_text(folder.path() / "s.csv"));
  std::string head, row, rest;
  std::getline(csv, head);
  std::getline(csv, row);
  EXPECT_TRUE(head.starts_with("case,book,title,dimension,phase_space,verdict,proved")) << head;
  EXPECT_TRUE(row.starts_with("a,1.1,a | b,2,canonical,proved,")) << row;
  EXPECT_EQ(std::ranges::count(head, ','), std::ranges::count(row, ','));
  EXPECT_FALSE(std::getline(csv, rest));
  EXPECT_EQ(run_in(folder, {"survey", "./a.toml", "--format", "csv"}).out,
            head + "\n" + row + "\n");
}

TEST(Tags, AnUnknownOneIsAnErrorWithTheNearest) {
  const Folder folder;
  folder.write("one.toml", oscillator("2.4"));
  const Environment here{{"CASIMIR_CASES", folder.path().string()}};
  for (const char* command : {"list", "survey"}) {
    const Outcome outcome = run({command, "--tag", "oscilators"}, {}, here);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_NE(outcome.err.find("did you mean 'oscillators'?"), std::string::npos) << outcome.err;
    const auto json = run({command, "--tag", "oscillators", "--json"}, {}, here).json();
    EXPECT_EQ(json.at(std::string(command) == "list" ? "cases" : "rows").size(), 1U);
  }
  EXPECT_EQ(run({"survey", "euler", "--tag", "oscillators"}, {}, here).status, 2);
}

TEST(List, ShowsTheSectionOfTheBook) {
  const Folder folder;
  folder.write("one.toml", oscillator("2.4"));
  folder.write("two.toml", oscillator("G"));
  const Environment here{{"CASIMIR_CASES", folder.path().string()}};
  const Outcome outcome = run({"list", "--tag", "oscillators"}, {}, here);
  EXPECT_NE(outcome.out.find("(Sec. 2.4)"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("(App. G)"), std::string::npos) << outcome.out;
  const auto json = run({"list", "--tag", "oscillators", "--json"}, {}, here).json();
  EXPECT_EQ(json.at("cases").at(0).at("book"), "2.4");
}

}  // namespace
}  // namespace casimir::test

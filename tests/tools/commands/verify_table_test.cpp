// The tables of `casimir verify`: what a person reads at a glance.
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>

#include <regex>

#include "symbolic/proof/claims/claim_kinds.hpp"
#include "tests/tools/program.hpp"
#include "tools/text/proofs/claim_words.hpp"

namespace casimir::test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t longest(const std::vector<std::string>& lines) {
  std::size_t result = 0;
  for (const std::string& line : lines) result = std::max(result, line.size());
  return result;
}

const std::regex kRow(R"((proved|refuted|undecided) .*)");

/// What the program writes to a terminal of so many columns.
std::string on_terminal(const std::vector<std::string>& arguments, unsigned short columns,
                        const char* no_colour = nullptr) {
  winsize size = {};
  size.ws_col = columns;
  size.ws_row = 50;
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    if (no_colour != nullptr) setenv("NO_COLOR", no_colour, 1);
    execute(arguments);
  }
  std::string text;
  std::array<char, 4096> chunk;
  for (ssize_t n = 0; (n = read(terminal, chunk.data(), chunk.size())) > 0;)
    text.append(chunk.data(), static_cast<std::size_t>(n));
  close(terminal);
  waitpid(child, nullptr, 0);
  std::erase(text, '\r');
  return text;
}

const char* const kNothingClaimed = R"toml(
[phase_space]
variables = ["x", "y"]
[equations]
x = "y"
y = "-x + y*(1 - x^2)"
[[scene]]
name = "default"
initial = { x = "1", y = "0" }
duration = "5"
)toml";

TEST(VerifyTable, ColumnsStandBelowTheirHeadings) {
  const auto lines = lines_of(run({"verify", "kovalevskaya"}).out);
  std::string heading;
  std::size_t rows = 0;
  for (const std::string& line : lines) {
    if (line.starts_with("verdict ")) heading = line;
    if (!std::regex_match(line, kRow) || line.find(" claims:") != std::string::npos) continue;
    ASSERT_FALSE(heading.empty()) << line;
    ++rows;
    for (const char* column : {"claim", "name"}) {
      const std::size_t place = heading.find(column);
      EXPECT_EQ(line.substr(place - 2, 2), "  ") << line;
      EXPECT_NE(line[place], ' ') << line;
    }
    const std::size_t end_of_time = heading.find("time") + 4;
    EXPECT_EQ(line.substr(end_of_time - 1, 1), "s") << line;
  }
  EXPECT_GE(rows, 10U);
  EXPECT_LE(longest(lines), 100U);
}

TEST(VerifyTable, NothingButVerdictsStandsInTheirColumn) {
  const auto lines = lines_of(run({"verify", "kovalevskaya"}).out);
  std::size_t evidence = 0;
  for (std::size_t i = 3; i < lines.size(); ++i) {  // below the heading
    if (lines[i].empty() || lines[i].starts_with("facts") || lines[i].starts_with("beside"))
      continue;
    if (std::regex_match(lines[i], kRow)) continue;
    EXPECT_EQ(lines[i].substr(0, 13), std::string(13, ' ')) << lines[i];
    ++evidence;
  }
  EXPECT_GE(evidence, 5U);
}

TEST(VerifyTable, SummaryCountsWhatDecidesTheVerdict) {
  EXPECT_NE(run({"verify", "kovalevskaya"})
                .out.find("proved     12 claims: 12 proved, 0 refuted, 0 undecided"),
            std::string::npos);
  // Without `integrable = true` the same facts do not count.
  std::string text = file_text(CASIMIR_SOURCE_DIR "/cases/kovalevskaya.toml");
  text = std::regex_replace(text, std::regex("integrable = true"), "");
  const std::string out = run({"verify", "-"}, text).out;
  EXPECT_NE(out.find("facts, which do not count"), std::string::npos) << out;
  EXPECT_NE(
      out.find("proved     9 claims: 9 proved, 0 refuted, 0 undecided (and 3 facts beside); "),
      std::string::npos)
      << out;
}

TEST(VerifyTable, SummaryNamesConditionsOnlyOfWhatIsProved) {
  // The density log(x*y) is one on parts of the domain; 1/x is none at all.
  const std::string text =
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"x\"\n"
      "y = \"-y\"\n[[measure]]\ndensity = \"log(x*y)\"\n";
  const auto last_line = [](const std::string& out) { return lines_of(out).back(); };
  const std::string proved = last_line(run({"verify", "-"}, text).out);
  EXPECT_TRUE(proved.starts_with("proved")) << proved;
  EXPECT_NE(proved.find(" where "), std::string::npos) << proved;
  const std::string refuted =
      last_line(run({"verify", "-"}, text + "[[measure]]\ndensity = \"1/x\"\n").out);
  EXPECT_TRUE(refuted.starts_with("refuted")) << refuted;
  EXPECT_EQ(refuted.find(" where "), std::string::npos) << refuted;
}

TEST(VerifyTable, RefutationShowsResidualWitnessAndValue) {
  const std::string good = "M1^2 + M2^2 + 2*M3^2 - 2*r*g1";
  const std::string bad = "M1^2 + M2^2 + 2*M3^2 + 2*r*g1";
  const std::string proved = run({"verify", "kovalevskaya", "--integral", good}).out;
  const std::string refuted = run({"verify", "kovalevskaya", "--integral", bad}).out;
  for (const char* label : {"reason ", "residual ", "witness ", "value "}) {
    EXPECT_EQ(proved.find(label), std::string::npos) << proved;
    EXPECT_NE(refuted.find(std::string(13, ' ') + label), std::string::npos) << refuted;
  }
  EXPECT_NE(refuted.find("refuted    1 claim: 0 proved, 1 refuted, 0 undecided; "),
            std::string::npos)
      << refuted;
  EXPECT_NE(refuted.find("M1 = "), std::string::npos);
}

TEST(VerifyTable, UndecidedShowsTheReason) {
  const Outcome outcome =
      run({"verify", "kovalevskaya", "--integral", "(M1+M2+M3+g1+g2+g3+r)^300"});
  EXPECT_NE(outcome.out.find("reason    an expanded power"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("0 proved, 0 refuted, 1 undecided"), std::string::npos);
}

TEST(VerifyTable, LongNamesAreWrappedInTheirColumn) {
  std::string sum = "M1";
  for (int i = 0; i < 20; ++i) sum += " + 0*M1*M2*g1";
  const auto spaced = lines_of(run({"verify", "kovalevskaya", "--integral", sum}).out);
  EXPECT_LE(longest(spaced), 100U);
  std::erase(sum, ' ');
  EXPECT_LE(longest(lines_of(run({"verify", "kovalevskaya", "--integral", sum}).out)), 100U);
}

TEST(VerifyTable, AllIsOneLineACaseAndATotal) {
  const Outcome outcome = run({"verify", "--all", "--tag", "chapter-2"});
  EXPECT_EQ(outcome.status, 0);
  const auto lines = lines_of(outcome.out);
  const auto json = run({"verify", "--all", "--tag", "chapter-2", "--json"}).json();
  ASSERT_EQ(lines.size(), json.at("cases").size() + 3);  // a heading, an empty line, the total
  for (std::size_t i = 0; i < json.at("cases").size(); ++i) {
    const std::string name = json.at("cases").at(i).at("case");
    EXPECT_TRUE(lines[i + 1].starts_with("proved     " + name + " ")) << lines[i + 1];
    // What the verdict depends on comes last.
    const bool has_conditions = json.at("cases").at(i).contains("where");
    EXPECT_EQ(lines[i + 1].find("  where "), has_conditions ? lines[0].size() : std::string::npos)
        << lines[i + 1];
    if (!has_conditions) EXPECT_EQ(lines[i + 1].size(), lines[0].size());
  }
  EXPECT_TRUE(std::regex_match(
      lines.back(),
      std::regex(R"(proved     \d+ cases, (\d+) claims: \1 proved, 0 refuted, 0 undecided; .*s)")))
      << lines.back();
}

TEST(VerifyTable, AllShowsTheOffendingClaims) {
  const Folder folder;
  std::string text = file_text(CASIMIR_SOURCE_DIR "/cases/euler.toml");
  folder.write("bent.toml", text + "\n[integrals]\nWRONG = \"M1\"\n");
  const Outcome outcome = run({"verify", "--all", "--tag", "free-body"}, {},
                              {{"CASIMIR_CASES", folder.path().string()}});
  EXPECT_EQ(outcome.status, 1);
  const auto lines = lines_of(outcome.out);
  const auto bent = std::ranges::find_if(
      lines, [](const std::string& line) { return line.starts_with("refuted    bent "); });
  ASSERT_NE(bent, lines.end()) << outcome.out;
  EXPECT_TRUE(std::regex_match(*(bent + 1), std::regex(R"( +refuted +integral +WRONG .*)")))
      << *(bent + 1);
  EXPECT_NE(outcome.out.find("witness "), std::string::npos);
  EXPECT_TRUE(lines.back().starts_with("refuted  ")) << lines.back();
}

TEST(VerifyTable, TerminalSetsTheWidthAndAllowsColour) {
  const std::string narrow = on_terminal({"verify", "kovalevskaya"}, 72);
  EXPECT_NE(narrow.find("\x1b[32mproved"), std::string::npos);
  const std::string plain = std::regex_replace(narrow, std::regex("\x1b\\[\\d+m"), "");
  EXPECT_LE(longest(lines_of(plain)), 72U) << plain;
  const std::string wide = on_terminal({"verify", "kovalevskaya"}, 200, "1");
  EXPECT_EQ(wide.find('\x1b'), std::string::npos);
  EXPECT_GT(longest(lines_of(wide)), 100U) << wide;
  EXPECT_EQ(run({"verify", "kovalevskaya"}).out.find('\x1b'), std::string::npos);
}

TEST(VerifyTable, EachKindOfClaimsHasItsWords) {
  for (const ClaimRow& row : claim_rows()) {
    const tools::ClaimWords& words = tools::claim_words(row.kind);
    EXPECT_EQ(words.kind, row.kind);
    EXPECT_FALSE(std::string(words.one).empty());
    EXPECT_NE(std::string(words.one), words.many);
    // What has a list of its own in a case, but matrices and maps, is shown below a heading.
    const bool list = row.clear && row.kind != ClaimKind::lax && row.kind != ClaimKind::map;
    if (list) EXPECT_NE(words.heading, nullptr) << to_string(row.kind);
  }
}

TEST(VerifyTable, OfACaseWithoutClaimsSaysSo) {
  const Outcome outcome = run({"verify", "-"}, kNothingClaimed);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\nnothing is claimed; "), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("proved"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace casimir::test

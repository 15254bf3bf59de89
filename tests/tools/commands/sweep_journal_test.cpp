// What a sweep keeps of what it has done, and how it goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/tools/commands/sweep_arguments.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// Waits until the journal has some points, then sends the sweep a signal.
bool kill_when_some_are_done(pid_t child, const Folder& folder, const std::string& journal,
                             int signal = SIGKILL) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < end) {
    if (file_text(folder.path() / journal).size() > 20000) {
      kill(child, signal);
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST(SweepJournal, GoesOnAfterAKill) {
  const Folder folder;
  const std::string points = "3000";
  const pid_t child = start(sweep_arguments(points, "killed.csv"), folder);
  ASSERT_TRUE(kill_when_some_are_done(child, folder, "killed.csv.journal"));
  EXPECT_EQ(finish(child, folder).status, 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "killed.csv")) << "it was too fast";
  // A torn last line and a damaged one are not there.
  const std::filesystem::path journal = folder.path() / "killed.csv.journal";
  std::string text = file_text(journal);
  const std::size_t second = text.find('\n', text.find('\n') + 1);
  text[second - 12] = text[second - 12] == '7' ? '8' : '7';
  text += "17,0,2";
  folder.write("killed.csv.journal", text);
  std::vector<std::string> arguments = sweep_arguments(points, "killed.csv");
  arguments.back() = "--json";
  const Outcome outcome = run_in(folder, arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = outcome.json();
  const std::size_t lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  EXPECT_EQ(json.at("resumed"), lines - 2) << "the head and the damaged line";
  EXPECT_EQ(json.at("points").get<std::size_t>(),
            json.at("resumed").get<std::size_t>() + json.at("computed").get<std::size_t>());
  EXPECT_FALSE(std::filesystem::exists(journal));
  ASSERT_EQ(run_in(folder, sweep_arguments(points, "whole.csv")).status, 0);
  EXPECT_TRUE(file_text(folder.path() / "killed.csv") == file_text(folder.path() / "whole.csv"));
}

TEST(SweepJournal, AnInterruptKeepsWhatIsDoneAndSaysSo) {
  const Folder folder;
  const pid_t child = start(sweep_arguments("200000", "s.csv"), folder);
  ASSERT_TRUE(kill_when_some_are_done(child, folder, "s.csv.journal", SIGINT));
  const Outcome outcome = finish(child, folder);
  EXPECT_EQ(outcome.status, 130);
  EXPECT_NE(outcome.err.find("the same command goes on"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.files(), 1U) << "the journal";
}

TEST(SweepJournal, ATimeLimitKeepsWhatIsDone) {
  const Folder folder;
  // On a busy machine the compiler may take all of a short limit: then nothing is kept, as is told.
  // Few points that take long, so that the table of them does not.
  Outcome outcome;
  for (const char* limit : {"0.5", "2", "8", "32"}) {
    std::vector<std::string> limited = sweep_arguments("28000", "s.csv", "2000");
    limited.insert(limited.end(), {"--time-limit", limit});
    outcome = run_in(folder, limited);
    EXPECT_EQ(outcome.status, 4) << outcome.err;
    if (std::filesystem::exists(folder.path() / "s.csv.journal")) break;
    EXPECT_NE(outcome.err.find("before any of"), std::string::npos) << outcome.err;
  }
  EXPECT_NE(outcome.err.find("s.csv.journal"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "s.csv"));
  // Another sweep does not go on from it.
  const Outcome other = run_in(folder, sweep_arguments("3", "s.csv"));
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("restart"), std::string::npos) << other.err;
  std::vector<std::string> again = sweep_arguments("3", "s.csv");
  again.emplace_back("--restart");
  EXPECT_EQ(run_in(folder, again).status, 0);
}

}  // namespace
}  // namespace casimir::test

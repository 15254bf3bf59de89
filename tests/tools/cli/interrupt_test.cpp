// Ctrl-C and SIGTERM: 130 and 143 within a second, nothing half-written, nothing left behind.
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

struct Long {
  const char* name;
  std::vector<std::string> arguments;
  /// When it is interrupted: all cases are verified in less than a second.
  std::chrono::milliseconds after{700};
};

void PrintTo(const Long& one, std::ostream* stream) { *stream << one.name; }

class Interrupt : public testing::TestWithParam<Long> {
 protected:
  void expect_end(int signal, int status) {
    const Folder folder, temporary;
    const pid_t child =
        start(GetParam().arguments, folder, {},
              {{"TMPDIR", temporary.path().string()}, {"CASIMIR_CACHE", temporary / "cache"}});
    std::this_thread::sleep_for(GetParam().after);
    const auto begin = std::chrono::steady_clock::now();
    kill(child, signal);
    const Outcome outcome = finish(child, folder);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      // Finished points of a sweep are kept on purpose; see sweep_test.
      EXPECT_EQ(entry.path().extension(), ".journal") << entry.path();
    }
    for (const auto& entry : std::filesystem::directory_iterator(temporary.path()))
      EXPECT_EQ(entry.path().filename(), "cache") << entry.path();
  }
};

TEST_P(Interrupt, CtrlCIs130) { expect_end(SIGINT, 130); }

TEST_P(Interrupt, SigtermIs143) { expect_end(SIGTERM, 143); }

INSTANTIATE_TEST_SUITE_P(
    All, Interrupt,
    testing::Values(
        Long{"Integrate", {"integrate", "euler", "--method", "taylor", "--duration", "1e9"}},
        Long{"IntegrateWithDigits",
             {"integrate", "kovalevskaya", "--digits", "400", "--duration", "1000", "--output",
              "x.csv"}},
        Long{"Conserve", {"conserve", "euler", "--duration", "1e9", "--output", "x.csv"}},
        Long{"ConserveAll", {"conserve", "--all", "--output", "x.csv"}},
        Long{"Sweep",
             {"sweep", "euler", "--over", "M1=1:2:2000", "--duration", "1e6", "--output", "x.csv"}},
        Long{"Search", {"search", "kovalevskaya-two-fields", "--degree", "12"}},
        Long{"VerifyAll", {"verify", "--all"}, std::chrono::milliseconds(250)},
        Long{"VerifyAllWithALimit",
             {"verify", "--all", "--time-limit", "600"},
             std::chrono::milliseconds(250)},
        Long{"Section",
             {"section", "kovalevskaya", "--orbits", "500", "--points", "5000", "--output",
              "x.csv"}},
        Long{"Bench", {"bench", "kovalevskaya", "--output", "x.csv"}},
        Long{"StressAll", {"stress", "--all", "--output", "x.csv"}},
        Long{"ReportAll", {"report", "--all", "--output", "x.html"}}),
    [](const auto& one) { return one.param.name; });

/// What a command shows on a terminal until it has shown `text`, or half a minute is over. The
/// command is interrupted then.
std::string shown_until(const std::vector<std::string>& arguments, const std::string& text) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) execute(arguments);
  std::string shown;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (shown.find(text) == std::string::npos && std::chrono::steady_clock::now() < end) {
    pollfd waiting{terminal, POLLIN, 0};
    if (poll(&waiting, 1, 200) <= 0) continue;
    char buffer[4096];
    const ssize_t count = read(terminal, buffer, sizeof buffer);
    if (count <= 0) break;
    shown.append(buffer, static_cast<std::size_t>(count));
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(terminal);
  return shown;
}

TEST(Progress, ConserveAllShowsABarOnATerminal) {
  const std::string shown =
      shown_until({"conserve", "--all", "--tag", "euler-poisson", "--method", "taylor"}, "[#");
  EXPECT_NE(shown.find("[#"), std::string::npos) << shown;
  EXPECT_NE(shown.find(" %  "), std::string::npos) << shown;
  // The twins: quiet, and no terminal.
  EXPECT_EQ(shown_until({"conserve", "euler", "--method", "taylor", "--quiet"}, "%").find('%'),
            std::string::npos);
  EXPECT_EQ(run({"conserve", "euler", "--method", "taylor"}).err, "");
}

}  // namespace
}  // namespace casimir::test

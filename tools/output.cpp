#include "tools/output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "codegen/compile.hpp"
#include "symbolic/error.hpp"
#include "tools/cli.hpp"

namespace casimir::tools {
namespace {

/// The temporary files of this process, in memory that a signal handler may read.
constexpr int kSlots = 8;
constexpr std::size_t kPathBytes = 4096;
char g_paths[kSlots][kPathBytes];
std::atomic<bool> g_used[kSlots];

int claim_slot(const std::string& path) {
  if (path.size() >= kPathBytes) return -1;
  for (int i = 0; i < kSlots; ++i) {
    bool free = false;
    if (!g_used[i].compare_exchange_strong(free, true)) continue;
    std::memcpy(g_paths[i], path.c_str(), path.size() + 1);
    return i;
  }
  return -1;
}

void release_slot(const std::string& path) {
  for (int i = 0; i < kSlots; ++i) {
    if (g_used[i] && path == g_paths[i]) g_used[i] = false;
  }
}

std::atomic<bool> g_hold, g_noted;

void on_signal(int signal) {
  if (signal == SIGINT && g_hold && !g_noted.exchange(true)) return;
  abandon_compile();
  for (int i = 0; i < kSlots; ++i) {
    if (g_used[i]) unlink(g_paths[i]);
  }
  _exit(128 + signal);
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(path_.string() + fmt::format(".{}.part", getpid())) {
  claim_slot(temporary_.string());
  stream_.open(temporary_, std::ios::binary);
  if (!stream_) {
    const int reason = errno;
    release_slot(temporary_.string());
    throw SystemError(fmt::format("cannot write '{}': {}", printable(path_.string(), 200),
                                  std::strerror(reason)));
  }
}

OutputFile::~OutputFile() {
  if (done_) return;
  std::error_code ignored;
  stream_.close();
  std::filesystem::remove(temporary_, ignored);
  release_slot(temporary_.string());
}

void OutputFile::commit() {
  stream_.close();
  std::error_code problem;
  if (!stream_)
    throw SystemError(fmt::format("cannot write all of '{}': {}", printable(path_.string(), 200),
                                  std::strerror(errno)));
  std::filesystem::rename(temporary_, path_, problem);
  if (problem)
    throw SystemError(
        fmt::format("cannot write '{}': {}", printable(path_.string(), 200), problem.message()));
  done_ = true;
  release_slot(temporary_.string());
}

void install_interrupt_handler() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

void hold_interrupts(bool hold) {
  g_noted = false;
  g_hold = hold;
}

bool interrupt_held() { return g_noted; }

bool may_colour(int descriptor) {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(descriptor) != 0 && (no_colour == nullptr || no_colour[0] == '\0');
}

}  // namespace casimir::tools

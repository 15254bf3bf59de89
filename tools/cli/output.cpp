#include "tools/cli/output.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "codegen/compile.hpp"
#include "symbolic/error.hpp"
#include "tools/cli/children.hpp"
#include "tools/cli/errors.hpp"

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
  end_children();
  abandon_compile();
  for (int i = 0; i < kSlots; ++i) {
    if (g_used[i]) unlink(g_paths[i]);
  }
  _exit(128 + signal);
}

/// Only if it is standard output that nobody reads any more.
void on_broken_pipe(int signal) {
  const int saved = errno;
  pollfd output = {STDOUT_FILENO, POLLOUT, 0};
  if (poll(&output, 1, 0) > 0 && (output.revents & (POLLERR | POLLHUP))) on_signal(signal);
  errno = saved;
}

/// The file that a name means, through symbolic links.
std::filesystem::path meant(const std::filesystem::path& path) {
  std::error_code missing;
  const std::filesystem::path real = std::filesystem::canonical(path, missing);
  return missing ? path : real;
}

[[noreturn]] void cannot_write(const char* what, const std::filesystem::path& path,
                               const std::string& reason) {
  throw SystemError(fmt::format("{} '{}': {}", what, printable(path.string(), 200), reason));
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  const auto type = std::filesystem::status(path_, ignored).type();
  using enum std::filesystem::file_type;
  if (type == directory) cannot_write("cannot write", path_, std::strerror(EISDIR));
  in_place_ = type == character || type == fifo || type == socket || type == block;
  if (!in_place_) path_ = meant(path_);
  temporary_ = path_;
  if (!in_place_) {
    temporary_ += fmt::format(".{}.part", getpid());
    claim_slot(temporary_.string());
  }
  stream_.open(temporary_, std::ios::binary);
  if (!stream_) {
    const int reason = errno;
    if (!in_place_) release_slot(temporary_.string());
    cannot_write("cannot write", path_, std::strerror(reason));
  }
}

OutputFile::~OutputFile() {
  if (done_ || in_place_) return;
  std::error_code ignored;
  stream_.close();
  std::filesystem::remove(temporary_, ignored);
  release_slot(temporary_.string());
}

void OutputFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_)
    cannot_write("cannot write all of", path_,
                 errno != 0 ? std::strerror(errno) : "the disk may be full");
  done_ = true;
  if (in_place_) return;
  struct stat old {};
  if (stat(path_.c_str(), &old) == 0) chmod(temporary_.c_str(), old.st_mode & 07777);
  std::error_code problem;
  std::filesystem::rename(temporary_, path_, problem);
  done_ = !problem;
  if (problem) cannot_write("cannot write", path_, problem.message());
  release_slot(temporary_.string());
}

ScratchFile::ScratchFile(std::filesystem::path path) : path_(std::move(path)) {
  claim_slot(path_.string());
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  release_slot(path_.string());
}

void install_interrupt_handler() {
  struct sigaction action = {};
  sigemptyset(&action.sa_mask);
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction old = {};
  sigaction(SIGHUP, nullptr, &old);
  if (old.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup has it ignored
  action.sa_handler = on_broken_pipe;
  sigaction(SIGPIPE, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
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

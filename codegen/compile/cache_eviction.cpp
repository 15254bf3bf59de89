// How the cache stays small: what is removed from it, and when.
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "codegen/compile.hpp"
#include "codegen/compile/cache.hpp"

namespace casimir::codegen {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1000;
constexpr std::uintmax_t kUsualBytes = std::uintmax_t{256} << 20;
constexpr std::uintmax_t kBytesOfBlock = 512;  // what st_blocks counts
constexpr time_t kGraceSeconds = 60;  // a process we cannot see may be alive in another container
constexpr time_t kForgottenSeconds = 24 * 3600;

/// A file that may have to go.
struct Kept {
  timespec used;
  std::uintmax_t bytes;
  fs::path path;
};

bool later(const Kept& a, const Kept& b) {
  if (a.used.tv_sec != b.used.tv_sec) return a.used.tv_sec > b.used.tv_sec;
  return a.used.tv_nsec > b.used.tv_nsec;
}

/// Left by a process that is dead, or has been forgotten.
bool is_abandoned(const fs::path& workspace) {
  struct stat info {};
  if (lstat(workspace.c_str(), &info) != 0) return false;
  const time_t age = time(nullptr) - info.st_mtime;
  if (age > kForgottenSeconds) return true;
  const long pid = std::strtol(workspace.filename().c_str() + std::strlen("work-"), nullptr, 10);
  const bool dead = pid <= 0 || (kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH);
  return dead && age > kGraceSeconds;
}

/// Unless somebody is about to load it. \return  whether it is gone
bool remove_unused(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  const bool in_use = file >= 0 && flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!in_use) unlink(path.c_str());
  if (file >= 0) close(file);
  return !in_use;
}

}  // namespace

std::uintmax_t cache_size_limit() {
  const char* text = std::getenv("CASIMIR_CACHE_SIZE");
  if (!text || !*text) return kUsualBytes;
  const char* const end = text + std::strlen(text);
  std::uintmax_t number = 0;
  const auto [rest, problem] = std::from_chars(text, end, number);
  const std::string unit(rest, end);
  const int shift = unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : unit.empty() ? 0 : -1;
  if (problem != std::errc{} || shift < 0 || number > (UINTMAX_MAX >> shift)) {
    throw EnvironmentError(
        "the environment variable CASIMIR_CACHE_SIZE is no size: expected bytes, or a number with "
        "K, M or G, such as 256M");
  }
  return number << shift;
}

void Cache::tidy(std::uintmax_t bytes) const {
  std::error_code ignored;
  std::vector<Kept> files;
  for (fs::directory_iterator i(folder(), ignored), end; !ignored && i != end;
       i.increment(ignored)) {
    const std::string name = i->path().filename().string();
    std::error_code failed;
    if (name.starts_with("work-") && is_abandoned(i->path())) fs::remove_all(i->path(), failed);
    struct stat info {};
    if ((!name.ends_with(".so") && !name.starts_with("failed-")) ||
        lstat(i->path().c_str(), &info) != 0) {
      continue;
    }
    const auto size = std::max(static_cast<std::uintmax_t>(info.st_size),
                               static_cast<std::uintmax_t>(info.st_blocks) * kBytesOfBlock);
    files.push_back({info.st_mtim, size, i->path()});
  }
  std::ranges::sort(files, later);
  std::size_t count = 0;
  std::uintmax_t taken = 0;
  for (const Kept& file : files) {
    const bool fits = count < kMostFiles && file.bytes <= bytes && taken <= bytes - file.bytes;
    if (fits || !remove_unused(file.path)) {
      ++count;
      taken += file.bytes;
    }
  }
}

}  // namespace casimir::codegen

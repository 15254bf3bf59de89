#include "codegen/cache.hpp"

#include <fcntl.h>
#include <pwd.h>
#include <signal.h>
#include <sodium.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "codegen/compile.hpp"

namespace casimir::codegen {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigestDigits = 64;
constexpr char kMark[] = "casimir-object-1";  // ends a finished object, after its digest
constexpr std::size_t kMostObjects = 1000;
constexpr time_t kGraceSeconds = 60;  // a process we cannot see may be alive in another container
constexpr time_t kForgottenSeconds = 24 * 3600;

[[noreturn]] void fail(const std::string& what, const fs::path& path) {
  throw CacheUnusable(what + " " + path.string() + ": " + std::strerror(errno));
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

time_t age_of(const fs::path& path) {
  struct stat info {};
  return lstat(path.c_str(), &info) == 0 ? time(nullptr) - info.st_mtime : 0;
}

/// Left by a process that is dead, or has been forgotten.
bool is_abandoned(const fs::path& workspace) {
  const time_t age = age_of(workspace);
  if (age > kForgottenSeconds) return true;
  const long pid = std::strtol(workspace.filename().c_str() + std::strlen("work-"), nullptr, 10);
  const bool dead = pid <= 0 || (kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH);
  return dead && age > kGraceSeconds;
}

fs::path home() {
  if (const char* path = std::getenv("HOME"); path && path[0] == '/') return path;
  const passwd* user = getpwuid(getuid());
  return user && user->pw_dir ? fs::path(user->pw_dir) : fs::path();
}

/// Makes the folder and those above it; only its owner may use the new ones.
void make_folder(const fs::path& folder) {
  struct stat info {};
  if (stat(folder.c_str(), &info) == 0 && S_ISDIR(info.st_mode)) return;
  const fs::path parent = folder.parent_path();
  if (!parent.empty() && parent != folder) make_folder(parent);
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) fail("cannot make the folder", folder);
}

}  // namespace

std::string digest(const std::vector<std::string>& parts) {
  if (sodium_init() < 0) throw EnvironmentError("libsodium cannot be initialised");
  crypto_generichash_state state;
  unsigned char bytes[kDigestDigits / 2];
  crypto_generichash_init(&state, nullptr, 0, sizeof bytes);
  const auto add = [&](const std::string& text) {
    crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(text.data()),
                              text.size());
  };
  for (const std::string& part : parts) {
    add(std::to_string(part.size()) + ":");
    add(part);
  }
  crypto_generichash_final(&state, bytes, sizeof bytes);
  char text[kDigestDigits + 1];
  sodium_bin2hex(text, sizeof text, bytes, sizeof bytes);
  return text;
}

void write_file(const fs::path& path, const std::string& content) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) fail("cannot write", path);
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t count = write(file, content.data() + done, content.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      close(file);
      errno = reason;
      fail("cannot write", path);
    }
    done += static_cast<std::size_t>(count);
  }
  if (close(file) != 0 && errno != EINTR) fail("cannot write", path);
}

// ------------------------------------------------------------------------------------- the folder

CacheFolders cache_folders(const fs::path& wanted) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value ? value : "");
  };
  CacheFolders result;
  const fs::path chosen = wanted.empty() ? variable("CASIMIR_CACHE") : wanted;
  result.asked_for = !chosen.empty();
  if (result.asked_for) {
    std::error_code ignored;
    result.folders.push_back(fs::absolute(chosen, ignored));
  } else if (const fs::path base = variable("XDG_CACHE_HOME"); base.is_absolute()) {
    result.folders.push_back(base / "casimir");
  } else if (!home().empty()) {
    result.folders.push_back(home() / ".cache" / "casimir");
  }
  const fs::path temporary = variable("TMPDIR");
  result.folders.push_back((temporary.is_absolute() ? temporary : fs::path("/tmp")) /
                           ("casimir-" + std::to_string(getuid())));
  return result;
}

Cache::Cache(fs::path folder) : folder_(std::move(folder)) {
  make_folder(folder_);
  const int file = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) fail("cannot open the folder", folder_);
  struct stat info {};
  const int failed = fstat(file, &info);
  close(file);
  if (failed) fail("cannot examine the folder", folder_);
  if (info.st_uid != geteuid()) {
    throw CacheUnsafe("the cache folder " + folder_.string() +
                      " belongs to another user: choose another one with CASIMIR_CACHE");
  }
  if (info.st_mode & (S_IWGRP | S_IWOTH)) {
    throw CacheUnsafe("others may write to the cache folder " + folder_.string() +
                      ": run chmod go-w on it, or choose another one with CASIMIR_CACHE");
  }
  if (access(folder_.c_str(), W_OK | X_OK) != 0) fail("cannot write to the folder", folder_);
}

std::optional<fs::path> Cache::find(const std::string& key) const {
  const fs::path path = folder_ / (key + ".so");
  const std::string content = content_of(path);
  if (content.empty()) return std::nullopt;
  const std::size_t trailer = kDigestDigits + std::strlen(kMark);
  if (content.size() > trailer && content.ends_with(kMark)) {
    const std::string object = content.substr(0, content.size() - trailer);
    if (content.compare(object.size(), kDigestDigits, digest({key, object})) == 0) {
      utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // used now
      return path;
    }
  }
  unlink(path.c_str());
  return std::nullopt;
}

fs::path Cache::store(const std::string& key, const fs::path& object) const {
  std::string content = content_of(object);
  content += digest({key, content}) + kMark;
  // A new file, so that whoever has a damaged one mapped keeps what it had.
  const fs::path finished = object.parent_path() / "finished.so";
  write_file(finished, content);
  const fs::path path = folder_ / (key + ".so");
  if (rename(finished.c_str(), path.c_str()) != 0) fail("cannot write", path);
  return path;
}

void Cache::tidy() const {
  std::error_code ignored;
  std::vector<std::pair<time_t, fs::path>> objects;
  for (fs::directory_iterator i(folder_, ignored), end; !ignored && i != end;
       i.increment(ignored)) {
    const std::string name = i->path().filename().string();
    std::error_code failed;
    if (name.starts_with("work-") && is_abandoned(i->path())) fs::remove_all(i->path(), failed);
    if (name.ends_with(".so")) objects.emplace_back(age_of(i->path()), i->path());
    if (name.starts_with("failed-") && age_of(i->path()) > kForgottenSeconds)
      unlink(i->path().c_str());
  }
  if (objects.size() <= kMostObjects) return;
  std::ranges::sort(objects);
  for (std::size_t i = kMostObjects; i < objects.size(); ++i) unlink(objects[i].second.c_str());
}

CacheLock::CacheLock(const Cache& cache, const std::string& key) {
  const fs::path path = cache.folder() / ("lock-" + key.substr(0, 2));
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file_ < 0) return;
  while (flock(file_, LOCK_EX) != 0 && errno == EINTR) {
  }
}

CacheLock::~CacheLock() {
  if (file_ >= 0) close(file_);
}

Workspace::Workspace(const Cache& cache) {
  static std::atomic<int> count{0};
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  folder_ =
      cache.folder() / ("work-" + std::to_string(getpid()) + "-" + std::to_string(now.tv_sec) +
                        "-" + std::to_string(now.tv_nsec) + "-" + std::to_string(++count));
  if (mkdir(folder_.c_str(), 0700) != 0) fail("cannot make the folder", folder_);
}

Workspace::~Workspace() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace casimir::codegen

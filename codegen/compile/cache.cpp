#include "codegen/compile/cache.hpp"

#include <fcntl.h>
#include <pwd.h>
#include <sodium.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "codegen/compile.hpp"

namespace casimir::codegen {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigestDigits = 64;
constexpr char kMark[] = "casimir-object-1";  // ends a finished object, after its digest
constexpr off_t kLargestObject = off_t{1} << 30;

[[noreturn]] void fail(const std::string& what, const fs::path& path) {
  throw CacheUnusable(what + " " + path.string() + ": " + std::strerror(errno));
}

/// An open file; closed with its last copy.
InUse holder_of(int file) {
  return {new int(file), [](const int* held) {
            close(*held);
            delete held;
          }};
}

/// The whole file, or nothing if it cannot be read.
std::string content_of(int file, std::size_t size) {
  std::string content(size, '\0');
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = read(file, content.data() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return {};
    done += static_cast<std::size_t>(count);
  }
  return content;
}

/// Whether what is open there is a file that only this user can have written.
bool is_ours(const struct stat& info) {
  return S_ISREG(info.st_mode) && info.st_uid == geteuid() &&
         (info.st_mode & (S_IWGRP | S_IWOTH)) == 0 && info.st_size <= kLargestObject;
}

/// Whether it is an object with the digest of this key and its content.
bool is_sound(const std::string& content, const std::string& key) {
  const std::size_t trailer = kDigestDigits + std::strlen(kMark);
  if (content.size() <= trailer || !content.ends_with(kMark)) return false;
  const std::string object = content.substr(0, content.size() - trailer);
  return content.compare(object.size(), kDigestDigits, digest({key, object})) == 0;
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
  // Who may rename a folder on the way could put another one in its place.
  for (fs::path above = folder_.parent_path();; above = above.parent_path()) {
    if (stat(above.c_str(), &info) == 0 && (info.st_mode & S_IWOTH) && !(info.st_mode & S_ISVTX)) {
      throw CacheUnsafe("others may write to " + above.string() +
                        ", and so replace the cache folder in it: choose another one with "
                        "CASIMIR_CACHE");
    }
    if (above == above.parent_path()) break;
  }
}

std::optional<CachedObject> Cache::find(const std::string& key) const {
  const fs::path path = folder_ / (key + ".so");
  // What is no plain file neither holds us up nor leads us elsewhere.
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) {
    if (errno != ENOENT) unlink(path.c_str());
    return std::nullopt;
  }
  InUse held = holder_of(file);
  while (flock(file, LOCK_SH) != 0 && errno == EINTR) {
  }
  struct stat info {};
  if (fstat(file, &info) != 0 || info.st_nlink == 0) return std::nullopt;  // removed to make room
  if (is_ours(info) && is_sound(content_of(file, static_cast<std::size_t>(info.st_size)), key)) {
    futimens(file, nullptr);  // used now
    return CachedObject{path, std::move(held)};
  }
  unlink(path.c_str());
  return std::nullopt;
}

CachedObject Cache::store(const std::string& key, const fs::path& object) const {
  std::string content;
  if (const int made = open(object.c_str(), O_RDONLY | O_CLOEXEC); made >= 0) {
    const InUse closed = holder_of(made);
    struct stat info {};
    if (fstat(made, &info) == 0) content = content_of(made, static_cast<std::size_t>(info.st_size));
  }
  if (content.empty()) fail("cannot read", object);
  content += digest({key, content}) + kMark;
  // A new file, so that whoever has a damaged one mapped keeps what it had.
  const fs::path finished = object.parent_path() / "finished.so";
  write_file(finished, content);
  const int file = open(finished.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) fail("cannot read", finished);
  InUse held = holder_of(file);
  flock(file, LOCK_SH | LOCK_NB);  // before others can see it
  const fs::path path = folder_ / (key + ".so");
  if (rename(finished.c_str(), path.c_str()) != 0) fail("cannot write", path);
  return {path, std::move(held)};
}

CacheLock::CacheLock(const Cache& cache, const std::string& key, double seconds) {
  const fs::path path = cache.folder() / ("lock-" + key.substr(0, 2));
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  if (file_ < 0) return;
  const fs::path object = cache.folder() / (key + ".so");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return;
    if (access(object.c_str(), F_OK) == 0 || std::chrono::steady_clock::now() > end) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
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

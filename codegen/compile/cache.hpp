#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace casimir::codegen {

/// Keeps an object of the cache from being removed to make room. Nobody else need know what it is.
using InUse = std::shared_ptr<const void>;

/// An object of the cache, and what keeps it there.
struct CachedObject {
  std::filesystem::path path;
  InUse in_use;
};

/// A folder of compiled objects that only its owner may write.
class Cache {
 public:
  /// Makes the folder if need be, with the mode 0700. It may be read-only, and nothing new goes in.
  /// \throws CacheUnsafe    if others could have put objects there.
  /// \throws CacheUnusable  if it cannot be made or opened; the text has the reason.
  explicit Cache(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }

  /// The sound object of that key: a regular file of this user that nobody else may write, with the
  /// digest that it was stored with. Anything else of that name is removed.
  std::optional<CachedObject> find(const std::string& key) const;

  /// Takes a finished object in under that key, with its digest, all at once or not at all.
  /// \throws CacheUnusable
  CachedObject store(const std::string& key, const std::filesystem::path& object) const;

  /// Removes what processes left that died, and the objects unused for longest, until at most a
  /// thousand and at most `bytes` are left. Objects in use stay.
  void tidy(std::uintmax_t bytes) const;

 private:
  std::filesystem::path folder_;
};

/// The bound on the bytes of a cache: $CASIMIR_CACHE_SIZE, as "500K", "64M" or "2G"; 256M without.
/// \throws EnvironmentError  if it is no size.
std::uintmax_t cache_size_limit();

/// Held while an object is being made, so that others wait for it instead of making it too.
/// Released by the system when its process dies. Where the file system has no locks, nobody waits.
class CacheLock {
 public:
  /// Waits until it has the lock, until the object is there, or for `seconds`: whoever holds the
  /// lock may be stuck.
  CacheLock(const Cache& cache, const std::string& key, double seconds);
  ~CacheLock();
  CacheLock(const CacheLock&) = delete;
  CacheLock& operator=(const CacheLock&) = delete;

 private:
  int file_ = -1;
};

/// A new folder in the cache for one run of the compiler; removed with all it holds.
class Workspace {
 public:
  /// \throws CacheUnusable
  explicit Workspace(const Cache& cache);
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// The folders to try, best first, and whether the first was asked for by name: then an unsafe one
/// is an error and not a reason to go elsewhere.
struct CacheFolders {
  std::vector<std::filesystem::path> folders;
  bool asked_for = false;
};
CacheFolders cache_folders(const std::filesystem::path& wanted);

/// BLAKE2b of the parts, each with its length, as 64 hexadecimal digits.
std::string digest(const std::vector<std::string>& parts);

/// Writes a whole file.
/// \throws CacheUnusable
void write_file(const std::filesystem::path& path, const std::string& content);

}  // namespace casimir::codegen

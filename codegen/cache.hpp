#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace casimir::codegen {

/// A folder of compiled objects that only its owner may write.
class Cache {
 public:
  /// Makes the folder if need be.
  /// \throws CacheUnsafe    if others could have put objects there.
  /// \throws CacheUnusable  if it cannot be made or written; the text has the reason.
  explicit Cache(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }

  /// The sound object of that key. A damaged one is removed.
  std::optional<std::filesystem::path> find(const std::string& key) const;

  /// Takes a finished object in under that key, with its digest, all at once or not at all.
  /// \throws CacheUnusable
  std::filesystem::path store(const std::string& key, const std::filesystem::path& object) const;

  /// Removes what processes left that died, and the objects unused for longest beyond a thousand.
  void tidy() const;

 private:
  std::filesystem::path folder_;
};

/// Held while an object is being made, so that others wait for it instead of making it too.
/// Released by the system when its process dies. Where the file system has no locks, nobody waits.
class CacheLock {
 public:
  CacheLock(const Cache& cache, const std::string& key);
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

/// Writes a whole file. \throws CacheUnusable
void write_file(const std::filesystem::path& path, const std::string& content);

}  // namespace casimir::codegen

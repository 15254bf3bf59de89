#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// Points of a sweep that are done, kept beside the output until all are: a text file that is only
/// ever appended to, with a checksum in each line. A kill can lose what was not yet appended and
/// tear the last line; whatever is not sound is not there.
class Journal {
 public:
  /// Opens the journal of this output, or begins it.
  /// \param fingerprint  of the sweep
  /// \param restart  what is there is thrown away
  /// \throws RequestError   if it belongs to another sweep
  /// \throws EnvironmentError  if it cannot be written, or another process writes it
  Journal(const std::string& output, const std::string& fingerprint, std::size_t columns,
          bool restart);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }

  /// What is done, by point.
  const std::map<std::size_t, PointResult>& done() const { return done_; }

  /// Adds results; they are on the disk when this returns.
  /// \throws EnvironmentError
  void append(const std::map<std::size_t, PointResult>& results);

  /// After the output has been written.
  void remove();

 private:
  void read(const std::string& fingerprint, std::size_t columns);
  void write(const std::string& text);

  std::string path_;
  int file_ = -1;
  std::map<std::size_t, PointResult> done_;
};

/// 32 hexadecimal digits that tell a text from others.
std::string digest(const std::string& text);

}  // namespace casimir

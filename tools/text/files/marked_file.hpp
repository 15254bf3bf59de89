#pragma once

#include <string>

namespace casimir::tools {

/// A Markdown file in which one part is written by a command and the rest by people: the part
/// stands between lines "<!-- NAME -->" and "<!-- /NAME -->".
class MarkedFile {
 public:
  /// Reads the file; one that does not exist will be made.
  /// \throws UsageError  if it exists and does not have each mark once, in this order.
  MarkedFile(std::string path, std::string name);

  /// Puts `part` between the marks; the rest of the file stays as it is, byte by byte.
  /// \throws SystemError  if it cannot be written.
  void write(const std::string& part) const;

 private:
  std::string path_;
  std::string before_, after_;  ///< with the marks
};

}  // namespace casimir::tools

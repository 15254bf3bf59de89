#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace casimir::tools {

/// A file that appears under its name only when it is complete: written beside it, then renamed.
/// An interrupted or failed command leaves nothing.
class OutputFile {
 public:
  /// \throws SystemError  if it cannot be written.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ofstream& stream() { return stream_; }
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Makes it appear. \throws SystemError  if not everything could be written.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool done_ = false;
};

/// Installs the handlers of SIGINT and SIGTERM: they end the compiler if it runs, remove
/// half-written files and exit with 130 (143 for SIGTERM).
void install_interrupt_handler();

/// While interrupts are held, the first SIGINT is only noted; a second one ends the program as
/// ever. To hold them, or to let go, forgets the one noted.
void hold_interrupts(bool hold);
/// Whether one was noted.
bool interrupt_held();

/// Whether text on this stream may be coloured: a terminal, and NO_COLOR is not set.
bool may_colour(int descriptor);

}  // namespace casimir::tools

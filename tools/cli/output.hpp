#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace casimir::tools {

/// A file that appears under its name only when it is complete: written beside it, then renamed.
/// An interrupted or failed command leaves nothing, or the file that was there. A symbolic link
/// stays one, a file keeps its mode, and what is no file, as /dev/stdout, is written to as it is.
class OutputFile {
 public:
  /// \throws SystemError  if it cannot be written.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ofstream& stream() { return stream_; }
  /// What is written to until then.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Makes it appear.
  /// \throws SystemError  if not everything could be written.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool in_place_ = false;  ///< it is no file: there is nothing beside it
  bool done_ = false;
};

/// A file that another program makes on the way: gone at the end, and where this one is
/// interrupted.
class ScratchFile {
 public:
  explicit ScratchFile(std::filesystem::path path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Whether the name of an output says that a page is meant: .html or .htm.
inline bool is_page_name(const std::string& path) {
  return path.ends_with(".html") || path.ends_with(".htm");
}

/// Installs the handlers of SIGINT, SIGTERM and SIGHUP: they end the compiler if it runs, remove
/// half-written files and exit with 130 (143 for SIGTERM, 129 for SIGHUP). So it is, with 141,
/// where nobody reads standard output any more; other broken pipes, and files that have grown to
/// the limit of the system, are errors of the write.
void install_interrupt_handler();

/// While interrupts are held, the first SIGINT is only noted; a second one ends the program as
/// ever. To hold them, or to let go, forgets the one noted.
void hold_interrupts(bool hold);
/// Whether one was noted.
bool interrupt_held();

/// Whether text on this stream may be coloured: a terminal, and NO_COLOR is not set.
bool may_colour(int descriptor);

}  // namespace casimir::tools

#include "tools/cli/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

namespace casimir::tools {

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest free number is this one. The wrong way round, so that its use fails as it would.
    open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

const char* standard_output_problem() {
  errno = 0;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::cout && !std::ferror(stdout)) return nullptr;
  // An earlier write failed, and its reason is forgotten: the next one has the same.
  if (errno == 0 && write(STDOUT_FILENO, "\n", 1) == 1) return "not all of it could be written";
  return std::strerror(errno);
}

}  // namespace casimir::tools

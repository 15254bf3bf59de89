#pragma once

#include <string>
#include <vector>

namespace casimir::traps {

/// What a run of the program left.
struct Said {
  int status = -1;       ///< exit status, or 128 + signal
  bool in_time = true;   ///< false: it was ended from here
  double seconds = 0;    ///< of processors, with those of its compiler
  std::string out, err;  ///< what it wrote
};

/// Runs the program with these words, no shell between. It is ended after so many seconds of its
/// own on a processor, which a busy machine does not change; and after ten times as many on the
/// clock. \param folder  for what it writes; one for each thread
Said run_program(const std::vector<std::string>& words, const std::string& folder, double seconds);

}  // namespace casimir::traps

#pragma once

#include <cstdint>
#include <string>

namespace casimir::adversary {

/// What to run.
struct Request {
  std::uint64_t count = 10000, seed = 1, first = 0;
  double seconds = 120;  ///< of processor time, for one claim
  int show = 1;
  std::string family{};
  bool print = false;
  double shrink = 60;       ///< seconds for making a failing claim smaller; 0: it is shown as it is
  std::string undecided{};  ///< a file for the true claims that stay undecided, sorted by family
};

/// Judges claims one after the other, each in a child process that may crash or hang, and prints
/// the failures as case files and tables of what came out. The same request has the same claims
/// everywhere.
/// \return whether there was no failure
bool run(const Request& request);

}  // namespace casimir::adversary

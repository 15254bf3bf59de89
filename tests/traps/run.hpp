#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/traps/scene.hpp"

namespace casimir::traps {

/// What to run.
struct Request {
  std::uint64_t count = 2000, seed = 1, first = 0;
  std::vector<std::string> methods{"auto"};
  std::string kind{};                  ///< only this one
  std::string keep{};                  ///< a folder for the files of what fails
  std::string show{};                  ///< an outcome that is listed though it is no failure
  std::string program{};               ///< casimir
  std::string fixed{};                 ///< a folder of scenes to run instead of generated ones
  std::vector<std::string> options{};  ///< further words for the program
  double seconds = 20;                 ///< of a processor, after which a run hangs
  int jobs = 2;
  bool folded = false;  ///< the numbers are compiled in
  bool print = false;   ///< the scenes instead of judging them
};

/// Runs the program on every scene with every method, and prints a table and what fails. The same
/// request has the same scenes everywhere.
/// \return whether there was no failure
bool run(const Request& request);

}  // namespace casimir::traps

#pragma once

#include <string>

#include "tools/analysis/sweep/ranks.hpp"

namespace casimir::tools {

/// The processes that mpirun started, or this one alone. Made and destroyed by all of them
/// together.
class MpiRanks : public Ranks {
 public:
  /// \throws SystemError  under mpirun, if this program was built without MPI: every process would
  ///                      do the whole sweep
  MpiRanks();
  ~MpiRanks() override;

  void broadcast(std::vector<unsigned long long>& numbers) const override;
  std::vector<double> gather(const std::vector<double>& numbers) const override;
  int largest(int number) const override;

  /// Says what it was on stderr, and ends all of them at once.
  void end_all(const std::exception& problem) const override;

 private:
  [[maybe_unused]] bool started_ = false;  ///< in a build with MPI
};

/// The MPI that this program was built with, or empty.
std::string mpi_version();

}  // namespace casimir::tools

#pragma once

#include "tools/analysis/sweep/ranks.hpp"

namespace casimir::tools {

struct MpiCalls;

/// The processes that mpirun started, or this one alone. Made and destroyed by all of them
/// together.
class MpiRanks : public Ranks {
 public:
  /// \throws SystemError  under mpirun, if this program was built without MPI, or its module for MPI does
  ///                      not load: every process would do the whole sweep
  MpiRanks();
  ~MpiRanks() override;

  void broadcast(std::vector<unsigned long long>& numbers) const override;
  std::vector<double> gather(const std::vector<double>& numbers) const override;
  int largest(int number) const override;

  /// Says what it was on stderr, and ends all of them at once.
  void end_all(const std::exception& problem) const override;

 private:
  const MpiCalls* calls_ = nullptr;  ///< where several processes were started
};

}  // namespace casimir::tools

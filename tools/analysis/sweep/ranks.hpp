#pragma once

#include <string>
#include <vector>

namespace casimir::tools {

/// The processes that share a sweep: those that mpirun started, or this one alone. Rank 0 reads,
/// writes and speaks. Made and destroyed by all of them together.
class Ranks {
 public:
  /// \throws SystemError  under mpirun, if this program was built without MPI: every process would
  ///                      do the whole sweep
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool speaks() const { return rank_ == 0; }

  /// Processors for the threads of this rank, so that together they use each once.
  int processors() const { return processors_; }

  /// Rank 0's numbers, in all ranks.
  void broadcast(std::vector<unsigned long long>& numbers) const;

  /// The numbers of all ranks one after the other, in rank 0; empty in the others.
  std::vector<double> gather(const std::vector<double>& numbers) const;

  /// The largest of all ranks.
  int largest(int number) const;

  /// Ends all of them at once.
  [[noreturn]] void abort(int status) const;

 private:
  int rank_ = 0, size_ = 1, processors_ = 1;
  bool started_ = false;
};

/// The MPI that this program was built with, or empty.
std::string mpi_version();

}  // namespace casimir::tools

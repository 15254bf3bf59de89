#pragma once

#include <stdexcept>
#include <vector>

namespace casimir {

/// The processes that share a sweep: this one alone, unless a class of its own says otherwise. Rank
/// 0 reads, writes and speaks.
class Ranks {
 public:
  Ranks();
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// The number of this process, from 0.
  int rank() const { return rank_; }
  /// How many there are.
  int size() const { return size_; }
  /// Whether this is the one that reads, writes and speaks.
  bool speaks() const { return rank_ == 0; }

  /// Processors for the threads of this rank, so that together they use each once.
  int processors() const { return processors_; }

  /// Rank 0's numbers, in all ranks.
  virtual void broadcast(std::vector<unsigned long long>& numbers) const;

  /// The numbers of all ranks one after the other, in rank 0; empty in the others.
  virtual std::vector<double> gather(const std::vector<double>& numbers) const;

  /// The largest of all ranks.
  virtual int largest(int number) const;

  /// Called in one of several ranks for a failure that the others do not have, and would wait for:
  /// ends them all, or returns and lets it be thrown.
  virtual void end_all(const std::exception& problem) const;

 protected:
  int rank_ = 0;        ///< see `rank`
  int size_ = 1;        ///< see `size`
  int processors_ = 1;  ///< see `processors`
};

}  // namespace casimir

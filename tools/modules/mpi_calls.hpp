#pragma once

namespace casimir::tools {

/// What a sweep asks of MPI, as functions of plain data: a module of its own is linked to MPI, and
/// loaded only where several processes were started. All but `version` are called by every process
/// together, `abort` apart.
struct MpiCalls {
  /// Starts MPI. The number of this process, how many there are, and how many of them on this
  /// machine.
  void (*start)(int* rank, int* size, int* neighbours);
  void (*finish)();
  /// Rank 0's `count` numbers, in all ranks.
  void (*broadcast)(unsigned long long* numbers, int count);
  /// How many numbers each rank has, in rank 0's `lengths`, one for each.
  void (*gather_lengths)(int own, int* lengths);
  /// The `own` numbers of each rank, in rank 0's `all`: `lengths[i]` of rank i from `places[i]`.
  void (*gather)(const double* numbers, int own, double* all, const int* lengths,
                 const int* places);
  /// The largest of all ranks.
  int (*largest)(int number);
  /// Ends all processes at once.
  void (*abort)(int status);
};

/// The name of the module and of the `MpiCalls` in it.
inline constexpr const char* kMpiModule = "casimir_mpi";
inline constexpr const char* kMpiCalls = "casimir_mpi_calls";

}  // namespace casimir::tools

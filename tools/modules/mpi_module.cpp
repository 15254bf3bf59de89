#include <mpi.h>

#include <cstdlib>

#include "tools/modules/mpi_calls.hpp"

namespace casimir::tools {
namespace {

void start(int* rank, int* size, int* neighbours) {
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, rank);
  MPI_Comm_size(MPI_COMM_WORLD, size);
  MPI_Comm here;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, neighbours);
  MPI_Comm_free(&here);
}

void finish() { MPI_Finalize(); }

void broadcast(unsigned long long* numbers, int count) {
  MPI_Bcast(numbers, count, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
}

void gather_lengths(int own, int* lengths) {
  MPI_Gather(&own, 1, MPI_INT, lengths, 1, MPI_INT, 0, MPI_COMM_WORLD);
}

void gather(const double* numbers, int own, double* all, const int* lengths, const int* places) {
  MPI_Gatherv(numbers, own, MPI_DOUBLE, all, lengths, places, MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

int largest(int number) {
  int result = number;
  MPI_Allreduce(&number, &result, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return result;
}

void abort_all(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

}  // namespace
}  // namespace casimir::tools

extern "C" const casimir::tools::MpiCalls casimir_mpi_calls = {
    casimir::tools::start,          casimir::tools::finish, casimir::tools::broadcast,
    casimir::tools::gather_lengths, casimir::tools::gather, casimir::tools::largest,
    casimir::tools::abort_all};

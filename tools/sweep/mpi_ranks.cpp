#include "tools/sweep/mpi_ranks.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "tools/cli/errors.hpp"
#ifdef CASIMIR_MPI
#include <mpi.h>
#endif

namespace casimir::tools {
namespace {

/// Whether this process is one of several that a launcher started. Without one MPI is not touched:
/// to start it takes a second.
bool launched() {
  return std::ranges::any_of(
      std::vector<const char*>{"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMIX_RANK"},
      [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

#ifdef CASIMIR_MPI

MpiRanks::MpiRanks() {
  if (!launched()) return;
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  started_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm here;
  int neighbours = 1;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &neighbours);
  MPI_Comm_free(&here);
  const int all = static_cast<int>(std::thread::hardware_concurrency());
  if (processors_ >= all) processors_ = std::max(1, processors_ / neighbours);
}

MpiRanks::~MpiRanks() {
  if (started_) MPI_Finalize();
}

void MpiRanks::broadcast(std::vector<unsigned long long>& numbers) const {
  if (!started_) return;
  unsigned long long length = numbers.size();
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
  numbers.resize(length);
  MPI_Bcast(numbers.data(), static_cast<int>(length), MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
}

std::vector<double> MpiRanks::gather(const std::vector<double>& numbers) const {
  if (!started_) return numbers;
  const int own = static_cast<int>(numbers.size());
  std::vector<int> lengths(static_cast<std::size_t>(size_)), places(lengths.size());
  MPI_Gather(&own, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  int all = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    places[i] = all;
    all += lengths[i];
  }
  std::vector<double> result(speaks() ? static_cast<std::size_t>(all) : 0);
  MPI_Gatherv(numbers.data(), own, MPI_DOUBLE, result.data(), lengths.data(), places.data(),
              MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return result;
}

int MpiRanks::largest(int number) const {
  int result = number;
  if (started_) MPI_Allreduce(&number, &result, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return result;
}

void MpiRanks::end_all(const std::exception& problem) const {
  std::cerr << "casimir: error: " << problem.what() << '\n';
  if (started_) MPI_Abort(MPI_COMM_WORLD, kEnvironment);
  std::_Exit(kEnvironment);
}

std::string mpi_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string version(text, static_cast<std::size_t>(length));
  return version.substr(0, version.find_first_of(",\n"));
}

#else

MpiRanks::MpiRanks() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (launched() && (size == nullptr || std::string(size) != "1"))
    throw SystemError(
        "casimir was built without MPI: under mpirun each process would do the whole sweep; "
        "install it with: apt-get install libopenmpi-dev, and build again");
}

MpiRanks::~MpiRanks() = default;
void MpiRanks::broadcast(std::vector<unsigned long long>& numbers) const {
  Ranks::broadcast(numbers);
}
std::vector<double> MpiRanks::gather(const std::vector<double>& numbers) const {
  return Ranks::gather(numbers);
}
int MpiRanks::largest(int number) const { return Ranks::largest(number); }
void MpiRanks::end_all(const std::exception& problem) const { Ranks::end_all(problem); }
std::string mpi_version() { return {}; }

#endif

}  // namespace casimir::tools

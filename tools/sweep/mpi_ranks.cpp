#include "tools/sweep/mpi_ranks.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "tools/cli/errors.hpp"
#include "tools/modules/load.hpp"
#include "tools/modules/mpi_calls.hpp"

namespace casimir::tools {
namespace {

/// Whether this process is one of several that a launcher started. Without one MPI is not touched:
/// to start it takes a second.
bool launched() {
  return std::ranges::any_of(
      std::vector<const char*>{"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMIX_RANK"},
      [](const char* name) { return std::getenv(name) != nullptr; });
}

/// The MPI of the module, or none.
const MpiCalls* calls() {
#ifdef CASIMIR_MPI
  return static_cast<const MpiCalls*>(module_symbol(kMpiModule, kMpiCalls));
#else
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size != nullptr && std::string(size) == "1") return nullptr;
  throw SystemError(
      "casimir was built without MPI: under mpirun each process would do the whole sweep; "
      "install it with: apt-get install libopenmpi-dev, and build again");
#endif
}

}  // namespace

MpiRanks::MpiRanks() {
  if (launched()) calls_ = calls();
  if (calls_ == nullptr) return;
  int neighbours = 1;
  calls_->start(&rank_, &size_, &neighbours);
  const int all = static_cast<int>(std::thread::hardware_concurrency());
  if (processors_ >= all) processors_ = std::max(1, processors_ / neighbours);
}

MpiRanks::~MpiRanks() {
  if (calls_ != nullptr) calls_->finish();
}

void MpiRanks::broadcast(std::vector<unsigned long long>& numbers) const {
  if (calls_ == nullptr) return;
  unsigned long long length = numbers.size();
  calls_->broadcast(&length, 1);
  numbers.resize(length);
  calls_->broadcast(numbers.data(), static_cast<int>(length));
}

std::vector<double> MpiRanks::gather(const std::vector<double>& numbers) const {
  if (calls_ == nullptr) return numbers;
  const int own = static_cast<int>(numbers.size());
  std::vector<int> lengths(static_cast<std::size_t>(size_)), places(lengths.size());
  calls_->gather_lengths(own, lengths.data());
  int all = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    places[i] = all;
    all += lengths[i];
  }
  std::vector<double> result(speaks() ? static_cast<std::size_t>(all) : 0);
  calls_->gather(numbers.data(), own, result.data(), lengths.data(), places.data());
  return result;
}

int MpiRanks::largest(int number) const {
  return calls_ == nullptr ? number : calls_->largest(number);
}

void MpiRanks::end_all(const std::exception& problem) const {
  if (calls_ == nullptr) return;
  std::cerr << "casimir: error: " << problem.what() << '\n';
  calls_->abort(kEnvironment);
}

}  // namespace casimir::tools

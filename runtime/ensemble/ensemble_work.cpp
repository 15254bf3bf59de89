// What the threads of an ensemble share.
#include "runtime/ensemble/ensemble_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <thread>

#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"

namespace casimir {

EnsembleWork::EnsembleWork(const Ensemble& ensemble, const Settings& settings)
    : ensemble_(ensemble), settings_(settings) {
  result.members.resize(ensemble.size());
  for (std::size_t i = 0; i < ensemble.size(); ++i)
    result.members[i].state.assign(ensemble.state(i), ensemble.state(i) + ensemble.states);
  if (!ensemble.atol.empty() && ensemble.atol.size() != ensemble.size())
    throw std::invalid_argument("an ensemble has an absolute tolerance for each member or none");
  std::map<double, std::vector<std::size_t>> of_atol;
  for (std::size_t i = 0; i < ensemble.size(); ++i)
    of_atol[ensemble.atol_of(i, settings.atol)].push_back(i);
  for (auto& [atol, members] : of_atol) shares_.emplace_back(atol, std::move(members));
}

long long EnsembleWork::next(std::size_t share) {
  if (stop_ || share >= shares_.size()) return -1;
  Share& from = shares_[share];
  const std::size_t place = from.next++;
  return place < from.members.size() ? static_cast<long long>(from.members[place]) : -1;
}

bool EnsembleWork::give_up(unsigned& calls) {
  constexpr unsigned kSeldom = 64;
  if (settings_.give_up && calls++ % kSeldom == 0 && settings_.give_up()) stop_ = true;
  return stop_;
}

void EnsembleWork::fail(std::exception_ptr problem) {
  const std::lock_guard lock(guard_);
  if (!problem_) problem_ = std::move(problem);
  stop_ = true;
}

void EnsembleWork::on_threads(int jobs, int lanes, const std::function<void()>& worker) {
  const std::size_t wide = static_cast<std::size_t>(lanes);
  const std::size_t registers = (ensemble_.size() + wide - 1) / wide;
  const std::size_t wanted =
      jobs > 0 ? static_cast<std::size_t>(jobs) : std::thread::hardware_concurrency();
  const std::size_t count = std::max<std::size_t>(1, std::min(wanted, registers));
  result.jobs = static_cast<int>(count);
  const auto guarded = [&] {
    try {
      worker();
    } catch (...) {
      fail(std::current_exception());
    }
  };
  std::vector<std::thread> threads;
  try {
    while (threads.size() + 1 < count) threads.emplace_back(guarded);
  } catch (const std::system_error&) {  // the system allows no more of them
    result.jobs = static_cast<int>(threads.size()) + 1;
  }
  guarded();
  for (std::thread& thread : threads) thread.join();
  if (problem_) std::rethrow_exception(problem_);
}

std::mutex& exact_constants_guard() {
  static std::mutex guard;
  return guard;
}

EndCheck::EndCheck(const Ensemble& ensemble, const Program& invariants)
    : ensemble_(ensemble),
      program_(invariants),
      invariants_(invariants),
      angles_(moving_angles(invariants, ensemble.states)),
      inputs_(invariants.inputs.size()),
      first_(invariants.outputs.size()),
      last_(first_.size()),
      sizes_(first_.size()) {}

void EndCheck::evaluate_at(std::size_t member, const double* state, double time,
                           std::vector<double>& values) {
  std::copy_n(state, ensemble_.states, inputs_.begin());
  std::copy_n(ensemble_.values_of(member), ensemble_.parameters,
              inputs_.begin() + static_cast<std::ptrdiff_t>(ensemble_.states));
  inputs_.back() = time;
  invariants_(inputs_.data(), values.data());
  std::vector<SizedNumber> sized;
  for (const double input : inputs_) sized.push_back(Arithmetic<SizedNumber>::plain(input));
  const std::vector<SizedNumber> terms = evaluate(program_, sized);
  for (std::size_t i = 0; i < terms.size(); ++i)
    sizes_[i] =
        std::max({sizes_[i], static_cast<double>(std::abs(terms[i].size)), std::abs(first_[i])});
}

/// The last values of what has angles: as near to the first as their branches allow.
void EndCheck::put_on_one_branch(const std::vector<long double>& start) {
  if (angles_.empty()) return;
  const std::vector<bool> has_angles = with_angles(program_, angles_);
  const std::vector<long double> differences = least_differences(
      program_, angles_, start, std::vector<long double>(inputs_.begin(), inputs_.end()));
  for (std::size_t i = 0; i < last_.size(); ++i)
    if (has_angles[i]) last_[i] = static_cast<double>(first_[i] + differences[i]);
}

void EndCheck::operator()(std::size_t member, MemberResult& result) {
  if (first_.empty()) return;
  const std::lock_guard lock(exact_constants_guard());
  std::fill(sizes_.begin(), sizes_.end(), 0.);
  evaluate_at(member, ensemble_.state(member), 0, first_);
  const std::vector<long double> start(inputs_.begin(), inputs_.end());
  evaluate_at(member, result.state.data(), result.time, last_);
  put_on_one_branch(start);
  result.invariants.resize(first_.size());
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const double change = std::abs(last_[i] - first_[i]);
    // A value that overflowed is no small change.
    const double drift = std::isnan(change) ? std::numeric_limits<double>::infinity()
                         : change == 0      ? 0
                                            : change / sizes_[i];
    result.invariants[i] = {first_[i], last_[i], drift};
  }
}

}  // namespace casimir

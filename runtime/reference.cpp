#include "runtime/reference.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/digits/agreed_run.hpp"

namespace casimir {
Reference reference_solution(const Program& rhs, const std::vector<cln::cl_R>& initial,
                             const cln::cl_R& duration, int digits,
                             const std::vector<cln::cl_R>& parameters,
                             const std::function<bool()>& give_up) {
  constexpr int kLeastDigits = 20;
  PreciseProblem problem;
  problem.rhs = &rhs;
  problem.start = [&](int) {
    std::vector<cln::cl_R> start = initial;
    start.insert(start.end(), parameters.begin(), parameters.end());
    start.push_back(duration);
    return start;
  };
  if (give_up) problem.give_up = [&](double) { return give_up(); };
  AgreedRun agreed = agreed_run(problem, std::max(digits, kLeastDigits));
  Reference reference;
  reference.reached = agreed.run.status == Status::ok;
  reference.reason = agreed.run.reason;
  reference.singular = agreed.run.singular_time.has_value();
  reference.time = agreed.run.singular_time.value_or(agreed.run.time);
  if (reference.reached) reference.error_bound = std::pow(10., agreed.log10_error);
  reference.state = std::move(agreed.run.state);
  reference.digits = agreed.run.digits;
  reference.steps = agreed.run.steps;
  return reference;
}

}  // namespace casimir

#pragma once

#include <functional>

#include "tests/adversary/judge.hpp"
#include "tests/adversary/run.hpp"

namespace casimir::adversary {

/// Judges the claims of the request in a child process. Where it dies, or does not answer in time,
/// that claim is `broken` and another child goes on with the next.
void judge_all(const Request& request,
               const std::function<void(std::uint64_t index, const Judgement&)>& report);

}  // namespace casimir::adversary

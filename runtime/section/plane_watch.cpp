#include "runtime/section/plane_watch.hpp"

#include <algorithm>

namespace casimir {
namespace {

/// The function as a right-hand side of the kernel's inputs: all rates are the function.
Program as_rates(const Program& function, std::size_t states, std::size_t size) {
  Program result = function;
  result.inputs.assign(function.inputs.begin(),
                       function.inputs.begin() + static_cast<std::ptrdiff_t>(states));
  while (result.inputs.size() < size) result.inputs.emplace_back("deviation");
  result.inputs.emplace_back("time");
  // What is no state is not used.
  for (Instruction& line : result.code)
    if (line.op == Op::input && line.a >= static_cast<int>(states)) line.a = static_cast<int>(size);
  result.outputs.assign(size, function.outputs.front());
  result.output_names.assign(size, "plane");
  return result;
}

bool hides(const StepWatch::Watched& watched) {
  switch (watched.kind) {
    case StepWatch::Kind::side:
    case StepWatch::Kind::exponent:
    case StepWatch::Kind::both:
    case StepWatch::Kind::front:
    case StepWatch::Kind::power:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::optional<StepWatch> watch_of_plane(const Program& function, std::size_t states,
                                        std::size_t size) {
  StepWatch watch(as_rates(function, states, size));
  if (std::ranges::none_of(watch.watched(), hides)) return std::nullopt;
  return watch;
}

}  // namespace casimir

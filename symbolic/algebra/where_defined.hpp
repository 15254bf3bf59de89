#pragma once

#include <cln/exception.h>

#include <optional>
#include <stdexcept>
#include <utility>

namespace casimir {

/// What `compute` returns, or nothing where an expression has no value: a pole, a division by zero,
/// a number that is too large for CLN. GiNaC and CLN say so by exceptions of several types. All
/// others, such as TooLarge or std::bad_alloc, are not about values, and pass.
template <class Compute>
auto where_defined(Compute&& compute) -> std::optional<decltype(compute())> {
  try {
    return std::forward<Compute>(compute)();
  } catch (const std::domain_error&) {  // GiNaC::pole_error is one
    return std::nullopt;
  } catch (const std::overflow_error&) {  // GiNaC's division of numbers by zero
    return std::nullopt;
  } catch (const cln::runtime_exception&) {
    return std::nullopt;
  }
}

}  // namespace casimir

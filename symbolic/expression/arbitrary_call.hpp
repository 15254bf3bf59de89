#pragma once

#include <optional>
#include <vector>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {

/// Reads what stands between the name of an arbitrary function and its arguments: nothing, primes
/// (U'' of one argument), or a prime and the numbers of the arguments it is differentiated by
/// (U'[1,2] of several).
/// \param at  the offset in `text`; moved behind what was read
/// \return  one order for each argument
/// \throws CaseError
std::vector<unsigned> read_orders(const Text& text, std::size_t& at, std::size_t end,
                                  const FunctionName& function);

/// Of the symbol of an arbitrary function its name; empty for any other value.
std::optional<FunctionName> named_function(const GiNaC::ex& value);

/// The derivative of an arbitrary function with bounds on what it costs.
Quantity value_of_arbitrary(const GiNaC::ex& function, const std::vector<unsigned>& orders,
                            const std::vector<Quantity>& arguments);

}  // namespace casimir

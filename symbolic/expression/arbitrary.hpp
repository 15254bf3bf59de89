#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

namespace casimir {

/// Arbitrary functions of a case file, as U in `[functions] U = ["r"]`. In a model each is a
/// parameter whose name shows its arguments, "U(r)", and whose value is a function: the symbol of
/// the parameter is the first operand of every value and derivative of U. Where the symbol is
/// replaced by a function that is given (`given_function`), values and derivatives become its own.

inline constexpr std::size_t kMostArguments = 4;  ///< of an arbitrary function

/// What the name of a parameter says that is an arbitrary function.
struct FunctionName {
  std::string name;                    ///< U
  std::vector<std::string> arguments;  ///< r
};

/// "U(r, s)".
std::string function_parameter_name(const FunctionName& function);

/// The parts of such a name; empty for the name of a parameter that is a number.
std::optional<FunctionName> function_name(const std::string& parameter);

/// The derivative of orders n_1, .. of an arbitrary function at some arguments: U^(n)(a).
/// \param function  the symbol of the parameter
GiNaC::ex arbitrary(const GiNaC::ex& function, const std::vector<unsigned>& orders,
                    const std::vector<GiNaC::ex>& arguments);

/// What a value of an arbitrary function is of.
struct Arbitrary {
  GiNaC::symbol function;
  std::vector<unsigned> orders;
  std::vector<GiNaC::ex> arguments;
};

/// Empty for any other function.
std::optional<Arbitrary> as_arbitrary(const GiNaC::function& f);

/// The sum of the orders of the highest derivative of arbitrary functions in an expression; empty
/// where it has none of them.
std::optional<unsigned> highest_derivative(const GiNaC::ex& expression);

/// The value of a parameter that is a function: `body` over symbols of its own.
GiNaC::ex given_function(const std::vector<GiNaC::symbol>& arguments, const GiNaC::ex& body);

/// "U", "U'", "U''" or, of several arguments, "U'[1,2]".
std::string derivative_text(const std::string& name, const std::vector<unsigned>& orders);

}  // namespace casimir

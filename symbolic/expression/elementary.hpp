#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace casimir {

/// A function that expressions may use, of one argument or two.
struct ElementaryFunction {
  std::string_view name;
  std::size_t arity = 1;
  GiNaC::ex (*apply)(const GiNaC::ex&, const GiNaC::ex&);  ///< the second is ignored for arity 1
  int uses = 1;             ///< how often the argument occurs in what it makes
  bool real = false;        ///< whether it is for real numbers alone
  bool everywhere = false;  ///< whether it has a value wherever its argument has one
};

/// The function of that name, or null.
const ElementaryFunction* find_elementary_function(const std::string& name);

std::vector<std::string> elementary_function_names();

/// A hyperbolic function by exponentials of its argument, as exact algebra takes it; nothing for
/// other functions.
std::optional<GiNaC::ex> by_exponentials(const GiNaC::function& f);

}  // namespace casimir

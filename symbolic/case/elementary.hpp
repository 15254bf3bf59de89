#pragma once

#include <ginac/ginac.h>

#include <string>
#include <string_view>
#include <vector>

namespace casimir {

/// A function that expressions may use, of one argument or two.
struct ElementaryFunction {
  std::string_view name;
  std::size_t arity;
  GiNaC::ex (*apply)(const GiNaC::ex&, const GiNaC::ex&);  ///< the second is ignored for arity 1
};

/// The function of that name, or null.
const ElementaryFunction* find_elementary_function(const std::string& name);

std::vector<std::string> elementary_function_names();

}  // namespace casimir

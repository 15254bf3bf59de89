#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// Where a search has to find something: values of parameters, over the others, and the function.
struct Special {
  Substitution values;  ///< empty: for all values
  Expr function;
};

/// A request to search, and what is known to be there by construction.
struct SearchCase {
  Case base;  ///< its level, if any, is that of its conditional claim
  int degree = 1;
  std::vector<Expr> functions{};
  std::vector<std::string> free{};
  std::vector<Special> specials{};

  bool is_free() const { return !free.empty(); }
  /// The case file, with the command that asks in its first line.
  std::string text() const;
};

using SearchTemplate = SearchCase (*)(Random&);
/// Systems that have an integral which a search may overlook when it takes an identity, a function
/// or an exponent for a symbol.
const std::vector<SearchTemplate>& search_templates();
/// The same for values of parameters.
const std::vector<SearchTemplate>& free_templates();

}  // namespace casimir::adversary

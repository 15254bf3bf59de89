#pragma once

#include <string>
#include <vector>

#include "symbolic/expression/expression.hpp"
#include "symbolic/model.hpp"

namespace casimir {

// What the readers of a case file's tables share.

/// The sign of a Poisson map as the file writes it: "+", also where nothing is said, or "-".
/// \throws CaseError  for any other text.
int sign_of(const std::optional<Text>& text);

/// \throws CaseError  where a symbol has the name `value`, which names the value of a residual in a
///                    witness, as each symbol has its value there by its name.
void check_symbol_name(const Text& name);

/// \param lost  gets what GiNaC simplified away.
Assumption assumption_of(const Text& text, Scope& names, std::vector<GiNaC::ex>& lost);

/// A function of the file with what it was written with beside its value.
NamedExpression named(const Text& name, const Quantity& quantity);

/// The same of an expression that has no name, which its own text stands for.
NamedExpression anonymous(const Text& text, Scope& names);

/// One expression for each symbol, over `names`.
/// \param domain  gets what they are defined by beside their values, as of NamedExpression.
/// \throws CaseError  for a symbol without an expression, and for a name that is none of them.
std::vector<GiNaC::ex> all_components(const Text& map, const std::vector<Entry>& entries,
                                      const std::vector<GiNaC::symbol>& symbols, Scope& names,
                                      const std::string& what, std::vector<GiNaC::ex>& domain);

}  // namespace casimir

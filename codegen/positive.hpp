#pragma once

#include <ginac/ginac.h>

namespace casimir::codegen {

/// Whether the form of an expression in real symbols shows that it is positive wherever it has a
/// value: exp(q), q^2 + 1. False says nothing.
bool is_shown_positive(const GiNaC::ex& expression);

}  // namespace casimir::codegen

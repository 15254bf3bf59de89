#pragma once

#include <utility>

#include "tests/adversary/identity_tables.hpp"

namespace casimir::adversary {

/// Of an identity, made of operands.
using Sides = std::pair<Expr, Expr>;
using Made = const Operands&;

inline const Expr kTwo = 2;

inline Expr square(const Expr& e) { return pow(e, 2); }
inline Expr cube(const Expr& e) { return pow(e, 3); }
inline Expr hypot(const Expr& a, const Expr& b) { return sqrt(square(a) + square(b)); }

}  // namespace casimir::adversary

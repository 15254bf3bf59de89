#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/adversary/ball.hpp"
#include "tests/adversary/expression.hpp"

namespace casimir::adversary {

/// Thrown where some part of an expression has no real value at a point: the point is outside of
/// the domain.
struct NotReal {};
/// Thrown where 60 digits do not tell, or a derivative has no value: at the edge of a domain.
struct Unknown {};

using Point = std::map<std::string, Ball>;

/// A value and its derivatives along some symbols.
struct Dual {
  Ball value;
  std::vector<Ball> slope;
};

/// The value and the gradient by automatic differentiation, from the tree alone.
/// \param along  the symbols to differentiate by
/// \param real   whether every part has to be real; else principal branches of complex functions
/// \throws NotReal, Unknown
Dual evaluate(const Expr& e, const Point& point, const std::vector<std::string>& along, bool real);

/// The value alone.
Ball value(const Expr& e, const Point& point, bool real = true);

}  // namespace casimir::adversary

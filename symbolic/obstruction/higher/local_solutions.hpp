#pragma once

#include <optional>

#include "symbolic/obstruction/higher/laurent_series.hpp"

namespace casimir::obstruction {

/// A fundamental matrix of x' = A x at t = 0 whose entries are Laurent series, so that its
/// monodromy around t = 0 is trivial; empty where none is found with poles of order `poles` at
/// most.
///
/// The columns solve the linear equations for finitely many coefficients. That they begin a true
/// fundamental matrix is checked afterwards: with x = Phi c the equations are c' = B c, and where
/// B = Phi^(-1) (A Phi - Phi') is O(t^p) with p >= 0, c = 1 + O(t^(p + 1)) is one solution of them.
/// The coefficients are called known as far as that formula gives them.
std::optional<SeriesMatrix> laurent_solutions(const SeriesMatrix& a, long poles, long last);

}  // namespace casimir::obstruction

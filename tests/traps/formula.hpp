#pragma once

#include <string>
#include <utility>
#include <vector>

namespace casimir::traps {

/// 64 bits of mantissa: three digits more than what is tested.
using Real = long double;

using Texts = std::vector<std::string>;
using Named = std::vector<std::pair<std::string, std::string>>;

/// Expressions in the notation of case files with values in `Real`. They share no code with what is
/// tested.
class Formulas {
 public:
  /// \param symbols      with values when asked for, in this order
  /// \param definitions  names for subexpressions, each over what stands before it
  /// \throws std::runtime_error  for what is no expression
  Formulas(const Texts& symbols, const Named& definitions, const Texts& texts);
  /// The values of all texts. Not for two threads at a time.
  void operator()(const Real* symbols, Real* values);

 private:
  friend class Reader;
  enum class Op {
    constant,
    symbol,
    add,
    subtract,
    multiply,
    divide,
    negate,
    whole_power,
    power,
    sqrt,
    sin,
    cos,
    tan,
    exp,
    log,
    asin,
    acos,
    atan,
    atan2,
    sinh,
    cosh,
    tanh,
    cot,
    absolute,
    sign
  };
  struct Line {
    Op op;
    int a = 0, b = 0;  ///< lines, or a symbol, or an exponent
    Real value = 0;
  };
  Real value_of(const Line& line, const Real* symbols) const;

  std::vector<Line> lines_;
  std::vector<int> results_;
  std::vector<Real> values_;
};

/// The value of a constant expression, as "1/3" or "exp(-100)".
Real constant(const std::string& text);

}  // namespace casimir::traps

#pragma once

#include <ginac/ginac.h>

#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {

/// A point of the phase and parameter space with exact coordinates: rational, or an angle with
/// rational sine and cosine, or the logarithm of a rational number. Evaluates expressions by GiNaC
/// alone, independently of the ring that found the point.
class ExactPoint {
 public:
  /// \param point  completed by `ring` with a Freedom whose `bare` symbols are `bare`.
  ExactPoint(const FunctionRing& ring, const std::vector<cln::cl_RA>& point,
             const std::vector<bool>& bare);

  /// The value of an expression over the ring's symbols; a rational number where it is one.
  /// \throws std::exception  at a pole
  GiNaC::ex evaluate(const GiNaC::ex& expression) const;

  /// Each symbol with its value, such as "3/5", "2*atan(1/3)" or "log(2)".
  const std::vector<std::pair<std::string, std::string>>& coordinates() const {
    return coordinates_;
  }

  /// The value of a symbol of the ring.
  const GiNaC::ex& value(const GiNaC::symbol& symbol) const { return values_.at(symbol); }

 private:
  struct Functions;
  Limits limits_;
  GiNaC::exmap values_;
  /// For each angle u = factor * symbol: symbol, factor, and exp(I u) as a Gaussian rational.
  struct Angle {
    GiNaC::ex symbol;
    GiNaC::numeric factor;
    GiNaC::numeric circle;
  };
  struct Exponent {
    GiNaC::ex symbol;
    GiNaC::numeric factor;
    GiNaC::numeric value;
  };
  std::vector<Angle> angles_;
  std::vector<Exponent> exponents_;
  std::vector<std::pair<std::string, std::string>> coordinates_;
};

}  // namespace casimir

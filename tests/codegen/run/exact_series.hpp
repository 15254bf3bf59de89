#pragma once

#include <cln/float.h>
#include <ginac/ginac.h>

#include <map>
#include <vector>

namespace casimir::testing {

/// A number in sixty digits, and what its rounding errors in another precision are measured by:
/// with a relative error e in every operation, the number has an absolute error of a few e * size.
struct Sized {
  cln::cl_F value;
  double size = 0;
};

/// A truncated power series in one variable.
using Series = std::vector<Sized>;

/// Evaluates expressions of GiNaC along series: nothing of it is shared with the code generator.
/// Order 0 gives values, order 1 along x + s*d derivatives in the direction d.
class SeriesEvaluator {
 public:
  explicit SeriesEvaluator(std::size_t order) : order_(order) {}

  void set(const GiNaC::symbol& symbol, Series series);

  /// \throws std::domain_error  where it has no finite value, or is no function that we know.
  Series operator()(const GiNaC::ex& expression) const;

  Series constant(const cln::cl_R& value) const;

 private:
  Series power(const GiNaC::ex& base, const GiNaC::ex& exponent) const;
  Series call(const GiNaC::ex& function) const;

  std::size_t order_;
  std::map<GiNaC::ex, Series, GiNaC::ex_is_less> values_;
};

/// The Taylor coefficients of the solutions of x' = field up to `order`, by power matching.
/// \param fixed  what other symbols stand for; the time, if any, as its value at the start.
std::vector<Series> solution_series(const std::vector<GiNaC::symbol>& variables,
                                    const std::vector<GiNaC::ex>& field,
                                    const std::vector<cln::cl_R>& state,
                                    const std::map<GiNaC::ex, cln::cl_R, GiNaC::ex_is_less>& fixed,
                                    const GiNaC::symbol* time, std::size_t order);

}  // namespace casimir::testing

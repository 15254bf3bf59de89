#include "symbolic/witness.hpp"

#include <cln/rational.h>
#include <cln/rational_io.h>

#include <algorithm>
#include <sstream>

#include "symbolic/exact_constant.hpp"
#include "symbolic/exact_point.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// The symbols that must keep rational values, since they occur otherwise than as plain angles.
std::vector<bool> bare_symbols(const Model& model, const FunctionRing& ring,
                               const Polynomial& numerator, const Level& level) {
  std::vector<bool> bare = ring.bare_symbols(numerator);
  const auto keep = [&](const ex& e) {
    for (std::size_t i = 0; i < bare.size(); ++i) bare[i] = bare[i] || e.has(ring.symbols()[i]);
  };
  for (const Polynomial& f : level.numerators) {
    const std::vector<bool> of_level = ring.bare_symbols(f);
    for (std::size_t i = 0; i < bare.size(); ++i) bare[i] = bare[i] || of_level[i];
  }
  for (const Assumption& a : model.assumptions) keep(a.difference);
  return bare;
}

/// The witness if the value at this point is shown not to be zero, and the level's to be zero.
std::optional<Witness> confirmed(const ExactPoint& point, const ex& expression, const Level& level,
                                 const std::vector<ex>& real_domain) {
  try {
    const bool real = std::all_of(real_domain.begin(), real_domain.end(), [&](const ex& f) {
      const auto sign = sign_of_constant(point.evaluate(f));
      return sign && *sign >= 0;
    });
    if (!real) return std::nullopt;
    const auto value = exact_constant(point.evaluate(expression));
    if (!value || value->zero) return std::nullopt;
    const bool on_level =
        std::all_of(level.functions.begin(), level.functions.end(), [&](const ex& f) {
          const auto zero = exact_constant(point.evaluate(f));
          return zero && zero->zero;
        });
    if (!on_level) return std::nullopt;
    return Witness{point.coordinates(), value->text};
  } catch (const std::exception&) {
    return std::nullopt;  // a pole at this point
  }
}

}  // namespace

std::optional<Witness> find_witness(const Model& model, const FunctionRing& ring,
                                    PointSearch& points, const Polynomial& numerator,
                                    const std::function<ex()>& by_ginac, const Level& level) {
  const ex expression = by_ginac();
  const std::vector<ex> real_domain = ring.real_domain();
  constexpr int kTrials = 60;
  if (ring.has_value(numerator)) {  // the nicest points: every function has a rational value
    const FunctionRing::Freedom freedom{false, bare_symbols(model, ring, numerator, level)};
    for (int trial = 0; trial < kTrials; ++trial) {
      const auto point = points.completed(level, freedom);
      if (!point) break;
      if (cln::zerop(numerator.evaluate(*point))) continue;
      if (auto found =
              confirmed(ExactPoint(ring, *point, freedom.bare), expression, level, real_domain))
        return found;
    }
  }
  if (ring.is_polynomial()) return std::nullopt;
  const std::vector<bool> all_bare(ring.symbols().size(), true);
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto point = points.rational(level);
    if (!point) break;
    if (auto found = confirmed(ExactPoint(ring, *point, all_bare), expression, level, real_domain))
      return found;
  }
  return std::nullopt;
}

}  // namespace casimir

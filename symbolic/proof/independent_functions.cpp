#include "symbolic/proof/independent_functions.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/proof/points/real_point.hpp"
#include "symbolic/proof/thin_domain.hpp"

namespace casimir {
namespace {

constexpr std::size_t kMostFunctions = 30;
constexpr std::size_t kDrawsForEach = 8;

using Values = std::vector<std::vector<Ball>>;

/// Values of the functions at points, sorted by the signs of the switches; empty where there are no
/// points.
std::map<std::vector<int>, Values> values_on_pieces(Prover& prover,
                                                    const std::vector<Polynomial>& functions,
                                                    const std::vector<Polynomial>& switches) {
  std::map<std::vector<int>, Values> pieces;
  const std::size_t enough = functions.size() + 2;
  for (std::size_t k = 0; k < kDrawsForEach * enough; ++k) {
    auto point = prover.real_points().random(prover.domain());
    if (!point) break;
    std::vector<int> signs;
    for (const Polynomial& p : switches) signs.push_back(point->value(p).sign().value_or(0));
    if (std::find(signs.begin(), signs.end(), 0) != signs.end()) continue;
    Values& values = pieces[signs];
    if (values.size() >= enough) continue;
    values.emplace_back();
    for (const Polynomial& f : functions) values.back().push_back(point->value(f));
    if (switches.empty() && values.size() == enough) break;
  }
  return pieces;
}

/// One row for each polynomial, a column for each of the monomials that are wanted.
RationalMatrix coefficients(const std::vector<Polynomial>& polynomials,
                            const std::function<bool(const std::vector<unsigned long>&)>& wanted) {
  std::map<std::vector<unsigned long>, std::size_t> columns;
  for (const Polynomial& p : polynomials)
    for (const auto& [number, powers] : p.term_list())
      if (wanted(powers)) columns.try_emplace(powers, columns.size());
  RationalMatrix rows(polynomials.size(), std::vector<cln::cl_RA>(columns.size()));
  for (std::size_t i = 0; i < polynomials.size(); ++i)
    for (const auto& [number, powers] : polynomials[i].term_list())
      if (wanted(powers)) rows[i][columns.at(powers)] = number;
  return rows;
}

/// Whether all generators in them are exponentials of polynomials that are independent over the
/// rational numbers up to constants: such are algebraically independent over the rational
/// functions.
bool are_of_free_exponentials(const FunctionRing& ring, const std::vector<Polynomial>& functions) {
  const std::size_t own = ring.symbols().size();
  std::vector<Polynomial> exponents;
  for (std::size_t g = own; g < ring.end_of_generators(); ++g) {
    if (std::none_of(functions.begin(), functions.end(),
                     [&](const Polynomial& f) { return f.uses(g); }))
      continue;
    const FunctionRing::Origin origin = ring.origin(g);
    if (origin.kind != FunctionRing::Origin::Kind::exponential) return false;
    for (std::size_t k = own; k < ring.end_of_generators(); ++k)
      if (origin.argument.uses(k)) return false;  // no polynomial
    exponents.push_back(origin.argument);
  }
  const auto varies = [](const std::vector<unsigned long>& powers) {
    return std::any_of(powers.begin(), powers.end(), [](unsigned long k) { return k > 0; });
  };
  return exponents.empty() || rank(coefficients(exponents, varies)) == exponents.size();
}

}  // namespace

bool independent_on_pieces(Prover& prover, const std::vector<Polynomial>& functions) {
  if (functions.empty()) return false;
  if (are_of_free_exponentials(prover.ring(), functions)) {
    const auto all = [](const std::vector<unsigned long>&) { return true; };
    return rank(coefficients(functions, all)) == functions.size();
  }
  if (functions.size() > kMostFunctions) return false;
  const FunctionRing::Pieces what = prover.ring().pieces(functions);
  if (!what.rigid || thin_domain(prover)) return false;
  try {
    auto pieces = values_on_pieces(prover, functions, what.switches);
    return !pieces.empty() && std::all_of(pieces.begin(), pieces.end(), [&](auto& piece) {
      return least_rank(std::move(piece.second), RealPoints::kBits) == functions.size();
    });
  } catch (const NotCertified&) {
    return false;
  }
}

}  // namespace casimir

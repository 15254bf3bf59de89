#include "symbolic/proof/lasting_minor.hpp"

#include <algorithm>
#include <map>

#include "symbolic/proof/generic_rank.hpp"
#include "symbolic/proof/independent_functions.hpp"
#include "symbolic/proof/parameter_minors.hpp"

namespace casimir {
namespace {

using Indices = std::vector<std::size_t>;

class LastingMinor {
 public:
  LastingMinor(Prover& prover, const PolynomialRows& rows, std::size_t rank,
               const MatrixParameters& parameters)
      : prover_(prover), ring_(prover.ring()), rows_(rows), rank_(rank), parameters_(parameters) {}

  bool exists();

 private:
  const PolynomialRing& ring() const { return ring_.ring(); }
  bool lasts(const Polynomial& minor);
  PolynomialRows minor_of(const Indices& rows, const Indices& columns) const;
  bool is_never_identically_zero(const Polynomial& f);

  Prover& prover_;
  const FunctionRing& ring_;
  const PolynomialRows& rows_;
  std::size_t rank_;
  const MatrixParameters& parameters_;
};

bool LastingMinor::exists() {
  constexpr std::size_t kMost = 12, kMostTerms = 400;
  std::size_t tried = 0;
  try {
    auto point = prover_.real_points().random(prover_.domain());
    if (!point) return false;
    const auto [own_rows, own_columns] = regular_minor(*point, rows_, rank_);
    if (own_rows.size() < rank_ || own_columns.size() < rank_) return false;
    for (const Indices& rows : with_one_changed(own_rows, rows_.size())) {
      for (const Indices& columns : with_one_changed(own_columns, rows_[0].size())) {
        if (tried++ == kMost) return false;
        const auto value = short_determinant(minor_of(rows, columns), ring(), kMostTerms);
        if (value && lasts(*value) && !point->value(*value).contains_zero()) return true;
      }
    }
  } catch (const NotCertified&) {
  }
  return false;
}

bool LastingMinor::lasts(const Polynomial& minor) {
  const auto has_no_zeros = [&](const Polynomial& product) {
    const auto factors = product.factors();
    return !product.is_zero() &&
           std::all_of(factors.begin(), factors.end(), [&](const auto& factor) {
             const Polynomial& f = factor.first;
             return f.is_constant() || !parameters_.depends(f) || ring_.is_nowhere_zero(f) ||
                    parameters_.is_excluded(f) || is_never_identically_zero(f);
           });
  };
  return has_no_zeros(ring_.lowest_terms(minor).first) || has_no_zeros(minor);
}

PolynomialRows LastingMinor::minor_of(const Indices& rows, const Indices& columns) const {
  PolynomialRows minor;
  for (const std::size_t i : rows) {
    minor.emplace_back();
    for (const std::size_t j : columns) minor.back().push_back(rows_[i][j]);
  }
  return minor;
}

/// A sum of independent functions without parameters, of which one coefficient is not zero at all
/// parameters beside the zeros of the factors that were looked at. Where no function has parameters
/// it is enough that the coefficients have no other factor in common: then they vanish together for
/// fewer parameters than one equation leaves.
bool LastingMinor::is_never_identically_zero(const Polynomial& f) {
  std::map<std::vector<unsigned long>, Polynomial> coefficients;
  bool polynomial = true;
  for (const auto& [number, exponents] : f.term_list()) {
    std::vector<unsigned long> others(exponents.size()), own(exponents.size());
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] > 0 && i >= ring_.symbols().size()) {
        if (parameters_.depends(ring().variable(i))) return false;
        polynomial = false;
      }
      (parameters_.is_parameter(i) ? own : others)[i] = exponents[i];
    }
    TermCollector term(ring());
    term.add(number, own);
    coefficients.try_emplace(others, ring()).first->second += term.finish();
  }
  const auto lasts = [&](const Polynomial& coefficient) {
    const auto factors = coefficient.factors();
    return ring_.is_nowhere_zero(coefficient) ||
           std::all_of(factors.begin(), factors.end(), [&](const auto& factor) {
             return factor.first.is_constant() || parameters_.is_excluded(factor.first);
           });
  };
  Polynomial common(ring());
  bool any = false;
  for (const auto& [unused, coefficient] : coefficients) {
    any = any || lasts(coefficient);
    common = Polynomial::gcd(common, coefficient);
  }
  if (!any && (parameters_.in_functions || !lasts(common))) return false;
  if (polynomial) return true;
  std::vector<Polynomial> functions;
  for (const auto& [exponents, unused] : coefficients) {
    TermCollector term(ring());
    term.add(1, exponents);
    functions.push_back(term.finish());
  }
  return independent_on_pieces(prover_, functions);
}

}  // namespace

bool has_lasting_minor(Prover& prover, const PolynomialRows& rows, std::size_t rank,
                       const MatrixParameters& parameters) {
  return LastingMinor(prover, rows, rank, parameters).exists();
}

}  // namespace casimir

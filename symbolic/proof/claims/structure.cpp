// The bracket itself: skew symmetry and the Jacobi identity, Borisov & Mamaev (1.8).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string>

#include "symbolic/proof/certificate_writer.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/theorems.hpp"

namespace casimir {

std::vector<Claim> skew_claims(const Model& model) {
  if (!model.poisson) return {};
  return {{ClaimKind::skew,
           "bracket",
           false,
           [](Prover& prover, Proof& proof) {
             std::vector<Residual> residuals;
             const PoissonStructure& structure = *prover.model().poisson;
             for (std::size_t i = 0; i < prover.dimension(); ++i) {
               for (std::size_t j = 0; j <= i; ++j) {
                 residuals.push_back(
                     {fmt::format("{{x{0},x{1}}} + {{x{1},x{0}}}", i + 1, j + 1),
                      prover.bracket_entry(i, j) + prover.bracket_entry(j, i),
                      [&structure, i, j] { return structure(i, j) + structure(j, i); }});
               }
             }
             prover.decide(proof, residuals, {});
           },
           {},
           {},
           false,
           Subject::bracket}};
}

namespace {

/// Structure constants of a linear bracket, {x_i, x_j} = sum_k c(i, j)[k] x_k / d, as machine
/// integers that are small enough for sums of their products.
class StructureConstants {
 public:
  /// Empty for any other bracket.
  static std::optional<StructureConstants> of(const Prover& prover) {
    StructureConstants result(prover.dimension());
    return result.read(prover) && result.fits() ? std::optional(std::move(result)) : std::nullopt;
  }

  /// Whether {x_i,{x_j,x_k}} + cyclic is zero: exact, since no sum can overflow.
  bool jacobi_holds(std::size_t i, std::size_t j, std::size_t k) {
    std::fill(sum_.begin(), sum_.end(), 0);
    add_nested(i, j, k);
    add_nested(j, k, i);
    add_nested(k, i, j);
    return std::all_of(sum_.begin(), sum_.end(), [](long s) { return s == 0; });
  }

 private:
  explicit StructureConstants(std::size_t n) : n_(n), constants_(n * n * n), sum_(n) {}

  long* row(std::size_t i, std::size_t j) { return constants_.data() + (i * n_ + j) * n_; }

  bool read(const Prover& prover) {
    constexpr long kMaxDenominator = 1L << 31;
    std::vector<std::optional<Polynomial::LinearForm>> forms;
    long common = 1;
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = i + 1; j < n_; ++j) {
        forms.push_back(prover.bracket_entry(i, j).linear_form());
        if (!forms.back()) return false;
        common = std::lcm(common, forms.back()->denominator);
        if (common >= kMaxDenominator) return false;
      }
    }
    auto form = forms.begin();
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = i + 1; j < n_; ++j, ++form) {
        for (const auto& [k, c] : (*form)->coefficients) {
          if (k >= n_) return false;  // a parameter or a generator
          row(i, j)[k] = c * (common / (*form)->denominator);
          row(j, i)[k] = -row(i, j)[k];
        }
      }
    }
    return true;
  }

  bool fits() const {
    long largest = 0;
    for (const long c : constants_) largest = std::max(largest, std::labs(c));
    // 3 n products are added up.
    const long bound = std::numeric_limits<long>::max() / (3 * static_cast<long>(n_));
    return largest == 0 || largest <= bound / largest;
  }

  /// Adds {x_a,{x_b,x_c}}.
  void add_nested(std::size_t a, std::size_t b, std::size_t c) {
    const long* inner = row(b, c);
    for (std::size_t l = 0; l < n_; ++l) {
      if (inner[l] == 0) continue;
      const long* outer = row(a, l);
      for (std::size_t m = 0; m < n_; ++m) sum_[m] += inner[l] * outer[m];
    }
  }

  std::size_t n_;
  std::vector<long> constants_, sum_;
};

/// The defects of a bracket of any form; the derivatives of its entries are taken once.
class Jacobi {
 public:
  explicit Jacobi(const Prover& prover) : prover_(prover), n_(prover.dimension()) {
    slopes_.resize(n_ * n_);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        const Polynomial& entry = prover.bracket_entry(i, j);
        if (entry.is_constant()) continue;
        for (std::size_t l = 0; l < n_; ++l) {
          Polynomial slope = prover.ring().derivative(entry, l);
          if (!slope.is_zero()) slopes_[i * n_ + j].emplace_back(l, std::move(slope));
        }
      }
    }
  }

  Polynomial defect(std::size_t i, std::size_t j, std::size_t k) const {
    SumOfProducts sum(prover_.ring().ring());
    const std::size_t cyclic[3][3] = {{i, j, k}, {j, k, i}, {k, i, j}};
    for (const auto& [a, b, c] : cyclic) {
      for (const auto& [l, slope] : slopes_[b * n_ + c])
        sum.add(prover_.bracket_entry(a, l), slope);
    }
    return sum.finish();
  }

 private:
  const Prover& prover_;
  std::size_t n_;
  std::vector<std::vector<std::pair<std::size_t, Polynomial>>> slopes_;
};

void decide_jacobi(Prover& prover, Proof& proof) {
  const auto& x = prover.model().variables;
  std::optional<StructureConstants> constants = StructureConstants::of(prover);
  std::optional<Jacobi> jacobi;
  std::vector<Residual> residuals;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = i + 1; j < x.size(); ++j) {
      for (std::size_t k = j + 1; k < x.size(); ++k) {
        if (constants && constants->jacobi_holds(i, j, k)) continue;
        if (!jacobi) jacobi.emplace(prover);
        Polynomial defect = jacobi->defect(i, j, k);
        if (defect.is_zero()) continue;  // of a hundred thousand nearly all are
        residuals.push_back({fmt::format("{{{0},{{{1},{2}}}}} + cyclic", x[i].get_name(),
                                         x[j].get_name(), x[k].get_name()),
                             std::move(defect), [&prover, i, j, k] {
                               return prover.model().poisson->jacobi_defect(i, j, k);
                             }});
      }
    }
  }
  prover.decide(proof, residuals, {});
}

/// Where the bracket may jump on the way of a motion. The flow keeps the bracket on each side and
/// need not take the one to the other.
void say_where_bracket_jumps(Prover& prover, Proof& proof) {
  std::set<std::string> jumps;
  const std::size_t n = prover.model().variables.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (const Polynomial& jump : prover.passed_jumps(prover.bracket_entry(i, j), true))
        jumps.insert(prover.ring().text(jump) + " = 0");
  proof.jumps.assign(jumps.begin(), jumps.end());
}

}  // namespace

std::vector<Claim> jacobi_claims(const Model& model) {
  if (!model.poisson) return {};
  return {{ClaimKind::jacobi,
           "Jacobi identity",
           false,
           [](Prover& prover, Proof& proof) {
             decide_jacobi(prover, proof);
             if (proof.verdict == Verdict::proved) say_where_bracket_jumps(prover, proof);
           },
           {},
           {},
           false,
           Subject::bracket}};
}

bool is_poisson(Prover& prover) {
  Proof proof;
  decide_jacobi(prover, proof);
  return proof.verdict == Verdict::proved;
}

void certify_skew(CertificateWriter& writer, const Statement& /*statement*/) {
  writer.file().begin_part("skew: the bracket is skew symmetric");
  writer.file().state_skew_symmetry();
}

void certify_jacobi(CertificateWriter& writer, const Statement& /*statement*/) {
  const auto twice = [&](std::size_t i, std::size_t j, std::size_t k) {
    return writer.flow(i, writer.bracket_entry(j, k));
  };
  for (std::size_t i = 0; i < writer.dimension(); ++i) {
    for (std::size_t j = i + 1; j < writer.dimension(); ++j) {
      for (std::size_t k = j + 1; k < writer.dimension(); ++k) {
        const Polynomial defect = twice(i, j, k) + twice(j, k, i) + twice(k, i, j);
        CertificateWriter::cofactors(defect, {});
      }
    }
  }
  writer.file().begin_part("jacobi: the Jacobi identity");
  writer.file().state_jacobi();
}

}  // namespace casimir

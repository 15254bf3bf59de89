// Polynomial relations between functions: found by linear algebra on their values modulo a prime,
// then proved.
#include "symbolic/proof/dependence.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <cln/rational_io.h>
#include <flint/fmpq.h>
#include <flint/nmod_mat.h>

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/functions/point_completer.hpp"

namespace casimir {
namespace {

constexpr mp_limb_t kPrimeOfRank = (mp_limb_t{1} << 61) - 1;
constexpr std::size_t kMaxMonomials = 700;
constexpr std::size_t kSpareRows = 10;  ///< equations beyond the unknowns

using Exponents = std::vector<unsigned>;
using Term = std::pair<cln::cl_RA, Exponents>;

cln::cl_I prime() { return (cln::cl_I(1) << 61) - 1; }

/// Numerator over denominator modulo the prime; empty if it divides the denominator.
std::optional<mp_limb_t> residue(const cln::cl_RA& value, nmod_t modulus) {
  const auto reduced = [](const cln::cl_I& n) {
    return static_cast<mp_limb_t>(cln::cl_I_to_ulong(cln::mod(n, prime())));
  };
  const mp_limb_t denominator = reduced(cln::denominator(value));
  if (denominator == 0) return std::nullopt;
  return nmod_div(reduced(cln::numerator(value)), denominator, modulus);
}

cln::cl_I integer_of(const fmpz_t value) {
  char* digits = fmpz_get_str(nullptr, 10, value);
  const cln::cl_I result(digits);
  flint_free(digits);
  return result;
}

/// The rational with small numerator and denominator that has this residue.
std::optional<cln::cl_RA> reconstructed(mp_limb_t value) {
  fmpz_t residue_value;
  fmpz_t modulus;
  fmpq_t rational;
  fmpz_init_set_ui(residue_value, value);
  fmpz_init_set_ui(modulus, kPrimeOfRank);
  fmpq_init(rational);
  std::optional<cln::cl_RA> result;
  if (fmpq_reconstruct_fmpz(rational, residue_value, modulus) != 0)
    result = cln::cl_RA(integer_of(fmpq_numref(rational))) / integer_of(fmpq_denref(rational));
  fmpq_clear(rational);
  fmpz_clear(modulus);
  fmpz_clear(residue_value);
  return result;
}

/// A scoped matrix modulo the prime.
class ResidueMatrix {
 public:
  ResidueMatrix(std::size_t rows, std::size_t columns) {
    nmod_mat_init(value_, static_cast<slong>(rows), static_cast<slong>(columns), kPrimeOfRank);
  }
  ~ResidueMatrix() { nmod_mat_clear(value_); }
  ResidueMatrix(const ResidueMatrix&) = delete;
  ResidueMatrix& operator=(const ResidueMatrix&) = delete;
  mp_limb_t& operator()(std::size_t i, std::size_t j) { return value_->rows[i][j]; }
  nmod_t modulus() const { return value_->mod; }
  void reduce() { nmod_mat_rref(value_); }

 private:
  nmod_mat_t value_;
};

/// What the relation may be made of: the functions, then the parameters, each with its degree.
class ModularRelation {
 public:
  ModularRelation(Prover& prover, const std::vector<NamedExpression>& functions, bool independent)
      : prover_(prover), independent_(independent) {
    for (const NamedExpression& f : functions)
      add(f.name, prover.convert(f.value), /*parameter=*/false);
    for (std::size_t i = 0; i < prover.model().parameters.size(); ++i) {
      add(prover.model().parameters[i].get_name(),
          prover.ring().ring().variable(prover.dimension() + i), /*parameter=*/true);
    }
  }

  std::optional<std::string> find() {
    if (!std::all_of(values_.begin(), values_.end(), [&](const Polynomial& p) {
          return functions::PointCompleter(prover_.ring().table()).has_value(p);
        })) {
      return std::nullopt;
    }
    const long first = weights_[0];
    for (const long bound : {first, 2 * first, 3 * first, 4 * first}) {
      std::vector<Exponents> monomials = monomials_up_to(bound);
      if (monomials.size() > kMaxMonomials) return std::nullopt;
      const auto relation = null_vector(monomials);
      if (relation && determines_first(*relation) && holds(*relation)) return text(*relation);
    }
    return std::nullopt;
  }

 private:
  void add(const std::string& name, const Polynomial& value, bool parameter) {
    names_.push_back(name);
    values_.push_back(value);
    weights_.push_back(parameter ? 1
                                 : std::max(1L, prover_.ring().numerator(value).total_degree()));
  }

  long weight(const Exponents& e) const {
    long sum = 0;
    for (std::size_t i = 0; i < e.size(); ++i) sum += weights_[i] * static_cast<long>(e[i]);
    return sum;
  }

  /// All of weight at most `bound`: light ones first, among equal ones those with the function that
  /// is asked about last, so that it is what the others are solved for.
  std::vector<Exponents> monomials_up_to(long bound) const {
    std::vector<Exponents> result{Exponents(names_.size())};
    for (std::size_t i = 0; i < names_.size(); ++i) {
      for (std::size_t k = 0; k < result.size() && result.size() <= kMaxMonomials; ++k) {
        Exponents next = result[k];
        ++next[i];
        if (weight(next) <= bound) result.push_back(std::move(next));
      }
    }
    std::stable_sort(result.begin(), result.end(), [&](const Exponents& a, const Exponents& b) {
      return std::pair(weight(a), a[0]) < std::pair(weight(b), b[0]);
    });
    return result;
  }

  /// The values of functions and parameters at a random point, modulo the prime.
  std::optional<std::vector<mp_limb_t>> values_at_random(nmod_t modulus) {
    const auto point = prover_.random_point({});
    if (!point) return std::nullopt;
    std::vector<mp_limb_t> values;
    for (const Polynomial& p : values_) {
      const auto value = residue(p.evaluate(*point), modulus);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
    return values;
  }

  /// The first monomial that is a combination of those before it, and that combination.
  std::optional<std::vector<Term>> null_vector(const std::vector<Exponents>& monomials) {
    const std::size_t columns = monomials.size();
    ResidueMatrix matrix(columns + kSpareRows, columns);
    for (std::size_t row = 0; row < columns + kSpareRows; ++row) {
      const auto values = values_at_random(matrix.modulus());
      if (!values) return std::nullopt;
      for (std::size_t j = 0; j < columns; ++j) {
        mp_limb_t product = 1;
        for (std::size_t i = 0; i < names_.size(); ++i) {
          for (unsigned k = 0; k < monomials[j][i]; ++k)
            product = nmod_mul(product, (*values)[i], matrix.modulus());
        }
        matrix(row, j) = product;
      }
    }
    matrix.reduce();
    for (std::size_t column = 0; column < columns; ++column) {
      if (matrix(column, column) == 1) continue;  // so far every column has had its pivot
      std::vector<Term> relation{{1, monomials[column]}};
      for (std::size_t i = 0; i < column; ++i) {
        if (matrix(i, column) == 0) continue;
        const auto coefficient = reconstructed(matrix(i, column));
        if (!coefficient) return std::nullopt;
        relation.emplace_back(-*coefficient, monomials[i]);
      }
      return relation;
    }
    return std::nullopt;
  }

  /// Whether the factor of the highest power of the first function is a number, or a function that
  /// is zero nowhere or everywhere, which it is not.
  bool determines_first(const std::vector<Term>& relation) const {
    unsigned highest = 0;
    for (const auto& [coefficient, exponents] : relation) highest = std::max(highest, exponents[0]);
    if (highest == 0) return false;
    Exponents alone(names_.size());
    alone[0] = highest;
    std::vector<Exponents> leading;
    for (const auto& [coefficient, exponents] : relation)
      if (exponents[0] == highest) leading.push_back(exponents);
    if (leading == std::vector<Exponents>{alone}) return true;
    if (!independent_) return false;
    const FunctionRing::Pieces pieces = prover_.ring().pieces(values_);
    return pieces.rigid && pieces.switches.empty();
  }

  bool holds(const std::vector<Term>& relation) const {
    Polynomial sum(prover_.ring().ring());
    for (const auto& [coefficient, exponents] : relation) {
      Polynomial term = prover_.ring().ring().constant(coefficient);
      for (std::size_t i = 0; i < exponents.size(); ++i)
        if (exponents[i] > 0) term *= values_[i].pow(exponents[i]);
      sum += term;
    }
    return prover_.ring().numerator(sum).is_zero();
  }

  std::string text_of(const Exponents& exponents) const {
    std::string text;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const bool plain = std::all_of(names_[i].begin(), names_[i].end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_';
      });
      if (!text.empty()) text += "*";
      text += plain ? names_[i] : "(" + names_[i] + ")";
      if (exponents[i] > 1) text += "^" + std::to_string(exponents[i]);
    }
    return text;
  }

  std::string text(const std::vector<Term>& relation) const {
    Exponents only_first(names_.size());
    only_first[0] = 1;
    const bool solved = relation[0].second == only_first;
    std::string sum;
    for (std::size_t k = solved ? 1 : 0; k < relation.size(); ++k) {
      const cln::cl_RA coefficient = solved ? -relation[k].first : relation[k].first;
      append_term(sum, coefficient, text_of(relation[k].second));
    }
    if (sum.empty()) sum = "0";
    return solved ? names_[0] + " = " + sum : sum + " = 0" + where_it_determines(relation);
  }

  /// Where the highest power of the first function has a factor of others, a*F = G says nothing of
  /// F for a = 0: a phrase, or nothing.
  std::string where_it_determines(const std::vector<Term>& relation) const {
    unsigned highest = 0;
    for (const auto& [coefficient, exponents] : relation) highest = std::max(highest, exponents[0]);
    std::string factor;
    bool is_number = true;
    for (auto [coefficient, exponents] : relation) {
      if (exponents[0] != highest) continue;
      exponents[0] = 0;
      const std::string text = text_of(exponents);
      is_number = is_number && text.empty();
      append_term(factor, coefficient, text);
    }
    return is_number ? "" : ", where " + factor + " != 0";
  }

  Prover& prover_;
  const bool independent_;
  std::vector<std::string> names_;
  std::vector<Polynomial> values_;
  std::vector<long> weights_;
};

}  // namespace

std::optional<std::string> polynomial_relation(Prover& prover,
                                               const std::vector<NamedExpression>& functions,
                                               bool independent) {
  return ModularRelation(prover, functions, independent).find();
}

}  // namespace casimir

#include "symbolic/proof/special_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/algebra/where_defined.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/lasting_minor.hpp"
#include "symbolic/proof/parameter_minors.hpp"
#include "symbolic/proof/parameter_sets.hpp"
#include "symbolic/proof/quotient_rows.hpp"

namespace casimir {
namespace {

using Indices = std::vector<std::size_t>;

class SpecialParameters {
 public:
  /// \param no_zeros  what vanishes nowhere where the case has values; empty before denominators are
  ///                  cleared
  SpecialParameters(Prover& prover, const PolynomialRows& rows, std::size_t rank,
                    const QuotientsModulo& quotients,
                    std::optional<std::vector<Polynomial>> no_zeros = {})
      : prover_(prover),
        ring_(prover.ring()),
        rows_(rows),
        rank_(rank),
        quotients_(quotients),
        no_zeros_(no_zeros.value_or(std::vector<Polynomial>())),
        nothing_divided_(no_zeros && no_zeros->empty()) {
    if (prover.model().parameters.empty()) return;
    const std::vector<bool> used = used_variables(rows);  // of none, where all are constant
    // What depends on a parameter is one of the entries exactly where it is this sum.
    Polynomial sum(ring());
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i]) sum += ring().variable(i);
    for (std::size_t i = 0; i < prover.model().parameters.size(); ++i) {
      const std::size_t place = prover.dimension() + i;
      if (ring_.depends_on(sum, place)) places_.push_back(place);
    }
    if (places_.empty()) return;
    // Functions of parameters, such as sin(a), have special values as well.
    for (std::size_t g = ring_.symbols().size(); g < ring_.end_of_generators(); ++g) {
      const Polynomial own = ring().variable(g);
      // Of a sin(z)^2 + cos(z)^2 - 1 numbers for sine and cosine show no factor.
      if (used[g] && no_zeros && depends_on_others(own)) with_relations_ = true;
      if (!used[g] || !depends_on_parameters(own)) continue;
      if (!depends_on_others(own)) constants_.push_back(g);
      if (ring_.origin(g).kind != FunctionRing::Origin::Kind::inverse) with_functions_ = true;
    }
  }

  std::vector<std::string> run() {
    if (places_.empty() || rank_ == 0) return {};
    find_minors();
    for (const Polynomial& f : common_factors()) look_at_factor(f, Zeros::all_minors);
    const bool doubtful = with_relations_ || (with_functions_ && !nothing_divided_);
    const bool open =
        doubtful &&
        !has_lasting_minor(prover_, rows_, rank_,
                           {.is_parameter = [&](auto place) { return is_parameter(place); },
                            .depends = [&](const auto& p) { return depends_on_parameters(p); },
                            .is_excluded = [&](const auto& f) { return was_looked_at(f); },
                            .in_functions = with_functions_});
    if (minors_.empty() || !ring_.is_polynomial()) {
      for (const std::size_t p : places_) look_at_factor(ring().variable(p), Zeros::candidates);
    }
    if (!with_functions_ && places_.size() > 1) look_at_pairs();
    if (open) say_that_others_are_open();
    return std::move(found_);
  }

 private:
  const PolynomialRing& ring() const { return ring_.ring(); }
  /// Or a function of parameters alone.
  bool is_parameter(std::size_t place) const {
    return std::find(places_.begin(), places_.end(), place) != places_.end() ||
           std::find(constants_.begin(), constants_.end(), place) != constants_.end();
  }
  /// A function 1/d of parameters, which vanishes nowhere.
  bool uses_inverse(const Polynomial& p) const {
    return std::any_of(constants_.begin(), constants_.end(), [&](std::size_t g) {
      return p.uses(g) && ring_.origin(g).kind == FunctionRing::Origin::Kind::inverse;
    });
  }
  bool depends_on_parameters(const Polynomial& p) const {
    return std::any_of(places_.begin(), places_.end(),
                       [&](std::size_t place) { return ring_.depends_on(p, place); });
  }
  bool depends_on_others(const Polynomial& p) const {
    const std::size_t first = prover_.dimension();
    const std::size_t end = first + prover_.model().parameters.size();
    for (std::size_t i = 0; i < ring_.symbols().size(); ++i)
      if ((i < first || i >= end) && ring_.depends_on(p, i)) return true;
    return false;
  }
  /// What is known of the zeros of a factor: all minors vanish there, or nothing.
  enum class Zeros { all_minors, candidates };
  Polynomial at_numbers(const Polynomial& p, const std::vector<cln::cl_RA>& numbers) const;
  std::pair<Indices, Indices> regular_minor(const std::vector<cln::cl_RA>& point) const;
  void find_minors();
  bool was_looked_at(const Polynomial& f) const;
  void say_that_others_are_open();
  std::vector<Polynomial> common_factors() const;
  bool is_common_zero(const ParameterEquations& set) const;
  bool lowers_rank(const std::function<bool(std::vector<GiNaC::ex>&)>& put, bool* tried,
                   int draws = 200);
  bool is_solvable(const Polynomial& f, std::size_t place) const;
  bool put_zero(const Polynomial& f, std::vector<GiNaC::ex>& coordinates, bool larger) const;
  bool is_excluded_at_zero(const Polynomial& parameter) const;
  void look_at_factor(const Polynomial& f, Zeros zeros);
  std::vector<Polynomial> neighbouring_minors() const;
  void look_at_pairs();
  void look_at_set(ParameterEquations set);
  void add(const std::string& condition) {
    if (std::find(found_.begin(), found_.end(), condition) == found_.end())
      found_.push_back(condition);
  }

  Prover& prover_;
  const FunctionRing& ring_;
  const PolynomialRows& rows_;
  std::size_t rank_;
  const QuotientsModulo& quotients_;
  std::vector<Polynomial> no_zeros_;
  bool nothing_divided_;  ///< the rows are reduced, and differ by that alone from those before
  Indices places_;        ///< of the parameters that the matrix depends on
  Indices constants_;     ///< of the functions of these alone, such as sin(a)
  bool with_functions_ = false;          ///< of parameters that are not rational, such as sin(a*q)
  bool with_relations_ = false;          ///< functions that may obey some
  std::pair<Indices, Indices> regular_;  ///< rows and columns of the minors
  std::vector<Polynomial> minors_;       ///< with numbers for everything else
  std::vector<Polynomial> factors_;      ///< whose zeros were looked at
  std::vector<Polynomial> excluded_;     ///< those of them that are conditions
  std::vector<ParameterEquations> sets_;
  std::optional<MatrixModulo> modular_rows_;  ///< made when it is first needed
  std::vector<std::string> found_;
};

Polynomial SpecialParameters::at_numbers(const Polynomial& p,
                                         const std::vector<cln::cl_RA>& numbers) const {
  if (p.is_constant()) return p;
  TermCollector result(ring());
  for (auto [number, exponents] : p.term_list()) {
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0 || is_parameter(i)) continue;
      number = number * cln::expt(numbers[i], cln::cl_I(exponents[i]));
      exponents[i] = 0;
    }
    result.add(number, exponents);
  }
  return result.finish();
}

/// Rows and columns of a minor that is regular at a point.
std::pair<Indices, Indices> SpecialParameters::regular_minor(
    const std::vector<cln::cl_RA>& point) const {
  if (rows_.empty() || rows_[0].empty()) return {};
  RationalMatrix transposed(rows_[0].size());
  for (const auto& row : rows_) {
    for (std::size_t j = 0; j < row.size(); ++j)
      transposed[j].push_back(row[j].is_zero() ? 0 : row[j].evaluate(point));
  }
  Indices own_rows = independent_columns(transposed);
  own_rows.resize(std::min(own_rows.size(), rank_));
  RationalMatrix chosen;
  for (const std::size_t i : own_rows) {
    chosen.emplace_back();
    for (const auto& column : transposed) chosen.back().push_back(column[i]);
  }
  return {own_rows, independent_columns(chosen)};
}

/// A minor that is regular for other parameters, at some numbers for the coordinates.
void SpecialParameters::find_minors() {
  constexpr std::size_t kMinors = 3, kLargest = 8;
  if (rank_ > kLargest) return;
  std::mt19937 random(20190107);
  for (std::size_t k = 0; k < kMinors; ++k) {
    std::vector<cln::cl_RA> numbers(ring().size());
    for (cln::cl_RA& n : numbers) n = cln::cl_RA(static_cast<long>(random() % 997) - 498);
    if (regular_.first.size() < rank_) regular_ = regular_minor(numbers);
    if (regular_.first.size() < rank_) continue;
    PolynomialRows minor;
    for (const std::size_t i : regular_.first) {
      minor.emplace_back();
      for (const std::size_t j : regular_.second)
        minor.back().push_back(at_numbers(rows_[i][j], numbers));
    }
    std::optional<Polynomial> value = short_determinant(std::move(minor), ring());
    if (!value) return minors_.clear();
    if (uses_inverse(*value))
      value = ring_.lowest_terms(*value).first;
    else if (!constants_.empty())
      value = ring_.reduced(std::move(*value));  // as sin(a)^2 + cos(a)^2
    if (!value->is_zero()) minors_.push_back(std::move(*value));
    if (!minors_.empty() && minors_.back().is_constant()) return;
  }
}

std::vector<Polynomial> SpecialParameters::common_factors() const {
  if (minors_.empty()) return {};
  Polynomial common = minors_[0];
  for (const Polynomial& m : minors_) common = Polynomial::gcd(common, m);
  std::vector<Polynomial> result;
  if (common.is_zero()) return result;
  for (const auto& [f, exponent] : common.factors())
    if (!f.is_constant()) result.push_back(f);
  return result;
}

bool SpecialParameters::is_common_zero(const ParameterEquations& set) const {
  return !minors_.empty() && std::all_of(minors_.begin(), minors_.end(),
                                         [&](const auto& m) { return set.reduced(m).is_zero(); });
}

/// Whether the rank is smaller at all points that `put` leads to; `tried` becomes whether there are
/// any inside of all assumptions.
bool SpecialParameters::lowers_rank(const std::function<bool(std::vector<GiNaC::ex>&)>& put,
                                    bool* tried, int draws) {
  constexpr int kTrials = 3;
  static const std::vector<GiNaC::ex> kNothing;
  const auto& domain = ring_.is_polynomial() ? kNothing : prover_.domain();
  // Then every point is admitted, and need not be made where a rank modulo a prime decides.
  const bool everywhere = ring_.is_polynomial() && prover_.model().assumptions.empty();
  const auto has_full_rank = [&](const std::vector<GiNaC::ex>& coordinates) {
    if (ring_.is_polynomial() && !modular_rows_) modular_rows_.emplace(rows_);
    return modular_rows_ && modular_rows_->rank_at(coordinates) >= rank_;
  };
  int admitted = 0;
  for (int k = 0; k < draws && admitted < kTrials; ++k) {
    std::vector<GiNaC::ex> coordinates = prover_.real_points().draw();
    try {
      if (!put(coordinates)) continue;
      if (everywhere && has_full_rank(coordinates)) {
        *tried = true;
        return false;
      }
      RealPoint point = prover_.real_points().at(std::move(coordinates));
      if (!prover_.real_points().admits(point, domain)) continue;
      ++admitted;
      *tried = true;
      if (!everywhere && has_full_rank(point.coordinates())) return false;
      if (point.rank(rows_) >= rank_) return false;
    } catch (const NotCertified&) {
    }
  }
  return admitted > 0;
}

/// Whether f = 0 is an equation of degree 1 or 2 for the parameter.
bool SpecialParameters::is_solvable(const Polynomial& f, std::size_t place) const {
  if (f.degree(place) != 1 && f.degree(place) != 2) return false;
  for (const Polynomial& part : f.coefficients(place))
    if (ring_.depends_on(part, place)) return false;
  return true;
}

/// Gives a parameter the value at which f vanishes.
bool SpecialParameters::put_zero(const Polynomial& f, std::vector<GiNaC::ex>& coordinates,
                                 bool larger) const {
  for (const long degree : {1L, 2L}) {
    for (const std::size_t place : places_) {
      if (f.degree(place) != degree || !is_solvable(f, place)) continue;
      GiNaC::exmap others;
      for (const std::size_t p : places_)
        if (p != place) others.emplace(ring_.symbols()[p], coordinates[p]);
      std::vector<GiNaC::ex> c;
      for (const Polynomial& part : f.coefficients(place))
        c.push_back(prover_.ring().expression(part).subs(others));
      if (c.back().is_zero()) return false;
      if (degree == 1) {
        coordinates[place] = -c[0] / c[1];
        return true;
      }
      const GiNaC::ex discriminant = (c[1] * c[1] - 4 * c[0] * c[2]).expand();
      if (!discriminant.info(GiNaC::info_flags::nonnegative)) return false;
      const GiNaC::ex root = GiNaC::sqrt(discriminant);
      coordinates[place] = ((larger ? root : -root) - c[1]) / (2 * c[2]);
      return true;
    }
  }
  return false;
}

/// Whether some condition does not hold where the parameter is zero, as sin(a) != 0.
bool SpecialParameters::is_excluded_at_zero(const Polynomial& parameter) const {
  const GiNaC::exmap zero{{prover_.ring().expression(parameter), 0}};
  return std::any_of(excluded_.begin(), excluded_.end(), [&](const Polynomial& f) {
    const auto value = where_defined(
        [&] { return substituted(prover_.ring().expression(f), zero, prover_.ring().limits()); });
    return value && value->is_zero();
  });
}

void SpecialParameters::look_at_factor(const Polynomial& factor, Zeros zeros) {
  const Polynomial f = factor.scaled(1 / factor.content());
  for (const Polynomial& known : no_zeros_)
    if (const Polynomial g = known.scaled(1 / known.content()); f == g || f == -g) return;
  if (std::find(factors_.begin(), factors_.end(), f) != factors_.end()) return;
  if (ring_.is_nowhere_zero(f) || (zeros == Zeros::candidates && is_excluded_at_zero(f))) return;
  const bool solvable =
      std::any_of(places_.begin(), places_.end(), [&](std::size_t p) { return is_solvable(f, p); });
  bool tried = false, larger = false;
  const auto put = [&](std::vector<GiNaC::ex>& at) {
    larger = !larger;
    return put_zero(f, at, larger);
  };
  const bool lower = solvable && lowers_rank(put, &tried);
  // Where no point of its zeros was found inside of the assumptions there may be some all the same.
  const bool needed = lower || (zeros == Zeros::all_minors && !tried);
  if (needed || zeros == Zeros::all_minors) factors_.push_back(f);
  if (!needed) return;
  excluded_.push_back(f);
  add(ring_.text(f) + " != 0");
}

bool SpecialParameters::was_looked_at(const Polynomial& f) const {
  return std::find(factors_.begin(), factors_.end(), f.scaled(1 / f.content())) != factors_.end();
}

/// Functions such as sin(a*q) and sin(b*q) may become dependent, and functions such as sin(a) and
/// cos(a) - 1 vanish together, at values that no factor shows.
void SpecialParameters::say_that_others_are_open() {
  std::vector<std::string> names;
  for (const std::size_t p : places_) names.push_back(ring_.symbols()[p].get_name());
  add(fmt::format("{} {} generic", fmt::join(names, ", "), names.size() == 1 ? "is" : "are"));
}

/// Minors at some numbers, with another row or another column than the regular one, or both.
std::vector<Polynomial> SpecialParameters::neighbouring_minors() const {
  constexpr std::size_t kMost = 60;
  if (regular_.first.size() < rank_ || regular_.second.size() < rank_) return {};
  std::mt19937 random(20190109);
  std::vector<cln::cl_RA> numbers(ring().size());
  for (cln::cl_RA& n : numbers) n = cln::cl_RA(static_cast<long>(random() % 997) - 498);
  std::vector<Polynomial> result;
  for (const Indices& rows : with_one_changed(regular_.first, rows_.size())) {
    for (const Indices& columns : with_one_changed(regular_.second, rows_[0].size())) {
      if (result.size() == kMost) return result;
      PolynomialRows minor;
      for (const std::size_t i : rows) {
        minor.emplace_back();
        for (const std::size_t j : columns)
          minor.back().push_back(at_numbers(rows_[i][j], numbers));
      }
      const auto value = short_determinant(std::move(minor), ring());
      if (value && !value->is_zero()) result.push_back(*value);
    }
  }
  return result;
}

/// Linear equations that make all minors vanish.
void SpecialParameters::look_at_pairs() {
  constexpr GroebnerLimits kLimits{.reductions = 100, .elements = 20, .terms = 100};
  if (minors_.size() < 2 || minors_.back().is_constant()) return;
  std::vector<Polynomial> simple;  // with the same zeros
  const auto add_simple = [&](const Polynomial& minor) {
    Polynomial product = ring().constant(1);
    for (const auto& [f, exponent] : minor.factors())
      if (!f.is_constant()) product *= f;
    if (std::find(simple.begin(), simple.end(), product) == simple.end()) simple.push_back(product);
  };
  for (const Polynomial& m : minors_) add_simple(m);
  const std::vector<Polynomial> neighbours = neighbouring_minors();
  for (const Polynomial& m : neighbours) {
    if (m.is_constant()) return;
    add_simple(m);
  }
  const std::vector<Polynomial> basis = groebner_basis(simple, kLimits);
  const bool linear = std::all_of(basis.begin(), basis.end(),
                                  [](const Polynomial& m) { return m.total_degree() == 1; });
  if (linear && basis.size() > 1) {
    if (const auto set = solved_for_parameters(basis, places_)) look_at_set(*set);
  }
  const std::vector<ParameterForm> forms = parameter_forms(ring(), places_);
  std::vector<MinorModulo> modular;
  const auto add_modular = [&](const std::vector<Polynomial>& minors) {
    for (const Polynomial& m : minors) {
      try {
        modular.emplace_back(m);
      } catch (const std::domain_error&) {  // it excludes nothing, then
      }
    }
  };
  add_modular(minors_);
  // At numbers that no functions have together a minor says nothing of the others.
  if (quotients_.are_known() && std::none_of(rows_.begin(), rows_.end(), [&](const auto& row) {
        return has_generators(ring_, row);
      }))
    add_modular(neighbours);
  // Where a condition excludes one form, it excludes both together.
  std::vector<bool> excluded;
  for (const ParameterForm& f : forms)
    excluded.push_back(std::any_of(excluded_.begin(), excluded_.end(), [&](const Polynomial& e) {
      return e == f.form || e == -f.form;
    }));
  for (std::size_t i = 0; i < forms.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (excluded[i] || excluded[j]) continue;
      if (!may_all_vanish(forms[j], forms[i], places_, ring(), modular)) continue;
      const auto set = solved_for_parameters({forms[j].form, forms[i].form}, places_);
      if (set && is_common_zero(*set)) look_at_set(*set);
    }
  }
}

void SpecialParameters::look_at_set(ParameterEquations set) {
  if (set.values.size() < 2) return;
  std::sort(set.values.begin(), set.values.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto vanishes = [&](const Polynomial& f) { return set.reduced(f).is_zero(); };
  if (std::any_of(excluded_.begin(), excluded_.end(), vanishes)) return;
  for (const ParameterEquations& known : sets_)
    if (std::all_of(known.forms.begin(), known.forms.end(), vanishes)) return;
  Polynomial squares(ring());
  std::string text;
  for (const auto& [place, value] : set.values) {
    const Polynomial f = ring().variable(place) - value;
    squares += f * f;
    text += (text.empty() ? "" : " + ") +
            (f.terms() == 1 ? ring_.text(f * f) : fmt::format("({})^2", ring_.text(f)));
  }
  if (ring_.is_nowhere_zero(squares)) return;
  bool tried = false;
  const auto put = [&](std::vector<GiNaC::ex>& at) {
    GiNaC::exmap others;
    for (const std::size_t p : places_) others.emplace(ring_.symbols()[p], at[p]);
    for (const auto& [place, value] : set.values)
      at[place] = prover_.ring().expression(value).subs(others);
    return true;
  };
  // Which points are inside of the assumptions takes longer to tell than the rank of quotients.
  constexpr int kFirst = 3;
  for (int k = 0; k < kFirst; ++k) {
    std::vector<GiNaC::ex> coordinates = prover_.real_points().draw();
    if (put(coordinates) && quotients_.have_rank(rank_, coordinates)) return;
  }
  constexpr int kDraws = 50;  // a condition that is not confirmed is none here
  if (!lowers_rank(put, &tried, kDraws)) return;
  sets_.push_back(set);
  add(text + " != 0");
}

}  // namespace

std::vector<std::string> needed_parameters(Prover& prover, const PolynomialRows& rows,
                                           std::size_t rank) {
  // The rank is that of rows times what vanishes nowhere: of v/(v + a) - v/(v + b) the factor a - b
  // is seen in the numerator alone.
  PolynomialRows numerators = rows;
  std::optional<std::vector<Polynomial>> denominators;
  try {
    denominators = clear_denominators(prover.ring(), numerators);
  } catch (const TooLarge&) {  // it is for almost all values then, as without them
  }
  const QuotientsModulo quotients(prover, numerators,
                                  denominators.value_or(std::vector<Polynomial>()));
  std::vector<std::string> conditions = SpecialParameters(prover, rows, rank, quotients).run();
  if (!denominators) return conditions;
  for (std::string& more :
       SpecialParameters(prover, numerators, rank, quotients, std::move(denominators)).run())
    if (std::find(conditions.begin(), conditions.end(), more) == conditions.end())
      conditions.push_back(std::move(more));
  return conditions;
}

}  // namespace casimir

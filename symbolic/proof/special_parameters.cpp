#include "symbolic/proof/special_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/algebra/where_defined.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/parameter_minors.hpp"

namespace casimir {
namespace {

using Indices = std::vector<std::size_t>;

/// A parameter that is zero, or equal to another one.
struct SimpleForm {
  Polynomial form;
  std::size_t place;
  std::optional<std::size_t> equal_to;
};

/// Equations for parameters, each solved for one of them by the others.
struct Equations {
  std::vector<Polynomial> forms;
  std::vector<std::pair<std::size_t, Polynomial>> values{};
};

class SpecialParameters {
 public:
  SpecialParameters(Prover& prover, const PolynomialRows& rows, std::size_t rank)
      : prover_(prover), ring_(prover.ring()), rows_(rows), rank_(rank) {
    const auto used = [&](const auto& property) {
      return std::any_of(rows.begin(), rows.end(), [&](const auto& row) {
        return std::any_of(row.begin(), row.end(), property);
      });
    };
    for (std::size_t i = 0; i < prover.model().parameters.size(); ++i) {
      const std::size_t place = prover.dimension() + i;
      if (used([&](const Polynomial& p) { return ring_.depends_on(p, place); }))
        places_.push_back(place);
    }
    // Functions of parameters, such as sin(a), have special values as well.
    for (std::size_t g = ring_.symbols().size(); g < ring_.end_of_generators(); ++g) {
      const Polynomial own = ring().variable(g);
      if (!depends_on_parameters(own) || !used([&](const auto& p) { return p.uses(g); })) continue;
      if (!depends_on_others(own)) constants_.push_back(g);
      if (ring_.origin(g).kind != FunctionRing::Origin::Kind::inverse) with_functions_ = true;
    }
  }

  std::vector<std::string> run() {
    if (places_.empty() || rank_ == 0) return {};
    find_minors();
    for (const Polynomial& f : common_factors()) look_at_factor(f, Zeros::all_minors);
    const bool open = with_functions_ && !has_lasting_minor();
    if (minors_.empty() || !ring_.is_polynomial()) {
      for (const std::size_t p : places_) look_at_factor(ring().variable(p), Zeros::candidates);
    }
    if (ring_.is_polynomial() && places_.size() > 1) look_at_pairs();
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
  bool has_lasting_minor() const;
  bool is_certainly_nonzero(const Polynomial& p) const;
  bool is_never_identically_zero(const Polynomial& f) const;
  void say_that_others_are_open();
  std::vector<Polynomial> common_factors() const;
  std::vector<SimpleForm> simple_forms() const;
  bool may_vanish(const SimpleForm& a, const SimpleForm& b,
                  const std::vector<MinorModulo>& minors) const;
  std::optional<Equations> solved(const std::vector<Polynomial>& forms) const;
  static Polynomial reduced(Polynomial p, const Equations& set);
  bool is_common_zero(const Equations& set) const;
  bool lowers_rank(const std::function<bool(std::vector<GiNaC::ex>&)>& put, bool* tried);
  bool is_solvable(const Polynomial& f, std::size_t place) const;
  bool put_zero(const Polynomial& f, std::vector<GiNaC::ex>& coordinates, bool larger) const;
  bool is_excluded_at_zero(const Polynomial& parameter) const;
  void look_at_factor(const Polynomial& f, Zeros zeros);
  void look_at_pairs();
  void look_at_set(const Equations& set);
  void add(const std::string& condition) {
    if (std::find(found_.begin(), found_.end(), condition) == found_.end())
      found_.push_back(condition);
  }

  Prover& prover_;
  const FunctionRing& ring_;
  const PolynomialRows& rows_;
  std::size_t rank_;
  Indices places_;                       ///< of the parameters that the matrix depends on
  Indices constants_;                    ///< of the functions of these alone, such as sin(a)
  bool with_functions_ = false;          ///< of parameters that are not rational, such as sin(a*q)
  std::pair<Indices, Indices> regular_;  ///< rows and columns of the minors
  std::vector<Polynomial> minors_;       ///< with numbers for everything else
  std::vector<Polynomial> factors_;      ///< whose zeros were looked at
  std::vector<Polynomial> excluded_;     ///< those of them that are conditions
  std::vector<Equations> sets_;
  std::optional<MatrixModulo> modular_rows_;  ///< made when it is first needed
  std::vector<std::string> found_;
};

Polynomial SpecialParameters::at_numbers(const Polynomial& p,
                                         const std::vector<cln::cl_RA>& numbers) const {
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
    if (uses_inverse(*value)) value = ring_.lowest_terms(*value).first;
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

std::vector<SimpleForm> SpecialParameters::simple_forms() const {
  std::vector<SimpleForm> result;
  for (const std::size_t p : places_) {
    const Polynomial v = ring().variable(p);
    result.push_back({v, p, std::nullopt});
    for (const std::size_t q : places_)
      if (q < p) result.push_back({v - ring().variable(q), p, q});
  }
  return result;
}

/// False where some minor is not zero at a point at which both forms are.
bool SpecialParameters::may_vanish(const SimpleForm& a, const SimpleForm& b,
                                   const std::vector<MinorModulo>& minors) const {
  std::vector<std::uint64_t> point(ring().size());
  for (std::size_t i = 0; i < point.size(); ++i) point[i] = 7 * i + 3;
  const auto wanted = [&](const SimpleForm& form) {
    return form.equal_to ? point[*form.equal_to] : 0;
  };
  // Twice, since the second form may change what the first one has set.
  for (const SimpleForm* form : {&a, &b, &a, &b}) {
    const std::uint64_t value = wanted(*form), known = point[form->place];
    for (const std::size_t p : places_)
      if (p == form->place || (value == 0 && point[p] == known)) point[p] = value;
  }
  if (point[a.place] != wanted(a) || point[b.place] != wanted(b)) return true;
  return std::none_of(minors.begin(), minors.end(),
                      [&](const MinorModulo& minor) { return minor.is_nonzero_at(point); });
}

Polynomial SpecialParameters::reduced(Polynomial p, const Equations& set) {
  for (const auto& [place, value] : set.values) {
    Polynomial sum(p.ring()), power = p.ring().constant(1);
    for (const Polynomial& c : p.coefficients(place)) {
      sum += c * power;
      power *= value;
    }
    p = std::move(sum);
  }
  return p;
}

/// Linear equations, one after the other; empty where one contradicts the others.
std::optional<Equations> SpecialParameters::solved(const std::vector<Polynomial>& forms) const {
  Equations set{forms};
  for (const Polynomial& form : forms) {
    const Polynomial own = reduced(form, set);
    if (own.is_zero()) continue;
    if (own.total_degree() != 1) return std::nullopt;
    const auto place = std::find_if(places_.begin(), places_.end(),
                                    [&](std::size_t p) { return own.degree(p) == 1; });
    if (place == places_.end()) return std::nullopt;
    const std::vector<Polynomial> parts = own.coefficients(*place);
    const Polynomial value = parts[0].scaled(-1 / parts[1].term_list()[0].first);
    for (auto& [earlier, old] : set.values) old = reduced(old, {{}, {{*place, value}}});
    set.values.emplace_back(*place, value);
  }
  return set;
}

bool SpecialParameters::is_common_zero(const Equations& set) const {
  return !minors_.empty() && std::all_of(minors_.begin(), minors_.end(),
                                         [&](const auto& m) { return reduced(m, set).is_zero(); });
}

/// Whether the rank is smaller at all points that `put` leads to; `tried` becomes whether there are
/// any inside of all assumptions.
bool SpecialParameters::lowers_rank(const std::function<bool(std::vector<GiNaC::ex>&)>& put,
                                    bool* tried) {
  constexpr int kTrials = 3, kDraws = 200;
  static const std::vector<GiNaC::ex> kNothing;
  const auto& domain = ring_.is_polynomial() ? kNothing : prover_.domain();
  int admitted = 0;
  for (int k = 0; k < kDraws && admitted < kTrials; ++k) {
    std::vector<GiNaC::ex> coordinates = prover_.real_points().draw();
    try {
      if (!put(coordinates)) continue;
      RealPoint point = prover_.real_points().at(std::move(coordinates));
      if (!prover_.real_points().admits(point, domain)) continue;
      ++admitted;
      *tried = true;
      if (ring_.is_polynomial() && !modular_rows_) modular_rows_.emplace(rows_);
      if (modular_rows_ && modular_rows_->rank_at(point.coordinates()) >= rank_) return false;
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
    const auto value =
        where_defined([&] { return substituted(prover_.ring().expression(f), zero); });
    return value && value->is_zero();
  });
}

void SpecialParameters::look_at_factor(const Polynomial& factor, Zeros zeros) {
  const Polynomial f = factor.scaled(1 / factor.content());
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

/// Whether some minor is not zero at almost all points, for all parameters at which none of the
/// factors vanishes that were looked at: each of its factors is one of these, or vanishes nowhere,
/// or has no parameters and so is the same function for all of them.
bool SpecialParameters::has_lasting_minor() const {
  if (regular_.first.size() < rank_) return false;
  PolynomialRows minor;
  for (const std::size_t i : regular_.first) {
    minor.emplace_back();
    for (const std::size_t j : regular_.second) minor.back().push_back(rows_[i][j]);
  }
  const std::optional<Polynomial> value = short_determinant(std::move(minor), ring());
  if (!value) return false;
  const Polynomial top = ring_.lowest_terms(*value).first;
  if (top.is_zero() || !is_certainly_nonzero(*value)) return false;
  const auto lasts = [&](const Polynomial& product) {
    const auto factors = product.factors();
    return std::all_of(factors.begin(), factors.end(), [&](const auto& factor) {
      const Polynomial& f = factor.first;
      return f.is_constant() || !depends_on_parameters(f) || ring_.is_nowhere_zero(f) ||
             is_never_identically_zero(f) ||
             std::find(factors_.begin(), factors_.end(), f.scaled(1 / f.content())) !=
                 factors_.end();
    });
  };
  return lasts(top) || lasts(*value);
}

/// At some point of the domain, by balls: the ring need not know all relations of its functions.
bool SpecialParameters::is_certainly_nonzero(const Polynomial& p) const {
  try {
    auto point = prover_.real_points().random(prover_.domain());
    return point && !point->value(p).contains_zero();
  } catch (const NotCertified&) {
    return false;
  }
}

/// A polynomial in the coordinates of which one coefficient is not zero, whatever the parameters.
bool SpecialParameters::is_never_identically_zero(const Polynomial& f) const {
  std::map<std::vector<unsigned long>, Polynomial> coefficients;
  for (const auto& [number, exponents] : f.term_list()) {
    std::vector<unsigned long> others(exponents.size()), own(exponents.size());
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] > 0 && i >= ring_.symbols().size()) return false;
      (is_parameter(i) ? own : others)[i] = exponents[i];
    }
    TermCollector term(ring());
    term.add(number, own);
    coefficients.try_emplace(others, ring()).first->second += term.finish();
  }
  return std::any_of(coefficients.begin(), coefficients.end(), [&](const auto& coefficient) {
    return ring_.is_nowhere_zero(coefficient.second);
  });
}

/// Functions such as sin(a*q) and sin(b*q) may become dependent, and functions such as sin(a) and
/// cos(a) - 1 vanish together, at values that no factor shows.
void SpecialParameters::say_that_others_are_open() {
  std::vector<std::string> names;
  for (const std::size_t p : places_) names.push_back(ring_.symbols()[p].get_name());
  add(fmt::format("{} {} generic", fmt::join(names, ", "), names.size() == 1 ? "is" : "are"));
}

/// Two linear equations that make all minors vanish.
void SpecialParameters::look_at_pairs() {
  constexpr GroebnerLimits kLimits{.reductions = 100, .elements = 20, .terms = 100};
  if (minors_.size() < 2 || minors_.back().is_constant()) return;
  std::vector<Polynomial> simple;  // with the same zeros
  for (const Polynomial& m : minors_) {
    simple.push_back(ring().constant(1));
    for (const auto& [f, exponent] : m.factors())
      if (!f.is_constant()) simple.back() *= f;
  }
  const bool linear = std::all_of(simple.begin(), simple.end(),
                                  [](const Polynomial& m) { return m.total_degree() == 1; });
  if (linear) {
    const std::vector<Polynomial> basis = groebner_basis(simple, kLimits);
    if (basis.size() > 1) {
      if (const auto set = solved(basis)) look_at_set(*set);
    }
  }
  const std::vector<SimpleForm> forms = simple_forms();
  std::vector<MinorModulo> modular;
  for (const Polynomial& m : minors_) {
    try {
      modular.emplace_back(m);
    } catch (const std::domain_error&) {  // it excludes nothing, then
    }
  }
  for (std::size_t i = 0; i < forms.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!may_vanish(forms[j], forms[i], modular)) continue;
      const auto set = solved({forms[j].form, forms[i].form});
      if (set && is_common_zero(*set)) look_at_set(*set);
    }
  }
}

void SpecialParameters::look_at_set(const Equations& set) {
  if (set.values.size() < 2) return;
  const auto vanishes = [&](const Polynomial& f) { return reduced(f, set).is_zero(); };
  if (std::any_of(excluded_.begin(), excluded_.end(), vanishes)) return;
  for (const Equations& known : sets_)
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
  if (!lowers_rank(put, &tried)) return;
  sets_.push_back(set);
  add(text + " != 0");
}

}  // namespace

std::vector<std::string> needed_parameters(Prover& prover, const PolynomialRows& rows,
                                           std::size_t rank) {
  return SpecialParameters(prover, rows, rank).run();
}

}  // namespace casimir

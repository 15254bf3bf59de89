#pragma once

#include <cln/rational.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/search/exponents.hpp"
#include "symbolic/search/quasi_homogeneous.hpp"
#include "symbolic/search/system.hpp"

namespace casimir::search {

/// The terms of the equations of motion that decide about balances x_i = c_i (t - t0)^(-g_i): those
/// of the highest weight, as polynomials in a ring with one more variable, rho, at the end.
class LeadingPart {
 public:
  /// \param weights  name and weight; if empty, those are found for which most terms count
  /// \throws ModelError  where no weights make the equations quasi-homogeneous
  LeadingPart(const Model& model, const std::vector<std::pair<Text, Text>>& weights);

  const System& system() const { return system_; }
  System& system() { return system_; }
  std::size_t dimension() const { return dimension_; }
  const PolynomialRing& ring() const { return ring_; }
  std::size_t rho() const { return rho_; }
  /// The places of the coordinates.
  const std::vector<std::size_t>& unknowns() const { return unknowns_; }
  /// The leading terms of the rates, times `factor`.
  const std::vector<Polynomial>& field() const { return field_; }
  /// Made of parameters.
  const Polynomial& factor() const { return factor_; }
  /// g_i
  cln::cl_RA weight(std::size_t i) const {
    return cln::cl_RA(weights_.numerators[i]) / weights_.denominator;
  }
  /// Whether the leading terms have functions of parameters or numbers.
  bool has_functions() const { return has_functions_; }
  /// Why it is not known what these obey.
  const std::optional<std::string>& doubt() const { return doubt_; }

  std::vector<Polynomial> normal_forms(const std::vector<Polynomial>& row) const;
  Polynomial normal_form(const Polynomial& p) const { return normal_forms({p})[0]; }
  std::string text(const Polynomial& p) const;
  /// In lowest terms.
  std::string quotient(const Polynomial& top, const Polynomial& bottom) const;
  /// The weights, what was left out, the parameters, and, where there are none, the numbers.
  void describe(ExponentReport& report) const;

 private:
  void read_weights(const std::vector<std::pair<Text, Text>>& weights);
  void keep_leading_terms();
  Polynomial in_own_ring(const Polynomial& p) const;
  bool use(std::size_t place) const;
  std::optional<double> value_of(std::size_t place) const;
  void look_at_constants();
  LeadingSystem in_numbers(const std::vector<double>& values) const;

  const Model& model_;
  System system_;
  std::size_t dimension_;
  PolynomialRing ring_;
  std::size_t rho_;
  std::vector<std::size_t> unknowns_;
  std::vector<Polynomial> field_;
  Polynomial factor_;
  Weights weights_;
  std::vector<std::string> left_out_;
  bool has_functions_ = false;
  std::optional<std::string> doubt_{};
};

}  // namespace casimir::search

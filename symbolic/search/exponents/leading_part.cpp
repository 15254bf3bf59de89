#include "symbolic/search/exponents/leading_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/search/independence.hpp"

namespace casimir::search {

LeadingPart::LeadingPart(const Model& model, const std::vector<std::pair<Text, Text>>& weights)
    : model_(model),
      system_(model, {}, {}),
      dimension_(model.variables.size()),
      ring_(system_.ring().size() + 1),
      rho_(system_.ring().size()),
      factor_(ring_.constant(1)) {
  if (model.time) throw ModelError("exponents need equations that do not depend on the time");
  for (std::size_t i = 0; i < dimension_; ++i) unknowns_.push_back(i);
  std::vector<Polynomial> row = system_.prover().field();
  for (const Polynomial& rate : row) {
    for (std::size_t g = 0; g < system_.ring().size(); ++g) {
      if (g >= system_.prover().ring().symbols().size() && !system_.is_constant()[g] &&
          rate.uses(g))
        throw ModelError(
            "exponents need equations of motion that are polynomials in the variables");
    }
  }
  row.push_back(system_.ring().constant(1));
  if (!system_.prover().ring().is_polynomial())
    row = system_.prover().ring().common_numerators(std::move(row));
  factor_ = in_own_ring(row.back());
  row.pop_back();
  for (const Polynomial& p : row) field_.push_back(in_own_ring(p));
  read_weights(weights);
  keep_leading_terms();
  look_at_constants();
}

bool LeadingPart::use(std::size_t place) const {
  return factor_.uses(place) ||
         std::ranges::any_of(field_, [&](const Polynomial& p) { return p.uses(place); });
}

/// Of a real number.
std::optional<double> LeadingPart::value_of(std::size_t place) const {
  if (!system_.is_number(place)) return std::nullopt;
  const GiNaC::ex value = system_.functions().variable_value(place).evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value)) return std::nullopt;
  const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(value);
  return number.is_real() ? std::optional(number.to_double()) : std::nullopt;
}

void LeadingPart::look_at_constants() {
  for (std::size_t k = system_.functions().symbols().size(); k < rho_; ++k)
    has_functions_ = has_functions_ || use(k);
  if (has_functions_) doubt_ = unknown_relations(system_);
}

/// All of them times one parameter that is not zero, by what functions of parameters obey.
///
/// Where these are known to obey nothing else (`unknown_relations`), the polynomials in them modulo
/// their relations have no divisors of zero: a polynomial is zero as a function exactly where this
/// is zero, and a product only where a factor is.
std::vector<Polynomial> LeadingPart::normal_forms(const std::vector<Polynomial>& row) const {
  if (!has_functions_) return row;
  std::vector<Polynomial> parts;
  std::vector<std::size_t> counts;
  for (const Polynomial& p : row) {
    const std::vector<Polynomial> own = p.coefficients(rho_);
    counts.push_back(own.size());
    for (const Polynomial& part : own) parts.push_back(in_ring(part, system_.ring()));
  }
  parts = system_.functions().common_numerators(std::move(parts));
  std::vector<Polynomial> result;
  std::size_t next = 0;
  for (const std::size_t count : counts) {
    Polynomial sum(ring_);
    for (std::size_t k = 0; k < count; ++k)
      sum += in_ring(parts[next++], ring_) * ring_.variable(rho_).pow(k);
    result.push_back(std::move(sum));
  }
  return result;
}

Polynomial LeadingPart::in_own_ring(const Polynomial& p) const {
  TermCollector collector(ring_);
  for (auto [number, exponents] : p.term_list()) {
    exponents.push_back(0);
    collector.add(number, exponents);
  }
  return collector.finish();
}

std::string LeadingPart::text(const Polynomial& p) const {
  std::string result;
  for (const auto& [number, exponents] : p.term_list()) {
    std::string factors;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      if (!factors.empty()) factors += "*";
      if (i != rho_)
        factors += system_.functions().text(system_.ring().variable(i).pow(exponents[i]));
      else
        factors += exponents[i] > 1 ? fmt::format("rho^{}", exponents[i]) : "rho";
    }
    append_term(result, number, factors);
  }
  return result.empty() ? "0" : result;
}

std::string LeadingPart::quotient(const Polynomial& top, const Polynomial& bottom) const {
  const Polynomial common = Polynomial::gcd(top, bottom);
  Polynomial a = top, b = bottom;
  top.divide(common, &a);
  bottom.divide(common, &b);
  if (b.is_constant()) return text(a.scaled(1 / b.term_list()[0].first));
  const cln::cl_RA content = b.content();
  a = a.scaled(1 / content);
  b = b.scaled(1 / content);
  return quotient_text(text(a), a.terms() > 1, text(b));
}

void LeadingPart::read_weights(const std::vector<std::pair<Text, Text>>& weights) {
  std::vector<std::string> names;
  for (const GiNaC::symbol& s : model_.variables) names.push_back(s.get_name());
  if (weights.empty()) {
    const std::optional<Weights> found = find_weights(field_, names);
    if (!found) {
      throw ModelError(
          "no weights with small numbers make the equations of motion quasi-homogeneous: give "
          "some");
    }
    weights_ = *found;
  } else {
    weights_.numerators.assign(dimension_, 1);
    for (const auto& [name, weight] : weights) {
      const std::size_t i =
          symbol_position(name, name.value, 0, model_.variables, "a variable of this case");
      int value = 0;
      const char* end = weight.value.data() + weight.value.size();
      const auto [stop, problem] = std::from_chars(weight.value.data(), end, value);
      if (problem != std::errc() || stop != end || value < 1 || value > 100)
        throw weight.error("a weight is a whole number from 1 to 100");
      weights_.numerators[i] = value;
    }
  }
}

void LeadingPart::keep_leading_terms() {
  for (std::size_t i = 0; i < dimension_; ++i) {
    TermCollector kept(ring_), dropped(ring_);
    for (const auto& [number, exponents] : field_[i].term_list()) {
      const int more = excess(weights_, i, exponents);
      if (more > 0) {
        throw ModelError(
            fmt::format("with these weights the rate of {} has a term of too high a weight, so "
                        "that no solution "
                        "grows like a power",
                        model_.variables[i].get_name()));
      }
      (more == 0 ? kept : dropped).add(number, exponents);
    }
    field_[i] = kept.finish();
    const Polynomial rest = dropped.finish();
    if (!rest.is_zero())
      left_out_.push_back(
          fmt::format("{} in the rate of {}", text(rest), model_.variables[i].get_name()));
  }
}

void LeadingPart::describe(ExponentReport& report) const {
  for (std::size_t i = 0; i < dimension_; ++i)
    report.weights.emplace_back(model_.variables[i].get_name(), rational_text(weight(i)));
  report.left_out = left_out_;
  bool is_numeric = true;
  std::vector<double> values(ring_.size(), 1);
  for (std::size_t k = dimension_; k < rho_; ++k) {
    if (!use(k)) continue;
    if (!system_.is_number(k)) report.generic.push_back(system_.name(k));
    const std::optional<double> value = value_of(k);
    is_numeric = is_numeric && value;
    values[k] = value.value_or(1);
  }
  if (is_numeric) report.leading = in_numbers(values);
}

/// With these values of what is constant.
LeadingSystem LeadingPart::in_numbers(const std::vector<double>& values) const {
  const auto number_of = [&](const cln::cl_RA& number, const std::vector<unsigned long>& powers) {
    double result = cln::double_approx(number);
    for (std::size_t k = dimension_; k < powers.size(); ++k)
      result *= std::pow(values[k], static_cast<double>(powers[k]));
    return result;
  };
  double factor = 0;
  for (const auto& [number, powers] : factor_.term_list()) factor += number_of(number, powers);
  LeadingSystem leading;
  for (std::size_t i = 0; i < dimension_; ++i) {
    leading.names.push_back(model_.variables[i].get_name());
    leading.weights.push_back(cln::double_approx(weight(i)));
    auto& rate = leading.rates.emplace_back();
    for (auto [number, exponents] : field_[i].term_list()) {
      const double coefficient = number_of(number, exponents) / factor;
      exponents.resize(dimension_);
      rate.push_back({coefficient, exponents});
    }
  }
  return leading;
}

}  // namespace casimir::search

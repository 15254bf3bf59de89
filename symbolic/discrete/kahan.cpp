#include "symbolic/discrete/kahan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/discrete/minors.hpp"
#include "symbolic/discrete/new_names.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

struct Fraction {
  Polynomial top, bottom;
};

/// The field as fractions whose denominators are free of the variables, and the map made of it.
class Kahan {
 public:
  Kahan(const Model& flow, const std::optional<ex>& value, long highest)
      : flow_(flow),
        names_(flow),
        step_(names_.take({"eps", "epsilon", "step"})),
        step_value_(value.value_or(ex(step_))),
        ring_(symbols(), flow.assumptions, expressions(), flow.limits) {
    for (std::size_t i = 0; i < flow.field.size(); ++i) field_.push_back(component(i, highest));
  }

  RationalMapText map() {
    RationalMapText text;
    if (step_value_.is_equal(step_)) text.step = step_.get_name();
    const std::vector<Fraction> next = solve();
    name_denominators(next, text);
    for (const Fraction& x : next) text.next.push_back(text_of(x, text));
    if (has_cubic_hamiltonian()) {
      text.modified_integral = modified_hamiltonian(next, text);
      text.density = "1/(" + ring_.text(determinant_) + ")";
    }
    return text;
  }

 private:
  std::size_t dimension() const { return flow_.variables.size(); }

  std::vector<GiNaC::symbol> symbols() const {
    std::vector<GiNaC::symbol> result = flow_.symbols();
    result.push_back(step_);
    return result;
  }

  std::vector<ex> expressions() const {
    std::vector<ex> result = flow_.field;
    result.push_back(step_value_);
    if (flow_.hamiltonian) result.push_back(*flow_.hamiltonian);
    return result;
  }

  /// The highest degree in the variables of any term; empty where they are inside functions.
  std::optional<long> degree_of(const Polynomial& p) const {
    const std::size_t n = dimension();
    long degree = 0;
    for (const auto& [coefficient, exponents] : p.term_list()) {
      long own = 0;
      for (std::size_t i = 0; i < exponents.size(); ++i) {
        if (exponents[i] == 0) continue;
        if (i < n) own += static_cast<long>(exponents[i]);
        if (i >= ring_.symbols().size() && ring_.depends_on_first(ring_.ring().variable(i), n))
          return std::nullopt;
      }
      degree = std::max(degree, own);
    }
    return degree;
  }

  Fraction component(std::size_t i, long highest) {
    auto [top, bottom] = ring_.lowest_terms(ring_.convert(flow_.field[i]));
    const std::optional<long> degree = degree_of(top);
    if (degree && *degree <= highest && !ring_.depends_on_first(bottom, dimension()))
      return {std::move(top), std::move(bottom)};
    throw ModelError(fmt::format(
        "d{}/dt is no polynomial of degree at most {} in the variables: {}",
        flow_.variables[i].get_name(), highest,
        highest == 2 ? "Kahan's map is made of quadratic equations"
                     : "the implicit midpoint rule is a rational map of linear equations only; "
                       "Kahan's makes one of quadratic equations too"));
  }

  Polynomial product(const Polynomial& a, const Polynomial& b) const {
    return ring_.reduced(ring_.checked_product(a, b));
  }

  /// Cramer's rule for (2 b_i I - eps df_i) k = 2 f_i, where f_i / b_i is the field.
  std::vector<Fraction> solve() {
    const std::size_t n = dimension();
    const auto [eps, eps_bottom] = ring_.lowest_terms(ring_.convert(step_value_));
    std::vector<std::vector<Polynomial>> rows;
    for (std::size_t i = 0; i < n; ++i) {
      auto& row = rows.emplace_back();
      for (std::size_t j = 0; j < n; ++j) {
        Polynomial entry = -product(eps, ring_.derivative(field_[i].top, j));
        if (i == j) entry += product(field_[i].bottom, eps_bottom).scaled(2);
        row.push_back(std::move(entry));
      }
      row.push_back(product(field_[i].top, eps_bottom).scaled(2));
    }
    const auto minors = discrete::maximal_minors(
        rows, ring_.ring().constant(1),
        [&](const Polynomial& a, const Polynomial& b) { return product(a, b); });
    const unsigned all = (1U << (n + 1)) - 1;
    const auto without = [&](std::size_t column) {
      const auto found = minors.find(all & ~(1U << column));
      return found == minors.end() ? Polynomial(ring_.ring()) : found->second;
    };
    determinant_ = without(n);
    std::vector<Fraction> next;
    for (std::size_t i = 0; i < n; ++i) {
      Polynomial top = product(eps, without(i));
      if ((n - 1 - i) % 2 == 1) top = -top;
      const Polynomial bottom = product(eps_bottom, determinant_);
      top += product(ring_.ring().variable(i), bottom);
      next.push_back(in_lowest_terms(std::move(top), bottom));
    }
    return next;
  }

  static Fraction in_lowest_terms(Polynomial top, Polynomial bottom) {
    const Polynomial common = Polynomial::gcd(top, bottom);
    top.divide(common, &top);
    bottom.divide(common, &bottom);
    const cln::cl_RA content = bottom.content();
    return {top.scaled(1 / content), bottom.scaled(1 / content)};
  }

  /// Those that more than one next value has.
  void name_denominators(const std::vector<Fraction>& next, RationalMapText& text) {
    for (std::size_t i = 0; i < next.size(); ++i) {
      const auto same = [&](const Fraction& other) { return other.bottom == next[i].bottom; };
      const bool first = std::find_if(next.begin(), next.end(), same) == next.begin() + long(i);
      if (!first || next[i].bottom.is_constant() ||
          std::count_if(next.begin(), next.end(), same) < 2)
        continue;
      const std::string name =
          names_.take({named_.empty() ? "D" : fmt::format("D{}", named_.size() + 1)});
      text.definitions.emplace_back(name, ring_.text(next[i].bottom));
      named_.push_back({next[i].bottom, name});
    }
  }

  std::string text_of(const Fraction& x, const RationalMapText&) const {
    if (x.bottom.is_constant()) return ring_.text(x.top.scaled(1 / x.bottom.content()));
    for (const auto& [bottom, name] : named_) {
      if (bottom == x.bottom) return fmt::format("({})/{}", ring_.text(x.top), name);
    }
    return fmt::format("({})/({})", ring_.text(x.top), ring_.text(x.bottom));
  }

  bool has_cubic_hamiltonian() {
    if (!flow_.hamiltonian || !flow_.poisson || flow_.time) return false;
    for (std::size_t i = 0; i < dimension(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (const GiNaC::symbol& x : flow_.variables) {
          if ((*flow_.poisson)(i, j).has(x)) return false;
        }
      }
    }
    const auto [top, bottom] = ring_.lowest_terms(ring_.convert(*flow_.hamiltonian));
    const std::optional<long> degree = degree_of(top);
    return degree && *degree <= 3 && !ring_.depends_on_first(bottom, dimension());
  }

  /// H + sum_i dH/dx_i (x'_i - x_i)/3.
  std::string modified_hamiltonian(const std::vector<Fraction>& next, const RationalMapText& text) {
    const auto fraction = [&](const Polynomial& p) {
      auto [top, bottom] = ring_.lowest_terms(p);
      return fmt::format("({})/({})", ring_.text(top), ring_.text(bottom));
    };
    const Polynomial& h = ring_.convert(*flow_.hamiltonian);
    std::string sum = fraction(h);
    for (std::size_t i = 0; i < next.size(); ++i) {
      const Polynomial slope = ring_.derivative(h, i);
      if (ring_.reduced(slope).is_zero()) continue;
      sum += fmt::format(" + {}*({} - {})/3", fraction(slope), text_of(next[i], text),
                         flow_.variables[i].get_name());
    }
    return sum;
  }

  const Model& flow_;
  discrete::NewNames names_;
  GiNaC::symbol step_;
  ex step_value_;
  FunctionRing ring_;
  std::vector<Fraction> field_;
  Polynomial determinant_{ring_.ring()};
  std::vector<std::pair<Polynomial, std::string>> named_;
};

void check_autonomous(const Model& flow) {
  if (flow.time)
    throw ModelError("the equations depend on time, which a map of the phase space does not know");
}

}  // namespace

RationalMapText kahan_map(const Model& flow, const std::optional<ex>& value) {
  check_autonomous(flow);
  return Kahan(flow, value, 2).map();
}

void check_quadratic(const Model& flow) {
  check_autonomous(flow);
  Kahan(flow, std::nullopt, 2);
}

RationalMapText midpoint_map(const Model& flow, const std::optional<ex>& value) {
  check_autonomous(flow);
  return Kahan(flow, value, 1).map();
}

}  // namespace casimir

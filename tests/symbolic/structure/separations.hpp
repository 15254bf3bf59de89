#pragma once

// Separations and the check of what is found in numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <regex>

#include "symbolic/structure/separation.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {

using structure::Separation;
using structure::SeparationReport;
using Complex = std::complex<double>;

inline Text text_of(const std::string& value) { return {value, {"a test", 1, 1}, {}}; }

inline Model canonical(const std::string& variables, const std::string& hamiltonian,
                       const std::string& more = {}) {
  return model_of("hamiltonian = \"" + hamiltonian + "\"\n[phase_space]\nvariables = [" +
                  variables + "]\ncanonical = true\n" + more);
}

inline const std::string kPlane = R"("x", "y", "px", "py")";

inline SeparationReport searched(const Model& model, int degree,
                                 const std::vector<std::string>& on = {}) {
  structure::SeparationRequest request{degree, {}, {}};
  for (const std::string& own : on) request.on.push_back(text_of(own));
  return structure::find_separation(model, request);
}

/// Brackets of the roots with each other and with the integrals, at a point in doubles: by the
/// bracket of the model alone.
class AtPoint {
 public:
  AtPoint(const Model& model, const Separation& own, GiNaC::exmap values)
      : model_(model), own_(own), values_(std::move(values)) {
    for (const std::string& one : own.coefficients) a_.push_back(model.parse(text_of(one)));
    for (const std::string& one : own.integrals) f_.push_back(model.parse(text_of(one)));
    find_roots();
  }

  std::size_t size() const { return a_.size(); }
  Complex root(std::size_t i) const { return roots_[i]; }
  Complex slope(std::size_t i) const {
    Complex result = 1;
    for (std::size_t k = 0; k < size(); ++k)
      if (k != i) result *= roots_[i] - roots_[k];
    return result;
  }
  Complex with_integral(std::size_t i, std::size_t j) const {
    Complex sum = 0;
    for (std::size_t k = 0; k < size(); ++k)
      sum -= number(model_.poisson->bracket(a_[k], f_[j])) * power(i, size() - 1 - k);
    return sum / slope(i);
  }
  Complex with_root(std::size_t i, std::size_t j) const {
    Complex sum = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      for (std::size_t l = 0; l < size(); ++l)
        sum += number(model_.poisson->bracket(a_[k], a_[l])) * power(i, size() - 1 - k) *
               power(j, size() - 1 - l);
    }
    return sum / slope(i) / slope(j);
  }
  /// s_j at a root, which is real in the tests.
  double multiplier(const Separation::Relation& relation, std::size_t j, std::size_t i) const {
    return number(model_.parse(text_of(with_number(relation.multipliers[j], own_.names.root, i))));
  }
  /// The difference of the two sides of the equation for {u, G}^2.
  double equation_defect(const Separation::Relation& relation, std::size_t i) const {
    double g = 0, w = 0;
    for (std::size_t j = 0; j < f_.size(); ++j) {
      g += multiplier(relation, j, i) * number(f_[j]);
      w += multiplier(relation, j, i) * with_integral(i, j).real();
    }
    const std::string sides =
        std::regex_replace(with_number(relation.equation, own_.names.root, i),
                           std::regex("\\b" + own_.names.sum + "\\b"), "(" + fraction_of(g) + ")");
    return number(model_.parse(text_of(sides))) - w * w;
  }
  double number(const GiNaC::ex& e) const {
    return GiNaC::ex_to<GiNaC::numeric>(e.subs(values_).evalf()).to_double();
  }

 private:
  std::string with_number(const std::string& text, const std::string& name, std::size_t i) const {
    return std::regex_replace(text, std::regex("\\b" + name + "\\b"),
                              "(" + fraction_of(roots_[i].real()) + ")");
  }
  static std::string fraction_of(double value) {
    const auto scaled = static_cast<long long>(std::llround(value * 1e12));
    return std::to_string(scaled) + "/1000000000000";
  }
  Complex power(std::size_t i, std::size_t exponent) const {
    Complex result = 1;
    for (std::size_t k = 0; k < exponent; ++k) result *= roots_[i];
    return result;
  }
  /// By Durand and Kerner.
  void find_roots() {
    for (std::size_t i = 0; i < size(); ++i)
      roots_.push_back(std::pow(Complex(0.4, 0.9), static_cast<double>(i)));
    for (int step = 0; step < 300; ++step) {
      for (std::size_t i = 0; i < size(); ++i) {
        Complex value = 1;
        for (const GiNaC::ex& one : a_) value = value * roots_[i] + number(one);
        roots_[i] -= value / slope(i);
      }
    }
  }

  const Model& model_;
  const Separation& own_;
  GiNaC::exmap values_;
  std::vector<GiNaC::ex> a_, f_;
  std::vector<Complex> roots_;
};

/// Variables and parameters in order.
inline GiNaC::exmap point_of(const Model& model, const std::vector<GiNaC::ex>& numbers) {
  GiNaC::exmap result;
  std::size_t next = 0;
  for (const auto* list : {&model.variables, &model.parameters})
    for (const GiNaC::symbol& one : *list) result[one] = numbers.at(next++);
  return result;
}

/// What the theorem assumes, in numbers.
inline void expect_separated(const Model& model, const SeparationReport& report,
                             const std::vector<GiNaC::ex>& numbers) {
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  const Separation& own = report.found[0];
  EXPECT_EQ(own.separated, Verdict::proved);
  EXPECT_EQ(own.staeckel, Verdict::proved);
  const AtPoint at(model, own, point_of(model, numbers));
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (i == k) continue;
      EXPECT_GT(std::abs(at.root(i) - at.root(k)), 1e-3);
      EXPECT_LT(std::abs(at.with_root(i, k)), 1e-7);
    }
    const auto is_own = [&](const Separation::Relation& one) {
      return one.root.empty() ||
             std::abs(at.number(model.parse(text_of(one.root))) - at.root(i)) < 1e-6;
    };
    const auto relation = std::ranges::find_if(own.relations, is_own);
    ASSERT_NE(relation, own.relations.end());
    if (!relation->equation.empty()) EXPECT_LT(std::abs(at.equation_defect(*relation, i)), 1e-5);
    for (std::size_t k = 0; k < at.size(); ++k) {
      Complex sum = 0;
      for (std::size_t j = 0; j < at.size(); ++j)
        sum += at.multiplier(*relation, j, i) * at.with_integral(k, j);
      if (k == i)
        EXPECT_GT(std::abs(sum), 1e-4);
      else
        EXPECT_LT(std::abs(sum), 1e-6);
    }
  }
}

/// What is said of roots that are given.
inline SeparationReport examined(const Model& model, const std::string& roots) {
  structure::SeparationRequest request;
  request.roots = Text{roots, {"a test", 1, 1}, roots};
  return structure::find_separation(model, request);
}

/// Kepler's problem in the plane, with the angular momentum.
inline Model central() {
  return canonical(kPlane, "(px^2 + py^2)/2 - k/sqrt(x^2 + y^2)",
                   "[parameters]\nk = {}\n[integrals]\nL = \"x*py - y*px\"\n");
}

/// A point with (M, g) = 0.
inline const std::vector<GiNaC::ex> kOnLevel{
    1, GiNaC::numeric(1, 2), GiNaC::numeric(-3, 4), GiNaC::numeric(3, 5), 0, GiNaC::numeric(4, 5),
    1};

}  // namespace casimir::test

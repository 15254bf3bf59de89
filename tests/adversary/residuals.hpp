#pragma once

#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/evaluate.hpp"

namespace casimir::adversary {

/// A case at a point: its flow, brackets and what its claim says is zero there, in balls.
class At {
 public:
  At(const Case& claim, const Point& point);

  /// dx_i/dt.
  std::vector<Ball> field() const;
  /// The gradient of a function along the variables, and then the time if there is one.
  std::vector<Ball> gradient(const Expr& f) const;
  Ball value(const Expr& f) const;
  /// J as numbers.
  std::vector<std::vector<Ball>> structure() const;
  /// J grad f.
  std::vector<Ball> flow(const Expr& f) const;
  Ball bracket(const Expr& f, const Expr& g) const;
  Ball rate(const Expr& f) const;

  /// All that the claim says is zero here; not for facts about ranks.
  std::vector<Ball> residuals() const;

 private:
  Expr named(const Expr& e) const { return names_.empty() ? e : substitute(e, names_); }
  std::vector<Ball> jacobi() const;
  std::vector<Ball> lax() const;
  std::vector<Ball> map() const;
  std::vector<Ball> measure() const;
  std::vector<Ball> rates_of(const OnLevel& claim) const;
  Dual dual(const Expr& e) const;

  const Case& case_;
  const Point& point_;
  std::vector<std::string> along_;
  Substitution names_;
  bool real_;
};

/// What a claim's expressions may be called by: definitions, and H for the Hamiltonian where no
/// name of the case takes it.
Substitution names_of(const Case& claim);
/// Whether I stands in the claim, so that its roots and logarithms need not be real.
bool is_complex(const Case& claim);
/// Everything that the claim asks about, beside the flow.
std::vector<Expr> expressions_of(const Case& claim);
/// Functions of a fact: H and the integrals, with the Casimirs before them if wanted.
std::vector<Expr> functions_of(const Case& claim, bool casimirs);

}  // namespace casimir::adversary

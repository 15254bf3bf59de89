#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {

/// The names of a case file. A definition is read when it is first used, so that their order does
/// not matter; one that uses itself is an error.
class CaseNames : public Scope {
 public:
  /// No names yet. \param limits  of the case; outlive it
  explicit CaseNames(const Limits& limits) : limits_(limits) {}

  /// \throws CaseError  for a name that cannot be used, or is taken.
  void declare(const Text& name, const std::string& what, Quantity quantity);
  void define(const Entry& entry);

  /// Names a built-in, such as H for the Hamiltonian, unless the file declares the name itself:
  /// then it means what the file says.
  void offer(const std::string& name, Quantity quantity) {
    if (!pending_.contains(name)) table_.try_emplace(name, std::move(quantity));
  }

  /// Names a function of the file that was just read, as an integral, for use in further
  /// expressions.
  /// \throws CaseError  where the name already stands for something else.
  void name_function(const Text& name, const Quantity& quantity);

  const Quantity* find(const std::string& name) override;
  std::vector<std::string> known() const override;

  /// From here on expressions may use the bracket and the flow. `dynamics` is borrowed.
  void allow(const Dynamics* dynamics) { dynamics_ = dynamics; }
  const Dynamics* dynamics() override { return dynamics_; }

  void allow_complex_numbers(bool allowed) { complex_ = allowed; }
  bool complex_numbers() const override { return complex_; }
  const Limits& limits() const override { return limits_; }

 private:
  const Limits& limits_;
  bool complex_ = false;
  std::map<std::string, Quantity> table_;
  std::map<std::string, const Entry*> pending_;
  std::set<std::string> open_;
  const Dynamics* dynamics_ = nullptr;
};

/// The names of `base` and some more, such as a spectral parameter.
class ExtendedNames : public Scope {
 public:
  ExtendedNames(Scope& base, const std::vector<GiNaC::symbol>& extra);
  const Quantity* find(const std::string& name) override;
  std::vector<std::string> known() const override;
  const Dynamics* dynamics() override { return base_.dynamics(); }
  bool complex_numbers() const override { return base_.complex_numbers(); }
  const Limits& limits() const override { return base_.limits(); }

 private:
  Scope& base_;
  NameTable extra_;
};

}  // namespace casimir

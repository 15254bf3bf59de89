#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/adversary/expression.hpp"

namespace casimir::adversary {

/// What a rule may use.
struct Operands {
  Expr v, w;  ///< real
  Expr p, r;  ///< positive
  Expr u;     ///< between -1 and 1, or real only where it is
  long k = 2;
};

struct Rule {
  std::string family;
  std::function<std::pair<Expr, Expr>(const Operands&)> make;
};

/// Identities of real functions, wherever both sides have values.
const std::vector<Rule>& true_rules();
/// Such as hold for one sign, or on one branch only.
const std::vector<Rule>& branch_rules();

}  // namespace casimir::adversary

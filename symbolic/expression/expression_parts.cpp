// The parts of an expression that GiNaC has made something else of: where those have no value, the
// expression has none.
#include <algorithm>
#include <memory>
#include <unordered_set>
#include <utility>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/expression/principal_values.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// The functions and the powers in an expression.
std::unordered_set<ex> visible_parts(const ex& value) {
  std::unordered_set<ex> parts;
  for (auto part = value.preorder_begin(); part != value.preorder_end(); ++part) {
    if (GiNaC::is_a<GiNaC::power>(*part) || GiNaC::is_a<GiNaC::function>(*part))
      parts.insert(*part);
  }
  return parts;
}

/// It has a value wherever its base has one.
bool is_ring_power(const ex& part) {
  return GiNaC::is_a<GiNaC::power>(part) && part.op(1).info(GiNaC::info_flags::posint);
}

class LostInSubstitution {
 public:
  LostInSubstitution(const GiNaC::exmap& values, const Limits& limits, VanishingTerms vanishing)
      : values_(values), limits_(limits), vanishing_(vanishing) {}

  std::vector<ex> operator()(const ex& expression) {
    const std::unordered_set<ex> before = visible_parts(expression);
    if (before.empty()) return {};
    known_ = visible_parts(substituted(expression, values_, limits_));
    visit(expression);
    return std::move(lost_);
  }

 private:
  void visit(const ex& e) {
    if (e.nops() == 0 || !seen_.insert(e).second) return;
    const bool is_part = GiNaC::is_a<GiNaC::power>(e) || GiNaC::is_a<GiNaC::function>(e);
    if (is_part || GiNaC::is_a<GiNaC::mul>(e)) {
      const ex now = substituted(e, values_, limits_);
      if (vanishing_ == VanishingTerms::dropped && now.is_zero() && is_switched_off(e)) return;
      // Real as it is written; GiNaC may make a real number of two of them.
      if (is_part && is_no_real_constant(now, limits_.bits)) lost_.push_back(now);
      if (is_part)
        for (const ex& part : visible_parts(now))
          if (!is_ring_power(part) && known_.insert(part).second) lost_.push_back(part);
    }
    for (std::size_t i = 0; i < e.nops(); ++i) visit(e.op(i));
  }

  /// Whether it is zero by the values alone, wherever it is looked at: a strength of 0, or a
  /// function that is.
  bool is_switched_off(const ex& e) const {
    if (GiNaC::is_exactly_a<GiNaC::function>(e))
      return as_arbitrary(GiNaC::ex_to<GiNaC::function>(e)).has_value();
    return GiNaC::is_a<GiNaC::mul>(e) && std::any_of(e.begin(), e.end(), [&](const ex& factor) {
             return has_only_values(factor) && substituted(factor, values_, limits_).is_zero();
           });
  }
  bool has_only_values(const ex& e) const {
    return std::all_of(e.preorder_begin(), e.preorder_end(), [&](const ex& part) {
      return !GiNaC::is_a<GiNaC::symbol>(part) || values_.contains(part);
    });
  }

  const GiNaC::exmap& values_;
  const Limits& limits_;
  VanishingTerms vanishing_;
  std::unordered_set<ex> known_, seen_;
  std::vector<ex> lost_;
};

}  // namespace

std::vector<ex> lost_in_substitution(const ex& expression, const GiNaC::exmap& values,
                                     const Limits& limits, VanishingTerms vanishing) {
  return LostInSubstitution(values, limits, vanishing)(expression);
}

std::vector<ex> substituted_with_parts(const ex& expression, const GiNaC::exmap& values,
                                       const Limits& limits) {
  std::vector<ex> result =
      lost_in_substitution(expression, values, limits, VanishingTerms::counted);
  result.insert(result.begin(), substituted(expression, values, limits));
  return result;
}

std::vector<ex> lost_parts(const Quantity& quantity) {
  std::vector<ex> lost;
  if (!quantity.parts) return lost;
  const std::unordered_set<ex> visible = visible_parts(quantity.value);
  for (const ex& part : *quantity.parts) {
    // A sum of what is visible has values where that has.
    if (!visible.contains(part) &&
        (GiNaC::is_a<GiNaC::power>(part) || GiNaC::is_a<GiNaC::function>(part) ||
         GiNaC::is_a<GiNaC::mul>(part)))
      lost.push_back(part);
  }
  return lost;
}

Quantity with_parts(Quantity quantity, const std::vector<ex>& lost) {
  std::vector<ex> parts = lost;
  for (const ex& part : visible_parts(quantity.value)) parts.push_back(part);
  if (!parts.empty()) quantity.parts = std::make_shared<const std::vector<ex>>(std::move(parts));
  return quantity;
}

}  // namespace casimir

// The parts of an expression that GiNaC has made something else of: where those have no value, the
// expression has none.
#include <memory>
#include <unordered_set>
#include <utility>

#include "symbolic/expression/expression.hpp"

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

}  // namespace

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

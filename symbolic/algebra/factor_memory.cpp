#include "symbolic/algebra/factor_memory.hpp"

#include <algorithm>

namespace casimir {
namespace {

// Beyond these it is quicker to find the factors anew than to look for them, or they fill memory.
constexpr std::size_t kMostEntries = 200, kMostTermsKept = 500;

}  // namespace

/// Under the guard.
const FactorMemory::Entry* FactorMemory::find(const Polynomial& p) const {
  const std::size_t terms = p.terms();
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.whole.terms() == terms && entry.whole == p;
  });
  return found == entries_.end() ? nullptr : &*found;
}

std::optional<Factors> FactorMemory::of(const Polynomial& p) const {
  const std::lock_guard lock(guard_);
  const Entry* known = find(p);
  if (known == nullptr) return std::nullopt;
  return known->factors;
}

void FactorMemory::keep(const Polynomial& p, const Factors& factors) {
  if (p.terms() > kMostTermsKept) return;
  const std::lock_guard lock(guard_);
  const Polynomial one = p.ring().constant(1);
  const auto add = [&](const Polynomial& whole, const Factors& own) {
    if (entries_.size() < kMostEntries && find(whole) == nullptr) entries_.push_back({whole, own});
  };
  add(p, factors);
  for (const auto& [f, exponent] : factors)
    if (!f.is_constant() && f.content() == 1) add(f, {{one, 1}, {f, 1}});
}

}  // namespace casimir

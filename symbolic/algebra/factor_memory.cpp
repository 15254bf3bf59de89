#include "symbolic/algebra/factor_memory.hpp"

#include <algorithm>
#include <mutex>
#include <unordered_map>

namespace casimir {
namespace {

// Beyond these it is quicker to find the factors anew than to look for them, or they fill memory.
constexpr std::size_t kMostEntries = 200, kMostTermsKept = 500;

struct RememberedFactors {
  Polynomial whole;
  Factors factors;
};

struct RingMemories {
  std::mutex guard;
  std::unordered_map<const PolynomialRing*, std::vector<RememberedFactors>> of_ring;
};

/// Never destroyed, since a ring may be the last thing to go.
RingMemories& ring_memories() {
  static RingMemories& memories = *new RingMemories;
  return memories;
}

const RememberedFactors* remembered(const std::vector<RememberedFactors>& list,
                                    const Polynomial& p) {
  const std::size_t terms = p.terms();
  const auto found = std::find_if(list.begin(), list.end(), [&](const RememberedFactors& entry) {
    return entry.whole.terms() == terms && entry.whole == p;
  });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

std::optional<Factors> FactorMemory::of(const Polynomial& p) {
  RingMemories& memories = ring_memories();
  const std::lock_guard lock(memories.guard);
  const auto own = memories.of_ring.find(&p.ring());
  if (own == memories.of_ring.end()) return std::nullopt;
  const RememberedFactors* known = remembered(own->second, p);
  if (known == nullptr) return std::nullopt;
  return known->factors;
}

void FactorMemory::keep(const Polynomial& p, const Factors& factors) {
  if (p.terms() > kMostTermsKept) return;
  RingMemories& memories = ring_memories();
  const std::lock_guard lock(memories.guard);
  std::vector<RememberedFactors>& list = memories.of_ring[&p.ring()];
  const Polynomial one = p.ring().constant(1);
  const auto add = [&](const Polynomial& whole, const Factors& own) {
    if (list.size() < kMostEntries && remembered(list, whole) == nullptr)
      list.push_back({whole, own});
  };
  add(p, factors);
  for (const auto& [f, exponent] : factors)
    if (!f.is_constant() && f.content() == 1) add(f, {{one, 1}, {f, 1}});
}

void FactorMemory::forget(const PolynomialRing& ring) {
  RingMemories& memories = ring_memories();
  const std::lock_guard lock(memories.guard);
  memories.of_ring.erase(&ring);
}

}  // namespace casimir

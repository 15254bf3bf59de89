#include "tests/adversary/templates.hpp"

namespace casimir::adversary {

AnyClaim random_claim(Random& random) {
  const int choice = random(100);
  if (choice < 36) return random.of(identity_templates())(random);
  if (choice < 52) return random.of(rank_templates())(random);
  if (choice < 72) return random.of(level_templates())(random);
  if (choice < 91) return random.of(domain_templates())(random);
  if (choice < 95) return random.of(name_templates())(random);
  return choice < 97 ? random.of(search_templates())(random) : random.of(free_templates())(random);
}

}  // namespace casimir::adversary

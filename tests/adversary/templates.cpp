#include "tests/adversary/templates.hpp"

namespace casimir::adversary {

Case random_case(Random& random) {
  const int choice = random(20);
  if (choice < 8) return random.of(identity_templates())(random);
  if (choice < 11) return random.of(rank_templates())(random);
  if (choice < 15) return random.of(level_templates())(random);
  if (choice < 19) return random.of(domain_templates())(random);
  return random.of(name_templates())(random);
}

}  // namespace casimir::adversary

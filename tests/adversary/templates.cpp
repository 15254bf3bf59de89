#include "tests/adversary/templates.hpp"

#include "tests/adversary/shear.hpp"

namespace casimir::adversary {
namespace {

Case random_case(Random& random) {
  const int choice = random(100);
  if (choice < 36) return random.of(identity_templates())(random);
  if (choice < 54) return random.of(rank_templates())(random);
  if (choice < 75) return random.of(level_templates())(random);
  if (choice < 95) return random.of(domain_templates())(random);
  return random.of(name_templates())(random);
}

}  // namespace

AnyClaim random_claim(Random& random) {
  const int choice = random(100);
  if (choice < 2) return random.of(search_templates())(random);
  if (choice < 5) return random.of(free_templates())(random);
  if (choice == 97) return random.of(exponent_templates())(random);
  if (choice == 98) return random.of(darboux_templates())(random);
  if (choice == 99) return random.of(certificate_templates())(random);
  const Case claim = random_case(random);
  return random.one_in(3) ? sheared(claim, random) : claim;
}

}  // namespace casimir::adversary

#pragma once

#include <variant>
#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/planted_case.hpp"
#include "tests/adversary/random.hpp"
#include "tests/adversary/search_case.hpp"

namespace casimir::adversary {

/// Makes a claim of one sort, true or false, at random.
using Template = Case (*)(Random&);

/// Claims that are identities of functions, disguised by others: integrals, Casimir functions,
/// brackets, identities, measures, Lax pairs, maps, involution.
const std::vector<Template>& identity_templates();
/// Independence, rank and Liouville's count, with functions that are another one in disguise.
const std::vector<Template>& rank_templates();
/// Claims on levels: their parts, roots and denominators that vanish there, and what is real.
const std::vector<Template>& level_templates();
/// Signs of parameters, empty domains, complex roots, domains that only roots imply.
const std::vector<Template>& domain_templates();
/// Names that mean something else elsewhere.
const std::vector<Template>& name_templates();

/// A claim about a case, a search, or a structure that is there.
using AnyClaim = std::variant<Case, SearchCase, PlantedCase>;

/// A claim from any of them.
AnyClaim random_claim(Random& random);

}  // namespace casimir::adversary

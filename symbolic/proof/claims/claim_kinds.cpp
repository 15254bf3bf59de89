#include "symbolic/proof/claims/claim_kinds.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "symbolic/discrete/map_claims.hpp"
#include "symbolic/proof/claims/theorems.hpp"

namespace casimir {
namespace {

/// What a case claims of its bracket and of functions, it claims of a map on its phase space too.
template <ReadClaims read>
std::vector<Claim> of_base(const MapModel& map) {
  return read(map.base);
}

template <auto list>
void clear_list(Model& model) {
  (model.*list).clear();
}

constexpr std::array kClaimRows{
    ClaimRow{.kind = ClaimKind::skew,
             .name = "skew",
             .read = skew_claims,
             .read_of_map = of_base<skew_claims>,
             .certify = certify_skew},
    ClaimRow{.kind = ClaimKind::jacobi,
             .name = "jacobi",
             .read = jacobi_claims,
             .read_of_map = of_base<jacobi_claims>,
             .certify = certify_jacobi},
    ClaimRow{
        .kind = ClaimKind::identity, .read = frame_claims, .read_of_map = of_base<frame_claims>},
    ClaimRow{.kind = ClaimKind::map, .read_of_map = discrete::poisson_claims},
    ClaimRow{.kind = ClaimKind::casimir,
             .name = "casimir",
             .read = casimir_claims,
             .read_of_map = of_base<casimir_claims>,
             .clear = clear_list<&Model::casimirs>,
             .make = casimir_claim,
             .make_of_map = discrete::casimir_claim,
             .candidates = &Candidates::casimirs,
             .without_bracket = "a Casimir function needs a bracket, which this case does not have",
             .certify = certify_casimir,
             .letter = "C"},
    ClaimRow{.kind = ClaimKind::integral,
             .name = "integral",
             .read = integral_claims,
             .read_of_map = discrete::integral_claims,
             .clear = clear_list<&Model::integrals>,
             .make = integral_claim,
             .make_of_map = discrete::integral_claim,
             .candidates = &Candidates::integrals,
             .certify = certify_integral,
             .letter = "F"},
    ClaimRow{.kind = ClaimKind::conditional,
             .name = "conditional",
             .read = conditional_claims,
             .read_of_map = discrete::conditional_claims,
             .clear = clear_list<&Model::conditionals>,
             .make = integral_claim,
             .certify = certify_conditional},
    ClaimRow{.kind = ClaimKind::invariant_relation,
             .name = "invariant_relation",
             .read = invariant_relation_claims,
             .read_of_map = discrete::invariant_relation_claims,
             .clear = clear_list<&Model::invariant_relations>,
             .make = invariant_relation_claim,
             .make_of_map = discrete::invariant_relation_claim,
             .candidates = &Candidates::invariant_relations,
             .certify = certify_invariant_relation,
             .letter = "R"},
    ClaimRow{.kind = ClaimKind::lax,
             .name = "lax",
             .read = lax_claims,
             .clear = clear_list<&Model::lax_pairs>},
    ClaimRow{.kind = ClaimKind::map,
             .name = "map",
             .read = map_claims,
             .clear = clear_list<&Model::maps>},
    ClaimRow{.kind = ClaimKind::measure,
             .name = "measure",
             .read = measure_claims,
             .read_of_map = discrete::measure_claims,
             .clear = clear_list<&Model::measures>},
    ClaimRow{.kind = ClaimKind::map, .read_of_map = discrete::symmetry_claims},
    ClaimRow{.kind = ClaimKind::conjugacy,
             .name = "conjugacy",
             .read_of_map = discrete::conjugacy_claims},
    ClaimRow{.kind = ClaimKind::identity,
             .name = "identity",
             .read = identity_claims,
             .read_of_map = of_base<identity_claims>,
             .clear = clear_list<&Model::identities>},
    ClaimRow{.kind = ClaimKind::involution,
             .name = "involution",
             .read = involution_claims,
             .read_of_map = of_base<involution_claims>},
    ClaimRow{.kind = ClaimKind::independence,
             .name = "independence",
             .read = independence_claims,
             .read_of_map = of_base<independence_claims>},
    ClaimRow{.kind = ClaimKind::rank,
             .name = "rank",
             .read = rank_claims,
             .read_of_map = of_base<rank_claims>,
             .of_leaves = true},
    ClaimRow{.kind = ClaimKind::liouville,
             .name = "liouville",
             .read = liouville_claims,
             .read_of_map = discrete::liouville_claims,
             .of_leaves = true},
    ClaimRow{.kind = ClaimKind::liouville, .read = level_liouville_notes},
    ClaimRow{.kind = ClaimKind::measure, .read = unimodularity_notes},
    ClaimRow{.kind = ClaimKind::judgement, .name = "judgement"},
};

consteval bool every_kind_has_one_name() {
  for (int kind = 0; kind <= static_cast<int>(ClaimKind::judgement); ++kind) {
    const auto named = [&](const ClaimRow& row) {
      return row.name && static_cast<int>(row.kind) == kind;
    };
    if (std::ranges::count_if(kClaimRows, named) != 1) return false;
  }
  return true;
}
static_assert(every_kind_has_one_name());

}  // namespace

std::span<const ClaimRow> claim_rows() { return kClaimRows; }

const ClaimRow& claim_row(ClaimKind kind) {
  const auto row = std::ranges::find_if(
      kClaimRows, [&](const ClaimRow& own) { return own.name && own.kind == kind; });
  if (row == kClaimRows.end()) throw std::logic_error("a kind of claims without a row");
  return *row;
}

void require_bracket(const ClaimRow& row, const Model& model, const std::vector<Text>& texts) {
  if (row.without_bracket && !model.poisson && !texts.empty())
    throw texts[0].error(row.without_bracket);
}

std::string to_string(ClaimKind kind) { return claim_row(kind).name; }

std::optional<ClaimKind> claim_kind_of(const std::string& name) {
  for (const ClaimRow& row : kClaimRows) {
    if (row.name && name == row.name) return row.kind;
  }
  return std::nullopt;
}

}  // namespace casimir

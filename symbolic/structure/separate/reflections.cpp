#include "symbolic/structure/separate/reflections.hpp"

#include <algorithm>

namespace casimir::structure {
namespace {

/// Whether the coordinates that change their signs occur an odd number of times.
bool is_odd(const std::vector<unsigned long>& exponents, std::size_t mask) {
  bool odd = false;
  for (std::size_t i = 0; mask >> i != 0; ++i) odd ^= (mask >> i & 1) != 0 && exponents[i] % 2 == 1;
  return odd;
}

/// Whether all terms change their signs, or none; empty where some do.
std::optional<bool> sign_of(const Polynomial& p, std::size_t mask, bool extra = false) {
  std::optional<bool> result;
  for (const auto& [number, exponents] : p.term_list()) {
    const bool own = is_odd(exponents, mask) != extra;
    if (result.value_or(own) != own) return std::nullopt;
    result = own;
  }
  return result.value_or(false);
}

/// Whether all functions of the ring that are no symbols stay as they are.
bool keeps_functions(const Leaves& leaves, std::size_t mask) {
  const search::System& system = leaves.system();
  GiNaC::exmap values;
  for (std::size_t i = 0; i < leaves.dimension(); ++i) {
    const GiNaC::symbol& x = system.model().variables[i];
    if ((mask >> i & 1) != 0) values[x] = -x;
  }
  for (std::size_t g = system.functions().symbols().size();
       g < system.functions().end_of_generators(); ++g) {
    const GiNaC::ex own = system.expression(leaves.ring().variable(g));
    if (!(own.subs(values) - own).expand().is_zero()) return false;
  }
  return true;
}

std::optional<Reflection> reflection(const Leaves& leaves, const std::vector<Polynomial>& integrals,
                                     std::size_t mask) {
  std::optional<bool> odd;
  const std::vector<std::vector<std::size_t>> pairs = skew_indices(leaves.dimension(), 2);
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const Polynomial& p = leaves.bivector()[c];
    if (p.is_zero()) continue;
    const bool indices = ((mask >> pairs[c][0] ^ mask >> pairs[c][1]) & 1) != 0;
    const auto own = sign_of(p, mask, indices);
    if (!own || odd.value_or(*own) != *own) return std::nullopt;
    odd = own;
  }
  const auto has_sign = [&](const Polynomial& p) { return sign_of(p, mask).has_value(); };
  if (!std::ranges::all_of(leaves.ideal(), has_sign) || !std::ranges::all_of(integrals, has_sign) ||
      !keeps_functions(leaves, mask))
    return std::nullopt;
  return Reflection{mask, odd.value_or(false)};
}

}  // namespace

bool Reflection::keeps(const std::vector<unsigned long>& exponents, std::size_t i,
                       std::size_t j) const {
  return (is_odd(exponents, mask) != (((mask >> i ^ mask >> j) & 1) != 0)) == odd;
}

std::vector<Reflection> reflections_of(const Leaves& leaves,
                                       const std::vector<Polynomial>& integrals) {
  std::vector<Reflection> result;
  for (std::size_t mask = 1; mask < std::size_t{1} << leaves.dimension(); ++mask) {
    const auto own = reflection(leaves, integrals, mask);
    if (own) result.push_back(*own);
  }
  return result;
}

}  // namespace casimir::structure

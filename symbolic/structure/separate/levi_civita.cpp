#include "symbolic/structure/separate/levi_civita.hpp"

#include "symbolic/structure/separate/with_root.hpp"

namespace casimir::structure {

std::vector<Polynomial> levi_civita_defect(const Leaves& leaves, const RootCoefficients& a,
                                           const std::vector<Polynomial>& integrals) {
  // All in the root u_2; the other one is -a_1 - u_2.
  const WithRoot with(leaves, a);
  std::vector<WithRoot::Element> own, other;
  for (const Polynomial& f : integrals) {
    own.push_back(with.moved(f));
    const Polynomial first = leaves.bracket(a[0], f), second = leaves.bracket(a[1], f);
    other.push_back(with.reduced({a[0] * first - second, first}));
  }
  // D'(u_2)*n^2*{r, F_l} up to its sign, where r = -m/n.
  const auto rate_of_ratio = [&](const Polynomial& f) {
    return with.difference(with.product(with.moved(own[0], f), own[1]),
                           with.product(own[0], with.moved(own[1], f)));
  };
  std::vector<Polynomial> defect =
      with.difference(with.product(other[0], rate_of_ratio(integrals[1])),
                      with.product(other[1], rate_of_ratio(integrals[0])));
  defect = leaves.system().functions().common_numerators(std::move(defect));
  for (Polynomial& p : defect) p = leaves.reduced(p);
  return defect;
}

}  // namespace casimir::structure

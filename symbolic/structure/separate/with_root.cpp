#include "symbolic/structure/separate/with_root.hpp"

namespace casimir::structure {
namespace {

/// Modulo the level; denominators stay, unlike in `Leaves::reduced`.
Polynomial on_level(const Leaves& leaves, const Polynomial& p) {
  const Polynomial own = leaves.system().functions().reduced(p);
  if (leaves.ideal().empty()) return own;
  std::vector<Polynomial> quotients;
  return own.remainder(leaves.ideal(), &quotients);
}

}  // namespace

WithRoot::Element WithRoot::root() const {
  return reduced({Polynomial(leaves_.ring()), leaves_.ring().constant(1)});
}

WithRoot::Element WithRoot::reduced(Element p) const {
  const std::size_t n = a_.size();
  for (std::size_t m = p.size(); m-- > n;) {
    if (p[m].is_zero()) continue;
    for (std::size_t k = 1; k <= n; ++k) p[m - k] -= p[m] * a_[k - 1];
  }
  p.resize(n, Polynomial(leaves_.ring()));
  for (Polynomial& c : p) c = on_level(leaves_, c);
  return p;
}

WithRoot::Element WithRoot::product(const Element& a, const Element& b) const {
  Element result(a.size() + b.size() - 1, Polynomial(leaves_.ring()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j)
      if (!a[i].is_zero() && !b[j].is_zero()) result[i + j] += a[i] * b[j];
  }
  return reduced(std::move(result));
}

WithRoot::Element WithRoot::sum(Element a, const Element& b) const {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

WithRoot::Element WithRoot::difference(Element a, const Element& b) const {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

WithRoot::Element WithRoot::slope() const {
  const std::size_t n = a_.size();
  Element result(n, Polynomial(leaves_.ring()));
  result[n - 1] = leaves_.ring().constant(static_cast<long>(n));
  for (std::size_t k = 1; k < n; ++k)
    result[n - 1 - k] = a_[k - 1].scaled(static_cast<long>(n - k));
  return reduced(std::move(result));
}

WithRoot::Element WithRoot::moved(const Polynomial& f) const {
  Element result;
  for (std::size_t k = a_.size(); k-- > 0;) result.push_back(-leaves_.bracket(a_[k], f));
  return reduced(std::move(result));
}

WithRoot::Element WithRoot::moved(const Element& e, const Polynomial& f) const {
  Element brackets, slope_of_e;
  for (std::size_t m = 0; m < e.size(); ++m) {
    brackets.push_back(leaves_.bracket(e[m], f));
    if (m > 0) slope_of_e.push_back(e[m].scaled(static_cast<long>(m)));
  }
  slope_of_e.emplace_back(leaves_.ring());
  return sum(product(slope(), brackets), product(slope_of_e, moved(f)));
}

}  // namespace casimir::structure

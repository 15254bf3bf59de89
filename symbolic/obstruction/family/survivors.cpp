#include "symbolic/obstruction/family/survivors.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

void insert(const Univariate& polynomial, std::vector<RealRoot>& list) {
  if (polynomial.degree() < 1) return;
  for (RealRoot& root : real_roots(polynomial))
    if (std::find(list.begin(), list.end(), root) == list.end()) list.push_back(std::move(root));
}

std::vector<RealRoot> cuts(const std::vector<RiemannFamily>& families) {
  std::vector<RealRoot> result;
  for (const RiemannFamily& family : families) {
    for (const Univariate& condition : family.conditions.polynomials()) insert(condition, result);
    for (const RationalFunction& square : family.squares) {
      insert(square.numerator(), result);
      insert(square.denominator(), result);
      insert(square.derivative().numerator(), result);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// A number between two others.
cln::cl_RA between(RealRoot low, RealRoot high) {
  while (!(low.interval().high < high.interval().low)) {
    low.refine();
    high.refine();
  }
  return (low.interval().high + high.interval().low) / 2;
}

std::vector<Cell> cells_of(const std::vector<RealRoot>& cuts) {
  if (cuts.empty()) return {{std::nullopt, std::nullopt, 0}};
  std::vector<Cell> result{{std::nullopt, cuts.front(), cuts.front().interval().low - 1}};
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    result.push_back({cuts[i], cuts[i + 1], between(cuts[i], cuts[i + 1])});
  result.push_back({cuts.back(), std::nullopt, cuts.back().interval().high + 1});
  return result;
}

/// Adds a number if no family excludes it.
void decide(const std::vector<RiemannFamily>& families, const RealRoot& c, Survivors& result) {
  std::string why;
  for (const RiemannFamily& family : families) {
    const KimuraAt at = kimura_at(family, c);
    if (!at.solvable) return;
    const std::string own = at.known ? at.condition : "an equation has another form there";
    if (why.find(own) == std::string::npos) why += (why.empty() ? "" : "; ") + own;
  }
  result.values.push_back({c, why});
}

bool contains(const Cell& cell, const RealRoot& c) {
  return (!cell.low || *cell.low < c) && (!cell.high || c < *cell.high);
}

/// The candidates of a family in the cell; empty where they may be infinitely many.
std::optional<std::vector<RealRoot>> inside(const RiemannFamily& family, const Cell& cell) {
  std::optional<std::vector<Univariate>> polynomials;
  try {
    polynomials = candidates(family, cell);
  } catch (const NotDecided&) {
    return std::nullopt;
  }
  if (!polynomials) return std::nullopt;
  std::vector<RealRoot> all, result;
  for (const Univariate& polynomial : *polynomials) insert(polynomial, all);
  for (RealRoot& root : all)
    if (contains(cell, root)) result.push_back(std::move(root));
  return result;
}

/// The cell, or its halves where those are more than it: one family may have finitely many solvable
/// members near one end and another one near the other end, and none on the whole. The number
/// between them is decided here.
std::vector<Cell> parts_of(const std::vector<RiemannFamily>& families, const Cell& cell,
                           Survivors& result) {
  const auto is_finite = [&](const Cell& own) {
    return std::ranges::any_of(
        families, [&](const RiemannFamily& family) { return inside(family, own).has_value(); });
  };
  if (families.size() == 1 || is_finite(cell)) return {cell};
  const RealRoot middle(cell.inside);
  const Cell low{cell.low, middle, cell.low ? between(*cell.low, middle) : cell.inside - 1};
  const Cell high{middle, cell.high, cell.high ? between(middle, *cell.high) : cell.inside + 1};
  if (!is_finite(low) || !is_finite(high)) return {cell};
  decide(families, middle, result);
  return {low, high};
}

/// \return  whether only sequences say what survives in the cell
bool decide(const std::vector<RiemannFamily>& families, const Cell& cell, Survivors& result) {
  std::optional<std::vector<RealRoot>> fewest;
  for (const RiemannFamily& family : families) {
    auto own = inside(family, cell);
    if (own && (!fewest || own->size() < fewest->size())) fewest = std::move(own);
    if (fewest && fewest->empty()) return false;
  }
  if (!fewest) return true;
  for (const RealRoot& c : *fewest) decide(families, c, result);
  return false;
}

SurvivingSequence sequence_on(const std::vector<RiemannFamily>& families, const Cell& cell,
                              const std::string& name) {
  SurvivingSequence result{cell.text(name), {}};
  for (const RiemannFamily& family : families) {
    const std::string own = condition_text(family, name);
    if (std::find(result.conditions.begin(), result.conditions.end(), own) ==
        result.conditions.end())
      result.conditions.push_back(own);
  }
  return result;
}

}  // namespace

Survivors survivors(const std::vector<RiemannFamily>& families, const std::string& name) {
  std::vector<RiemannFamily> telling;
  for (const RiemannFamily& family : families)
    if (!says_nothing(family)) telling.push_back(family);
  Survivors result;
  if (telling.empty()) return result;
  result.informative = true;
  const std::vector<RealRoot> all = cuts(telling);
  for (const RealRoot& cut : all) decide(telling, cut, result);
  std::optional<Cell> open;  // neighbouring cells with sequences, as one
  std::vector<Cell> cells;
  for (const Cell& cell : cells_of(all))
    for (Cell& part : parts_of(telling, cell, result)) cells.push_back(std::move(part));
  for (const Cell& cell : cells) {
    const bool infinite = decide(telling, cell, result);
    if (infinite && open)
      open->high = cell.high;
    else if (infinite)
      open = cell;
    if (!infinite || !cell.high) {
      if (open) result.sequences.push_back(sequence_on(telling, *open, name));
      open.reset();
    }
  }
  std::sort(result.values.begin(), result.values.end(),
            [](const auto& a, const auto& b) { return a.value < b.value; });
  return result;
}

}  // namespace casimir::obstruction

#include "tools/analysis/sweep/grid.hpp"

namespace casimir {

std::size_t Grid::points() const {
  std::size_t product = 1;
  for (const Axis& axis : axes) product *= axis.values.size();
  return product;
}

std::vector<double> Grid::at(std::size_t point) const {
  std::vector<double> values(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    values[i] = axes[i].values[point % axes[i].values.size()];
    point /= axes[i].values.size();
  }
  return values;
}

}  // namespace casimir

#include "runtime/interpreted_series.hpp"

namespace casimir {

std::function<ModuleFunctions::Integration> interpreted(const Program&, std::size_t) {
  return {};
}

}  // namespace casimir

// The Poincare section of a report.
#include "tools/report/pictures.hpp"

namespace casimir::tools {

std::string section_svg(const CaseFile&, const Model&, const Scene&, const std::string&) {
  return {};
}

}  // namespace casimir::tools

#pragma once

#include <string>
#include <vector>

#include "symbolic/case_file.hpp"
#include "tools/report/findings.hpp"

namespace casimir::tools {

/// The pictures of a report as SVG elements (see page_svg). Empty: there is none.
struct Pictures {
  std::string motion, sphere, apex, drift, work_precision, section;
  std::string problem;       ///< why none could be drawn
  std::string section_note;  ///< why there is no section although the case has one
};

/// \param beside  the page; temporary files stand beside it
Pictures draw_pictures(const CaseFile& file, const Model& model, const Findings& findings,
                       const std::string& beside);

/// The Poincare section of a case that has one: a page_svg called `section`, or empty.
/// \throws SystemError  where it cannot be drawn, and what `section` throws
std::string section_svg(const CaseFile& file, const Model& model, const Scene& scene,
                        const std::string& beside);

}  // namespace casimir::tools

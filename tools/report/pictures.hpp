#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/case_file.hpp"
#include "tools/report/findings.hpp"
#include "tools/report/live_system.hpp"

namespace casimir::tools {

/// The pictures of a report as SVG elements (see page_svg). Empty: there is none.
struct Pictures {
  std::string motion, sphere, apex, drift, work_precision, section;
  std::string problem;  ///< why none could be drawn
  std::string section_caption;
  std::string section_note;  ///< why there is no section although the case has one
  std::string thumbnail;     ///< one of them, small
  std::optional<DrawnSection> drawn_section;
};

/// \param beside  the page; temporary files stand beside it
Pictures draw_pictures(const CaseFile& file, const Model& model, const Findings& findings,
                       const std::string& beside);

/// Draws the Poincare section of a case that has one, and keeps what it is made of.
/// \throws what `section` throws
void cut_section(const CaseFile& file, const Model& model, const Scene& scene, Pictures& pictures);

}  // namespace casimir::tools

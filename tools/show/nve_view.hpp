#pragma once

#include <string>
#include <vector>

#include "symbolic/obstruction/obstruct.hpp"
#include "tools/show/system_view.hpp"

namespace casimir::tools {

/// A curve of motion and its normal variational equation, for a terminal and for paper.
struct NveView {
  std::string along, level;
  std::vector<Formula> formulas;  ///< of the curve, then the equation and its reduced form
  std::string nve;                ///< in words, where there are no formulas of it
  std::string outcome;            ///< what is known of its Galois group
};

/// Of everything that was examined.
std::vector<NveView> nve_views(const Model& model, const obstruction::Obstruction& answer);

/// The document of `show --nve --json`, and the same for people. The time that is given runs out
/// where an answer would come later: what was found until then is not shown.
/// {
nlohmann::ordered_json nve_json(const Model& model, const obstruction::Obstruction& answer);
void nve_text(const Model& model, const obstruction::Obstruction& answer);
void nve_latex(const Model& model, const obstruction::Obstruction& answer);
/// }

}  // namespace casimir::tools

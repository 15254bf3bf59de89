#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/model.hpp"
#include "tools/show/notation.hpp"

namespace casimir::tools {

/// Of an equation that is multiplied out: nobody reads more.
inline constexpr double kMostTermsShown = 5000;

/// left = right, where the functions `on` vanish.
struct Formula {
  Written left, right;
  std::vector<Written> on = {};
};

/// Claims of one kind, constraints, or matrices that belong together.
struct FormulaGroup {
  std::string title;
  std::vector<Formula> formulas;
};

using WrittenMatrix = std::vector<std::vector<Written>>;

struct LaxView {
  std::optional<Written> spectral;  ///< the spectral parameter
  WrittenMatrix l, a;
  std::vector<Written> on;  ///< the functions whose zero level it is one on
};

/// What `show` tells of a system. What a case does not have is empty.
struct SystemView {
  std::vector<Written> variables;
  std::vector<VectorEntries> vectors;
  std::vector<Formula> vector_brackets;  ///< the non-zero ones in the shorthand: {M_i, g_j} = ..
  std::vector<Formula> zero_brackets;    ///< {g_i, g_j} = 0
  WrittenMatrix structure_matrix;        ///< {x_i, x_j}
  std::vector<Formula> brackets;         ///< the non-zero entries of its upper half
  std::optional<Written> hamiltonian;
  std::vector<Formula> vector_equations;  ///< dM/dt = M x dH/dM + ..
  std::vector<Formula> gradients;         ///< dH/dM = (..), of those that occur there
  std::vector<Formula> equations;         ///< in components
  std::vector<Formula> map;               ///< x' = .., of a map
  std::vector<FormulaGroup> claims;
  std::vector<LaxView> lax_pairs;
};

SystemView view_of(const Model& model, Notation& notation);

/// The same for the case of a map, whose base the notation is of.
SystemView view_of(const MapModel& map, Notation& notation);

/// The texts of formulas, and their trees.
/// {
std::vector<std::string> texts(const std::vector<Written>& list);
std::vector<typeset::Math> maths(const std::vector<Written>& list);
std::vector<std::vector<std::string>> texts(const WrittenMatrix& matrix);
typeset::MathMatrix maths(const WrittenMatrix& matrix);
/// }

/// The rank of the bracket on the generic leaf.
struct RankView {
  std::string name;                 ///< "rank 4"
  std::string evidence;             ///< or why it is not known
  std::optional<std::size_t> rank;  ///< where it is proved
};

/// None for a system without a bracket.
std::optional<RankView> rank_of(const Model& model);

}  // namespace casimir::tools

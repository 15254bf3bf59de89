#pragma once

#include <functional>
#include <string>

#include "codegen/dag/expression_dag.hpp"
#include "tools/typeset/math.hpp"

namespace casimir::tools::typeset {

/// An expression as people write it: parameters before coordinates, roots as roots, quotients as
/// fractions, sin^2(x).
/// \param names  how a symbol is written, by its name.
Math math(const codegen::Dag& dag, const codegen::Scaled& expression,
          const std::function<Math(const std::string&)>& names = name);

}  // namespace casimir::tools::typeset

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/case_file.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/frame.hpp"
#include "symbolic/poisson.hpp"

namespace casimir {

/// The symbols for the variables of a phase space, names checked.
/// \throws CaseError  for a name that cannot be used, and for more of them than the limit
std::vector<GiNaC::symbol> make_variables(const PhaseSpaceText& text, const Limits& limits);

/// The frame that the phase space names; none if it is given in another way.
std::optional<Frame> make_frame(const PhaseSpaceText& text,
                                const std::vector<GiNaC::symbol>& variables,
                                const std::vector<GiNaC::symbol>& parameters, Scope& names);

/// The bracket that the phase space names, over `variables`; none if it gives no bracket.
/// \param frame  as `make_frame` gave it
/// \param domain becomes what the brackets are defined by, as of NamedExpression; may be null
/// `names` must know the variables and whatever else the brackets may use.
/// Where the file says `dirac`, it is the Dirac bracket of the constraints that is returned.
/// \throws CaseError  for more than one form, an unknown algebra, a wrong number of variables, a
///                    bracket that is not skew, or one that is not linear where it has to be.
std::optional<PoissonStructure> make_bracket(const PhaseSpaceText& text,
                                             const std::vector<GiNaC::symbol>& variables,
                                             Scope& names, const std::optional<Frame>& frame,
                                             std::vector<GiNaC::ex>* domain = nullptr);

/// "e(3)", "canonical", "brackets", "structure constants", "frame" or "equations"; and what is made
/// of it.
std::string describe(const PhaseSpaceText& text);

}  // namespace casimir

#pragma once

#include "symbolic/case/case_names.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// Reads what a case file claims, the Casimir functions and integrals before all else since the
/// others may name them, and the section.
/// \param names  those of the case; gets the names of its functions.
/// \param model  has names, assumptions, bracket and equations; gets the claims.
/// \throws CaseError  for what cannot be read or needs a bracket that is not there.
void read_claims(const CaseFile& file, const FindCase& find_case, CaseNames& names, Model& model);

}  // namespace casimir

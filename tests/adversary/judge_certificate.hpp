#pragma once

#include <string>

#include "symbolic/model.hpp"
#include "tests/adversary/case.hpp"
#include "tests/adversary/judge.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// Reads the certificate of a case back: its bracket, its Hamiltonian and its functions have the
/// values and derivatives of those of the case, and for each claim that is proved there is a
/// theorem about them, or the certificate says that it has none.
Outcome judge_certificate(const Case& claim, const Model& model, Random& random, std::string& what);

}  // namespace casimir::adversary

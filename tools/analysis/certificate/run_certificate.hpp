#pragma once

#include <cln/rational.h>

#include <functional>
#include <string>
#include <vector>

#include "runtime/trace_check.hpp"
#include "symbolic/case/limits.hpp"
#include "tools/analysis/run/validated.hpp"

namespace casimir {

/// A run that others can verify: what was enclosed, and every step.
struct RunCertificate {
  std::string of_case;  ///< what the equations were called
  std::string scene;    ///< what the start was called
  /// The text of a case file with nothing in it but the variables, `[equations]`, `[integrals]`
  /// that made the sets smaller, and one scene: start and duration.
  std::string equations;
  std::vector<cln::cl_RA> radii;  ///< by how much each initial value may be off; empty: by nothing
  RunTrace trace;                 ///< every step of the run
  Limits limits{};                ///< under which the equations are read: no part of a file
};

/// The equations of a certificate as a model. \throws CaseError  for a text with anything else in it.
Model model_of_certificate(const RunCertificate& certificate);

/// Whether something was simplified away that need not have a value, as sqrt(x)^2 or 0*log(x), in
/// the equations, the integrals or a plane: then nothing is proved of what is written.
bool has_lost_parts(const Model& model, const std::string& plane);

/// What came of a certificate.
struct CheckedCertificate {
  TraceCheck check;                ///< of the steps
  std::string unproved;            ///< an integral that is not proved to be one; nothing is checked
  std::vector<std::string> names;  ///< of the states
  std::vector<std::string> integrals;  ///< that were proved anew
  GiNaC::ex duration;                  ///< after which the box is that of the end
  cln::cl_RA radius = 0;               ///< the largest half width of the box at the end
  /// Whether all that it says is proved.
  bool holds() const { return unproved.empty() && check.fault == TraceFault::none; }
};

/// Verifies a certificate: proves its integrals anew, and every step by `check_trace`. It rests on
/// the reader of case files and exact algebra, the prover for the integrals, and Arb.
/// \throws CaseError, ModelError  where the equations cannot be read.
/// \param give_up  asked before each step; true ends the check.
CheckedCertificate check_certificate(const RunCertificate& certificate,
                                     const std::function<bool()>& give_up = {});

}  // namespace casimir

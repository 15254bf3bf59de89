#pragma once

#include "symbolic/model.hpp"
#include "tools/analysis/certificate/run_certificate.hpp"
#include "tools/analysis/run/validated.hpp"

namespace casimir::tools {

/// Encloses the solutions of a scene as `enclose` does, and keeps every step in a certificate. What
/// is enclosed is what the certificate says, in its own words, so that it is that which is proved:
/// an integral that needs what the case assumes of its variables is left out, with a doubt. That
/// others can verify it is for `check_certificate` to say.
ValidatedMotion certified_motion(const Model& model, const Scene& given,
                                 const ValidatedOptions& asked, RunCertificate& certificate);

}  // namespace casimir::tools

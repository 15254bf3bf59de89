#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "tools/analysis/certificate/cycle_certificate.hpp"
#include "tools/analysis/certificate/horseshoe_certificate.hpp"
#include "tools/analysis/certificate/run_certificate.hpp"

namespace casimir {

/// What a file of certificates is of: one run, cycles, or a horseshoe.
struct CertificateFile {
  std::optional<RunCertificate> run;              ///< none: it is of something else
  std::optional<HorseshoeCertificate> horseshoe;  ///< the same
  std::vector<CycleCertificate> cycles;           ///< at least one, where it is of neither
};

/// A certificate as a file: JSON, with a line for each step and a digest (BLAKE2b, 32 bytes) of
/// everything before it, so that what was changed on its way is told from what is false.
std::string certificate_text(const RunCertificate& certificate);
/// The same of some cycles.
std::string certificate_text(const std::vector<CycleCertificate>& cycles);

/// The same of a horseshoe.
std::string certificate_text(const HorseshoeCertificate& certificate);

/// The end of a file of a certificate: `text` with its digest.
std::string with_digest(const std::string& text);

/// Reads such a file. It comes from a stranger: the size, the depth, every key and every number are
/// checked. That it is well formed says nothing of its truth.
/// \param file  names it in messages.
/// \param limits  of its numbers and equations
/// \throws CaseError  for what is malformed, with the place and what was expected.
CertificateFile read_certificate(const std::string& text, const std::string& file,
                                 const Limits& limits = {});

}  // namespace casimir

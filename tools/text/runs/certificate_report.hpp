#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/analysis/certificate/run_certificate.hpp"

namespace casimir::tools {

/// A certificate that was looked through, and what came of it.
struct CertificateReport {
  const RunCertificate& certificate;
  const CheckedCertificate& checked;
  double seconds = 0;  ///< that the check took, without reading

  /// Why it does not hold: a sentence, or nothing.
  std::string reason() const;
};

nlohmann::ordered_json to_json(const CertificateReport& report);
void print_text(const CertificateReport& report);

}  // namespace casimir::tools

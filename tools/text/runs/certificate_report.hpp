#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/analysis/certificate/cycle_certificate.hpp"
#include "tools/analysis/certificate/horseshoe_certificate.hpp"
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

/// The same of cycles.
struct CyclesReport {
  const std::vector<CycleCertificate>& certificates;
  std::vector<CheckedCycle> checked;  ///< one for each
  double seconds = 0;                 ///< that the check took, without reading

  /// Whether all of them are proved.
  bool holds() const;
};

nlohmann::ordered_json to_json(const CyclesReport& report);
void print_text(const CyclesReport& report);

/// The same of a horseshoe.
struct CheckedHorseshoeReport {
  const HorseshoeCertificate& certificate;
  const CheckedHorseshoe& checked;
  double seconds = 0;  ///< that the check took, without reading
};

nlohmann::ordered_json to_json(const CheckedHorseshoeReport& report);
void print_text(const CheckedHorseshoeReport& report);

}  // namespace casimir::tools

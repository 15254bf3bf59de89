#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/run_trace.hpp"
#include "runtime/validated_run.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {

struct Horseshoe;

/// An h-set (see horseshoe::HSet): a parallelogram on the surface and the level, by numbers as of a
/// RunTrace, all of which are doubles.
struct CertifiedSet {
  std::string name;                 ///< for messages
  std::vector<std::string> centre;  ///< one number for each state
  std::vector<std::string> frame;   ///< row after row; the first two columns span the parallelogram
  std::vector<std::string> sheet;   ///< half widths along the other columns
};

/// Chaos that others can verify: h-sets and which of them cover which.
struct HorseshoeCertificate {
  std::string of_case;  ///< what the equations were called
  /// As of RunCertificate; the integrals fix the level.
  std::string equations;
  std::string plane;  ///< s, an expression over the variables; it counts where it increases
  /// For each integral the ends of the interval of its values: numbers as of a RunTrace.
  std::vector<std::array<std::string, 2>> levels;
  std::vector<CertifiedSet> sets;
  std::vector<std::pair<int, int>> coverings;  ///< from which set to which
  Limits limits{};  ///< under which the equations are read: no part of a file
};

/// What came of the certificate of a horseshoe.
struct CheckedHorseshoe {
  std::string reason;                    ///< why it is not proved: a sentence; empty where it is
  bool stopped = false;                  ///< `give_up` said so
  cln::cl_RA entropy = 0;                ///< that of the return map is not below it
  std::size_t parts = 0;                 ///< images that were enclosed
  std::vector<std::string> level_names;  ///< the integrals, proved again to be constant
  std::vector<RationalInterval> levels;  ///< of their values
  /// Whether the theorem of horseshoe.hpp is proved, with this entropy.
  bool holds() const { return reason.empty(); }
};

/// The certificate of what was proved.
/// \param equations  a text as of the certificate, whose integrals are those of the level.
/// \param plane      s, such that it increases where it counts.
/// \param limits     of the case that it is of.
HorseshoeCertificate certificate_of(const Horseshoe& proof, const std::string& of_case,
                                    const std::string& equations, const std::string& plane,
                                    const Limits& limits = {});

/// Verifies a certificate: each hypothesis of the theorem of horseshoe.hpp is proved again. Nothing
/// but the equations, the surface, the numbers of the h-sets and the arrows is taken from it, and
/// these are what the theorem is about. All is computed in Arb's balls, of 96 bits: that the
/// functions of the level are constant (by the prover), that the sets lie on surface and level,
/// that they are disjoint, that flow and first returns of all their points are enclosed, and that
/// they cover one another. So it rests on Arb and on exact algebra, and not on the arithmetic in
/// doubles; how sets are divided and followed (Lohner's method) is the same as where it was found.
/// \param give_up  asked before each part of a set; true ends the check.
/// \throws CaseError, ModelError  where the equations cannot be read.
CheckedHorseshoe check_horseshoe(const HorseshoeCertificate& certificate,
                                 const std::function<bool()>& give_up = {});

}  // namespace casimir

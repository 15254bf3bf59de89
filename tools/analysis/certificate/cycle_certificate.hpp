#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/run_trace.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/section/validated_cycles.hpp"

namespace casimir {

/// A periodic orbit whose existence others can verify. With the flow phi, the unknowns are a point
/// x and a time T; the equations are s(x) = 0, I_a(x) = c_a, and (phi_T(x) - x)_i = 0 for the
/// closing coordinates i. The numbers are texts as in a RunTrace.
struct CycleCertificate {
  std::string of_case;  ///< what the equations were called
  /// As of RunCertificate; the integrals are the I_a, and start and duration the middle of the box.
  std::string equations;
  std::string plane;                 ///< s, an expression over the variables
  std::vector<std::string> levels;   ///< c_a; all levels within 2^-52 of their size are meant
  std::vector<int> closing;          ///< the coordinates i, as many as are missing
  std::string radius;                ///< of the box, in each coordinate and the time
  std::vector<std::string> inverse;  ///< an approximate inverse of the derivatives, row after row
  /// Of x' = T f(x), T' = 0 over a unit of time: from the middle, and from the box.
  RunTrace point, box;
  Limits limits{};  ///< under which the equations are read: no part of a file
};

/// What came of the certificate of a cycle.
struct CheckedCycle {
  std::string reason;    ///< why it is not proved: a sentence; empty where it is
  bool stopped = false;  ///< that is why: nothing is said of the rest
  /// Exactly one point of the box, with exactly one time, solves the equations; it is within these.
  std::vector<RationalInterval> state;
  RationalInterval period{0, 0};   ///< after which the orbit is at its start again
  std::vector<std::string> names;  ///< of the states
  /// The functions of the level, and their values: it is proved for each value of these intervals.
  std::vector<std::string> level_names;
  std::vector<RationalInterval> levels;
  /// Whether it is proved.
  bool holds() const { return reason.empty(); }
};

/// Verifies the certificate of a cycle: proves that the I_a are integrals, both runs by
/// `check_trace`, which encloses the derivatives of the flow too, and Krawczyk's test with them.
/// That the orbit closes in the other coordinates too follows from the mean value theorem, where
/// the derivatives of the I_a by them are a regular matrix over the hull of start and end.
/// \param give_up  asked before each step; true ends the check.
/// \throws CaseError, ModelError  where the equations cannot be read.
CheckedCycle check_cycle(const CycleCertificate& certificate,
                         const std::function<bool()>& give_up = {});

/// Makes a certificate of a cycle that was found, and checks it. Nothing where it does not hold.
/// \param equations  as of the certificate, with the start near the orbit and about its period.
/// \param levels     one for each integral of the equations.
/// \param limits     of the case that it is of.
std::optional<CycleCertificate> certify_cycle(const std::string& of_case,
                                              const std::string& equations,
                                              const std::string& plane,
                                              const std::vector<double>& levels,
                                              const Limits& limits = {});

}  // namespace casimir

#pragma once

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "runtime/integrate.hpp"

namespace casimir::tools {

/// One row of `conserve`, `bench` and `stress`.
struct Row {
  std::string case_name, scene, method;
  std::string code = "specialised";  ///< or "general": parameters at run time, nothing left out
  double tolerance = 0;
  double error = std::numeric_limits<double>::quiet_NaN();  ///< not a number: there is no reference
  double drift = 0;
  double seconds = 0;
  double spread = 0;  ///< half the distance of the quartiles of repeated runs
  int rounds = 1;     ///< in which the time was taken; 0: it is that of a run that did not arrive
  unsigned long long steps = 0, evaluations = 0;
  std::string status = "ok";  ///< a Status, "wrong", "too_slow", or "refused"
  std::string reason = {};    ///< a sentence, where the status needs one
  bool refused = false;       ///< it did not arrive, and may do so
  bool failed = false;        ///< the command fails because of it
};

/// {"rows": [..], "failed": N}.
nlohmann::ordered_json to_json(const std::vector<Row>& rows);

/// The same columns as CSV.
void write_csv(std::ostream& stream, const std::vector<Row>& rows);

/// A table for people. Case and scene stand in lines of their own.
std::string to_text(const std::vector<Row>& rows, bool with_error);

/// What a user may do about a run that stopped early; empty where there is nothing.
std::string advice(Status status);

/// 17 significant digits: reads back as the same double.
std::string exact_text(double value);

/// The same for a number that may be beyond the range of double.
std::string exact_text(long double value);

/// A CSV field: quoted where it has to be.
std::string csv_field(const std::string& text);

/// "12.3 us", "4.5 ms", "1.2 s".
std::string duration_text(double seconds);

}  // namespace casimir::tools

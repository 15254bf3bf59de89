#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "runtime/integrate.hpp"
#include "tools/analysis/proof/exact_text.hpp"
#include "tools/analysis/row.hpp"

namespace casimir::tools {

/// "ok", "wrong", "drift above 1e-09", ..: what became of a row, as the interface spells it.
std::string status_text(const Row& row);

/// {"rows": [..], "failed": N}.
nlohmann::ordered_json to_json(const std::vector<Row>& rows);

/// A table for people. Case and scene stand in lines of their own.
std::string to_text(const std::vector<Row>& rows, bool with_error);

/// "2 of 3 runs keep every invariant to 1e-09; 1 did not arrive".
/// \param bound  of the drift, beside the size of an invariant
std::string conservation_sentence(const std::vector<Row>& rows, double bound);

/// What a user may do about a run that stopped early; empty where there is nothing.
std::string advice(Status status);

/// A CSV field: quoted where it has to be.
std::string csv_field(const std::string& text);

/// "12.3 us", "4.5 ms", "1.2 s".
std::string duration_text(double seconds);

}  // namespace casimir::tools

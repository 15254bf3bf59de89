#pragma once

#include <vector>

#include "tools/analysis/row.hpp"
#include "tools/tables/table.hpp"

namespace casimir::tools {

/// Measured runs as a table, with the columns of their JSON; what there is no reference for has no
/// error.
Table table_of(const std::vector<Row>& rows);

}  // namespace casimir::tools

#include "tools/text/runs/row_table.hpp"

#include <cmath>

#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {

Table table_of(const std::vector<Row>& rows) {
  const auto column = [&](const auto& of) {
    std::vector<std::decay_t<decltype(of(rows.front()))>> cells;
    for (const Row& row : rows) cells.push_back(of(row));
    return cells;
  };
  const auto present = [](double value) {
    return std::isnan(value) ? std::optional<double>() : std::optional<double>(value);
  };
  const auto whole = [](auto value) { return static_cast<std::int64_t>(value); };
  return {{{"case", column([](const Row& row) { return row.case_name; })},
           {"scene", column([](const Row& row) { return row.scene; })},
           {"method", column([](const Row& row) { return row.method; })},
           {"code", column([](const Row& row) { return row.code; })},
           {"tolerance", column([](const Row& row) { return row.tolerance; }), {}, "{:g}"},
           {"error", column([&](const Row& row) { return present(row.error); })},
           {"drift", column([&](const Row& row) { return present(row.drift); })},
           {"seconds", column([](const Row& row) { return row.seconds; }), {}, "{:.6g}"},
           {"spread", column([](const Row& row) { return row.spread; }), {}, "{:.3g}"},
           {"rounds", column([&](const Row& row) { return whole(row.rounds); })},
           {"steps", column([&](const Row& row) { return whole(row.steps); })},
           {"evaluations", column([&](const Row& row) { return whole(row.evaluations); })},
           {"status", column([](const Row& row) { return status_text(row); })}}};
}

}  // namespace casimir::tools

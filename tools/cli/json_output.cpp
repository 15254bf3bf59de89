#include "tools/cli/json_output.hpp"

#include <iostream>

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Grows where a key is taken away or changes its meaning; new keys leave it as it is.
constexpr int kSchema = 1;

/// What strangers wrote may be no UTF-8, which JSON has to be.
std::string clean(const std::string& text) { return printable(text, text.size()); }

}  // namespace

std::string json_text(const Json& document) {
  Json versioned{{"schema", kSchema}};
  versioned.update(document);
  return versioned.dump(2) + '\n';
}

void print_json(const Json& document) { std::cout << json_text(document); }

Json error_json(const std::string& text) { return {{"error", {{"text", clean(flat(text))}}}}; }

Json error_json(const CaseError& problem) {
  Json error{{"text", clean(flat(problem.text()))}, {"file", clean(problem.where().file)}};
  if (problem.where().line > 0) {
    error["line"] = problem.where().line;
    error["column"] = problem.where().column;
  }
  if (!problem.hint().empty()) error["hint"] = clean(flat(problem.hint()));
  return {{"error", error}};
}

}  // namespace casimir::tools

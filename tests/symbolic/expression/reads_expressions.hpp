#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <map>
#include <string>
#include <utility>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir::test {

/// Column and text of the error that `action` throws, or "accepted".
template <class Action>
std::string error_in(const Action& action) {
  try {
    action();
  } catch (const CaseError& error) {
    return std::to_string(error.where().column) + ": " + error.text();
  }
  return "accepted";
}

/// Reads expressions over names that a test declares.
class ReadsExpressions : public testing::Test {
 protected:
  ReadsExpressions(std::initializer_list<const char*> names) {
    for (const char* name : names) declare(name);
  }
  void declare(const std::string& name) { names_.add(name, Quantity::symbol(symbol(name))); }
  const GiNaC::symbol& symbol(const std::string& name) {
    return symbols_.try_emplace(name, name).first->second;
  }
  GiNaC::ex parse(const std::string& text) {
    return parse_expression({text, {"test", 1, 1}, text}, names_).value;
  }
  std::string error_of(const std::string& text) {
    return error_in([&] { parse(text); });
  }

  /// Each text has an error that begins like this, with its column.
  template <std::size_t N>
  void expect_errors(const std::pair<const char*, const char*> (&wrong)[N]) {
    for (const auto& [text, message] : wrong)
      EXPECT_TRUE(error_of(text).starts_with(message)) << text << ": " << error_of(text);
  }

  std::map<std::string, GiNaC::symbol> symbols_;
  NameTable names_{Limits{}};
};

}  // namespace casimir::test

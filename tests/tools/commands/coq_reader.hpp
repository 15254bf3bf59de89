#pragma once

#include <ginac/ginac.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace casimir::test {

/// What a certificate states, read by code of its own: functions of rational polynomials, and
/// equations between them. Anything else that stands in the file is an error.
class CoqReader {
 public:
  /// \throws std::runtime_error  for a sentence that is neither a definition nor a statement with
  ///                             the one proof that certificates use.
  explicit CoqReader(const std::string& text);

  struct Statement {
    std::vector<std::string> variables;
    std::string left, right;
  };

  const std::vector<std::string>& theorems() const { return theorems_; }
  const std::vector<std::string>& lemmas() const { return lemmas_; }
  const std::map<std::string, Statement>& statements() const { return statements_; }
  bool defines(const std::string& function) const { return functions_.contains(function); }

  /// The function at these arguments.
  GiNaC::ex value(const std::string& function, const std::vector<GiNaC::ex>& arguments) const;

  using Names = std::map<std::string, GiNaC::ex>;
  /// An expression of the file, expanded, where the functions `zero` that it calls are zero.
  GiNaC::ex value(const std::string& expression, const Names& names,
                  const std::set<std::string>& zero = {}) const;

 private:
  struct Function {
    std::vector<std::string> parameters;
    std::string body;
  };
  class Parser;
  void read_sentence(const std::string& sentence);

  std::map<std::string, Function> functions_;
  std::map<std::string, Statement> statements_;
  std::vector<std::string> theorems_, lemmas_;
};

}  // namespace casimir::test

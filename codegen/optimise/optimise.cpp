#include "codegen/optimise/optimise.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "codegen/dag/program_to_dag.hpp"
#include "codegen/dag/vanishing.hpp"
#include "codegen/optimise/factor.hpp"
#include "codegen/optimise/terms.hpp"

namespace casimir::codegen {

namespace {

// An expansion that is much longer than what it expands loses, and takes long to lose.
constexpr std::size_t kAlwaysTried = 150;
constexpr std::size_t kMostTermsOfASystem = 1500;
constexpr std::size_t kMostGrowth = 4;
// Longer sums are not looked for in an expansion.
constexpr std::size_t kMostTermsOfSum = 30;
// Of long systems only the best bet is factored.
constexpr std::size_t kLong = 400;

std::size_t term_count(const TermSystem& system) {
  std::size_t result = 0;
  for (const Variable& v : system.variables) result += v.value.size();
  return result;
}

/// Tells systems apart that define different things or have their terms in another order, which
/// decides what is factored first.
class Signatures {
 public:
  /// Whether a system with the same definitions was here before.
  bool seen(const TermSystem& system) {
    of_variable_.assign(system.variables.size(), -1);
    std::vector<int> definitions;
    for (const int output : system.outputs) definitions.push_back(of(system, output));
    // Sums that no output needs any more count too: they lead the factoring.
    for (std::size_t v = 0; v < system.variables.size(); ++v)
      definitions.push_back(of(system, static_cast<int>(v)));
    std::sort(definitions.begin() + static_cast<std::ptrdiff_t>(system.outputs.size()),
              definitions.end());
    return !systems_.insert(definitions).second;
  }

 private:
  /// Numbers that say what a variable is, and the rationals in it.
  using Definition = std::pair<std::vector<int>, std::vector<cln::cl_RA>>;

  int of(const TermSystem& system, int variable) {
    const auto v = static_cast<std::size_t>(variable);
    if (of_variable_[v] < 0) {
      Definition definition = definition_of(system, system.variables[v]);
      of_variable_[v] =
          known_.try_emplace(std::move(definition), static_cast<int>(known_.size())).first->second;
    }
    return of_variable_[v];
  }

  Definition definition_of(const TermSystem& system, const Variable& v) {
    Definition result{{static_cast<int>(v.kind), v.input, static_cast<int>(v.function)},
                      {v.exponent}};
    for (const int argument : v.arguments) result.first.push_back(of(system, argument));
    for (const Term& t : v.value) {
      std::vector<std::pair<int, int>> monomial;
      for (const VariablePower& l : t.monomial)
        monomial.emplace_back(of(system, l.variable), l.exponent);
      std::ranges::sort(monomial);
      result.first.push_back(static_cast<int>(monomial.size()));
      for (const auto& [base, exponent] : monomial)
        result.first.insert(result.first.end(), {base, exponent});
      result.second.push_back(t.coefficient);
    }
    return result;
  }

  std::map<Definition, int> known_;
  std::set<std::vector<int>> systems_;
  std::vector<int> of_variable_;
};

/// The cheapest of the programs considered, of those whose numbers doubles have if there are any;
/// of equals the first.
class Choice {
 public:
  Choice(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs)
      : inputs_(inputs), outputs_(outputs) {}

  void consider(Program candidate) {
    const std::pair cost(std::ranges::any_of(candidate.constants, beyond_range),
                         weight(count_operations(candidate)));
    if (best_ && cost >= least_) return;
    best_ = std::move(candidate);
    least_ = cost;
  }

  /// The structure of the expressions and, while it is not too long, their expansion.
  void consider_forms_of(const Dag& dag, const std::vector<Scaled>& expressions) {
    const TermSystem structural = within_range(system_of(dag, inputs_.size(), expressions));
    consider_factored(structural);
    consider(structural);
    const std::size_t limit =
        std::min(kMostTermsOfASystem, std::max(kAlwaysTried, kMostGrowth * term_count(structural)));
    const auto expansion = expanded(structural, limit);
    if (!expansion) return;
    const TermSystem joined = with_squares_joined(*expansion);
    const TermSystem folded = with_sums_taken_out(joined, kMostTermsOfSum);
    consider_factored(folded);
    // It loses digits where the sum is small.
    if (!has_power_of_sum(folded)) consider_factored(joined);
  }

  Program best() const { return without_dead_code(*best_); }

 private:
  void consider(const TermSystem& system) {
    consider(lowered(flattened(system), inputs_, outputs_));
    consider(lowered(flattened(rescaled(system)), inputs_, outputs_));
  }

  void consider_factored(const TermSystem& system) {
    if (signatures_.seen(system)) return;
    consider(factored(system, Preference::best));
    if (term_count(system) > kLong) return;
    consider(factored(system, Preference::sums));
    consider(factored(system, Preference::products));
  }

  const std::vector<std::string>& inputs_;
  const std::vector<std::string>& outputs_;
  Signatures signatures_;
  std::optional<Program> best_;
  std::pair<bool, int> least_;  ///< numbers that doubles do not have, and operations
};

bool same(const std::vector<Scaled>& a, const std::vector<Scaled>& b) {
  return std::ranges::equal(a, b, [](const Scaled& s, const Scaled& t) {
    return s.node == t.node && s.coefficient == t.coefficient;
  });
}

}  // namespace

Program optimised(const Dag& dag, const std::vector<Scaled>& expressions,
                  const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  Choice choice(inputs, outputs);
  choice.consider_forms_of(dag, expressions);
  return choice.best();
}

Program optimised(Dag& dag, const std::vector<Program>& programs) {
  Choice choice(programs.front().inputs, programs.front().output_names);
  std::vector<std::vector<Scaled>> seen;
  for (const Program& program : programs) {
    std::vector<Scaled> expressions = lifted(dag, program);
    if (std::ranges::none_of(seen, [&](const auto& other) { return same(expressions, other); })) {
      choice.consider_forms_of(dag, expressions);
      seen.push_back(std::move(expressions));
    }
  }
  for (const Program& program : programs) choice.consider(program);
  return choice.best();
}

SparseProgram optimised(Dag& dag, const std::vector<SparseProgram>& programs) {
  std::map<std::pair<int, int>, std::size_t> nonzero;  // in how many of the programs
  for (const SparseProgram& matrix : programs) {
    const std::vector<Scaled> values = lifted(dag, matrix.program);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (!vanishes(dag, values[k], matrix.program.inputs.size())) ++nonzero[matrix.entries[k]];
    }
  }
  SparseProgram result;
  std::vector<Program> parts;
  for (const SparseProgram& matrix : programs) {
    result.entries.clear();
    Program part = matrix.program;
    part.outputs.clear();
    part.output_names.clear();
    for (std::size_t k = 0; k < matrix.entries.size(); ++k) {
      if (nonzero[matrix.entries[k]] < programs.size()) continue;
      result.entries.push_back(matrix.entries[k]);
      part.outputs.push_back(matrix.program.outputs[k]);
      part.output_names.push_back(matrix.program.output_names[k]);
    }
    parts.push_back(without_dead_code(part));
  }
  result.program = optimised(dag, parts);
  return result;
}

}  // namespace casimir::codegen

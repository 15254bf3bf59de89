// The systems from which `casimir new` lets a user start.
#include "tools/runs/new_case.hpp"

#include <cln/rational_io.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/model/invariant_forms.hpp"

namespace casimir::tools {
namespace {

cln::cl_RA ratio(long numerator, long denominator) {
  return cln::cl_RA(numerator) / cln::cl_RA(denominator);
}

/// Variables with one letter, such as M1, M2, M3.
struct BracketBlock {
  std::string letters;
  std::size_t start = 0, size = 0;
  bool commutes = true;  ///< with itself
};

std::string letters_of(const std::string& name) {
  return name.substr(0, name.find_first_of("0123456789"));
}

std::vector<BracketBlock> blocks_of(const LieAlgebra& algebra,
                                    const std::vector<std::string>& names) {
  std::vector<BracketBlock> blocks;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (blocks.empty() || blocks.back().letters != letters_of(names[i]))
      blocks.push_back({letters_of(names[i]), i, 0});
    ++blocks.back().size;
  }
  for (BracketBlock& block : blocks) {
    const auto inside = [&](std::size_t i) {
      return i >= block.start && i < block.start + block.size;
    };
    block.commutes = std::ranges::none_of(
        algebra.constants, [&](const auto& c) { return inside(c.i) && inside(c.j); });
  }
  return blocks;
}

/// Builds the Hamiltonian term by term, with the parameters that it needs.
class TopBuilder {
 public:
  explicit TopBuilder(const LieAlgebra& algebra) {
    std::istringstream order(algebra.order);
    for (std::string name; order >> name;) names_.push_back(name);
    blocks_ = blocks_of(algebra, names_);
    result_.phase_space = fmt::format("algebra = \"{}\"", algebra.name);
  }

  NewCase build() {
    if (blocks_.front().size == 1) {
      squares({"", 0, names_.size()}, "a");
      result_.about = "A positive quadratic form.";
    } else {
      kinetic(blocks_.front());
      for (std::size_t b = 1; b < blocks_.size(); ++b) further(blocks_[b], b);
      result_.about = "Kinetic energy" + about_the_rest() + ".";
    }
    std::string negative;
    for (const std::string& term : linear_) negative += " - " + term;
    result_.hamiltonian = fmt::format("({})/2{}", fmt::join(squares_, " + "), negative);
    initial();
    return std::move(result_);
  }

 private:
  std::string parameter(const std::string& name, const cln::cl_RA& value, bool positive) {
    result_.parameters.push_back({name, value, positive});
    return name;
  }

  /// A letter for parameters that no variable has.
  std::string letter(const std::string& wanted, const std::string& other) const {
    const bool taken = std::ranges::any_of(
        blocks_, [&](const BracketBlock& block) { return block.letters == wanted; });
    return taken ? other : wanted;
  }

  /// c1*x1^2 + c2*x2^2 + ..
  void squares(const BracketBlock& block, const std::string& letter) {
    for (std::size_t i = 0; i < block.size; ++i) {
      const std::string name = fmt::format("{}{}", letter, i + 1);
      squares_.push_back(fmt::format("{}*{}^2",
                                     parameter(name, ratio(1, static_cast<long>(i) + 1), true),
                                     names_[block.start + i]));
    }
  }

  /// For three momenta the inverse moments of inertia; for J_ij the coefficient a_i + a_j, one of
  /// Manakov's family of commuting Hamiltonians.
  void kinetic(const BracketBlock& block) {
    if (block.letters != "J") return squares(block, letter("a", "k"));
    std::size_t n = 2;
    while (n * (n - 1) / 2 < block.size) ++n;
    for (std::size_t i = 1; i <= n; ++i)
      parameter(fmt::format("a{}", i), ratio(1, static_cast<long>(i)), true);
    std::size_t at = block.start;
    for (std::size_t i = 1; i <= n; ++i) {
      for (std::size_t j = i + 1; j <= n; ++j)
        squares_.push_back(fmt::format("(a{} + a{})*{}^2", i, j, names_[at++]));
    }
  }

  void further(const BracketBlock& block, std::size_t number) {
    if (!block.commutes) {
      squares(block, "c");
      quadratic_in_.push_back(block.letters);
    } else if (block.letters == "l") {  // Rodrigues-Hamilton parameters: gamma_3 is quadratic
      linear_.push_back(parameter("r", 1, false) + "*(l0^2 - l1^2 - l2^2 + l3^2)");
      weight_ = true;
    } else {
      const char first = static_cast<char>('r' + number - 1);
      std::vector<std::string> terms;
      for (std::size_t i = 0; i < block.size; ++i) {
        const std::string name = fmt::format("{}{}", first, i + 1);
        const cln::cl_RA value = i + 1 == block.size ? ratio(1, 2) : i == 0 ? 1 : 0;
        terms.push_back(
            fmt::format("{}*{}", parameter(name, value, false), names_[block.start + i]));
      }
      linear_.push_back(fmt::format("({})", fmt::join(terms, " + ")));
      linear_in_.push_back(block.letters);
    }
  }

  std::string about_the_rest() const {
    std::string text;
    if (!quadratic_in_.empty())
      text += fmt::format(", also quadratic in {}", fmt::join(quadratic_in_, ", "));
    if (!linear_in_.empty())
      text += fmt::format(" and a potential linear in {}", fmt::join(linear_in_, ", "));
    if (weight_) text += " and weight: the factor of r is the third direction cosine";
    return text;
  }

  /// Momenta 1, 1/2, 1/3, ..; vectors of length one with rational components.
  void initial() {
    std::vector<cln::cl_RA> values;
    for (const BracketBlock& block : blocks_) {
      const std::size_t first = values.size();
      if (first == 0 || block.size == 1) {
        for (std::size_t i = 0; i < block.size; ++i)
          values.push_back(ratio(1, static_cast<long>(first + i) + 1));
        continue;
      }
      values.resize(first + block.size, 0);
      const std::size_t turn = (first / block.size + 2) % block.size;
      values[first + (turn + block.size - 1) % block.size] = ratio(4, 5);
      values[first + turn] = ratio(3, 5);
    }
    for (std::size_t i = 0; i < names_.size(); ++i)
      result_.variables.push_back({names_[i], values[i]});
  }

  std::vector<std::string> names_;
  std::vector<BracketBlock> blocks_;
  std::vector<std::string> squares_, linear_;          ///< terms
  std::vector<std::string> quadratic_in_, linear_in_;  ///< blocks
  bool weight_ = false;
  NewCase result_;
};

std::string form_text(const IntegerForm& form, const std::vector<NewQuantity>& variables) {
  std::string text;
  for (const auto& [factors, coefficient] : form) {
    if (text.empty())
      text = coefficient < 0 ? "-" : "";
    else
      text += coefficient < 0 ? " - " : " + ";
    std::vector<std::string> words;
    if (std::abs(coefficient) != 1) words.push_back(std::to_string(std::abs(coefficient)));
    if (factors.size() == 2 && factors[0] == factors[1]) {
      words.push_back(variables[factors[0]].name + "^2");
    } else {
      for (const std::size_t i : factors) words.push_back(variables[i].name);
    }
    text += fmt::format("{}", fmt::join(words, "*"));
  }
  return text;
}

cln::cl_RA value_of(const IntegerForm& form, const std::vector<NewQuantity>& variables) {
  cln::cl_RA sum = 0;
  for (const auto& [factors, coefficient] : form) {
    cln::cl_RA term = coefficient;
    for (const std::size_t i : factors) term = term * variables[i].value;
    sum = sum + term;
  }
  return sum;
}

/// "F1 - 13/15", which vanishes where F1 has that value.
std::string level(const std::string& name, const cln::cl_RA& value) {
  if (cln::zerop(value)) return name;
  return cln::plusp(value) ? fmt::format("{} - {}", name, rational_text(value))
                           : fmt::format("{} + {}", name, rational_text(-value));
}

}  // namespace

NewCase new_on_algebra(const LieAlgebra& algebra) {
  NewCase result = TopBuilder(algebra).build();
  for (const IntegerForm& form : invariant_forms_to_degree_two(algebra)) {
    const std::string name = fmt::format("F{}", result.casimirs.size() + 1);
    result.casimirs.emplace_back(name, form_text(form, result.variables));
    result.levels.push_back(level(name, value_of(form, result.variables)));
  }
  return result;
}

NewCase new_canonical(int n) {
  NewCase result;
  result.about = "Oscillators; w1, .. are the squares of their frequencies.";
  result.phase_space = "canonical = true";
  std::vector<std::string> kinetic, potential;
  for (int i = 1; i <= n; ++i) {
    result.variables.push_back({fmt::format("q{}", i), ratio(1, i)});
    result.parameters.push_back({fmt::format("w{}", i), i, true});
    kinetic.push_back(fmt::format("p{}^2", i));
    potential.push_back(fmt::format("w{0}*q{0}^2", i));
  }
  for (int i = 1; i <= n; ++i) result.variables.push_back({fmt::format("p{}", i), ratio(1, i + 1)});
  result.hamiltonian =
      fmt::format("({} + {})/2", fmt::join(kinetic, " + "), fmt::join(potential, " + "));
  result.integrals.emplace_back("E1", "(p1^2 + w1*q1^2)/2");
  result.levels.push_back(level("E1", ratio(5, 8)));
  return result;
}

NewCase new_equations(int n) {
  NewCase result;
  result.about = "A chain of species: each one eats the one before it (Volterra).";
  result.parameters.push_back({"k", 1, true});
  std::vector<std::string> names;
  cln::cl_RA sum = 0;
  for (int i = 1; i <= n; ++i) {
    names.push_back(fmt::format("x{}", i));
    result.variables.push_back({names.back(), ratio(1, i)});
    sum = sum + ratio(1, i);
    const std::string right = i == n   ? fmt::format("k*x{}*x{}", i, i - 1)
                              : i == 1 ? "-k*x1*x2"
                                       : fmt::format("k*x{}*(x{} - x{})", i, i - 1, i + 1);
    result.equations.emplace_back(names.back(), right);
  }
  result.integrals.emplace_back("S", fmt::format("{}", fmt::join(names, " + ")));
  result.levels.push_back(level("S", sum));
  return result;
}

}  // namespace casimir::tools

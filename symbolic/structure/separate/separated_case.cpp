#include "symbolic/structure/separate/separated_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "symbolic/structure/separate/separation_text.hpp"
#include "symbolic/structure/separate/with_root.hpp"

namespace casimir::structure {
namespace {

/// A case is not made where its map would be longer than this, in characters.
constexpr std::size_t kLongestSeparatedCase = 20000;

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::string list_of(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& one : texts) parts.push_back(quoted(one));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

class CaseWriter {
 public:
  CaseWriter(const Leaves& leaves, const std::vector<Polynomial>& integrals,
             const std::vector<SeparatedPair>& pairs)
      : leaves_(leaves), integrals_(integrals), pairs_(pairs) {}

  bool is_possible() const {
    const auto plain = [&](const SeparatedPair& own) {
      return std::ranges::all_of(own.equation.terms, [&](const SeparatedEquation::Term& one) {
        for (std::size_t i = 0; i < leaves_.dimension(); ++i)
          if (one.coefficient.uses(i)) return false;
        return true;
      });
    };
    const Model& model = leaves_.system().model();
    const auto is_taken = [&](const GiNaC::symbol& own) {
      const std::string name = own.get_name();
      for (std::size_t i = 1; i <= pairs_.size(); ++i) {
        for (const char* start : {"u", "G", "w", "root", "sum", "rate"})
          if (name == fmt::format("{}{}", start, i)) return true;
      }
      return false;
    };
    return std::ranges::all_of(pairs_, plain) && std::ranges::none_of(model.variables, is_taken) &&
           std::ranges::none_of(model.parameters, is_taken);
  }

  std::string whole() const { return head() + definitions() + map(); }

 private:
  std::string text(const Polynomial& p) const { return text_of(leaves_, p); }

  std::string head() const {
    const Model& model = leaves_.system().model();
    std::vector<std::string> names, brackets, assumed;
    for (const GiNaC::symbol& x : model.variables) names.push_back(x.get_name());
    const auto pairs = skew_indices(leaves_.dimension(), 2);
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const Polynomial& own = leaves_.bivector()[c];
      if (!own.is_zero())
        brackets.push_back(
            fmt::format("\"{},{}\" = \"{}\"\n", names[pairs[c][0]], names[pairs[c][1]], text(own)));
    }
    for (const Assumption& own : model.assumptions) assumed.push_back(own.text);
    std::string result = fmt::format(
        "title = \"{}, separated\"\nhamiltonian = \"{}\"\n\n[phase_space]\nvariables = {}\n",
        model.name, text(integrals_.front()), list_of(names));
    if (!assumed.empty()) result += fmt::format("domain = {}\n", list_of(assumed));
    result += fmt::format("\n[phase_space.brackets]\n{}\n", fmt::join(brackets, ""));
    if (!model.parameters.empty()) result += "[parameters]\n";
    for (const GiNaC::symbol& own : model.parameters) result += own.get_name() + " = {}\n";
    return result;
  }

  /// coefficients times powers of the i-th root.
  std::string at_root(const std::vector<Polynomial>& coefficients, std::size_t i) const {
    std::vector<std::string> parts;
    for (std::size_t m = 0; m < coefficients.size(); ++m) {
      if (!coefficients[m].is_zero())
        parts.push_back(fmt::format("({})*root{}^{}", text(coefficients[m]), i + 1, m));
    }
    return parts.empty() ? "0" : fmt::format("{}", fmt::join(parts, " + "));
  }

  std::string definitions() const {
    std::string result = "\n[definitions]\n";
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const SeparatedPair& own = pairs_[i];
      const WithRoot with(leaves_, own.a);
      WithRoot::Element rate = with.constant(Polynomial(leaves_.ring()));
      std::vector<std::string> sum;
      for (std::size_t j = 0; j < integrals_.size(); ++j) {
        sum.push_back(fmt::format("({})*({})", at_root(own.s[j], i), text(integrals_[j])));
        rate = with.sum(rate, with.product(with.reduced(own.s[j]), with.moved(integrals_[j])));
      }
      result += fmt::format("root{} = \"{}\"\n", i + 1, own.root);
      result += fmt::format("sum{} = \"{}\"\n", i + 1, fmt::join(sum, " + "));
      result += fmt::format("rate{} = \"({})/({})\"\n", i + 1, at_root(rate, i),
                            at_root(with.slope(), i));
    }
    return result;
  }

  /// A sum of terms that are coefficient * factor * u^power * G^degree over the denominator.
  struct Term {
    Polynomial coefficient;
    long factor, power, degree;
  };
  std::string sum_text(const SeparatedPair& own, const std::vector<Term>& terms,
                       std::size_t i) const {
    std::vector<std::string> parts;
    for (const Term& one : terms) {
      if (one.factor != 0)
        parts.push_back(fmt::format("({})*u{}^({})*G{}^{}",
                                    text(one.coefficient.scaled(one.factor)), i + 1, one.power,
                                    i + 1, one.degree));
    }
    if (parts.empty()) return "0";
    return fmt::format("({})/({})", fmt::join(parts, " + "), text(own.equation.denominator));
  }
  /// R, (dR/du)/2 and (dR/dG)/2.
  std::array<std::string, 3> right_sides(std::size_t i) const {
    const SeparatedPair& own = pairs_[i];
    std::vector<Term> whole, by_root, by_sum;
    for (const SeparatedEquation::Term& one : own.equation.terms) {
      const long power = static_cast<long>(one.power) - static_cast<long>(own.equation.shift),
                 degree = static_cast<long>(one.degree);
      const Polynomial half = one.coefficient.scaled(cln::cl_RA(1) / 2);
      whole.push_back({one.coefficient, 1, power, degree});
      by_root.push_back({half, power, power - 1, degree});
      by_sum.push_back({half, degree, power, degree - 1});
    }
    return {sum_text(own, whole, i), sum_text(own, by_root, i), sum_text(own, by_sum, i)};
  }

  std::string map() const {
    std::vector<std::string> names, brackets, image, expressions;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const std::string n = std::to_string(i + 1);
      const auto [right, by_root, by_sum] = right_sides(i);
      for (const char* start : {"u", "G", "w"}) names.push_back(start + n);
      brackets.push_back(fmt::format("\"u{0},G{0}\" = \"w{0}\"", n));
      brackets.push_back(fmt::format("\"u{0},w{0}\" = \"{1}\"", n, by_sum));
      brackets.push_back(fmt::format("\"w{0},G{0}\" = \"{1}\"", n, by_root));
      image.push_back(fmt::format("w{}^2 - {}", n, right));
      expressions.push_back(
          fmt::format("u{0} = \"root{0}\", G{0} = \"sum{0}\", w{0} = \"rate{0}\"", n));
    }
    std::string result = fmt::format(
        "\n[[map]]\nname = \"separated\"\nto = {{ variables = {}, brackets = {{ {} }} }}\n",
        list_of(names), fmt::join(brackets, ", "));
    std::vector<std::string> on = names_of(leaves_.on());
    if (!on.empty()) result += fmt::format("on = {}\n", list_of(on));
    return result + fmt::format("image = {}\nexpressions = {{ {} }}\n", list_of(image),
                                fmt::join(expressions, ", "));
  }

  const Leaves& leaves_;
  const std::vector<Polynomial>& integrals_;
  const std::vector<SeparatedPair>& pairs_;
};

}  // namespace

std::optional<std::string> separated_case(const Leaves& leaves,
                                          const std::vector<Polynomial>& integrals,
                                          const std::vector<SeparatedPair>& pairs) {
  const CaseWriter writer(leaves, integrals, pairs);
  if (!writer.is_possible()) return std::nullopt;
  std::string result = writer.whole();
  if (result.size() > kLongestSeparatedCase) return std::nullopt;
  return result;
}

Verdict verdict_of_map(const std::string& case_text, const Limits& limits) {
  try {
    const Model model = build_model(parse_case(case_text, "separated.toml", limits));
    Candidates only;
    only.only = ClaimKind::map;
    const std::vector<Proof> proofs = prove(model, only);
    return proofs.size() == 1 ? proofs.front().verdict : Verdict::undecided;
  } catch (const CaseError&) {
    return Verdict::undecided;  // a limit of the case was reached
  }
}

}  // namespace casimir::structure

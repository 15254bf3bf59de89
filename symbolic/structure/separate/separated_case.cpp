#include "symbolic/structure/separate/separated_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/proof/prover.hpp"
#include "symbolic/structure/separate/separation_text.hpp"
#include "symbolic/structure/separate/with_root.hpp"

namespace casimir::structure {
namespace {

/// A case is not made where its map would be longer than this, in characters.
constexpr std::size_t kLongestSeparatedCase = 20000;

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// The name of a file may have any characters.
std::string plain_name(std::string name) {
  std::erase_if(name, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_';
  });
  return name;
}

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

  /// Why no map can be written, or empty.
  std::string obstacle() const {
    const auto plain = [&](const SeparatedPair& own) {
      return std::ranges::all_of(own.equation.terms, [&](const SeparatedEquation::Term& one) {
        for (std::size_t i = 0; i < leaves_.dimension(); ++i)
          if (one.coefficient.uses(i)) return false;
        return true;
      });
    };
    if (!std::ranges::all_of(pairs_, plain))
      return "an equation of {u, G} has Casimir functions in it, whose values the level does not "
             "fix";
    const Model& model = leaves_.system().model();
    for (const auto* symbols : {&model.variables, &model.parameters}) {
      const auto taken = std::ranges::find_if(
          *symbols, [&](const auto& own) { return is_own_name(own.get_name()); });
      if (taken != symbols->end())
        return fmt::format("the case has the name '{}', which the map needs", taken->get_name());
    }
    return {};
  }

  std::string whole() const { return head() + definitions() + map(); }

 private:
  std::string text(const Polynomial& p) const { return text_of(leaves_, p); }

  bool is_own_name(const std::string& name) const {
    for (std::size_t i = 1; i <= pairs_.size(); ++i) {
      for (const char* start : {"u", "G", "w", "root", "sum", "rate"})
        if (name == fmt::format("{}{}", start, i)) return true;
    }
    return false;
  }

  /// In the variables and parameters alone: definitions and Casimir functions are not written, and
  /// a parameter may have got a value.
  std::vector<std::string> in_symbols(const std::vector<GiNaC::ex>& list) const {
    Prover prover(leaves_.system().model(), list);
    std::vector<std::string> result;
    for (const GiNaC::ex& own : list) result.push_back(prover.ring().text(prover.convert(own)));
    return result;
  }

  /// What the case assumes, but for what holds of numbers alone.
  std::vector<std::string> domain() const {
    const Model& model = leaves_.system().model();
    std::vector<GiNaC::ex> differences;
    std::vector<Comparison> signs;
    for (const Assumption& own : model.assumptions) {
      if (own.holds_at({}, model.limits)) continue;
      differences.push_back(own.difference);
      signs.push_back(own.comparison);
    }
    std::vector<std::string> result = in_symbols(differences);
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] += fmt::format(" {} 0", to_string(signs[k]));
    return result;
  }

  std::vector<std::string> level() const {
    std::vector<GiNaC::ex> values;
    for (const NamedExpression& f : leaves_.on()) values.push_back(f.value);
    return in_symbols(values);
  }

  std::string head() const {
    const Model& model = leaves_.system().model();
    std::vector<std::string> names, brackets;
    for (const GiNaC::symbol& x : model.variables) names.push_back(x.get_name());
    const auto pairs = skew_indices(leaves_.dimension(), 2);
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const Polynomial& own = leaves_.bivector()[c];
      if (!own.is_zero())
        brackets.push_back(
            fmt::format("\"{},{}\" = \"{}\"\n", names[pairs[c][0]], names[pairs[c][1]], text(own)));
    }
    const std::vector<std::string> assumed = domain();
    std::string result = fmt::format(
        "title = \"{}, separated\"\nhamiltonian = \"{}\"\n\n[phase_space]\nvariables = {}\n",
        plain_name(model.name), text(integrals_.front()), list_of(names));
    if (!assumed.empty()) result += fmt::format("domain = {}\n", list_of(assumed));
    result += fmt::format("\n[phase_space.brackets]\n{}\n", fmt::join(brackets, ""));
    std::string parameters;
    for (const GiNaC::symbol& own : model.parameters) {
      // No function of the separated system has an arbitrary one in it.
      if (!function_name(own.get_name())) parameters += own.get_name() + " = {}\n";
    }
    return parameters.empty() ? result : result + "[parameters]\n" + parameters;
  }

  std::string definitions() const {
    std::string result = "\n[definitions]\n";
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const SeparatedPair& own = pairs_[i];
      const WithRoot with(leaves_, own.a);
      const std::string root = fmt::format("root{}", i + 1);
      WithRoot::Element rate = with.constant(Polynomial(leaves_.ring()));
      std::vector<std::string> sum;
      for (std::size_t j = 0; j < integrals_.size(); ++j) {
        sum.push_back(
            fmt::format("({})*({})", in_powers(leaves_, own.s[j], root), text(integrals_[j])));
        rate = with.sum(rate, with.product(with.reduced(own.s[j]), with.moved(integrals_[j])));
      }
      result += fmt::format("root{} = \"{}\"\n", i + 1, own.root);
      result += fmt::format("sum{} = \"{}\"\n", i + 1, fmt::join(sum, " + "));
      result += fmt::format("rate{} = \"({})/({})\"\n", i + 1, in_powers(leaves_, rate, root),
                            in_powers(leaves_, with.slope(), root));
    }
    return result;
  }

  /// Half the derivative of R along u or G.
  SeparatedEquation half_slope(const SeparatedEquation& whole, bool along_root) const {
    SeparatedEquation result{{}, whole.denominator, whole.shift};
    if (along_root && whole.shift > 0) ++result.shift;
    for (const SeparatedEquation::Term& one : whole.terms) {
      const long factor = along_root ? static_cast<long>(one.power) - static_cast<long>(whole.shift)
                                     : static_cast<long>(one.degree);
      if (factor == 0) continue;
      const bool lower = along_root && whole.shift == 0;
      result.terms.push_back({one.power - (lower ? 1 : 0), one.degree - (along_root ? 0 : 1),
                              one.coefficient.scaled(cln::cl_RA(factor) / 2)});
    }
    return result;
  }

  std::string map() const {
    std::vector<std::string> names, brackets, image, expressions;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const std::string n = std::to_string(i + 1);
      const SeparatedEquation& own = pairs_[i].equation;
      const auto right = [&](const SeparatedEquation& one) {
        return text_of(leaves_, one, "u" + n, "G" + n);
      };
      for (const char* start : {"u", "G", "w"}) names.push_back(start + n);
      brackets.push_back(fmt::format("\"u{0},G{0}\" = \"w{0}\"", n));
      brackets.push_back(fmt::format("\"u{0},w{0}\" = \"{1}\"", n, right(half_slope(own, false))));
      brackets.push_back(fmt::format("\"w{0},G{0}\" = \"{1}\"", n, right(half_slope(own, true))));
      image.push_back(fmt::format("w{}^2 - ({})", n, right(own)));
      expressions.push_back(
          fmt::format("u{0} = \"root{0}\", G{0} = \"sum{0}\", w{0} = \"rate{0}\"", n));
    }
    std::string result = fmt::format(
        "\n[[map]]\nname = \"separated\"\nto = {{ variables = {}, brackets = {{ {} }} }}\n",
        list_of(names), fmt::join(brackets, ", "));
    const std::vector<std::string> on = level();
    if (!on.empty()) result += fmt::format("on = {}\n", list_of(on));
    return result + fmt::format("image = {}\nexpressions = {{ {} }}\n", list_of(image),
                                fmt::join(expressions, ", "));
  }

  const Leaves& leaves_;
  const std::vector<Polynomial>& integrals_;
  const std::vector<SeparatedPair>& pairs_;
};

/// \throws CaseError, ModelError  where the text is no case
Model read_back(const std::string& case_text, const Limits& limits) {
  return build_model(parse_case(case_text, "separated.toml", limits));
}

Verdict verdict_of_only_map(const Model& model) {
  Candidates only;
  only.only = ClaimKind::map;
  const std::vector<Proof> proofs = prove(model, only);
  return proofs.size() == 1 ? proofs.front().verdict : Verdict::undecided;
}

}  // namespace

SeparatedCase separated_case(const Leaves& leaves, const std::vector<Polynomial>& integrals,
                             const std::vector<SeparatedPair>& pairs) {
  const CaseWriter writer(leaves, integrals, pairs);
  SeparatedCase result;
  result.reason = writer.obstacle();
  if (!result.reason.empty()) return result;
  std::string text = writer.whole();
  if (text.size() > kLongestSeparatedCase) {
    result.reason = fmt::format("its file would have {} characters, more than {}", text.size(),
                                kLongestSeparatedCase);
    return result;
  }
  try {
    result.map = verdict_of_map(text, leaves.system().model().limits);
    result.text = std::move(text);
  } catch (const CaseError& problem) {
    result.reason = "its file could not be read back: " + problem.text();
  } catch (const ModelError& problem) {
    result.reason = fmt::format("its file could not be read back: {}", problem.what());
  }
  return result;
}

Verdict verdict_of_map(const std::string& case_text, const Limits& limits) {
  const Model model = read_back(case_text, limits);
  try {
    return verdict_of_only_map(model);
  } catch (const CaseError&) {
    return Verdict::undecided;  // a limit of the case was reached
  } catch (const TooLarge&) {
    return Verdict::undecided;
  }
}

}  // namespace casimir::structure

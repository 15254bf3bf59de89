#include "symbolic/model/phase_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/case/limits.hpp"
#include "symbolic/lie_algebra.hpp"
#include "symbolic/model/dirac_bracket.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using Symbols = std::vector<GiNaC::symbol>;

/// The strict upper triangle of a skew matrix, filled entry by entry.
class UpperTriangle {
 public:
  explicit UpperTriangle(std::size_t n) : n_(n), entries_(n * (n - 1) / 2) {}
  ex& at(std::size_t i, std::size_t j) { return entries_[i * n_ - i * (i + 1) / 2 + (j - i - 1)]; }
  void add(std::size_t i, std::size_t j, const ex& value) {
    if (i < j)
      at(i, j) += value;
    else
      at(j, i) -= value;
  }
  std::vector<ex> entries() const { return entries_; }

 private:
  std::size_t n_;
  std::vector<ex> entries_;
};

int sign_of(const PhaseSpaceText& text) {
  if (!text.sign || text.sign->value == "-") return 1;
  if (text.sign->value == "+") return -1;
  throw text.sign->error("'sign' must be \"-\" (the book's convention) or \"+\"");
}

std::vector<ex> algebra_brackets(const PhaseSpaceText& text, const Symbols& x) {
  const std::optional<LieAlgebra> algebra = find_lie_algebra(text.algebra->value);
  if (!algebra) {
    throw text.algebra->error(
        fmt::format("unknown Lie algebra '{}'", printable(text.algebra->value)), 0,
        lie_algebra_hint(text.algebra->value));
  }
  if (algebra->dimension != x.size()) {
    throw text.algebra->error(fmt::format("{} has {} variables ({}), {} given", algebra->name,
                                          algebra->dimension, algebra->order, x.size()));
  }
  UpperTriangle upper(x.size());
  for (const StructureConstant& c : algebra->constants) {
    upper.add(c.i, c.j, sign_of(text) * GiNaC::numeric(c.numerator, c.denominator) * x[c.k]);
  }
  return upper.entries();
}

std::vector<ex> canonical_brackets(const PhaseSpaceText& text, const Symbols& x) {
  if (x.size() % 2 != 0) {
    throw CaseError(
        text.where,
        fmt::format("canonical variables come in pairs q1..qn, p1..pn; {} given", x.size()));
  }
  UpperTriangle upper(x.size());
  for (std::size_t i = 0; i < x.size() / 2; ++i) upper.at(i, i + x.size() / 2) = sign_of(text);
  return upper.entries();
}

std::pair<std::size_t, std::size_t> pair_of(const Text& key, const Symbols& x) {
  const std::string& s = key.value;
  const std::size_t comma = s.find(',');
  if (comma == std::string::npos || s.find(',', comma + 1) != std::string::npos) {
    throw key.error(fmt::format("'{}' is not a pair of variables such as \"M1,M2\"", printable(s)));
  }
  const auto trimmed = [&](std::size_t begin, std::size_t end) {
    while (begin < end && s[begin] == ' ') ++begin;
    while (end > begin && s[end - 1] == ' ') --end;
    return symbol_position(key, s.substr(begin, end - begin), begin, x, "one of the variables");
  };
  return {trimmed(0, comma), trimmed(comma + 1, s.size())};
}

void check_linear(const Text& text, const ex& value, const Symbols& x) {
  ex rest = value;
  for (const GiNaC::symbol& v : x) {
    const ex slope = value.diff(v);
    for (const GiNaC::symbol& w : x) {
      if (slope.has(w))
        throw text.error("a structure constant must be a linear form in the variables");
    }
    rest -= slope * v;
  }
  if (!rest.expand().is_zero())
    throw text.error("a structure constant must be a linear form without a constant term");
}

std::vector<ex> explicit_brackets(const std::vector<Entry>& entries, bool linear, int sign,
                                  const Symbols& x, Scope& names, std::vector<ex>* domain) {
  UpperTriangle upper(x.size());
  std::map<std::pair<std::size_t, std::size_t>, ex> given;
  for (const auto& [key, text] : entries) {
    const auto [i, j] = pair_of(key, x);
    const Quantity quantity = parse_expression(text, names);
    const ex value = sign * quantity.value;
    for (const ex& part : lost_parts(quantity)) domain->push_back(part);
    if (linear) check_linear(text, value, x);
    if (i == j && !value.expand().is_zero()) {
      throw key.error(
          fmt::format("the bracket is not skew: {{{0},{0}}} must be 0", x[i].get_name()));
    }
    if (given.contains({i, j})) throw key.error("this bracket is given twice");
    const auto mirrored = given.find({j, i});
    if (mirrored != given.end() && !(mirrored->second + value).expand().is_zero()) {
      throw key.error(fmt::format("the bracket is not skew: {{{0},{1}}} must be -{{{1},{0}}}",
                                  x[i].get_name(), x[j].get_name()));
    }
    given[{i, j}] = value;
    if (i != j && mirrored == given.end()) upper.add(i, j, value);
  }
  return upper.entries();
}

std::optional<PoissonStructure> written_bracket(const PhaseSpaceText& text,
                                                const Symbols& variables, Scope& names,
                                                const std::optional<Frame>& frame,
                                                std::vector<ex>* domain) {
  const int forms = int(text.algebra.has_value()) + int(text.canonical) +
                    int(text.brackets.has_value()) + int(text.structure_constants.has_value()) +
                    int(text.vector_fields.has_value());
  if (forms > 1) {
    throw CaseError(text.where,
                    "the phase space must have exactly one of 'algebra', 'canonical', 'brackets', "
                    "'structure_constants' and 'vector_fields'");
  }
  if (frame) return frame_bracket(*frame, variables, sign_of(text));
  if (text.algebra) return PoissonStructure(variables, algebra_brackets(text, variables));
  if (text.canonical) return PoissonStructure(variables, canonical_brackets(text, variables));
  if (text.brackets) {
    return PoissonStructure(variables, explicit_brackets(*text.brackets, false, sign_of(text),
                                                         variables, names, domain));
  }
  if (text.structure_constants) {
    return PoissonStructure(variables, explicit_brackets(*text.structure_constants, true,
                                                         sign_of(text), variables, names, domain));
  }
  return std::nullopt;
}

/// What `dirac` makes of the bracket that is written.
PoissonStructure restricted_bracket(const PhaseSpaceText& text, const PoissonStructure& written,
                                    Scope& names, std::vector<ex>* domain) {
  const Text& dirac = *text.dirac;
  if (text.constraints.empty())
    throw dirac.error("a Dirac bracket needs 'constraints'", 0,
                      "constraints = [\"x^2 + y^2 - 1\", \"x*px + y*py\"]");
  if (text.constraints.size() > kMostConstraints)
    throw text.constraints.back().error(
        fmt::format("a Dirac bracket has at most {} constraints, {} given", kMostConstraints,
                    text.constraints.size()));
  std::vector<ex> constraints;
  for (const Text& constraint : text.constraints) {
    const Quantity quantity = parse_expression(constraint, names);
    for (const ex& part : lost_parts(quantity)) domain->push_back(part);
    constraints.push_back(quantity.value);
  }
  std::optional<DiracBracket> result;
  try {
    result = dirac_bracket(written, constraints, names.limits());
  } catch (const ModelError& problem) {
    throw dirac.error(fmt::format("the Dirac bracket cannot be computed: {}", problem.what()));
  }
  if (!result)
    throw dirac.error(
        "the constraints are not of the second class: the matrix of their brackets "
        "has determinant 0 on them",
        0,
        constraints.size() % 2 == 1
            ? "their number is odd: the velocity of a constraint is often missing"
            : "one that commutes with all others has no place in a Dirac bracket");
  domain->push_back(1 / result->determinant);
  return result->structure;
}

std::string describe_written(const PhaseSpaceText& text) {
  if (text.algebra)
    return text.algebra->value + (text.sign && text.sign->value == "+" ? ", plus sign" : "");
  if (text.canonical) return "canonical";
  if (text.brackets) return "brackets";
  if (text.structure_constants) return "structure constants";
  if (text.vector_fields) return "frame";
  return "equations";
}

}  // namespace

std::vector<GiNaC::symbol> make_variables(const PhaseSpaceText& text, const Limits& limits) {
  if (text.variables.empty())
    throw CaseError(text.where, "'variables' must name at least one variable");
  if (static_cast<double>(text.variables.size()) > limits.variables) {
    throw CaseError(text.where,
                    fmt::format("{} variables given; the limit is {:.0f}", text.variables.size(),
                                limits.variables),
                    {}, limits.hint(&Limits::variables), &Limits::variables);
  }
  Symbols result;
  for (const Text& name : text.variables) {
    check_name(name, "a variable");
    for (const GiNaC::symbol& other : result) {
      if (other.get_name() == name.value)
        throw name.error(fmt::format("'{}' is declared twice", name.value));
    }
    result.push_back(GiNaC::symbol(name.value));
  }
  return result;
}

std::optional<Frame> make_frame(const PhaseSpaceText& text, const Symbols& variables,
                                const Symbols& parameters, Scope& names) {
  if (!text.vector_fields) return std::nullopt;
  return make_frame(*text.vector_fields, variables, parameters, names);
}

std::optional<PoissonStructure> make_bracket(const PhaseSpaceText& text, const Symbols& variables,
                                             Scope& names, const std::optional<Frame>& frame,
                                             std::vector<ex>* domain) {
  std::vector<ex> parts;
  if (domain == nullptr) domain = &parts;
  if (frame) domain->insert(domain->end(), frame->domain.begin(), frame->domain.end());
  const auto written = written_bracket(text, variables, names, frame, domain);
  if (!text.dirac) return written;
  if (!written)
    throw text.dirac->error("a Dirac bracket is made of another one, and none is given", 0,
                            "canonical = true");
  return restricted_bracket(text, *written, names, domain);
}

std::string describe(const PhaseSpaceText& text) {
  return describe_written(text) + (text.dirac ? ", Dirac bracket" : "");
}

}  // namespace casimir

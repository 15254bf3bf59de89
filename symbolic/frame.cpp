#include "symbolic/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/functions/point_completer.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using Symbols = std::vector<GiNaC::symbol>;
using PolynomialField = std::vector<Polynomial>;  ///< one component for each coordinate

Symbols variables_of(const std::vector<Text>& names, const Symbols& variables) {
  Symbols result;
  for (const Text& name : names) {
    result.push_back(
        variables[symbol_position(name, name.value, 0, variables, "one of the variables")]);
  }
  return result;
}

/// A field may not depend on momenta, nor on the time.
/// \param known  what it may depend on
void refuse_others(const Text& text, const ex& component,
                   const std::vector<const Symbols*>& known) {
  for (auto part = component.preorder_begin(); part != component.preorder_end(); ++part) {
    if (!GiNaC::is_a<GiNaC::symbol>(*part)) continue;
    const auto is_in = [&](const Symbols* list) {
      return std::ranges::any_of(*list, [&](const auto& own) { return ex(own).is_equal(*part); });
    };
    if (std::ranges::any_of(known, is_in)) continue;
    throw text.error(
        fmt::format("a field of the frame depends on the coordinates only, not on '{}'",
                    GiNaC::ex_to<GiNaC::symbol>(*part).get_name()));
  }
}

void read_fields(const VectorFieldsText& text, const Symbols& parameters, Scope& names,
                 Frame& frame) {
  const std::size_t k = frame.momenta.size();
  frame.fields.assign(k, std::vector<ex>(frame.coordinates.size(), 0));
  std::vector<bool> given(k);
  for (const VectorFieldText& field : text.fields) {
    const std::size_t s = symbol_position(field.momentum, field.momentum.value, 0, frame.momenta,
                                          "one of the momenta");
    given[s] = true;
    for (const auto& [name, value] : field.components) {
      const std::size_t i =
          symbol_position(name, name.value, 0, frame.coordinates, "one of the coordinates");
      const Quantity component = parse_expression(value, names);
      frame.fields[s][i] = component.value;
      for (const ex& part : lost_parts(component)) frame.domain.push_back(part);
      refuse_others(value, component.value, {&frame.coordinates, &parameters});
    }
  }
  for (std::size_t s = 0; s < k; ++s) {
    if (!given[s]) {
      throw CaseError(text.where, fmt::format("the frame has no vector field for the momentum '{}'",
                                              frame.momenta[s].get_name()));
    }
  }
}

/// Finds the structure functions in the ring of the fields' own functions.
class StructureFunctions {
 public:
  StructureFunctions(const Frame& frame, const Symbols& symbols, const Limits& limits)
      : frame_(frame), ring_(symbols, {}, expressions(frame), limits) {
    for (const auto& field : frame.fields) fields_.push_back(converted(field));
  }

  /// c_ij^1, .., c_ij^k; empty if the commutator is no combination of the fields.
  std::optional<std::vector<ex>> solve(std::size_t i, std::size_t j) {
    const PolynomialField target = converted(frame_.commutator(i, j));
    if (const auto constants = constant_combination(target)) return constants;
    return functional_combination(target);
  }

  /// Whether the fields are dependent at generic points, so that functions c_ij^s are not unique.
  bool dependent() {
    const auto point = random_point();
    return !point || rank(rows_at(fields_, *point)) < fields_.size();
  }

 private:
  static std::vector<ex> expressions(const Frame& frame) {
    std::vector<ex> all;
    for (std::size_t i = 0; i < frame.fields.size(); ++i) {
      all.insert(all.end(), frame.fields[i].begin(), frame.fields[i].end());
      for (std::size_t j = 0; j < i; ++j) {
        for (const ex& e : frame.commutator(i, j)) all.push_back(e);
      }
    }
    return all;
  }

  PolynomialField converted(const std::vector<ex>& field) {
    PolynomialField result;
    for (const ex& component : field) result.push_back(ring_.convert(component));
    return result;
  }

  std::optional<std::vector<cln::cl_RA>> random_point() {
    std::uniform_int_distribution<int> numerators(-9, 9);
    std::uniform_int_distribution<int> denominators(1, 5);
    const auto draw = [&]() -> cln::cl_RA {
      const int numerator = numerators(random_);
      return cln::cl_RA(numerator) / denominators(random_);
    };
    // A root has a rational value at few points. Where no point was found once, none is looked for
    // again; where the numbers are long, fewer are tried.
    const long trials =
        no_point_
            ? 0
            : std::clamp(4000 / (1 + functions::PointCompleter(ring_.table()).argument_degree()),
                         5L, 200L);
    for (long trial = 0; trial < trials; ++trial) {
      std::vector<cln::cl_RA> point;
      for (std::size_t i = 0; i < ring_.symbols().size(); ++i) point.push_back(draw());
      if (functions::PointCompleter(ring_.table()).complete(point, draw, {.formal = true}))
        return point;
    }
    no_point_ = true;
    return std::nullopt;
  }

  static RationalMatrix rows_at(const std::vector<PolynomialField>& fields,
                                const std::vector<cln::cl_RA>& point) {
    RationalMatrix rows;
    for (const PolynomialField& field : fields) {
      rows.emplace_back();
      for (const Polynomial& p : field) rows.back().push_back(p.evaluate(point));
    }
    return rows;
  }

  bool holds(const PolynomialField& target, const std::vector<Polynomial>& factors,
             const Polynomial& denominator) {
    for (std::size_t i = 0; i < target.size(); ++i) {
      Polynomial defect = target[i] * denominator;
      for (std::size_t s = 0; s < factors.size(); ++s) defect -= factors[s] * fields_[s][i];
      if (!ring_.numerator(defect).is_zero()) return false;
    }
    return true;
  }

  /// Constants that are right at enough random points, and then everywhere.
  std::optional<std::vector<ex>> constant_combination(const PolynomialField& target) {
    const std::size_t k = fields_.size();
    RationalMatrix equations;  // k coefficients and the right-hand side
    for (std::size_t point_count = 0; point_count < k + 2; ++point_count) {
      const auto point = random_point();
      if (!point) return std::nullopt;
      const RationalMatrix rows = rows_at(fields_, *point);
      for (std::size_t i = 0; i < target.size(); ++i) {
        equations.emplace_back();
        for (std::size_t s = 0; s < k; ++s) equations.back().push_back(rows[s][i]);
        equations.back().push_back(target[i].evaluate(*point));
      }
    }
    const auto solution = solve_unique(equations);
    if (!solution) return std::nullopt;
    std::vector<Polynomial> factors;
    std::vector<ex> result;
    for (const cln::cl_RA& c : *solution) {
      factors.push_back(ring_.ring().constant(c));
      result.emplace_back(GiNaC::numeric(c));
    }
    if (!holds(target, factors, ring_.ring().constant(1))) return std::nullopt;
    return result;
  }

  /// Functions of the coordinates, by Cramer's rule on rows that are regular at a random point.
  std::optional<std::vector<ex>> functional_combination(const PolynomialField& target) {
    const std::size_t k = fields_.size();
    const auto point = random_point();
    if (!point || target.size() < k) return std::nullopt;
    const std::vector<std::size_t> columns = independent_columns(rows_at(fields_, *point));
    if (columns.size() < k) return std::nullopt;
    const Polynomial denominator = determinant(fields_, columns);
    std::vector<Polynomial> factors;
    for (std::size_t s = 0; s < k; ++s) {
      std::vector<PolynomialField> replaced = fields_;
      replaced[s] = target;
      factors.push_back(determinant(replaced, columns));
    }
    if (!holds(target, factors, denominator)) return std::nullopt;
    std::vector<ex> result;
    for (const Polynomial& factor : factors) result.push_back(ring_.quotient(factor, denominator));
    return result;
  }

  /// Of the square matrix of the given columns.
  Polynomial determinant(const std::vector<PolynomialField>& rows,
                         const std::vector<std::size_t>& columns, std::size_t row = 0) {
    if (row == rows.size()) return ring_.ring().constant(1);
    Polynomial sum(ring_.ring());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (rows[row][columns[c]].is_zero()) continue;
      std::vector<std::size_t> rest = columns;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(c));
      const Polynomial term = rows[row][columns[c]] * determinant(rows, rest, row + 1);
      sum += c % 2 == 0 ? term : -term;
    }
    return sum;
  }

  const Frame& frame_;
  FunctionRing ring_;
  std::vector<PolynomialField> fields_;
  std::mt19937 random_{20190102};
  bool no_point_ = false;  ///< a search for points has failed
};

}  // namespace

ex Frame::along(std::size_t s, const ex& f) const {
  GiNaC::exvector terms;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!fields[s][i].is_zero()) terms.push_back(fields[s][i] * f.diff(coordinates[i]));
  }
  return GiNaC::add(terms);
}

std::vector<ex> Frame::commutator(std::size_t i, std::size_t j) const {
  std::vector<ex> result;
  for (std::size_t component = 0; component < coordinates.size(); ++component)
    result.push_back(along(i, fields[j][component]) - along(j, fields[i][component]));
  return result;
}

Frame make_frame(const VectorFieldsText& text, const Symbols& variables, const Symbols& parameters,
                 Scope& names) {
  Frame frame;
  frame.coordinates = variables_of(text.coordinates, variables);
  frame.momenta = variables_of(text.momenta, variables);
  const std::size_t k = frame.momenta.size();
  if (frame.coordinates.empty() || k == 0)
    throw CaseError(text.where, "the frame needs 'coordinates' and 'momenta'");
  if (frame.coordinates.size() + k != variables.size()) {
    throw CaseError(text.where, fmt::format("{} coordinates and {} momenta do not make up the {} "
                                            "variables",
                                            frame.coordinates.size(), k, variables.size()));
  }
  constexpr std::size_t kMaxFields = 12;
  if (k > kMaxFields)
    throw CaseError(text.where, fmt::format("a frame has at most {} vector fields", kMaxFields));
  read_fields(text, parameters, names, frame);
  Symbols symbols = frame.coordinates;
  symbols.insert(symbols.end(), parameters.begin(), parameters.end());
  StructureFunctions structure(frame, symbols, names.limits());
  frame.structure.assign(k * k * k, 0);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = i + 1; j < k; ++j) {
      const auto c = structure.solve(i, j);
      if (!c) {
        throw CaseError(
            text.where,
            structure.dependent()
                ? fmt::format("the fields of the frame are dependent, and [{}, {}] is no "
                              "combination of them with constant coefficients",
                              frame.momenta[i].get_name(), frame.momenta[j].get_name())
                : fmt::format("the frame does not close: the commutator of the fields of {} and {} "
                              "is no combination of the fields",
                              frame.momenta[i].get_name(), frame.momenta[j].get_name()));
      }
      for (std::size_t s = 0; s < k; ++s) {
        frame.structure[(i * k + j) * k + s] = (*c)[s];
        frame.structure[(j * k + i) * k + s] = -(*c)[s];
      }
    }
  }
  return frame;
}

PoissonStructure frame_bracket(const Frame& frame, const Symbols& variables, int sign) {
  const auto index = [](const Symbols& among,
                        const GiNaC::symbol& s) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < among.size(); ++i) {
      if (among[i].is_equal(s)) return i;
    }
    return std::nullopt;
  };
  std::vector<ex> upper;
  for (std::size_t a = 0; a < variables.size(); ++a) {
    for (std::size_t b = a + 1; b < variables.size(); ++b) {
      const auto qa = index(frame.coordinates, variables[a]);
      const auto qb = index(frame.coordinates, variables[b]);
      ex value = 0;
      if (qa && !qb) {
        value = frame.fields[*index(frame.momenta, variables[b])][*qa];
      } else if (!qa && qb) {
        value = -frame.fields[*index(frame.momenta, variables[a])][*qb];
      } else if (!qa && !qb) {
        const std::size_t i = *index(frame.momenta, variables[a]);
        const std::size_t j = *index(frame.momenta, variables[b]);
        for (std::size_t s = 0; s < frame.momenta.size(); ++s)
          value -= frame.c(i, j, s) * frame.momenta[s];
      }
      upper.push_back(sign * value);
    }
  }
  return PoissonStructure(variables, upper);
}

ex legendre_transform(const Frame& frame, const Text& text) {
  const auto k = static_cast<unsigned>(frame.velocities.size());
  const ex& lagrangian = fit_for_normal(*frame.lagrangian);
  GiNaC::matrix hessian(k, k);
  GiNaC::matrix unknown(k, 1);
  GiNaC::matrix right(k, 1);
  GiNaC::exmap at_rest;
  for (const GiNaC::symbol& w : frame.velocities) at_rest[w] = 0;
  for (unsigned i = 0; i < k; ++i) {
    const ex momentum = lagrangian.diff(frame.velocities[i]);
    for (unsigned j = 0; j < k; ++j) {
      hessian(i, j) = normal_form(momentum.diff(frame.velocities[j]));
      for (const GiNaC::symbol& w : frame.velocities) {
        if (hessian(i, j).has(w)) {
          throw text.error(
              "the Legendre transform is taken of Lagrangians that are quadratic in "
              "the velocities; give a 'hamiltonian' beside this one");
        }
      }
    }
    right(i, 0) = frame.momenta[i] - momentum.subs(at_rest, GiNaC::subs_options::no_pattern);
    unknown(i, 0) = GiNaC::symbol("u");
  }
  if (normal_form(hessian.determinant()).is_zero())
    throw text.error("the Lagrangian is degenerate: the velocities do not follow from the momenta");
  const GiNaC::matrix velocity = hessian.solve(unknown, right);
  GiNaC::exmap values;
  ex result = 0;
  for (unsigned i = 0; i < k; ++i) {
    values[frame.velocities[i]] = velocity(i, 0);
    result += velocity(i, 0) * frame.momenta[i];
  }
  return normal_form(result - lagrangian.subs(values, GiNaC::subs_options::no_pattern));
}

}  // namespace casimir

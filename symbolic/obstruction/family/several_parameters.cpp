#include "symbolic/obstruction/family/several_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "symbolic/obstruction/equation/kimura.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/equation/lame.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;
using F = ParametricFunction;

/// The value of a function of the parameters alone; empty where its denominator vanishes.
std::optional<cl_RA> value(const F& f, const std::vector<cl_RA>& point) {
  const cl_RA below = f.denominator().evaluate(point);
  if (cln::zerop(below)) return std::nullopt;
  return f.numerator().evaluate(point) / below;
}

/// Whether the member at a point is one of the family and has no solvable identity component.
bool excludes(const GeneralFamily& family, const std::vector<cl_RA>& point) {
  for (const Univariate& condition : family.conditions.polynomials())
    if (cln::zerop(condition.at(point[F::kParameter]))) return false;
  for (const Polynomial& condition : family.conditions.several())
    if (cln::zerop(condition.evaluate(point))) return false;
  SquaredDifferences squares;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto own = value(family.squares[i], point);
    if (!own) return false;
    squares[i] = *own;
  }
  return family.lame ? !lame_class(squares[2]) : !kimura(squares);
}

/// Tries some rational points.
bool excludes_something(const GeneralFamily& family) {
  const cl_RA numbers[] = {cl_RA(7) / 3, -5, cl_RA(11) / 7, cl_RA(2) / 13, -cl_RA(3) / 11};
  constexpr std::size_t kNumbers = 5;
  std::vector<cl_RA> point(F(1).numerator().ring().size(), 0);
  for (std::size_t first = 0; first < kNumbers; ++first)
    for (std::size_t step = 0; step < kNumbers; ++step) {
      std::size_t place = first;
      for (std::size_t i = 0; i < point.size(); ++i) {
        if (i == F::kVariable) continue;
        point[i] = numbers[place % kNumbers];
        place += step;
      }
      if (excludes(family, point)) return true;
    }
  return false;
}

/// The polynomials with something behind each and between them.
std::string conditions_text(const ParameterConditions& conditions, const CurveNames& names,
                            const char* behind, const char* between) {
  std::string result;
  const auto add = [&](const std::string& own) {
    result += (result.empty() ? "" : between) + own + behind;
  };
  for (const Univariate& own : conditions.polynomials()) add(own.text(names.parameter));
  for (const Polynomial& own : conditions.several()) add(written(F(own, F(1).numerator()), names));
  return result;
}

std::string survival_text(const GeneralFamily& family, const CurveNames& names) {
  const auto square = [&](std::size_t i) { return written(family.squares[i], names); };
  if (family.lame)
    return fmt::format("{} = s^2 with s in Z/2, Z/3, Z/4 or Z/5 (Lame's equation, n = s - 1/2)",
                       square(2));
  return fmt::format(
      "a sum of sqrt({}), sqrt({}), sqrt({}) with signs is an odd integer, or they stand in "
      "Schwarz's list",
      square(0), square(1), square(2));
}

}  // namespace

void exclude_regions(const HamiltonianSystem& system, std::vector<GeneralEquation> equations,
                     Obstruction& result) {
  CurveNames names{"z", system.free->get_name()};
  std::string all = names.parameter;
  for (const GiNaC::symbol& other : system.further) {
    names.further.push_back(other.get_name());
    all += ", " + other.get_name();
  }
  FreeSequence survive{"real " + all, {}};
  for (GeneralEquation& equation : equations) {
    Examined& shown = equation.shown;
    for (std::size_t i = equation.family.lame ? 1 : 0; i < 3; ++i)
      shown.exponents.push_back(fmt::format("{}: difference of exponents sqrt({})",
                                            equation.family.points[i],
                                            written(equation.family.squares[i], names)));
    shown.where = conditions_text(equation.family.conditions, names, " != 0", ", ");
    shown.decisive = excludes_something(equation.family);
    const std::string condition = survival_text(equation.family, names);
    shown.outcome = shown.decisive
                        ? "SL(2, C) or of another kind without a solvable identity component, but "
                          "where " +
                              condition
                        : "the identity component is solvable wherever it was tried";
    result.examined.push_back(shown);
    if (!shown.decisive) continue;
    const std::string other_form =
        conditions_text(equation.family.conditions, names, " = 0", " or ");
    survive.conditions.push_back(
        other_form.empty() ? condition : fmt::format("{}, or {}", condition, other_form));
  }
  if (survive.conditions.empty())
    throw NotDecided(
        "no equation of Riemann with three singular points, and none of Lame, excludes values of " +
        all);
  result.proved = true;
  result.sequences.push_back(std::move(survive));
}

}  // namespace casimir::obstruction

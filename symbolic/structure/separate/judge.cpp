#include "symbolic/structure/separate/judge.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/structure/separate/levi_civita.hpp"
#include "symbolic/structure/separate/separated_case.hpp"
#include "symbolic/structure/separate/separation_text.hpp"

namespace casimir::structure {
namespace {

Verdict proved_if(bool shown) { return shown ? Verdict::proved : Verdict::undecided; }

bool all_vanish(const Leaves& leaves, const std::vector<Polynomial>& list) {
  return std::ranges::all_of(list, [&](const Polynomial& p) { return leaves.vanishes(p); });
}

bool is_certainly_not_zero(RealPoint& point, const Polynomial& p) {
  try {
    return !point.value(p).contains_zero();
  } catch (const NotCertified&) {
    return false;
  }
}

}  // namespace

void SeparationJudge::judge_bivector(Separation& result, const Characteristic& own,
                                     const std::vector<Polynomial>& integrals) const {
  const std::size_t n = leaves_.dimension();
  const Bivector& p = own.bivector;
  result.tangent = proved_if(leaves_.is_tangent(p, own.rows));
  result.compatible = proved_if(all_vanish(leaves_, schouten(leaves_.bivector(), p, n)));
  result.jacobi = proved_if(all_vanish(leaves_, schouten(p, p, n)));
  bool commute = true;
  for (std::size_t f = 0; f < integrals.size(); ++f) {
    const std::vector<Polynomial> a = leaves_.gradient(integrals[f]);
    for (std::size_t g = f + 1; g < integrals.size(); ++g) {
      const std::vector<Polynomial> b = leaves_.gradient(integrals[g]);
      Polynomial sum(leaves_.ring());
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) sum += entry(p, n, i, j) * a[i] * b[j];
      commute = commute && leaves_.vanishes(sum);
    }
  }
  result.involution = proved_if(commute);
}

/// A point at which none of these is zero, one with real roots if there is one; null where none was
/// found.
RealPoint* SeparationJudge::judge_point(Separation& result, const RootCoefficients& a,
                                        std::vector<Polynomial> nonzero) const {
  result.nonzero = factors_of(leaves_, nonzero);
  const std::vector<Polynomial> hermite = positive_where_real(leaves_, a);
  RealPoint* found = nullptr;
  for (RealPoint& point : points_) {
    try {
      if (std::ranges::any_of(nonzero,
                              [&](const Polynomial& p) { return point.value(p).contains_zero(); }))
        continue;
      const bool real = std::ranges::all_of(
          hermite, [&](const Polynomial& p) { return point.value(p).sign() == 1; });
      if (found != nullptr && (result.real || !real)) continue;
      found = &point;
      result.distinct = Verdict::proved;
      result.real = real;
      result.point = point.text();
    } catch (const NotCertified&) {
      continue;
    }
  }
  if (found == nullptr)
    result.reason = "no point was found at which the roots are shown to be coordinates on the tori";
  return found;
}

/// A bracket of coefficients that is not zero where the roots are distinct makes one of the roots'.
void SeparationJudge::judge_commuting(Separation& result, const RootCoefficients& a,
                                      RealPoint& point) const {
  if (roots_commute(leaves_, a)) {
    result.commuting = Verdict::proved;
    return;
  }
  result.reason = "it is not shown that the roots commute";
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t l = k + 1; l < a.size(); ++l) {
      if (!is_certainly_not_zero(point, leaves_.bracket(a[k], a[l]))) continue;
      result.commuting = Verdict::refuted;
      result.reason = "the roots do not commute at the point";
    }
  }
}

/// Where no multiplier is a number, one of the coefficients that are constant on a leaf must not be
/// zero: then the multipliers vanish for some values of the root at most.
bool SeparationJudge::exclude_zeros(Separation& result, const StaeckelForm& form,
                                    RealPoint& point) const {
  std::vector<Polynomial> nonzero;
  for (const Multipliers& s : form.multipliers) {
    std::optional<Polynomial> shortest;
    for (const std::vector<Polynomial>& row : s) {
      for (const Polynomial& p : row) {
        if (!leaves_.vanishes(p) && (!shortest || p.terms() < shortest->terms())) shortest = p;
        if (p.is_constant() && !p.is_zero()) shortest = p;
      }
    }
    if (!shortest || !is_certainly_not_zero(point, *shortest)) return false;
    nonzero.push_back(*shortest);
  }
  for (const std::string& own : factors_of(leaves_, nonzero))
    if (std::ranges::find(result.nonzero, own) == result.nonzero.end())
      result.nonzero.push_back(own);
  return true;
}

void SeparationJudge::judge_multipliers(Separation& result, const RootCoefficients& a,
                                        const std::vector<Polynomial>& integrals,
                                        RealPoint& point) const {
  const auto form = staeckel_form(leaves_, a, integrals, casimirs_, watch_);
  if (!form || !exclude_zeros(result, *form, point)) {
    result.no_map = "Staeckel's form was not found";
    return;
  }
  result.staeckel = Verdict::proved;
  std::vector<SeparatedEquation> equations;
  for (std::size_t i = 0; i < form->multipliers.size(); ++i) {
    result.relations.push_back(relation_of(leaves_, form->multipliers[i], names_));
    Separation::Relation& own = result.relations.back();
    if (!form->roots.empty()) own.root = text_of(leaves_, form->roots[i]);
    const auto equation =
        separated_equation(leaves_, form->roots.empty() ? a : RootCoefficients{-form->roots[i]},
                           form->multipliers[i], integrals, casimirs_, watch_);
    if (!equation) continue;
    own.equation = text_of(leaves_, *equation, names_.root, names_.sum);
    equations.push_back(*equation);
  }
  if (equations.size() == form->multipliers.size())
    judge_map(result, a, *form, equations, integrals);
  else
    result.no_map = "no equation of each root with its sum was found";
}

/// The map to the separated variables, where the roots can be written down.
void SeparationJudge::judge_map(Separation& result, const RootCoefficients& a,
                                const StaeckelForm& form,
                                const std::vector<SeparatedEquation>& equations,
                                const std::vector<Polynomial>& integrals) const {
  std::vector<SeparatedPair> pairs;
  for (std::size_t i = 0; i < form.roots.size(); ++i)
    pairs.push_back(
        {text_of(leaves_, form.roots[i]), {-form.roots[i]}, form.multipliers[i], equations[i]});
  if (form.roots.empty() && a.size() == 2) {
    for (const char* sign : {"+", "-"})
      pairs.push_back({fmt::format("(-({0}) {2} sqrt(({0})^2 - 4*({1})))/2", text_of(leaves_, a[0]),
                                   text_of(leaves_, a[1]), sign),
                       a, form.multipliers[0], equations[0]});
  }
  if (pairs.empty()) {
    result.no_map = "the roots are no polynomials, and more than two";
    return;
  }
  SeparatedCase own = separated_case(leaves_, integrals, pairs);
  result.map_case = std::move(own.text);
  result.map = own.map;
  result.no_map = std::move(own.reason);
}

/// By theorem 3, for two degrees of freedom.
void SeparationJudge::judge_levi_civita(Separation& result, const RootCoefficients& a,
                                        const std::vector<Polynomial>& integrals,
                                        RealPoint& point) const {
  const std::vector<Polynomial> defect = levi_civita_defect(leaves_, a, integrals);
  if (std::ranges::all_of(defect, [](const Polynomial& p) { return p.is_zero(); })) {
    result.separated = Verdict::proved;
  } else if (std::ranges::any_of(
                 defect, [&](const Polynomial& p) { return is_certainly_not_zero(point, p); })) {
    result.separated = Verdict::refuted;
    result.reason =
        "Levi-Civita's condition is violated at the point; other integrals of the Hamiltonian are "
        "not excluded";
  } else {
    result.reason = "Levi-Civita's condition is not decided at the point";
  }
}

Separation SeparationJudge::begin(const RootCoefficients& a,
                                  const std::vector<Polynomial>& integrals) const {
  Separation result;
  result.names = names_;
  for (const Polynomial& f : integrals) result.integrals.push_back(text_of(leaves_, f));
  write_roots(result, leaves_, a);
  return result;
}

std::optional<Separation> SeparationJudge::of_bivector(
    const Bivector& p, const std::vector<Polynomial>& integrals) const {
  const auto own = characteristic_of(leaves_, p, watch_);
  if (!own) return std::nullopt;
  const RootCoefficients& a = own->coefficients;
  auto nonzero = regular_where(leaves_, a, integrals);
  if (!nonzero) return std::nullopt;
  if (!own->pfaffian.is_constant()) nonzero->push_back(leaves_.reduced(own->pfaffian));
  Separation result = begin(a, integrals);
  RealPoint* point = judge_point(result, a, std::move(*nonzero));
  if (point == nullptr) return std::nullopt;
  write_bivector(result, leaves_, own->bivector);
  judge_bivector(result, *own, integrals);
  judge_commuting(result, a, *point);
  if (result.commuting != Verdict::proved) return std::nullopt;
  judge_multipliers(result, a, integrals, *point);
  const auto proved = {result.tangent, result.compatible, result.jacobi, result.involution};
  const bool by_bivector =
      std::ranges::all_of(proved, [](Verdict verdict) { return verdict == Verdict::proved; });
  if (result.staeckel != Verdict::proved && !by_bivector) return std::nullopt;
  result.separated = Verdict::proved;
  return result;
}

Separation SeparationJudge::of_roots(const RootCoefficients& a,
                                     const std::vector<Polynomial>& poles,
                                     const std::vector<Polynomial>& integrals) const {
  Separation result = begin(a, integrals);
  auto nonzero = regular_where(leaves_, a, integrals);
  if (!nonzero) {
    result.reason = "the roots are not distinct, or no coordinates on the tori of the integrals";
    return result;
  }
  nonzero->insert(nonzero->end(), poles.begin(), poles.end());
  RealPoint* point = judge_point(result, a, std::move(*nonzero));
  if (point == nullptr) return result;
  judge_commuting(result, a, *point);
  if (result.commuting == Verdict::refuted) result.separated = Verdict::refuted;
  if (result.commuting != Verdict::proved) return result;
  judge_multipliers(result, a, integrals, *point);
  if (result.staeckel == Verdict::proved)
    result.separated = Verdict::proved;
  else if (a.size() == 2)
    judge_levi_civita(result, a, integrals, *point);
  else
    result.reason =
        "Staeckel's form was not found, and for more than two roots nothing else is tried";
  return result;
}

}  // namespace casimir::structure

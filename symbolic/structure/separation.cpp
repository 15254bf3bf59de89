#include "symbolic/structure/separation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "symbolic/search/conditions/real_ideal.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/independence.hpp"
#include "symbolic/structure/brackets.hpp"
#include "symbolic/structure/separate/bivector_ansatz.hpp"
#include "symbolic/structure/separate/commuting_integrals.hpp"
#include "symbolic/structure/separate/separated_equation.hpp"

namespace casimir::structure {
namespace {

constexpr std::size_t kMostExamined = 60;   ///< bivectors of one space
constexpr std::size_t kPointsOfLevel = 12;  ///< that are drawn
constexpr int kHighestInMany = 4;           ///< degree of integrals where variables are many
constexpr std::size_t kManyCoordinates = 6;

Verdict proved_if(bool shown) { return shown ? Verdict::proved : Verdict::undecided; }

bool all_vanish(const Leaves& leaves, const std::vector<Polynomial>& list) {
  return std::ranges::all_of(list, [&](const Polynomial& p) { return leaves.vanishes(p); });
}

/// The case itself or, of bare equations, with the first bracket that is found for them.
struct WithBracket {
  Model model;
  std::optional<std::string> text;  ///< of that bracket and its Hamiltonian
};

std::optional<WithBracket> with_bracket(const Model& model, const search::Watch& watch) {
  if (model.poisson && model.hamiltonian) return WithBracket{model, {}};
  for (int degree = 0; degree <= 2; ++degree) {
    for (const Bracket& own : find_brackets(model, degree, watch).found) {
      if (!own.hamiltonian || own.jacobi != Verdict::proved || own.motion != Verdict::proved)
        continue;
      WithBracket result{model, {}};
      result.model.poisson.emplace(model.variables, own.upper);
      result.model.hamiltonian = own.hamiltonian;
      result.model.phase_space = "explicit brackets";
      std::vector<std::string> parts;
      for (const auto& [label, text] : own.texts)
        parts.push_back(fmt::format("{{{}}} = {}", label, text));
      result.text = fmt::format("{}, H = {}", fmt::join(parts, ", "), own.hamiltonian_text);
      return result;
    }
  }
  return std::nullopt;
}

bool obeys_jacobi(const Model& model) {
  Candidates only;
  only.only = ClaimKind::jacobi;
  const std::vector<Proof> proofs = prove(model, only);
  return !proofs.empty() && std::ranges::all_of(proofs, [](const Proof& proof) {
    return proof.verdict == Verdict::proved && proof.where.empty();
  });
}

class SeparationSearch {
 public:
  SeparationSearch(const Model& model, const SeparationRequest& request, const search::Watch& watch)
      : model_(model), request_(request), watch_(watch) {
    report_.degree = request.degree;
  }

  SeparationReport run();

 private:
  bool look(const std::vector<Text>& on, int degree);
  bool read(const std::vector<Text>& on, int degree);
  std::optional<std::string> doubt_of_none();
  bool look_with(const std::vector<Polynomial>& integrals);
  bool look_among(const BivectorSpace& space, const std::vector<Polynomial>& integrals);
  std::optional<Separation> examine(const Bivector& p, const std::vector<Polynomial>& integrals);
  void judge_bivector(Separation& result, const Characteristic& own,
                      const std::vector<Polynomial>& integrals);
  std::string text_of(const std::vector<Polynomial>& coefficients, const std::string& u) const;
  std::string text_of(const SeparatedEquation& equation, const std::string& u) const;
  Separation::Relation relation_of(const Multipliers& s, const std::string& u) const;
  void judge_multipliers(Separation& result, const RootCoefficients& a,
                         const std::vector<Polynomial>& integrals);
  bool judge_point(Separation& result, const Characteristic& own,
                   const std::vector<Polynomial>& integrals);
  void write_factors(Separation& result, const std::vector<Polynomial>& list) const;
  void write_roots(Separation& result, const Characteristic& own);
  std::string text(const Polynomial& p) const { return leaves_->system().functions().text(p); }
  std::string free_name() const;

  const Model& model_;
  const SeparationRequest& request_;
  const search::Watch& watch_;
  std::optional<Leaves> leaves_;
  std::vector<Polynomial> casimirs_, functions_;
  std::vector<RealPoint> points_;
  SeparationReport report_;
};

/// "u", or the first other name that the case does not use.
std::string SeparationSearch::free_name() const {
  const auto used = [&](const std::string& name) {
    const auto is = [&](const GiNaC::symbol& own) { return own.get_name() == name; };
    return std::ranges::any_of(model_.variables, is) || std::ranges::any_of(model_.parameters, is);
  };
  for (const char* name : {"u", "v", "w", "z", "s", "lambda"})
    if (!used(name)) return name;
  return "u_";
}

void SeparationSearch::judge_bivector(Separation& result, const Characteristic& own,
                                      const std::vector<Polynomial>& integrals) {
  const std::size_t n = leaves_->dimension();
  const Bivector& p = own.bivector;
  result.tangent = proved_if(leaves_->is_tangent(p, own.rows));
  result.compatible = proved_if(all_vanish(*leaves_, schouten(leaves_->bivector(), p, n)));
  result.jacobi = proved_if(all_vanish(*leaves_, schouten(p, p, n)));
  bool commute = true;
  for (std::size_t f = 0; f < integrals.size(); ++f) {
    const std::vector<Polynomial> a = leaves_->gradient(integrals[f]);
    for (std::size_t g = f + 1; g < integrals.size(); ++g) {
      const std::vector<Polynomial> b = leaves_->gradient(integrals[g]);
      Polynomial sum(leaves_->ring());
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) sum += entry(p, n, i, j) * a[i] * b[j];
      commute = commute && leaves_->vanishes(sum);
    }
  }
  result.involution = proved_if(commute);
}

/// Whether there is a point at which the roots are distinct and, with the integrals, coordinates.
bool SeparationSearch::judge_point(Separation& result, const Characteristic& own,
                                   const std::vector<Polynomial>& integrals) {
  auto nonzero = regular_where(*leaves_, own.coefficients, integrals);
  if (!nonzero) return false;
  if (!own.pfaffian.is_constant()) nonzero->push_back(leaves_->reduced(own.pfaffian));
  write_factors(result, *nonzero);
  const std::vector<Polynomial> hermite = hermite_minors(*leaves_, own.coefficients);
  for (RealPoint& point : points_) {
    try {
      if (std::ranges::any_of(*nonzero,
                              [&](const Polynomial& p) { return point.value(p).contains_zero(); }))
        continue;
      const bool real = std::ranges::all_of(
          hermite, [&](const Polynomial& p) { return point.value(p).sign() == 1; });
      if (result.distinct == Verdict::proved && (result.real || !real)) continue;
      result.distinct = Verdict::proved;
      result.real = real;
      result.point = point.text();
    } catch (const NotCertified&) {
      continue;
    }
  }
  return result.distinct == Verdict::proved;
}

/// A polynomial in one variable with its coefficients in brackets where they are sums.
std::string SeparationSearch::text_of(const std::vector<Polynomial>& coefficients,
                                      const std::string& u) const {
  std::string sum;
  for (std::size_t m = coefficients.size(); m-- > 0;) {
    if (coefficients[m].is_zero()) continue;
    const std::string power = m == 0 ? "" : m == 1 ? u : fmt::format("{}^{}", u, m);
    std::string own = text(coefficients[m]);
    if (coefficients[m].terms() > 1) own = "(" + own + ")";
    if (!power.empty()) own = own == "1" ? power : own == "-1" ? "-" + power : own + "*" + power;
    sum += sum.empty() ? own : own.starts_with('-') ? " - " + own.substr(1) : " + " + own;
  }
  return sum.empty() ? "0" : sum;
}

Separation::Relation SeparationSearch::relation_of(const Multipliers& s,
                                                   const std::string& u) const {
  Separation::Relation result;
  result.may_vanish = true;
  for (std::size_t j = 0; j < s.size(); ++j) {
    std::string own = text_of(s[j], u);
    result.multipliers.push_back(own);
    if (own == "0") continue;
    const bool is_constant = std::ranges::all_of(s[j].begin() + 1, s[j].end(),
                                                 [](const auto& p) { return p.is_zero(); });
    if (is_constant && s[j][0].is_constant()) result.may_vanish = false;
    const bool minus = own.starts_with('-') && own.find(' ') == std::string::npos;
    if (minus) own.erase(0, 1);
    if (own.find(' ') != std::string::npos && (own[0] != '(' || own.find(')') + 1 != own.size()))
      own = "(" + own + ")";
    const std::string product = (own == "1" ? "" : own + "*") + fmt::format("F{}", j + 1);
    const std::string sign = result.sum.empty() ? (minus ? "-" : "") : minus ? " - " : " + ";
    result.sum += sign + product;
  }
  return result;
}

/// In descending powers of u, times the sum G.
std::string SeparationSearch::text_of(const SeparatedEquation& equation,
                                      const std::string& u) const {
  std::vector<SeparatedEquation::Term> terms = equation.terms;
  std::ranges::stable_sort(terms, [](const auto& a, const auto& b) {
    return std::pair(b.degree, b.power) < std::pair(a.degree, a.power);
  });
  const cln::cl_RA number =
      equation.denominator.is_constant() ? equation.denominator.content() : cln::cl_RA(1);
  const cln::cl_RA sign = equation.denominator.is_constant() &&
                                  !(equation.denominator == leaves_->ring().constant(number))
                              ? -1
                              : 1;
  std::string sum;
  for (const SeparatedEquation::Term& one : terms) {
    std::string own = text(one.coefficient.scaled(sign / number));
    if (one.coefficient.terms() > 1) own = "(" + own + ")";
    for (const auto& [name, power] :
         {std::pair(u, one.power), std::pair(std::string("G"), one.degree)}) {
      if (power == 0) continue;
      own = own == "1" ? "" : own == "-1" ? "-" : own + "*";
      own += power == 1 ? name : fmt::format("{}^{}", name, power);
    }
    sum += sum.empty() ? own : own.starts_with('-') ? " - " + own.substr(1) : " + " + own;
  }
  if (equation.denominator.is_constant()) return sum.empty() ? "0" : sum;
  return fmt::format("({})/({})", sum, text(equation.denominator));
}

void SeparationSearch::judge_multipliers(Separation& result, const RootCoefficients& a,
                                         const std::vector<Polynomial>& integrals) {
  const auto form = staeckel_form(*leaves_, a, integrals, casimirs_, watch_);
  if (!form) return;
  result.staeckel = Verdict::proved;
  for (std::size_t i = 0; i < form->multipliers.size(); ++i) {
    result.relations.push_back(relation_of(form->multipliers[i], result.variable));
    Separation::Relation& own = result.relations.back();
    if (!form->roots.empty()) own.root = text(form->roots[i]);
    const auto equation =
        separated_equation(*leaves_, form->roots.empty() ? a : RootCoefficients{-form->roots[i]},
                           form->multipliers[i], integrals, casimirs_, watch_);
    if (equation) own.equation = text_of(*equation, result.variable);
  }
}

/// The factors of what may not be zero, each once, without numbers.
void SeparationSearch::write_factors(Separation& result,
                                     const std::vector<Polynomial>& list) const {
  for (const Polynomial& p : list) {
    for (const auto& [factor, exponent] : p.factors()) {
      if (factor.is_constant()) continue;
      const std::string own = text(factor);
      if (std::ranges::find(result.nonzero, own) == result.nonzero.end())
        result.nonzero.push_back(own);
    }
  }
}

void SeparationSearch::write_roots(Separation& result, const Characteristic& own) {
  const std::size_t n = own.coefficients.size();
  for (std::size_t c = 0; c < own.bivector.size(); ++c) {
    const Polynomial& p = own.bivector[c];
    if (p.is_zero()) continue;
    const std::vector<std::size_t> pair = skew_indices(leaves_->dimension(), 2)[c];
    result.bivector.emplace_back(
        leaves_->system().name(pair[0]) + "," + leaves_->system().name(pair[1]), text(p));
    long size = 0;
    for (const auto& [number, exponents] : p.term_list()) {
      long sum = 0;
      for (std::size_t i = 0; i < leaves_->dimension(); ++i) sum += static_cast<long>(exponents[i]);
      size = std::max(size, sum);
    }
    result.degree = std::max(result.degree, static_cast<int>(size));
  }
  result.polynomial = fmt::format("{}^{}", result.variable, n);
  for (std::size_t k = 1; k <= n; ++k) {
    const std::string own_text = text(own.coefficients[k - 1]);
    result.coefficients.push_back(own_text);
    if (own.coefficients[k - 1].is_zero()) continue;
    const std::string power = n == k       ? ""
                              : n - k == 1 ? "*" + result.variable
                                           : fmt::format("*{}^{}", result.variable, n - k);
    result.polynomial += fmt::format(" + ({}){}", own_text, power);
  }
}

std::optional<Separation> SeparationSearch::examine(const Bivector& p,
                                                    const std::vector<Polynomial>& integrals) {
  const auto own = characteristic_of(*leaves_, p, watch_);
  if (!own) return std::nullopt;
  Separation result;
  result.variable = free_name();
  if (!judge_point(result, *own, integrals)) return std::nullopt;
  judge_bivector(result, *own, integrals);
  result.commuting = proved_if(roots_commute(*leaves_, own->coefficients));
  if (result.commuting == Verdict::proved) judge_multipliers(result, own->coefficients, integrals);
  const auto is_proved = [](Verdict verdict) { return verdict == Verdict::proved; };
  const bool by_bivector = is_proved(result.tangent) && is_proved(result.compatible) &&
                           is_proved(result.jacobi) && is_proved(result.involution);
  if (!is_proved(result.commuting) || (!is_proved(result.staeckel) && !by_bivector))
    return std::nullopt;
  result.separated = Verdict::proved;
  write_roots(result, *own);
  for (const Polynomial& f : integrals) result.integrals.push_back(text(f));
  return result;
}

/// Whether one of the bivectors, the Poisson ones in a space, gives variables.
bool SeparationSearch::look_among(const BivectorSpace& space,
                                  const std::vector<Polynomial>& integrals) {
  if (space.basis.empty()) return false;
  std::vector<Bivector> members = poisson_members(*leaves_, space.basis, watch_);
  if (members.size() > kMostExamined) members.resize(kMostExamined, members.front());
  for (const Bivector& p : members) {
    ++report_.examined;
    auto found = examine(p, integrals);
    if (!found) continue;
    report_.found.push_back(std::move(*found));
    return true;
  }
  return false;
}

/// First those that have the symmetry of the case, as these are fewer.
bool SeparationSearch::look_with(const std::vector<Polynomial>& integrals) {
  const std::vector<Reflection> reflections = reflections_of(*leaves_, integrals);
  for (int degree = 0; degree <= request_.degree; ++degree) {
    watch_.begin(fmt::format("bivectors of degree {}", degree));
    const auto space = [&](const std::vector<Reflection>& symmetric) {
      return compatible_bivectors(*leaves_, casimirs_, integrals, degree, symmetric, watch_);
    };
    if (!reflections.empty() && look_among(space(reflections), integrals)) return true;
    const BivectorSpace all = space({});
    if (degree == request_.degree) report_.none = report_.none && all.empty;
    if (look_among(all, integrals)) return true;
  }
  return false;
}

/// Why "no such bivector" says nothing of functions on the level: empty where it does.
std::optional<std::string> SeparationSearch::doubt_of_none() {
  search::System& system = leaves_->system();
  if (auto reason = search::unknown_relations(system)) return reason;
  if (auto reason = search::thin_assumptions(system)) return reason;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < leaves_->dimension(); ++i) places.push_back(i);
  if (!leaves_->on().empty() && !search::is_shown_real_and_prime(leaves_->ideal(), places))
    return "it was not shown that what vanishes on the level is a combination of its functions";
  return std::nullopt;
}

/// Reads the level, with integrals that a search up to a degree finds beside those of the case, or
/// none for 0. Whether there is something to look for; if not, the report has the reason.
bool SeparationSearch::read(const std::vector<Text>& on, int degree) {
  std::vector<NamedExpression> level;
  for (const Text& own : on) level.push_back(model_.parse_named(own));
  watch_.begin("integrals");
  const std::vector<GiNaC::ex> values = possible_integrals(model_, on, degree, watch_),
                               casimirs = possible_casimirs(model_, watch_);
  std::vector<GiNaC::ex> others = values;
  others.insert(others.end(), casimirs.begin(), casimirs.end());
  points_.clear();  // of the ring that goes, as all that follows
  casimirs_.clear();
  functions_.clear();
  leaves_.emplace(model_, level, others);
  search::System& system = leaves_->system();
  system.prover().begin_claim(values, Subject::motion);
  report_.on = names_of(level);
  report_.generic.clear();
  for (const std::size_t place : system.parameters()) report_.generic.push_back(system.name(place));
  report_.freedom = leaves_->degrees_of_freedom();
  for (const GiNaC::ex& c : casimirs) {
    const Polynomial& own = leaves_->convert(c);
    bool is_one = true;
    for (std::size_t i = 0; i < leaves_->dimension(); ++i)
      is_one = is_one && leaves_->vanishes(leaves_->bracket(leaves_->ring().variable(i), own));
    if (is_one) casimirs_.push_back(own);
  }
  for (const GiNaC::ex& f : values) {
    Polynomial own = leaves_->convert(f);
    if (functions_.empty() || leaves_->vanishes(leaves_->bracket(functions_.front(), own)))
      functions_.push_back(std::move(own));
  }
  PolynomialRows slopes;
  for (const Polynomial& f : functions_) slopes.push_back(leaves_->gradient(f));
  if (report_.freedom < 2)
    report_.reason = report_.freedom == 0 ? "the bracket is zero on the level"
                                          : "the leaves have one degree of freedom: there is "
                                            "nothing to separate";
  else if (model_.complex_numbers || !system.prover().has_no_zero_divisors(slopes))
    report_.reason = "variables that separate are searched for functions without I and |x|";
  else
    points_ = points_of(*leaves_, kPointsOfLevel);
  if (report_.reason.empty() && points_.empty())
    report_.reason = "no exact point was found inside the assumptions on the level";
  return report_.reason.empty();
}

/// Whether the question is answered, or cannot be; else there may be more integrals to look for.
bool SeparationSearch::look(const std::vector<Text>& on, int degree) {
  report_.reason.clear();
  if (!read(on, degree)) return true;
  report_.integrals.clear();
  for (const Polynomial& f : functions_) report_.integrals.push_back(text(f));
  const auto choices = commuting_choices(*leaves_, functions_, points_);
  if (choices.empty()) {
    report_.reason = fmt::format(
        "{} integrals in involution are needed whose flows are independent, the Hamiltonian being "
        "one of them; so many were not found",
        report_.freedom);
    return false;
  }
  report_.none = true;
  for (const std::vector<Polynomial>& own : choices)
    if (look_with(own)) return true;
  std::optional<std::string> doubt;
  if (report_.none) doubt = doubt_of_none();
  report_.none = report_.none && !doubt;
  report_.reason = doubt ? "no bivector of this degree was found, but " + *doubt
                   : report_.none
                       ? "no bivector of this degree obeys the conditions that are linear"
                       : "no bivector that was examined has roots in which the integrals are shown "
                         "to separate";
  return true;
}

SeparationReport SeparationSearch::run() {
  if (!obeys_jacobi(model_)) {
    report_.reason = "the bracket is not shown to obey the Jacobi identity";
    return report_;
  }
  // First with what the case claims; the search for more integrals takes longer.
  for (const int degree : {0, 2, 3, 4, 6}) {
    if (degree > kHighestInMany && model_.variables.size() > kManyCoordinates) break;
    if (look(request_.on, degree)) return report_;
    if (!request_.on.empty() || model_.conditionals.empty()) continue;
    const std::string reason = report_.reason;
    std::vector<Text> on;
    for (const NamedExpression& f : model_.conditionals.front().on)
      on.push_back({f.name, f.where, {}});
    try {
      if (look(on, degree)) return report_;
    } catch (const NotLeaves&) {
      // The case has its integral on another kind of level.
      report_.reason = reason;
      report_.on.clear();
    }
  }
  return report_;
}

}  // namespace

SeparationReport find_separation(const Model& model, const SeparationRequest& request,
                                 const search::Watch& watch) {
  const auto own = with_bracket(model, watch);
  if (!own) {
    SeparationReport report;
    report.degree = request.degree;
    report.reason = "no Poisson bracket of a degree up to 2 was found for the equations of motion";
    return report;
  }
  SeparationReport report = SeparationSearch(own->model, request, watch).run();
  report.bracket_of_motion = own->text;
  return report;
}

}  // namespace casimir::structure

#include "symbolic/structure/separation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "symbolic/search/conditions/real_ideal.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/independence.hpp"
#include "symbolic/structure/brackets.hpp"
#include "symbolic/structure/separate/bivector_ansatz.hpp"
#include "symbolic/structure/separate/commuting_integrals.hpp"
#include "symbolic/structure/separate/judge.hpp"

namespace casimir::structure {
namespace {

constexpr std::size_t kMostChoicesOfIntegrals = 6;
constexpr std::size_t kMostExamined = 60;   ///< bivectors of one space
constexpr std::size_t kPointsOfLevel = 12;  ///< that are drawn
constexpr int kHighestInMany = 4;           ///< degree of integrals where variables are many
constexpr std::size_t kManyCoordinates = 6;

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
    names_.root = free_name({"u", "v", "w", "z", "s", "lambda"});
    names_.sum = free_name({"G", "Phi", "Sigma"});
    names_.rate = free_name({"w", "v", "y", "rate"});
    if (names_.rate == names_.root) names_.rate = free_name({"rate"});
    names_.integral = free_name({"F", "K", "Q", "f"}, true);
  }

  SeparationReport run();

 private:
  bool look(const std::vector<Text>& on, int degree);
  bool read(const std::vector<Text>& on, int degree);
  std::optional<std::string> doubt_of_none();
  bool look_with(const std::vector<Polynomial>& integrals);
  bool look_among(const BivectorSpace& space, const std::vector<Polynomial>& integrals);
  std::string text(const Polynomial& p) const { return leaves_->system().functions().text(p); }
  bool is_used(const std::string& name) const;
  std::string free_name(std::initializer_list<const char*> wanted, bool is_start = false) const;
  SeparationJudge judge() { return SeparationJudge(*leaves_, casimirs_, points_, names_, watch_); }
  void read_roots();
  void look_at_roots(const std::vector<std::vector<Polynomial>>& choices);

  const Model& model_;
  const SeparationRequest& request_;
  const search::Watch& watch_;
  SeparationNames names_;
  std::vector<GiNaC::ex> roots_;  ///< the coefficients of the polynomial that was given
  std::vector<GiNaC::ex> poles_;  ///< where one of these is zero, they have no values
  std::optional<Leaves> leaves_;
  std::vector<Polynomial> casimirs_, functions_;
  std::vector<RealPoint> points_;
  SeparationReport report_;
};

bool SeparationSearch::is_used(const std::string& name) const {
  const auto is = [&](const GiNaC::symbol& own) { return own.get_name() == name; };
  const auto is_named = [&](const NamedExpression& own) { return own.name == name; };
  return std::ranges::any_of(model_.symbols(), is) ||
         std::ranges::any_of(model_.definitions, is_named) ||
         std::ranges::any_of(model_.casimirs, is_named) ||
         std::ranges::any_of(model_.integrals, is_named);
}

/// The first that the case does not use, with 1, 2, .. behind it if it is a start.
std::string SeparationSearch::free_name(std::initializer_list<const char*> wanted,
                                        bool is_start) const {
  constexpr int kMostNumbers = 9;
  for (std::string tail;; tail += "_") {
    for (const char* own : wanted) {
      const std::string name = own + tail;
      bool used = is_used(name);
      for (int k = 1; is_start && k <= kMostNumbers; ++k)
        used = used || is_used(name + std::to_string(k));
      if (!used) return name;
    }
  }
}

/// Where I stands as a word of its own; 0 where it does not.
std::size_t place_of_imaginary_unit(const std::string& text) {
  const auto is_of_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t i = text.find('I'); i != std::string::npos; i = text.find('I', i + 1))
    if ((i == 0 || !is_of_name(text[i - 1])) && (i + 1 == text.size() || !is_of_name(text[i + 1])))
      return i;
  return 0;
}

/// The roots may be complex, the coefficients are real functions: points are certified for these.
void refuse_complex(const GiNaC::ex& given, const Text& text) {
  const auto is_complex = [](const GiNaC::ex& part) {
    return GiNaC::is_exactly_a<GiNaC::numeric>(part) &&
           !GiNaC::ex_to<GiNaC::numeric>(part).is_real();
  };
  if (std::none_of(given.preorder_begin(), given.preorder_end(), is_complex)) return;
  throw text.error("the polynomial has to be real, without I", place_of_imaginary_unit(text.value));
}

/// What is divided by may vanish identically in a way that is hidden, as sin(x)^2 + cos(x)^2 - 1.
/// \param coefficients  divided by the leading one
void check_coefficients(const Model& model, const GiNaC::ex& leading,
                        const std::vector<GiNaC::ex>& coefficients, const Text& text) {
  const auto is_polynomial = [](const GiNaC::ex& own) {
    return own.info(GiNaC::info_flags::polynomial);
  };
  if (GiNaC::is_exactly_a<GiNaC::numeric>(leading) &&
      std::ranges::all_of(coefficients, is_polynomial))
    return;
  try {
    Prover alone(model, {leading});
    if (alone.ring().reduced(alone.convert(leading)).is_zero())
      throw text.error(fmt::format("the leading coefficient of '{}' is identically zero",
                                   printable(text.value)));
    Prover prover(model, coefficients);
    for (const GiNaC::ex& own : coefficients) prover.convert(own);
  } catch (const TooLarge&) {
    throw;
  } catch (const ModelError& problem) {
    throw text.error(problem.what());
  }
}

/// The coefficients of the polynomial that was given, where the highest one is 1.
void SeparationSearch::read_roots() {
  if (!request_.roots) return;
  const GiNaC::symbol u(names_.root);
  Model with_root = model_;
  with_root.parameters.push_back(u);
  const GiNaC::ex given = with_root.parse(*request_.roots).expand();
  refuse_complex(given, *request_.roots);
  if (!given.is_polynomial(u) || given.degree(u) < 1)
    throw request_.roots->error(fmt::format("'{}' is not a polynomial in {}",
                                            printable(request_.roots->value), names_.root));
  const int n = given.degree(u);
  const GiNaC::ex leading = given.coeff(u, n);
  poles_.push_back(leading);
  for (int k = 1; k <= n; ++k) {
    const GiNaC::ex own = given.coeff(u, n - k);
    poles_.push_back(own.normal().denom());
    roots_.push_back((own / leading).normal());
  }
  check_coefficients(model_, leading, roots_, *request_.roots);
}

/// The first choice of integrals that separate in the roots, or else the first that are not shown
/// not to; what is refuted is so for all choices.
void SeparationSearch::look_at_roots(const std::vector<std::vector<Polynomial>>& choices) {
  if (roots_.size() != *report_.freedom)
    throw request_.roots->error(
        fmt::format("a polynomial of degree {} is needed, as the leaves have "
                    "dimension {}; this one has degree {}",
                    *report_.freedom, 2 * *report_.freedom, roots_.size()));
  RootCoefficients a;
  for (const GiNaC::ex& own : roots_) a.push_back(leaves_->convert(own));
  std::vector<Polynomial> poles;
  for (const GiNaC::ex& own : poles_)
    if (!GiNaC::is_a<GiNaC::numeric>(own)) poles.push_back(leaves_->convert(own));
  for (const std::vector<Polynomial>& integrals : choices) {
    Separation own = judge().of_roots(a, poles, integrals);
    const bool is_better =
        report_.found.empty() || own.separated == Verdict::proved ||
        (report_.found.front().separated == Verdict::refuted && own.separated != Verdict::refuted);
    if (is_better) {
      report_.found.clear();
      report_.found.push_back(std::move(own));
    }
    if (report_.found.front().separated == Verdict::proved) return;
  }
}

/// Whether one of the bivectors, the Poisson ones in a space, gives variables.
bool SeparationSearch::look_among(const BivectorSpace& space,
                                  const std::vector<Polynomial>& integrals) {
  if (space.basis.empty()) return false;
  std::vector<Bivector> members = poisson_members(*leaves_, space.basis, watch_);
  if (members.size() > kMostExamined) members.resize(kMostExamined, members.front());
  for (const Bivector& p : members) {
    ++report_.examined;
    auto found = judge().of_bivector(p, integrals);
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
  if (auto reason = search::thin_domain(system)) return reason;
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
  for (const NamedExpression& own : model_.constraints) others.push_back(own.value);
  others.insert(others.end(), roots_.begin(), roots_.end());
  others.insert(others.end(), poles_.begin(), poles_.end());
  points_.clear();  // of the ring that goes, as all that follows
  casimirs_.clear();
  functions_.clear();
  leaves_.emplace(model_, level, others);
  search::System& system = leaves_->system();
  std::vector<GiNaC::ex> domain = values;
  domain.insert(domain.end(), roots_.begin(), roots_.end());
  system.prover().begin_claim(domain, Subject::motion);
  report_.on = names_of(level);
  report_.generic.clear();
  report_.generic = system.generic_parameters();
  const std::size_t n = leaves_->degrees_of_freedom();
  report_.freedom = n;
  report_.not_used.clear();
  for (const NamedExpression& own : model_.constraints)
    if (!leaves_->vanishes(leaves_->convert(own.value)))
      report_.not_used.push_back(text(leaves_->convert(own.value)));
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
  if (n < 2)
    report_.reason = n == 0 ? "the bracket is zero on the level"
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
  const auto choices = commuting_choices(*leaves_, functions_, points_, kMostChoicesOfIntegrals);
  if (choices.empty()) {
    report_.reason = fmt::format(
        "{} integrals in involution are needed whose flows are independent, the Hamiltonian being "
        "one of them; so many were not found",
        *report_.freedom);
    return false;
  }
  if (request_.roots) {
    look_at_roots(choices);
    return true;
  }
  report_.none = true;
  for (const std::vector<Polynomial>& own : choices)
    if (look_with(own)) return true;
  report_.involved.clear();
  for (const Polynomial& f : choices.front()) report_.involved.push_back(text(f));
  std::optional<std::string> doubt;
  if (report_.none && choices.size() > 1)
    doubt = "the Hamiltonian has more integrals than these, of which other combinations may do";
  else if (report_.none)
    doubt = doubt_of_none();
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
  read_roots();
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

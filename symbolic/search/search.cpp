#include "symbolic/search/search.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/functions/short_text.hpp"
#include "symbolic/proof/thin_domain.hpp"
#include "symbolic/search/conditions/real_ideal.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/independence.hpp"
#include "symbolic/search/not_constant.hpp"

namespace casimir::search {
namespace {

NamedExpression read(const Model& model, const Text& text) {
  return {text.value, model.parse(text), text.where};
}

std::vector<NamedExpression> read(const Model& model, const std::vector<Text>& texts) {
  std::vector<NamedExpression> result;
  for (const Text& text : texts) result.push_back(read(model, text));
  return result;
}

std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& list,
                                 const std::vector<NamedExpression>& more) {
  std::vector<GiNaC::ex> result;
  for (const NamedExpression& f : list) result.push_back(f.value);
  for (const NamedExpression& f : more) result.push_back(f.value);
  return result;
}

}  // namespace

Finder::Finder(const Model& model, const Request& request, const Watch& watch)
    : model_(model),
      request_(request),
      watch_(watch),
      on_(read(model, request.on)),
      known_(request.known),
      system_(model, read(model, request.functions), values_of(on_, known_),
              request.denominators && on_.empty() ? System::Denominators::atoms
                                                  : System::Denominators::multiplied_out),
      degrees_(system_, request) {}

/// The polynomial Casimir functions, degree by degree, until there are as many independent ones as
/// the rank of the bracket leaves room for.
std::vector<Generator> Finder::casimirs_as_needed() {
  if (!model_.poisson || request_.casimirs_are_integrals) return {};
  Problem problem;
  problem.fields = {system_.atoms(), system_.coordinate_flows(), system_.plain_coordinate_flows()};
  // The time and functions of it alone would be some of them: they are numbers here. Functions of
  // Casimir functions are answers, and coefficients of others.
  for (std::size_t k = problem.fields.places.size(); k-- > model_.variables.size();) {
    const std::vector<Polynomial> slopes =
        system_.gradient(system_.ring().variable(problem.fields.places[k]));
    if (std::any_of(slopes.begin(), slopes.begin() + model_.variables.size(),
                    [](const Polynomial& slope) { return !slope.is_zero(); }))
      continue;
    const auto place = static_cast<std::ptrdiff_t>(k);
    problem.fields.places.erase(problem.fields.places.begin() + place);
    for (auto& row : problem.fields.rates) row.erase(row.begin() + place);
    // At points where a number of these has other values, they would be no numbers.
    problem.fields.plain.clear();
  }
  degrees_.set(problem);
  // The rank of the bracket at a random point is a lower bound of the generic one.
  std::size_t rank = 0;
  {
    const Modulus modulus = usable_modulus(system_);
    std::mt19937_64 random(3);
    const std::optional<Point> point = system_.random_point(modulus, random);
    Span span(modulus);
    for (const auto& row : problem.fields.rates) {
      if (!point) break;
      std::vector<Residue> values;
      for (std::size_t i = 0; i < model_.variables.size(); ++i)
        values.push_back(value_at(row[i], *point, modulus).value_or(0));
      span.insert(std::move(values));
    }
    rank = span.dimension();
  }
  std::vector<Polynomial> functions;
  if (request_.casimirs) {
    watch_.begin("Casimir functions");
    Solution solution = solve(system_, problem, watch_);
    // Nothing but the constants is annihilated by all fields of the coordinates.
    if (rank == model_.variables.size() && solution.found.empty()) {
      solution.complete = true;
      solution.reason.clear();
    }
    take(solution);
    drop_constants(solution.found);
    return solution.found;
  }
  const std::size_t room = model_.variables.size() - rank;
  const int highest = problem.degree;
  for (int degree = degrees_.is_limited() ? highest : 1; degree <= highest; ++degree) {
    if (rank_of_gradients(system_, functions) >= room) break;
    problem.degree = degree;
    watch_.begin(fmt::format("Casimir functions of degree {}", degree));
    const Solution solution = solve(system_, problem, watch_);
    for (const Generator& g : solution.found) {
      problem.known.push_back(g);
      functions.push_back(g.function);
    }
  }
  return problem.known;
}

Problem Finder::integral_problem(std::vector<Generator> known) {
  Problem problem;
  problem.fields = {system_.atoms(), {system_.flow()}, {system_.plain_flow()}};
  degrees_.set(problem);
  problem.known = std::move(known);
  for (const NamedExpression& f : on_) {
    Polynomial numerator = system_.prover().ring().numerator(system_.prover().convert(f.value));
    if (!system_.in_atoms(numerator)) {
      throw ModelError(fmt::format("'{}' is not a polynomial in the variables of the ansatz",
                                   printable(f.name)));
    }
    problem.on.push_back(std::move(numerator));
  }
  return problem;
}

/// On a level that the motion leaves there are no integrals to speak of. And that the rate of a
/// function vanishes on the level is the same as that it has cofactors only where the level's
/// functions generate the ideal of all that vanish there.
void Finder::check_level() {
  if (on_.empty()) return;
  Proof proof;
  system_.prover().decide_invariance(proof, on_);
  if (proof.verdict == Verdict::refuted)
    throw request_.on[0].error("the level that is searched is not invariant: " + proof.reason);
  if (proof.verdict == Verdict::undecided) {
    level_reason_ = "whether the level is invariant is undecided";
  } else if (!system_.relations().empty() ||
             !is_shown_real_and_prime(integral_problem({}).on, system_.atoms())) {
    level_reason_ =
        "it was not shown that what vanishes at all real points of the level is a combination of "
        "its functions with polynomials";
  }
}

std::optional<std::string> thin_domain(System& system) { return thin_domain(system.prover()); }

/// What else has to hold, for "no other" to be about functions.
void Finder::doubt() {
  const auto undecided = [&](const std::optional<std::string>& reason) {
    if (!report_.complete || !reason) return;
    report_.complete = false;
    report_.reason = *reason;
  };
  undecided(level_reason_);
  undecided(unknown_relations(system_));
  if (report_.complete) undecided(thin_domain(system_));
}

/// What is not zero in the ring may still be zero as a function: atan(-x) + atan(x).
void Finder::drop_constants(std::vector<Generator>& found) {
  if (!unknown_relations(system_)) return;  // independent functions
  const FunctionRing& ring = system_.functions();
  std::erase_if(found, [&](const Generator& g) {
    return !is_certainly_not_constant(model_, system_.expression(ring.reduced(g.function)));
  });
}

void Finder::take(const Solution& solution) {
  report_.trivial = solution.trivial;
  report_.complete = solution.complete;
  report_.reason = solution.reason;
  report_.unknowns = solution.unknowns;
  report_.equations = solution.equations;
  report_.blocks = solution.blocks;
  report_.largest_block = solution.largest_block;
  doubt();
}

std::vector<Found> Finder::described(const std::vector<Generator>& generators,
                                     const std::vector<Generator>& known, ClaimKind kind) {
  std::vector<Polynomial> functions;
  for (const Generator& g : known) functions.push_back(g.function);
  std::size_t rank = rank_of_gradients(system_, functions);
  std::vector<Found> list;
  for (const Generator& g : generators) {
    Found found;
    const FunctionRing& ring = system_.prover().ring();
    const Polynomial function = ring.reduced(g.function);
    found.value = system_.expression(function);
    found.text = short_text(ring, function, system_.is_constant());
    found.degree = degrees_.degree_of(g.function);
    functions.push_back(g.function);
    const std::size_t next = rank_of_gradients(system_, functions);
    found.independent = next > rank;
    rank = next;
    list.push_back(std::move(found));
  }
  prove_all(list, kind);
  return list;
}

void Finder::prove_all(std::vector<Found>& list, ClaimKind kind) const {
  for (Found& found : list) {
    found.verdict = prove_claim(model_, kind, {found.text, found.value, {}}, on_).verdict;
    watch_.tick(1);
  }
}

Report Finder::run() {
  check_level();
  report_.kind = request_.casimirs ? ClaimKind::casimir
                 : on_.empty()     ? ClaimKind::integral
                                   : ClaimKind::conditional;
  report_.generic = system_.generic_parameters();
  report_.functions = system_.names_of_functions();
  report_.weights = degrees_.named_weights();
  report_.degree_in = degrees_.named_limits();
  std::vector<Generator> casimirs = casimirs_as_needed();
  if (request_.casimirs) {
    report_.found = described(casimirs, {}, ClaimKind::casimir);
  } else {
    report_.casimirs = described(casimirs, {}, ClaimKind::casimir);
    std::vector<Generator> known = casimirs;
    if (const std::optional<Polynomial> h = system_.hamiltonian()) {
      known.push_back({*h, degrees_.order_of(*h)});
      report_.hamiltonian = true;
    }
    for (const NamedExpression& f : known_) {
      const Polynomial p = system_.prover().ring().reduced(system_.prover().convert(f.value));
      if (system_.in_atoms(p)) known.push_back({p, degrees_.order_of(p)});
    }
    std::erase_if(known, [](const Generator& g) { return g.degree == 0; });
    const Problem problem = integral_problem(known);
    watch_.begin(fmt::format("integrals of degree {}", request_.degree));
    Solution solution = solve(system_, problem, watch_);
    take(solution);
    drop_constants(solution.found);
    report_.found = described(solution.found, known, report_.kind);
  }
  for (const Found& found : report_.found) {
    if (found.verdict == Verdict::proved) continue;
    report_.complete = false;
    report_.reason = fmt::format("'{}' was found but not proved", found.text);
  }
  return report_;
}

Report find_integrals(const Model& model, const Request& request, const Watch& watch) {
  if (request.degree < 0 && request.degree_in.empty())
    throw ModelError("the degree of a search is not negative");
  if (request.casimirs && !model.poisson)
    throw ModelError("a Casimir function needs a bracket, which this case does not have");
  return Finder(model, request, watch).run();
}

}  // namespace casimir::search

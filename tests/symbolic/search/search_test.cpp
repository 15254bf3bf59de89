// The search for integrals against what is known of the cases, and its parts against FLINT.
#include <flint/nmod_mat.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "symbolic/case/limits.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/search/exponents.hpp"
#include "symbolic/search/modular/echelon.hpp"
#include "symbolic/search/search.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

using search::Echelon;
using search::Entry;
using search::Modulus;
using search::Residue;

using Rows = std::vector<std::vector<Entry>>;

Rows random_rows(std::size_t rows, std::size_t columns, std::size_t in_a_row,
                 const Modulus& modulus, std::mt19937_64& random) {
  Rows result;
  for (std::size_t i = 0; i < rows; ++i) {
    // Every third is a combination of the two before it.
    std::vector<Residue> values(columns, 0);
    if (i % 3 == 2) {
      for (std::size_t k = i - 2; k < i; ++k)
        for (const Entry& e : result[k]) values[e.column] = modulus.add(values[e.column], e.value);
    } else {
      for (std::size_t k = 0; k < in_a_row; ++k)
        values[random() % columns] = modulus.random(random);
    }
    auto& row = result.emplace_back();
    for (std::uint32_t c = 0; c < columns; ++c)
      if (values[c] != 0) row.push_back({c, values[c]});
  }
  return result;
}

std::size_t rank_by_flint(const Rows& rows, std::size_t columns, const Modulus& modulus) {
  nmod_mat_t matrix;
  nmod_mat_init(matrix, static_cast<slong>(rows.size()), static_cast<slong>(columns),
                modulus.prime());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Entry& e : rows[i]) nmod_mat_entry(matrix, i, e.column) = e.value;
  const slong rank = nmod_mat_rref(matrix);
  nmod_mat_clear(matrix);
  return static_cast<std::size_t>(rank);
}

TEST(Echelon, HasTheRankOfFlintAndABasisThatSolvesEveryEquation) {
  std::mt19937_64 random(3);
  for (const auto& [rows, columns, in_a_row] : std::vector<std::array<std::size_t, 3>>{
           {30, 40, 3}, {300, 250, 2}, {700, 400, 12}, {500, 600, 200}}) {
    const Modulus modulus = Modulus::nth(rows);
    const Rows matrix = random_rows(rows, columns, in_a_row, modulus, random);
    const Echelon echelon(modulus, matrix, columns, {});
    EXPECT_EQ(echelon.rank(), rank_by_flint(matrix, columns, modulus)) << rows;
    const auto basis = echelon.null_basis();
    EXPECT_EQ(basis.size(), columns - echelon.rank());
    for (std::size_t i = 0; i < basis.size(); i += 1 + basis.size() / 8) {
      const auto& vector = basis[i];
      for (const auto& row : matrix) {
        Residue sum = 0;
        for (const Entry& e : row)
          sum = modulus.add(sum, modulus.multiply(e.value, vector[e.column]));
        ASSERT_EQ(sum, 0U);
      }
    }
  }
}

TEST(Modular, FractionsComeBackFromTheirResidues) {
  const Modulus a = Modulus::nth(0), b = Modulus::nth(1);
  const cln::cl_RA number = cln::cl_RA(-123456) / 78125;
  const cln::cl_I both = search::chinese_remainder(
      cln::cl_I(static_cast<unsigned long>(*a.reduce(number))),
      cln::cl_I(static_cast<unsigned long>(a.prime())), *b.reduce(number), b);
  const auto back = search::rational_from(both, cln::cl_I(static_cast<unsigned long>(a.prime())) *
                                                    static_cast<unsigned long>(b.prime()));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(*back, number);
}

/// The degree of a polynomial in the variables; empty for another function of them.
std::optional<int> polynomial_degree(const Model& model, const GiNaC::ex& f) {
  GiNaC::lst variables;
  for (const GiNaC::symbol& s : model.variables) variables.append(s);
  if (!f.is_polynomial(variables)) return std::nullopt;
  const GiNaC::symbol scale;
  GiNaC::exmap scaled;
  for (const GiNaC::symbol& s : model.variables) scaled[s] = s * scale;
  return f.subs(scaled, GiNaC::subs_options::no_pattern).expand().degree(scale);
}

/// The rank of the gradients at a point with random coordinates, by GiNaC alone.
std::size_t gradient_rank_by_ginac(const Model& model, const std::vector<GiNaC::ex>& functions) {
  std::mt19937 random(9);
  GiNaC::exmap point;
  for (const auto* list : {&model.variables, &model.parameters})
    for (const GiNaC::symbol& s : *list)
      point[s] = GiNaC::numeric(static_cast<long>(random() % 1000 + 1), 7);
  GiNaC::matrix gradients(static_cast<unsigned>(functions.size()),
                          static_cast<unsigned>(model.variables.size()));
  for (unsigned i = 0; i < functions.size(); ++i)
    for (unsigned j = 0; j < model.variables.size(); ++j)
      gradients(i, j) = functions[i]
                            .diff(model.variables[j])
                            .subs(point, GiNaC::subs_options::no_pattern)
                            .normal();
  return gradients.rank();
}

/// The same by elimination in floating point, for functions that have no rational values.
std::size_t numeric_gradient_rank(const Model& model, const std::vector<GiNaC::ex>& functions) {
  std::mt19937 random(9);
  GiNaC::exmap point;
  for (const auto* list : {&model.variables, &model.parameters})
    for (const GiNaC::symbol& s : *list) point[s] = static_cast<double>(random() % 1000 + 1) / 700;
  std::vector<std::vector<double>> rows;
  for (const GiNaC::ex& f : functions) {
    auto& row = rows.emplace_back();
    for (const GiNaC::symbol& s : model.variables) {
      const GiNaC::ex value = f.diff(s).subs(point, GiNaC::subs_options::no_pattern).evalf();
      row.push_back(GiNaC::ex_to<GiNaC::numeric>(value).to_double());
    }
  }
  std::size_t rank = 0;
  for (; rank < rows.size(); ++rank) {
    std::size_t row = rank, column = 0;
    for (std::size_t i = rank; i < rows.size(); ++i)
      for (std::size_t j = 0; j < rows[i].size(); ++j)
        if (std::abs(rows[i][j]) > std::abs(rows[row][column])) row = i, column = j;
    if (std::abs(rows[row][column]) < 1e-9) break;
    std::swap(rows[row], rows[rank]);
    for (std::size_t i = rank + 1; i < rows.size(); ++i) {
      const double factor = rows[i][column] / rows[rank][column];
      for (std::size_t j = 0; j < rows[i].size(); ++j) rows[i][j] -= factor * rows[rank][j];
    }
  }
  return rank;
}

// With no hint but the Hamiltonian: the integrals of the file are functions of what is found.
TEST(Search, RediscoversEveryPolynomialIntegralOfTheCasesUpToDegreeFour) {
  std::size_t rediscovered = 0;
  // Their equations are so entangled by roots that a search takes longer than a test may, or is
  // refused.
  const std::set<std::string> too_long{"andoyer",
                                       "andoyer-lagrange",
                                       "gas-cloud-monatomic",
                                       "self-gravitating-ellipsoid",
                                       "self-gravitating-spheroid",
                                       "three-bodies-plane"};
  for (const auto& path : bundled_cases()) {
    if (too_long.contains(path.stem())) continue;
    const CaseFile file = read_case(path);
    Model model = build_model(file);
    const bool polynomial = std::ranges::all_of(
        model.field, [&](const auto& f) { return polynomial_degree(model, f).has_value(); });
    if (!polynomial && !file.scenes.empty()) model = build_model(file, file.scenes[0].parameters);
    std::vector<std::pair<std::string, GiNaC::ex>> declared;
    int degree = 0;
    for (const auto* list : {&model.casimirs, &model.integrals}) {
      for (const NamedExpression& f : *list) {
        const std::optional<int> own = polynomial_degree(model, f.value);
        if (!own || *own > 4 || *own < 1) continue;
        declared.emplace_back(f.name, f.value);
        degree = std::max(degree, *own);
      }
    }
    if (degree == 0) continue;
    const auto rank_of = polynomial ? gradient_rank_by_ginac : numeric_gradient_rank;
    const search::Report report = search::find_integrals(model, up_to(degree));
    EXPECT_TRUE(report.complete) << path << ": " << report.reason;
    std::vector<GiNaC::ex> found;
    if (report.hamiltonian) found.push_back(*model.hamiltonian);
    for (const auto* list : {&report.casimirs, &report.found}) {
      for (const search::Found& f : *list) {
        EXPECT_EQ(f.verdict, Verdict::proved) << path << ": " << f.text;
        found.push_back(model.parse(text(f.text)));
      }
    }
    const std::size_t rank = rank_of(model, found);
    for (const auto& [name, f] : declared) {
      std::vector<GiNaC::ex> more = found;
      more.push_back(f);
      EXPECT_EQ(rank_of(model, more), rank) << path << ": " << name;
      ++rediscovered;
    }
  }
  EXPECT_GT(rediscovered, 100U);
}

TEST(Search, SaysThatThereIsNoneWhereThereIsNone) {
  const Model model = model_of(euler_poisson("(2*M1^2 + 3*M2^2 + 7*M3^2)/2 - g1 + 5*g2 - 11*g3"));
  for (int degree = 1; degree <= 5; ++degree) {
    const search::Report report = search::find_integrals(model, up_to(degree));
    EXPECT_TRUE(report.complete) << degree;
    EXPECT_TRUE(report.found.empty()) << degree;
  }
}

TEST(Search, SymbolicParametersFindWhatNumbersFind) {
  const std::string hamiltonian =
      "(a1*M1^2 + a2*M2^2 + a3*M3^2)/2 + s*(a2*a3*g1^2 + a3*a1*g2^2 + a1*a2*g3^2)/2";
  const Model symbolic =
      model_of(euler_poisson(hamiltonian, "a1 = {}\na2 = {}\na3 = {}\ns = {}\n"));
  const search::Report general = search::find_integrals(symbolic, up_to(2));
  ASSERT_EQ(general.found.size(), 1U);
  EXPECT_EQ(general.generic, (std::vector<std::string>{"a1", "a2", "a3", "s"}));
  const Model numbers =
      model_of(euler_poisson("(M1^2 + 2*M2^2 + 5*M3^2)/2 + 3*(10*g1^2 + 5*g2^2 + 2*g3^2)/2"));
  EXPECT_EQ(search::find_integrals(numbers, up_to(2)).found.size(), 1U);
}

TEST(Search, EquationsWithoutABracket) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = \"y*z\"\ny = \"-2*x*z\"\n"
      "z = \"x*y\"\n");
  const search::Report report = search::find_integrals(model, up_to(2));
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(report.found.size(), 2U);
  EXPECT_EQ(report.found[0].text, "2*x^2 + y^2");
  EXPECT_EQ(report.found[1].text, "(x + z)*(x - z)");  // the proof is about what is printed
}

TEST(Search, AnIntegralOnALevelHasItsCofactor) {
  const Model model = model_of(euler_poisson("(M1^2 + M2^2 + 4*M3^2)/2 - r*g1", "r = {}\n"));
  EXPECT_TRUE(search::find_integrals(model, up_to(3)).found.empty());
  search::Request request = up_to(3);
  request.on = {text("M1*g1 + M2*g2 + M3*g3")};
  const search::Report report = search::find_integrals(model, request);
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].degree, 3);
  EXPECT_EQ(report.found[0].verdict, Verdict::proved);
}

TEST(Search, DeclaredFunctionsAreUnknownsToo) {
  // r^2 = x^2 + y^2: the integral that Laplace found has 1/r in it.
  const Model model = model_of(
      "hamiltonian = \"(px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)\"\n[phase_space]\n"
      "variables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n");
  EXPECT_EQ(search::find_integrals(model, up_to(2)).found.size(), 1U);  // the angular momentum
  search::Request request = up_to(3);
  request.functions = {text("1/sqrt(x^2 + y^2)")};
  const search::Report report = search::find_integrals(model, request);
  EXPECT_GE(report.found.size(), 3U);
  for (const search::Found& f : report.found) EXPECT_EQ(f.verdict, Verdict::proved) << f.text;
}

TEST(Search, WeightsCountTheDegree) {
  const Model model = model_of(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1"));
  search::Request request = up_to(4);
  for (const char* name : {"g1", "g2", "g3"}) request.weights.emplace_back(text(name), text("2"));
  const search::Report report = search::find_integrals(model, request);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].degree, 4);
  request.weights = {{text("g4"), text("2")}};
  EXPECT_THROW(search::find_integrals(model, request), CaseError);
  request.weights = {{text("g1"), text("0")}};
  EXPECT_THROW(search::find_integrals(model, request), CaseError);
}

TEST(Search, RefusesWhatDoesNotFitBeforeItTakesIt) {
  const Model model = model_of(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1"));
  try {
    search::find_integrals(model, up_to(60));
    FAIL() << "no refusal";
  } catch (const search::TooMuchMemory& problem) {
    EXPECT_NE(std::string(problem.what()).find("GB"), std::string::npos);
  }
}

TEST(Search, StopsWhereItIsTold) {
  const Model model = model_of(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1"));
  search::Watch watch;
  watch.tick = [](double) { throw search::TimeUp(); };
  EXPECT_THROW(search::find_integrals(model, up_to(4), watch), search::TimeUp);
}

std::vector<std::string> values_of(const search::ConditionReport& report) {
  std::vector<std::string> result;
  for (const search::Condition& condition : report.conditions) {
    EXPECT_EQ(condition.verdict, Verdict::proved);
    std::string line;
    for (const auto& [name, value] : condition.parameters)
      line += (line.empty() ? "" : ", ") + name + " = " + value;
    result.push_back(line);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Conditions, KovalevskayaAndLagrange) {
  const Model model =
      model_of(euler_poisson("(M1^2 + M2^2 + a3*M3^2)/2 - r*g1", "a3 = {}\nr = {}\n"));
  const auto report = search::find_conditions(model, up_to(4), {text("a3")});
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_EQ(values_of(report), (std::vector<std::string>{"a3 = 1", "a3 = 2"}));
}

TEST(Conditions, GoryachevAndChaplyginOnTheirLevel) {
  const Model model =
      model_of(euler_poisson("(M1^2 + M2^2 + a3*M3^2)/2 - r*g1", "a3 = {}\nr = {}\n"));
  search::Request request = up_to(3);
  request.on = {text("M1*g1 + M2*g2 + M3*g3")};
  const auto report = search::find_conditions(model, request, {text("a3")});
  EXPECT_EQ(values_of(report), (std::vector<std::string>{"a3 = 1", "a3 = 4"}));
}

TEST(Conditions, ClebschsIsASurface) {
  const Model model =
      model_of(euler_poisson("(a1*M1^2 + a2*M2^2 + a3*M3^2)/2 + (c1*g1^2 + c2*g2^2 + c3*g3^2)/2",
                             "a1 = {}\na2 = {}\na3 = {}\nc1 = {}\nc2 = {}\nc3 = {}\n"));
  const auto report = search::find_conditions(model, up_to(2), {text("c3")});
  ASSERT_EQ(report.conditions.size(), 1U);
  EXPECT_EQ(report.conditions[0].verdict, Verdict::proved);
  // (c2 - c3)/a1 + (c3 - c1)/a2 + (c1 - c2)/a3 = 0, by GiNaC.
  const GiNaC::ex relation = model.parse(text(report.conditions[0].relation));
  const GiNaC::ex clebsch =
      model.parse(text("a2*a3*(c2 - c3) + a3*a1*(c3 - c1) + a1*a2*(c1 - c2)"));
  EXPECT_TRUE((relation - clebsch).expand().is_zero() || (relation + clebsch).expand().is_zero())
      << report.conditions[0].relation;
}

TEST(Conditions, TwoParametersHaveCurvesAndPoints) {
  const Model model =
      model_of(euler_poisson("(M1^2 + a2*M2^2 + a3*M3^2)/2 - g1", "a2 = {}\na3 = {}\n"));
  const auto report = search::find_conditions(model, up_to(4), {text("a2"), text("a3")});
  EXPECT_EQ(values_of(report),
            (std::vector<std::string>{"a2 = 1, a3 = 2", "a2 = 2, a3 = 1", "a3 = a2"}));
}

TEST(Conditions, AnUnknownParameterIsNamed) {
  const Model model = model_of(euler_poisson("(M1^2 + M2^2 + a3*M3^2)/2", "a3 = {}\n"));
  EXPECT_THROW(search::find_conditions(model, up_to(2), {text("a4")}), CaseError);
  EXPECT_THROW(search::find_conditions(model, up_to(2), {text("a3"), text("a3")}), CaseError);
}

/// a - |a| is linear in a and is no equation for it: its solutions are all a >= 0.
TEST(Search, OfConditionsThatAnAbsoluteValueHidesNoValueIsMade) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"abs(a)*x\"\ny = "
      "\"-a*y\"\n[parameters]\na = {}\n");
  const auto report = search::find_conditions(model, up_to(2), {text("a")});
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(report.reason.find("another case"), std::string::npos) << report.reason;
  const auto left = std::ranges::find_if(
      report.conditions, [](const auto& own) { return own.verdict == Verdict::undecided; });
  ASSERT_NE(left, report.conditions.end());
  EXPECT_EQ(left->relation, "a - sqrt(a^2)");
  EXPECT_TRUE(left->values.empty());
}

TEST(Search, RootsOfConditionsAreInLowestTerms) {
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"(a^2 - 3)*y^2\"\ny = \"x "
      "+ (2*a^2 - 2*a - 1)*y\"\n[parameters]\na = {}\n");
  const auto report = search::find_conditions(model, up_to(2), {text("a")});
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(report.conditions.size(), 2U);
  EXPECT_EQ(report.conditions[0].parameters[0].second, "sqrt(3)");
  EXPECT_EQ(report.conditions[1].parameters[0].second, "-sqrt(3)");
}

TEST(Darboux, FindsHessAndNothingElse) {
  const auto report = search::find_darboux(
      model_of(euler_poisson("(a1*(M1^2 + M2^2) + a3*M3^2 + 2*b*M1*M3)/2 + r*g3",
                             "a1 = {}\na3 = {}\nb = {}\nr = {}\n")),
      1);
  EXPECT_TRUE(report.complete) << report.reason;
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].text, "M3");
  EXPECT_EQ(report.found[0].cofactor, "-M2*b");
  EXPECT_EQ(report.found[0].verdict, Verdict::proved);
  const auto none =
      search::find_darboux(model_of(euler_poisson("(M1^2 + M2^2 + 2*M3^2)/2 - g1")), 1);
  EXPECT_TRUE(none.complete);
  EXPECT_TRUE(none.found.empty());
}

/// Jouanolou's system, which has no Darboux polynomial, in linear coordinates: its Groebner bases
/// have numbers that grow by a factor in each step.
TEST(Darboux, EndsWhereTheNumbersGrow) {
  const auto report = search::find_darboux(
      model_of("[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\n"
               "x = \"(y + z)^2\"\ny = \"(z - x)^2\"\nz = \"(x + 2*y)^2\"\n"),
      2);
  EXPECT_FALSE(report.complete);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_TRUE(report.found.empty());
}

TEST(Darboux, EndsAtTheLimitOfWork) {
  Limits small;
  small.work = 100;
  const Model model = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\n"
      "x = \"(y + z)^2\"\ny = \"(z - x)^2\"\nz = \"(x + 2*y)^2\"\n",
      small);
  const auto darboux = search::find_darboux(model, 2);
  const auto exponents = search::kovalevskaya_exponents(model, {});
  for (const auto& [complete, reason] : {std::pair(darboux.complete, darboux.reason),
                                         std::pair(exponents.complete, exponents.reason)}) {
    EXPECT_FALSE(complete);
    EXPECT_NE(reason.find("'work'"), std::string::npos) << reason;
  }
}

/// Roots of one another: of the solutions of the equations all but a few say how the relations
/// between the roots hang together.
TEST(Search, OfNestedRootsLooksAtNoRelationsAlone) {
  const std::string root = "sqrt((q2 - q2^2)^2 + q2^2)";
  const auto report = search::find_integrals(
      model_of("hamiltonian = \"(p1^2 + p2^2)/2 + q1^2*(2*sqrt((q2^2 - q2)^2) - sqrt(2*" + root +
               " + 2*q2)*sqrt(2*" + root +
               " - 2*q2))\"\n[phase_space]\nvariables = [\"q1\", \"q2\", \"p1\", \"p2\"]\n"
               "canonical = true\n"),
      up_to(1));
  EXPECT_FALSE(report.complete);
}

}  // namespace
}  // namespace casimir::test

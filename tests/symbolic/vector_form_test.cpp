// Brackets in the shorthand of vectors, and that no form is given where there is none.
#include "symbolic/vector_form.hpp"

#include <gtest/gtest.h>

#include "tests/bundled_cases.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir {
namespace {

using test::model_of;

std::vector<std::string> vectors(const VectorForm& form) {
  std::vector<std::string> names;
  for (const Block& block : form.blocks) {
    if (block.is_vector()) names.push_back(block.name);
  }
  return names;
}

std::vector<std::string> vectors(const Model& model) {
  const auto form = find_vector_form(*model.poisson);
  return form ? vectors(*form) : std::vector<std::string>{};
}

Model with_algebra(const std::string& algebra, const std::string& variables,
                   const std::string& hamiltonian) {
  return model_of("hamiltonian = \"" + hamiltonian + "\"\n[phase_space]\nvariables = [" +
                  variables + "]\nalgebra = \"" + algebra + "\"\n");
}

const std::string kM = R"("M1", "M2", "M3")";
const std::string kG = R"("g1", "g2", "g3")";

/// {M_i, g_j} = -eps_ijk g_k as lines of a case file, with one of them replaced.
std::string rotation(const std::string& g, const std::string& bent_key = "",
                     const std::string& bent_value = "") {
  std::string lines;
  const char* rows[][3] = {{"1", "2", "-%3"}, {"1", "3", "%2"},  {"2", "1", "%3"},
                           {"2", "3", "-%1"}, {"3", "1", "-%2"}, {"3", "2", "%1"}};
  for (const auto& [i, j, value] : rows) {
    if (g == "M" && *i > *j) continue;
    const std::string key = std::string("M") + i + "," + g + j;
    std::string text = value;
    text.replace(text.find('%'), 1, g);
    lines += "\"" + key + "\" = \"" + (key == bent_key ? bent_value : text) + "\"\n";
  }
  return lines;
}

Model explicit_e3(const std::string& bent_key = "", const std::string& bent_value = "") {
  return model_of("hamiltonian = \"M1^2 + M2*g3 + sqrt(g1)\"\n[phase_space]\nvariables = [" + kM +
                  ", " + kG + "]\n[phase_space.brackets]\n" + rotation("M", bent_key, bent_value) +
                  rotation("g", bent_key, bent_value));
}

TEST(VectorForm, FindsTheVectorsOfTheNamedAlgebras) {
  const std::string mg = kM + ", " + kG;
  using Names = std::vector<std::string>;
  EXPECT_EQ(vectors(with_algebra("so(3)", kM, "M1^2")), (Names{"M"}));
  for (const char* algebra : {"e(3)", "so(4)", "so(3,1)"})
    EXPECT_EQ(vectors(with_algebra(algebra, mg, "M1^2")), (Names{"M", "g"})) << algebra;
  EXPECT_EQ(vectors(with_algebra("so(3)+2*R3", mg + R"(, "al1", "al2", "al3")", "M1^2")),
            (Names{"M", "g", "al"}));
  EXPECT_EQ(vectors(with_algebra("l(7)", kM + R"(, "l0", "l1", "l2", "l3")", "M1^2")),
            (Names{"M", "l"}));
}

TEST(VectorForm, FindsNoneWhereThereAreNoVectors) {
  EXPECT_TRUE(vectors(with_algebra("sl(2)", R"("h1", "h2", "h3")", "h1^2")).empty());
  EXPECT_TRUE(
      vectors(
          with_algebra("e(4)", R"("J12","J13","J14","J23","J24","J34","p1","p2","p3","p4")", "p1"))
          .empty());
  // Canonical triples are vectors only if something rotates them.
  EXPECT_TRUE(vectors(model_of("hamiltonian = \"p1^2\"\n[phase_space]\nvariables = [\"q1\", "
                               "\"q2\", \"q3\", \"p1\", \"p2\", \"p3\"]\ncanonical = true\n"))
                  .empty());
}

TEST(VectorForm, BracketsOfTheQuaternion) {
  const Model model = with_algebra("l(7)", kM + R"(, "l0", "l1", "l2", "l3")", "M1^2");
  const auto form = find_vector_form(*model.poisson);
  ASSERT_TRUE(form);
  ASSERT_EQ(form->blocks.size(), 3U);
  EXPECT_EQ(form->blocks[2].name, "l0");
  const GiNaC::numeric half(1, 2);
  for (const BlockBracket& bracket : form->brackets) {
    if (bracket.a != 0 || bracket.b == 0) continue;
    ASSERT_EQ(bracket.v.size(), 1U);
    EXPECT_EQ(bracket.v[0].block, 1U);
    // {M_i, l_j} = -(eps_ijk l_k + delta_ij l0)/2 and {M_i, l0} = l_i/2
    EXPECT_EQ(bracket.v[0].coefficient, bracket.b == 1 ? -half : half);
    EXPECT_EQ(bracket.s, bracket.b == 1 ? GiNaC::ex(-half * model.variables[3]) : GiNaC::ex(0));
  }
}

TEST(VectorForm, BentBracketHasNone) {
  EXPECT_EQ(vectors(explicit_e3()), (std::vector<std::string>{"M", "g"}));
  for (const auto& [key, value] :
       {std::pair("M1,M2", "-M3 + M1^2"), std::pair("M1,g2", "g3"), std::pair("M1,g2", "-2*g3"),
        std::pair("M3,g1", "-g2 + M1"), std::pair("M2,g3", "0"), std::pair("M1,M3", "M2*g1")})
    EXPECT_TRUE(vectors(explicit_e3(key, value)).empty()) << key << " = " << value;
}

TEST(VectorForm, PositionInSpaceIsThreeScalars) {
  // The position in space is a vector by its name only: {p_i, x_1} = -alpha_i.
  const Model model = model_of(
      "hamiltonian = \"M1^2 + p2^2 + x1\"\n[phase_space]\nvariables = [\"x1\", \"x2\", \"x3\", " +
      kM +
      R"(, "p1", "p2", "p3", "alpha1", "alpha2", "alpha3"])"
      "\n[phase_space.brackets]\n" +
      rotation("M") + rotation("p") + rotation("alpha") +
      "\"p1,x1\" = \"-alpha1\"\n\"p2,x1\" = \"-alpha2\"\n\"p3,x1\" = \"-alpha3\"\n");
  EXPECT_EQ(vectors(model), (std::vector<std::string>{"M", "p", "alpha"}));
  EXPECT_TRUE(reproduces(*find_vector_form(*model.poisson), model.variables, *model.hamiltonian,
                         model.field));
}

TEST(VectorForm, FlowIsTheHamiltonianFieldOfEveryCase) {
  std::size_t forms = 0;
  for (const auto& path : test::bundled_cases()) {
    const Model model = build_model(read_case(path));
    if (!model.poisson) continue;
    const auto form = find_vector_form(*model.poisson);
    if (!form) continue;
    ++forms;
    EXPECT_TRUE(reproduces(*form, model.variables, *model.hamiltonian, model.field)) << path;
  }
  EXPECT_GE(forms, 5U);
}

TEST(VectorForm, FlowOfMixedBlocksIsTheHamiltonianField) {
  const Model quaternion = with_algebra("l(7)", kM + R"(, "l0", "l1", "l2", "l3")",
                                        "M1^2*l0 + M2*l3 + sqrt(M3)*l1*l2 + sin(l0)");
  EXPECT_TRUE(reproduces(*find_vector_form(*quaternion.poisson), quaternion.variables,
                         *quaternion.hamiltonian, quaternion.field));
}

// The check itself must be able to fail: one coefficient, one sign, one field component.
TEST(VectorForm, WrongFlowIsNoticed) {
  const Model model = explicit_e3();
  const VectorForm form = *find_vector_form(*model.poisson);
  const auto holds = [&](const VectorForm& f, const std::vector<GiNaC::ex>& field) {
    return reproduces(f, model.variables, *model.hamiltonian, field);
  };
  EXPECT_TRUE(holds(form, model.field));
  for (std::size_t block = 0; block < form.flows.size(); ++block) {
    for (std::size_t term = 0; term < form.flows[block].size(); ++term) {
      VectorForm bent = form;
      bent.flows[block][term].coefficient *= -1;
      EXPECT_FALSE(holds(bent, model.field)) << block << ' ' << term;
    }
  }
  std::vector<GiNaC::ex> field = model.field;
  field[4] += model.variables[0];
  EXPECT_FALSE(holds(form, field));
  field.pop_back();
  EXPECT_FALSE(holds(form, field));
}

TEST(Triples, AreThreeNamesThatDifferInTheirLastCharacter) {
  const auto names = [](const std::vector<std::string>& list) {
    std::vector<std::string> result;
    for (const Triple& triple : find_triples(list)) result.push_back(triple.name);
    return result;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({"g1", "M1", "M2", "M3", "g2", "g3"}), (Names{"g", "M"}));
  EXPECT_EQ(names({"p_x", "p_y", "p_z"}), (Names{"p"}));
  EXPECT_EQ(names({"l0", "l1", "l2", "l3"}), (Names{"l"}));
  EXPECT_TRUE(names({"p1", "p2", "p3", "p4"}).empty());
  EXPECT_TRUE(names({"J11", "J12", "J13"}).empty());
  EXPECT_TRUE(names({"M1", "M2", "g3"}).empty());
  EXPECT_TRUE(names({"x", "y", "z"}).empty());
}

}  // namespace
}  // namespace casimir

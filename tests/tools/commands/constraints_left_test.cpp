// What is said of the whole space of the variables is not said of the constraints of a case.
#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Document = nlohmann::ordered_json;

/// Equations or brackets with constraints, or without where `constraints` is empty.
std::string constrained(const std::string& variables, const std::string& constraints,
                        const std::string& tables, const std::string& head = {}) {
  return "title = \"t\"\n" + head + "[phase_space]\nvariables = [" + variables + "]\n" +
         (constraints.empty() ? "" : "constraints = [" + constraints + "]\n") + tables;
}

/// The document and the text say that they are not about these constraints; about all where there
/// are none.
void expect_left_out(const Folder& folder, std::vector<std::string> command, const Document& left,
                     int status = 0) {
  const Outcome text = run_in(folder, command);
  EXPECT_EQ(text.status, status) << text.out << text.err;
  EXPECT_EQ(has(text.out, "whole space of the variables"), !left.empty()) << text.out;
  command.emplace_back("--json");
  const Document document = run_in(folder, command).json();
  EXPECT_EQ(document.value("not_on", Document::array()), left) << document;
}

// With z = 0 there is the integral x, which the search on w = 0 alone does not see.
TEST(ConstraintsLeft, OfASearchOnALevelWithoutThem) {
  const Folder folder;
  const std::string rates =
      "[equations]\nx = \"y*z\"\ny = \"x + y^2\"\nz = \"z\"\nw = \"w*(1 + x)\"\n";
  const std::string variables = R"("x", "y", "z", "w")";
  const std::string file = folder.write("on.toml", constrained(variables, R"("z")", rates));
  const std::vector<std::string> on{"search", file, "--degree", "1", "--on", "w"};
  expect_left_out(folder, on, Document::array({"z"}));
  EXPECT_TRUE(has(run_in(folder, on).out, "--on 'z'"));
  // The twins are about the constraints, in whatever way these are written, or have none.
  for (const char* z : {"z", "2*z"}) {
    const std::vector<std::string> both{"search", file, "--degree", "1", "--on", "w", "--on", z};
    expect_left_out(folder, both, Document::array());
    EXPECT_TRUE(has(run_in(folder, both).out, "degree 1   x"));
  }
  const std::string free = folder.write("free.toml", constrained(variables, "", rates));
  expect_left_out(folder, {"search", free, "--degree", "1", "--on", "w"}, Document::array());
}

// On z = 0 w is a Casimir function.
TEST(ConstraintsLeft, OfASearchForCasimirFunctions) {
  const Folder folder;
  const std::string head = "hamiltonian = \"p^2/2 + q^2/2\"\n";
  const std::string brackets = "[phase_space.brackets]\n\"q,p\" = \"1\"\n\"z,w\" = \"z\"\n";
  const std::string variables = R"("q", "p", "z", "w")";
  const std::string file =
      folder.write("casimir.toml", constrained(variables, R"("z")", brackets, head));
  expect_left_out(folder, {"search", file, "--degree", "1", "--casimirs"}, Document::array({"z"}));
  const std::string free = folder.write("free.toml", constrained(variables, "", brackets, head));
  expect_left_out(folder, {"search", free, "--degree", "1", "--casimirs"}, Document::array());
}

// The exponent that is not rational belongs to w, which is zero on the phase space.
TEST(ConstraintsLeft, OfExponents) {
  const Folder folder;
  const std::string rates = "[equations]\nx = \"x^2\"\ny = \"x*y\"\nw = \"sqrt(2)*x*w\"\n";
  const std::string variables = R"("x", "y", "w")";
  const std::string file = folder.write("w.toml", constrained(variables, R"("w")", rates));
  expect_left_out(folder, {"exponents", file}, Document::array({"w"}));
  const std::string free = folder.write("free.toml", constrained(variables, "", rates));
  expect_left_out(folder, {"exponents", free}, Document::array());
}

// Both are so(3) on their phase spaces.
TEST(ConstraintsLeft, OfIsomorphismsAndSymmetries) {
  const Folder folder;
  const std::string head = "hamiltonian = \"x^2 + 2*y^2 + 3*z^2\"\n";
  const std::string brackets =
      "[phase_space.brackets]\n\"x,y\" = \"z\"\n\"y,z\" = \"x\"\n\"z,x\" = \"y\"\n";
  const std::string more =
      folder.write("more.toml", constrained(R"("x", "y", "z", "w")", R"("w")", brackets, head));
  const std::string so3 =
      folder.write("so3.toml", constrained(R"("x", "y", "z")", "", brackets, head));
  expect_left_out(folder, {"relate", more, so3}, Document::array({"w"}), 1);
  expect_left_out(folder, {"relate", so3, so3}, Document::array());
  const Document symmetries = run_in(folder, {"relate", more, "--json"}).json();
  EXPECT_EQ(symmetries.at("not_on"), Document::array({"w"}));
}

}  // namespace
}  // namespace casimir::test

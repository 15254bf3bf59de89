#include "runtime/methods.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>

#include "runtime/kernels/one_step/splitting.hpp"
#include "runtime/module.hpp"
#include "tests/folder.hpp"
#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

using Rows = std::map<int, std::map<int, double>>;

Rows dop853_rows() {
  using namespace casimir_kernel::dop853;
  return {
      {2, {{1, a21}}},
      {3, {{1, a31}, {2, a32}}},
      {4, {{1, a41}, {3, a43}}},
      {5, {{1, a51}, {3, a53}, {4, a54}}},
      {6, {{1, a61}, {4, a64}, {5, a65}}},
      {7, {{1, a71}, {4, a74}, {5, a75}, {6, a76}}},
      {8, {{1, a81}, {4, a84}, {5, a85}, {6, a86}, {7, a87}}},
      {9, {{1, a91}, {4, a94}, {5, a95}, {6, a96}, {7, a97}, {8, a98}}},
      {10, {{1, a10_1}, {4, a10_4}, {5, a10_5}, {6, a10_6}, {7, a10_7}, {8, a10_8}, {9, a10_9}}},
      {11,
       {{1, a11_1},
        {4, a11_4},
        {5, a11_5},
        {6, a11_6},
        {7, a11_7},
        {8, a11_8},
        {9, a11_9},
        {10, a11_10}}},
      {12,
       {{1, a12_1},
        {4, a12_4},
        {5, a12_5},
        {6, a12_6},
        {7, a12_7},
        {8, a12_8},
        {9, a12_9},
        {10, a12_10},
        {11, a12_11}}}};
}

const std::map<int, double> kWeights = {
    {1, casimir_kernel::dop853::b1},   {6, casimir_kernel::dop853::b6},
    {7, casimir_kernel::dop853::b7},   {8, casimir_kernel::dop853::b8},
    {9, casimir_kernel::dop853::b9},   {10, casimir_kernel::dop853::b10},
    {11, casimir_kernel::dop853::b11}, {12, casimir_kernel::dop853::b12}};

/// A rooted tree: its subtrees, each by its index in the list of all trees.
struct Tree {
  std::vector<int> branches;
  int size;
  double density;  // gamma
};

/// All rooted trees with at most `most` nodes: 1, 1, 2, 4, 9, 20, 48, 115, .. of each size.
std::vector<Tree> rooted_trees(int most) {
  std::vector<Tree> trees;
  for (int size = 1; size <= most; ++size) {
    const int known = static_cast<int>(trees.size());
    std::vector<Tree> fresh;
    std::vector<int> chosen;
    const std::function<void(int, int)> choose = [&](int rest, int largest) {
      if (rest == 0) {
        double density = size;
        for (const int b : chosen) density *= trees[static_cast<std::size_t>(b)].density;
        fresh.push_back({chosen, size, density});
        return;
      }
      for (int b = largest; b >= 0; --b) {
        if (trees[static_cast<std::size_t>(b)].size > rest) continue;
        chosen.push_back(b);
        choose(rest - trees[static_cast<std::size_t>(b)].size, b);
        chosen.pop_back();
      }
    };
    choose(size - 1, known - 1);
    trees.insert(trees.end(), fresh.begin(), fresh.end());
  }
  return trees;
}

/// The largest defect of the order conditions of each order 1..most.
std::vector<double> order_defects(const Rows& rows, const std::map<int, double>& weights,
                                  int stages, int most) {
  const std::vector<Tree> trees = rooted_trees(most);
  std::vector<std::vector<double>> values;
  std::vector<double> defects(static_cast<std::size_t>(most) + 1);
  for (const Tree& tree : trees) {
    std::vector<double> value(static_cast<std::size_t>(stages) + 1, 1);
    for (const int b : tree.branches)
      for (int i = 1; i <= stages; ++i) {
        double sum = 0;
        if (const auto row = rows.find(i); row != rows.end())
          for (const auto& [j, a] : row->second)
            sum += a * values[static_cast<std::size_t>(b)][static_cast<std::size_t>(j)];
        value[static_cast<std::size_t>(i)] *= sum;
      }
    double sum = 0;
    for (const auto& [j, weight] : weights) sum += weight * value[static_cast<std::size_t>(j)];
    double& defect = defects[static_cast<std::size_t>(tree.size)];
    defect = std::max(defect, std::abs(sum - 1 / tree.density));
    values.push_back(value);
  }
  return defects;
}

TEST(Tableau, TheRoundedDop853FulfilsTheFirstConditionsFarBeyondDouble) {
  using namespace casimir_kernel::dop853;
  static_assert(std::numeric_limits<long double>::digits >= 64, "the rests are below double");
  const std::map<int, double> rests = {{1, b1_rest}, {9, b9_rest}, {12, b12_rest}};
  const auto rows = dop853_rows();
  const auto defect = [&](int power, bool corrected) {
    long double sum = 0;
    for (const auto& [i, weight] : kWeights) {
      long double node = 0;
      if (i > 1)
        for (const auto& [j, a] : rows.at(i)) node += a;
      const auto rest = rests.find(i);
      const long double lacks = corrected && rest != rests.end() ? rest->second : 0;
      sum += (weight + lacks) * std::pow(node, static_cast<long double>(power));
    }
    return static_cast<double>(std::abs(sum - 1.L / (power + 1)));
  };
  for (int power = 0; power <= 2; ++power) {
    EXPECT_LT(defect(power, true), 3e-18) << power;
    EXPECT_GT(defect(power, false), 5e-17) << power;
  }
}

TEST(Tableau, Dop853FulfilsAllConditionsOfOrderEight) {
  EXPECT_EQ(rooted_trees(8).size(), 200u);
  const std::vector<double> defects = order_defects(dop853_rows(), kWeights, 12, 9);
  for (std::size_t order = 1; order <= 8; ++order) EXPECT_LT(defects[order], 1e-14) << order;
  EXPECT_GT(defects[9], 1e-5);  // the twin: it is no method of order 9
  Rows bent = dop853_rows();
  bent[9][7] += 1e-9;
  EXPECT_GT(order_defects(bent, kWeights, 12, 8)[8], 1e-13);
}

TEST(Tableau, EstimatorsHaveOrderFiveAndThree) {
  using namespace casimir_kernel::dop853;
  const std::map<int, double> e5 = {{1, e5_1}, {6, e5_6},   {7, e5_7},   {8, e5_8},
                                    {9, e5_9}, {10, e5_10}, {11, e5_11}, {12, e5_12}};
  const std::map<int, double> e3 = {{1, e3_1}, {6, e3_6},   {7, e3_7},   {8, e3_8},
                                    {9, e3_9}, {10, e3_10}, {11, e3_11}, {12, e3_12}};
  const auto defects = [&](std::map<int, double> difference) {
    std::map<int, double> weights = kWeights;
    for (const auto& [j, d] : difference) weights[j] -= d;
    return order_defects(dop853_rows(), weights, 12, 6);
  };
  EXPECT_LT(defects(e5)[5], 1e-14);
  EXPECT_GT(defects(e5)[6], 1e-5);
  EXPECT_LT(defects(e3)[3], 1e-14);
  EXPECT_GT(defects(e3)[4], 1e-3);
}

Rows dopri5_rows() {
  using namespace casimir_kernel::dopri5;
  return {{2, {{1, a21}}},
          {3, {{1, a31}, {2, a32}}},
          {4, {{1, a41}, {2, a42}, {3, a43}}},
          {5, {{1, a51}, {2, a52}, {3, a53}, {4, a54}}},
          {6, {{1, a61}, {2, a62}, {3, a63}, {4, a64}, {5, a65}}},
          {7, {{1, b1}, {3, b3}, {4, b4}, {5, b5}, {6, b6}}}};
}

TEST(Tableau, Dopri5IsAPairOfOrderFiveAndFour) {
  using namespace casimir_kernel::dopri5;
  std::map<int, double> weights = {{1, b1}, {3, b3}, {4, b4}, {5, b5}, {6, b6}};
  const std::vector<double> fifth = order_defects(dopri5_rows(), weights, 7, 6);
  for (std::size_t order = 1; order <= 5; ++order) EXPECT_LT(fifth[order], 1e-14) << order;
  EXPECT_GT(fifth[6], 1e-5);
  for (const auto& [j, e] :
       std::map<int, double>{{1, e1}, {3, e3}, {4, e4}, {5, e5}, {6, e6}, {7, e7}})
    weights[j] -= e;
  const std::vector<double> fourth = order_defects(dopri5_rows(), weights, 7, 5);
  for (std::size_t order = 1; order <= 4; ++order) EXPECT_LT(fourth[order], 1e-14) << order;
  EXPECT_GT(fourth[5], 1e-5);
  const auto rows = dopri5_rows();
  for (const auto& [i, node] : std::map<int, double>{{2, c2}, {3, c3}, {4, c4}, {5, c5}}) {
    double sum = 0;
    for (const auto& [j, a] : rows.at(i)) sum += a;
    EXPECT_NEAR(sum, node, 1e-14) << i;
  }
}

// The weights of the extension at any place between the ends are a method of order 4 over a step of
// that length: at s the sum over a tree of q nodes is s^q / density.
TEST(Tableau, TheExtensionOfDopri5HasOrderFour) {
  using namespace casimir_kernel::dopri5;
  const std::map<int, double> end = {{1, b1}, {3, b3}, {4, b4}, {5, b5}, {6, b6}};
  const std::map<int, double> inner = {{1, d1}, {3, d3}, {4, d4}, {5, d5}, {6, d6}, {7, d7}};
  for (const double s : {0.25, 0.5, 0.9}) {
    const double r = 1 - s;
    // chord + r (bend + s (twist + r inner)), bend = k1 - chord, twist = chord - k7 - bend
    std::map<int, double> weights;
    const double of_chord = s * (1 - r + r * s * 2);
    for (const auto& [j, b] : end) weights[j] += of_chord * b;
    weights[1] += s * r * (1 - s);
    weights[7] -= s * s * r;
    for (const auto& [j, d] : inner) weights[j] += s * s * r * r * d;
    Rows shorter = dopri5_rows();  // in units of the part of the step
    for (auto& [i, row] : shorter)
      for (auto& [j, a] : row) a /= s;
    for (auto& [j, weight] : weights) weight /= s;
    const std::vector<double> defects = order_defects(shorter, weights, 7, 5);
    for (std::size_t order = 1; order <= 4; ++order) EXPECT_LT(defects[order], 1e-12) << s;
    EXPECT_GT(defects[5], 1e-6) << s;
  }
}

template <int s>
void check_gauss() {
  using Table = casimir_kernel::gauss::Tableau<s>;
  const auto mu = casimir_kernel::gauss::Step<Euler, s>::mu_table;
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < s; ++j) EXPECT_EQ(mu[i * s + j] + mu[j * s + i], 1);  // exactly: symplectic
  for (int power = 0; power <= 2 * s; ++power) {
    double sum = 0;  // sum b_j c_j^power = 1 / (power + 1) for a quadrature of order 2s
    for (int j = 0; j < s; ++j) sum += Table::b[j] * std::pow(Table::c[j], power);
    const double defect = std::abs(sum - 1. / (power + 1));
    if (power < 2 * s)
      EXPECT_LT(defect, 1e-15) << s << ' ' << power;
    else
      EXPECT_GT(defect, 1e-12) << s;
  }
  for (int power = 1; power <= s; ++power)
    for (int i = 0; i < s; ++i) {
      double sum = 0;  // collocation: sum a_ij c_j^(power-1) = c_i^power / power
      for (int j = 0; j < s; ++j)
        sum += mu[i * s + j] * Table::b[j] * std::pow(Table::c[j], power - 1);
      EXPECT_NEAR(sum, std::pow(Table::c[i], power) / power, 1e-15);
    }
}
TEST(Tableau, GaussIsSymplecticCollocationOfOrderTwoS) {
  check_gauss<1>();
  check_gauss<2>();
  check_gauss<3>();
  check_gauss<4>();
  check_gauss<6>();
  check_gauss<8>();
}

/// The sums of odd powers of the coefficients, both halves: 1, and 0 below the order (Hairer,
/// Lubich, Wanner: Geometric Numerical Integration (2006), V.3.1).
template <int order>
void check_composition() {
  using Scheme = casimir_kernel::splitting::Scheme<order>;
  for (int power = 1; power <= order + 1; power += 2) {
    double sum = 0;
    for (int j = 0; j < Scheme::half; ++j)
      sum += (j + 1 < Scheme::half ? 2 : 1) * std::pow(Scheme::gamma[j], power);
    if (power < order)
      EXPECT_NEAR(sum, power == 1 ? 1 : 0, 3e-16) << order << ' ' << power;
    else
      EXPECT_GT(std::abs(sum), 1e-6) << order;  // the twin: it is no method of order + 2
  }
}
TEST(Tableau, SplittingsAreCompositionsOfTheirOrder) {
  check_composition<4>();
  check_composition<6>();
  check_composition<8>();
}

TEST(Methods, NamesAreFoundAndUnique) {
  for (const Method& method : methods()) EXPECT_EQ(find_method(method.name), &method);
  EXPECT_EQ(find_method("dop854"), nullptr);
  EXPECT_EQ(method_names().size(), methods().size());
}

constexpr const char* kSystem = R"(
struct System {
  static constexpr int n = 3;
  static void rhs(double, const double* x, const double*, double* dx) {
    dx[0] = x[2] * x[1]; dx[1] = -x[2] * x[0]; dx[2] = 0;
  }
  static void jacobian(double, const double* x, const double*, double* J) {
    for (int k = 0; k < 9; ++k) J[k] = 0;
    J[1] = -x[2]; J[3] = x[2]; J[6] = x[1]; J[7] = -x[0];
  }
  static void moments(const double*, double* values) {
    values[0] = values[1] = values[3] = 1; values[2] = 0.5;
  }
  static constexpr int parts = 2;
  static constexpr bool moves[parts][n] = {{true, false, false}, {false, true, false}};
  template <int k>
  static void flow(double t, const double* x, const double*, double* dx) {
    if constexpr (k == 0) dx[0] = t * x[1]; else dx[1] = -t * x[0];
  }
};
extern "C" {
int casimir_abi_version(void) { return CASIMIR_ABI_VERSION; }
int casimir_dimension(void) { return 3; }
int casimir_parameter_count(void) { return 0; }
int casimir_invariant_count(void) { return 0; }
void casimir_rhs(double t, const double* x, const double* p, double* dx) { System::rhs(t, x, p, dx); }
void casimir_integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  casimir_kernel::integrate<System>(run, x, out);
}
}
)";

// The text of every kernel compiles by itself, without a warning and without any header, and what
// it makes is a module that integrates.
TEST(Methods, KernelTextsCompileWithoutHeaders) {
  const char* given = std::getenv("CXX");
  const std::string compiler = given ? given : "c++";
  const test::Folder folder;
  for (const Method& method : methods()) {
    if (!method.outside.empty() && !method.header.empty()) continue;  // needs its library's headers
    const std::string text = kernel_source(method);
    EXPECT_EQ(text.find("#include"), std::string::npos);
    EXPECT_EQ(text.find("#pragma once"), std::string::npos);
    EXPECT_EQ(text, kernel_source(method));
    if (!method.outside.empty() || method.series || method.closed_form) continue;
    std::ofstream(folder / "module.cpp") << text << kSystem;
    const std::string command = compiler +
                                " -std=c++20 -O1 -Wall -Wextra -Werror -nostdinc -shared -fPIC " +
                                (folder / "module.cpp") + " -o " + (folder / "module.so");
    ASSERT_EQ(std::system(command.c_str()), 0) << method.name;
    const Module module = Module::load(folder / "module.so");
    Settings settings;
    settings.duration = 3;
    const Trajectory orbit = integrate(module, method, settings, {1, 0, 1});
    EXPECT_EQ(orbit.status, Status::ok);
    EXPECT_NEAR(orbit.state[0], std::cos(3.), 1e-8) << method.name;
    std::filesystem::remove(folder / "module.so");
  }
  // The twin: another version of the interface, and a file that is no module.
  std::ofstream(folder / "old.cpp")
      << "extern \"C\" int casimir_abi_version(void) { return -1; }\n";
  ASSERT_EQ(std::system(
                (compiler + " -shared -fPIC " + (folder / "old.cpp") + " -o " + (folder / "old.so"))
                    .c_str()),
            0);
  EXPECT_THROW(Module::load(folder / "old.so"), std::runtime_error);
  EXPECT_THROW(Module::load(folder / "old.cpp"), std::runtime_error);
}

}  // namespace
}  // namespace casimir::test

#include "runtime/kernels/one_step/radau.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

using casimir_kernel::radau::Tableau;

/// sum over j of row_j c_j^power.
template <int s>
long double moment(const double* row, int power) {
  long double sum = 0;
  for (int j = 0; j < s; ++j) sum += row[j] * std::pow((long double)Tableau<s>::c[j], power);
  return sum;
}

template <int s>
void check_collocation() {
  using Table = Tableau<s>;
  EXPECT_EQ(Table::c[s - 1], 1);
  for (int i = 0; i < s; ++i)
    for (int power = 1; power <= s; ++power)
      EXPECT_NEAR(double(moment<s>(Table::a + i * s, power - 1)),
                  std::pow(Table::c[i], power) / power, 3e-16)
          << s << ' ' << i << ' ' << power;
  const double* weights = Table::a + s * (s - 1);
  for (int power = 1; power <= 2 * s; ++power) {
    const double defect = std::abs(double(moment<s>(weights, power - 1) - 1.0L / power));
    if (power < 2 * s)
      EXPECT_LT(defect, 2e-16) << s << ' ' << power;
    else
      EXPECT_GT(defect, 1e-7) << s;  // the twin: the order is 2s - 1 and no more
  }
}

/// The entry of the block diagonal matrix R.
template <int s>
double normal_form(int i, int j) {
  using Table = Tableau<s>;
  if (i == 0 || j == 0) return i == j ? Table::gamma : 0;
  if ((i - 1) / 2 != (j - 1) / 2) return 0;
  const int pair = (i - 1) / 2;
  return i == j ? Table::alpha[pair] : i < j ? Table::beta[pair] : -Table::beta[pair];
}

template <int s>
void check_normal_form() {
  using Table = Tableau<s>;
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < s; ++j) {
      long double back = 0, form = 0;  // A back R = back, and forth back = R
      for (int k = 0; k < s; ++k) {
        form += (long double)Table::forth[i * s + k] * Table::back[k * s + j];
        for (int m = 0; m < s; ++m)
          back += (long double)Table::a[i * s + k] * Table::back[k * s + m] * normal_form<s>(m, j);
      }
      EXPECT_NEAR(double(back), Table::back[i * s + j], 1e-15);
      EXPECT_NEAR(double(form), (normal_form<s>(i, j)), 2e-14);
    }
}

template <int s>
void check_estimator() {
  using Table = Tableau<s>;
  double difference[s];  // weights of the other method less those of this one
  for (int j = 0; j < s; ++j) {
    long double sum = 0;
    for (int i = 0; i < s; ++i) sum += (long double)Table::e[i] * Table::a[i * s + j];
    difference[j] = double(sum / Table::gamma);
  }
  EXPECT_NEAR(double(moment<s>(difference, 0)), -1 / Table::gamma, 1e-15);
  for (int power = 1; power < s; ++power)
    EXPECT_NEAR(double(moment<s>(difference, power)), 0, 1e-15) << power;
  EXPECT_GT(std::abs(double(moment<s>(difference, s))), 1e-4);
}

TEST(RadauTableau, IsCollocationOfOrderTwoSLessOne) {
  check_collocation<3>();
  check_collocation<5>();
}
TEST(RadauTableau, NormalFormOfTheInverse) {
  check_normal_form<3>();
  check_normal_form<5>();
}
TEST(RadauTableau, EstimatorHasOrderS) {
  check_estimator<3>();
  check_estimator<5>();
}

/// Robertson's reaction: y2 is small and fast.
struct Robertson {
  static constexpr int n = 3;
  static void rhs(double, const double* y, const double*, double* d) {
    const double first = 0.04 * y[0], second = 1e4 * y[1] * y[2], third = 3e7 * y[1] * y[1];
    d[0] = second - first;
    d[1] = first - second - third;
    d[2] = third;
  }
  static void jacobian(double, const double* y, const double*, double* J) {
    const double columns[9] = {
        -0.04,      0.04,       0,           1e4 * y[2], -1e4 * y[2] - 6e7 * y[1],
        6e7 * y[1], 1e4 * y[1], -1e4 * y[1], 0};
    std::copy_n(columns, 9, J);
  }
};

/// Van der Pol's oscillator with y1'' = ((1 - y1^2) y1' - y1) / p.
struct VanDerPol {
  static constexpr int n = 2;
  static void rhs(double, const double* y, const double* p, double* d) {
    d[0] = y[1];
    d[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) / p[0];
  }
  static void jacobian(double, const double* y, const double* p, double* J) {
    J[0] = 0;
    J[1] = (-2 * y[0] * y[1] - 1) / p[0];
    J[2] = 1;
    J[3] = (1 - y[0] * y[0]) / p[0];
  }
};

/// A pulse of area 2 at p, whose derivative is infinity by infinity far from there.
struct FarPulse {
  static constexpr int n = 2;
  static void rhs(double, const double* y, const double* p, double* d) {
    const double c = std::cosh(y[1] - p[0]);
    d[0] = 1 / (c * c);
    d[1] = 1;
  }
  static void jacobian(double, const double* y, const double* p, double* J) {
    const double c = std::cosh(y[1] - p[0]);
    J[0] = J[1] = J[3] = 0;
    J[2] = -2 * std::sinh(y[1] - p[0]) * c / (c * c * c * c);
  }
};

struct Scene {
  double duration;
  std::vector<double> reference;
};

// States to 34 digits; to the digits given there those of Hairer, Wanner II, IV.10.
const Scene kRobertson40 = {
    40,
    {7.158270687194050904744737512050263e-1, 9.185534764557763903899212577750991e-6,
     2.841637457458303517616223495823959e-1}};
const Scene kRobertson1e11 = {
    1e11,
    {2.083340149701294230572549279906962e-8, 8.333360770334783400647660286241254e-14,
     9.999999791665151693793543464405007e-1}};
const Scene kVanDerPol = {
    2, {1.706167732170465008478187592418068, -8.928097010248165477786030645601919e-1}};

double worst_relative(const std::vector<double>& x, const std::vector<double>& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(x[i] / truth[i] - 1));
  return worst;
}

Settings settings_of(double duration, double rtol, double atol) {
  Settings settings;
  settings.duration = duration;
  settings.rtol = rtol;
  settings.atol = atol;
  return settings;
}

class Radau : public testing::TestWithParam<std::string> {};

// Every component to its own size, y2 = 8e-14 too, in few steps over eleven decades.
TEST_P(Radau, SmallComponentsKeepTheirDigits) {
  for (const Scene& scene : {kRobertson40, kRobertson1e11}) {
    const Trajectory orbit =
        run<Robertson>(GetParam(), settings_of(scene.duration, 1e-11, 1e-22), {1, 0, 0});
    ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
    EXPECT_EQ(orbit.time, scene.duration);
    EXPECT_LT(worst_relative(orbit.state, scene.reference), 1e-10);
    EXPECT_LT(orbit.evaluations, 50000u);
    EXPECT_LT(orbit.steps, 8000u);
  }
}

TEST_P(Radau, RelaxationOscillation) {
  const Trajectory orbit =
      run<VanDerPol>(GetParam(), settings_of(kVanDerPol.duration, 1e-10, 1e-10), {2, 0}, {1e-6});
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  EXPECT_LT(worst_relative(orbit.state, kVanDerPol.reference), 1e-9);
  EXPECT_LT(orbit.steps, 5000u);
}

TEST_P(Radau, DerivativesThatAreNoNumbersDoNotEndARun) {
  Settings settings = settings_of(400, 1e-9, 1e-9);
  const Trajectory orbit = run<FarPulse>(GetParam(), settings, {0, 0}, {370});
  ASSERT_EQ(orbit.status, Status::ok) << orbit.reason;
  EXPECT_EQ(orbit.state[1], 400);
}

TEST_P(Radau, StepsDoNotGrowWithTheDamping) {
  std::vector<unsigned long long> steps;
  for (const double rate : {1e3, 1e5, 1e7}) {
    const Trajectory orbit = run<Stiff>(GetParam(), settings_of(10, 1e-8, 1e-8), {2}, {rate});
    ASSERT_EQ(orbit.status, Status::ok);
    // x' = p (cos t - x): p^2 cos t + p sin t over p^2 + 1 behind the transient.
    const double truth = (rate * std::cos(10.) + std::sin(10.)) * rate / (rate * rate + 1);
    EXPECT_NEAR(orbit.state[0], truth, 3e-7) << rate;
    steps.push_back(orbit.steps);
  }
  EXPECT_LE(steps[2], steps[0] + 10) << "the fast transient alone may cost more";
  EXPECT_LT(*std::max_element(steps.begin(), steps.end()), 200u);
}

// The matrices are kept where nothing calls for new ones.
TEST_P(Radau, JacobiansAreFewerThanSteps) {
  const Trajectory orbit = run<Robertson>(GetParam(), settings_of(40, 1e-12, 1e-12), {1, 0, 0});
  EXPECT_LT(orbit.jacobians, 0.9 * static_cast<double>(orbit.steps));
}

// Samples between the steps are as good as the steps. A stiff component has not the full order.
TEST_P(Radau, DenseOutputOfAStiffSystem) {
  Settings settings = settings_of(10, 1e-11, 1e-11);
  settings.sample_every = 0.1;
  const double rate = 1e6;
  const Trajectory orbit = run<Stiff>(GetParam(), settings, {1}, {rate});
  ASSERT_EQ(orbit.samples.size(), 101u);
  for (std::size_t k = 1; k < orbit.samples.size(); ++k) {
    const double t = orbit.sample_times[k];
    EXPECT_NEAR(orbit.samples[k][0], (rate * std::cos(t) + std::sin(t)) * rate / (rate * rate + 1),
                1e-9)
        << t;
  }
}

TEST_P(Radau, WithoutASolverThereIsNoStep) {
  casimir_run run = {};
  run.t_end = 1;
  run.rtol = run.atol = 1e-8;
  double x[2] = {1, 0};
  casimir_outcome outcome = {};
  kernel<Oscillator>(GetParam())(&run, x, &outcome);
  EXPECT_EQ(outcome.status, CASIMIR_NO_CONVERGENCE);
  EXPECT_EQ(outcome.steps, 0u);
  EXPECT_EQ(x[0], 1);
}

INSTANTIATE_TEST_SUITE_P(Runtime, Radau, testing::Values("radau5", "radau9"),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace casimir::test

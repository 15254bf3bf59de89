// Where the motion has a solution in closed form, the program must reach it: scenes of the bundled
// cases against elliptic functions of Boost.Math, or elementary ones. The formulas are written down
// here from the textbook and share nothing with the equations that the program derives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <map>

#include "symbolic/case_file.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Real = long double;  // the phase of a long run costs digits that the comparison needs
using Values = std::map<std::string, Real>;

/// A scene in numbers, and how to call the program for it.
struct Setting {
  std::string file, scene;
  std::vector<std::string> replaced;  ///< NAME=VALUE, as after --param
  Values parameters, initial;
  Real a(const std::string& name) const { return parameters.at(name); }
  Real x(const std::string& name) const { return initial.at(name); }
};

/// "p", "p/q" or a decimal number.
Real parsed(const std::string& text) {
  const std::size_t bar = text.find('/');
  if (bar == std::string::npos) return std::stold(text);
  return std::stold(text.substr(0, bar)) / std::stold(text.substr(bar + 1));
}

Setting setting_in(const std::string& file, const std::string& scene,
                   const std::vector<std::string>& replaced = {}) {
  Setting result{file, scene, replaced, {}, {}};
  for (const SceneText& text : read_case(file).scenes) {
    if (text.name.value != scene) continue;
    for (const auto& entry : text.parameters)
      result.parameters[entry.first.value] = parsed(entry.second.value);
    for (const auto& entry : text.initial)
      result.initial[entry.first.value] = parsed(entry.second.value);
  }
  for (const std::string& text : replaced) {
    const std::size_t sign = text.find('=');
    result.parameters[text.substr(0, sign)] = parsed(text.substr(sign + 1));
  }
  return result;
}

std::string bundled(const std::string& name) {
  return CASIMIR_SOURCE_DIR "/cases/" + name + ".toml";
}

/// The bundled case with one more scene, called "own", in a file in `folder`.
Setting own_setting(const Folder& folder, const std::string& name, const std::string& scene) {
  return setting_in(
      folder.write(name + ".toml", file_text(bundled(name)) +
                                       "\n[[scene]]\nname = \"own\"\nduration = \"1\"\n" + scene),
      "own");
}

/// Largest difference between the program's state after `duration` and `exact` in the variables
/// that it names, against the larger of 1 and the largest of these.
Real error_after(const Setting& setting, const std::string& duration, const Values& exact) {
  std::vector<std::string> arguments{"integrate",   setting.file,  "--scene",
                                     setting.scene, "--duration",  duration,
                                     "--json",      "--tolerance", "1e-13"};
  for (const std::string& text : setting.replaced)
    arguments.insert(arguments.end(), {"--param", text});
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  if (outcome.status != 0) return 1;
  const auto state = outcome.json().at("state");
  Real error = 0, scale = 1;
  for (const auto& [name, value] : exact) {
    const Real found = std::stold(state.at(name).get<std::string>());
    if (!std::isfinite(found) || !std::isfinite(value)) return 1;
    error = std::max(error, std::abs(found - value));
    scale = std::max(scale, std::abs(value));
  }
  return error / scale;
}

using Solution = Values (*)(const Setting& setting, Real t);

void expect_exact(Solution solution, const Setting& setting,
                  const std::vector<std::string>& durations) {
  for (const std::string& duration : durations)
    EXPECT_LT(error_after(setting, duration, solution(setting, parsed(duration))), 1e-10L)
        << setting.file << ", scene " << setting.scene << ", t = " << duration;
}

struct Jacobi {
  Real sn, cn, dn;
};

/// Jacobi's functions `rate*t` after the place where sn and cn are in the proportion given, of
/// modulus k <= 1.
Jacobi jacobi(Real k, Real sn0, Real cn0, Real rate, Real t) {
  if (k == 1) {  // here the proportion sn : dn = sinh u, because cn and dn are equal
    const Real u = std::asinh(sn0 / cn0) + rate * t;
    return {std::tanh(u), 1 / std::cosh(u), 1 / std::cosh(u)};
  }
  Jacobi result{};
  const Real u = boost::math::ellint_1(k, std::atan2(sn0, cn0)) + rate * t;
  result.sn = boost::math::jacobi_elliptic(k, u, &result.cn, &result.dn);
  return result;
}

/// Euler's top for a1 > a2 > a3. With h = 2H and G^2 = (M, M), the momentum goes round axis 1 if
/// h > a2*G^2 and round axis 3 if h < a2*G^2; the component along that axis is a dn, that along the
/// middle axis always a sn.
Values euler_top(const Setting& s, Real t) {
  const Real a1 = s.a("a1"), a2 = s.a("a2"), a3 = s.a("a3");
  const Real m1 = s.x("M1"), m2 = s.x("M2"), m3 = s.x("M3");
  const Real h = a1 * m1 * m1 + a2 * m2 * m2 + a3 * m3 * m3;
  const Real square = m1 * m1 + m2 * m2 + m3 * m3;
  // M1 and M3 where M2 = 0, and the squares of the two possible rates.
  Real top = std::sqrt((h - a3 * square) / (a1 - a3));
  Real bottom = std::sqrt((a1 * square - h) / (a1 - a3));
  const Real along1 = (a1 - a2) * (a1 - a3) * top * top;
  const Real along3 = (a2 - a3) * (a1 - a3) * bottom * bottom;
  const Real rate = std::sqrt(std::max(along1, along3));
  const Real k = std::sqrt(std::min(along1, along3) / std::max(along1, along3));
  const bool round1 = along1 >= along3;
  (round1 ? top : bottom) *= std::copysign(1.0L, round1 ? m1 : m3);
  const Real middle = (a1 - a3) * top * bottom / rate;
  const Jacobi e = jacobi(k, m2 / middle, round1 ? m3 / bottom : m1 / top, rate, t);
  return {{"M1", top * (round1 ? e.dn : e.cn)},
          {"M2", middle * e.sn},
          {"M3", bottom * (round1 ? e.cn : e.dn)}};
}

/// The three real roots, rising, of u^3 + b*u^2 + c*u + d, by Viete's cosines.
std::array<Real, 3> roots_of_cubic(Real b, Real c, Real d) {
  const Real p = b * b / 9 - c / 3, q = b * c / 6 - b * b * b / 27 - d / 2;
  const Real third = boost::math::constants::two_pi<Real>() / 3;
  const Real angle = std::acos(std::clamp(q / std::sqrt(p * p * p), -1.0L, 1.0L)) / 3;
  std::array<Real, 3> roots{};
  for (int i = 0; i < 3; ++i)
    roots[static_cast<std::size_t>(i)] =
        2 * std::sqrt(p) * std::cos(angle + static_cast<Real>(i) * third) - b / 3;
  std::sort(roots.begin(), roots.end());
  return roots;
}

/// Height u(t) of an axis of symmetry in the field of the potential r*u, from height u0 and speed
/// v0: u'^2 = a^2*((2*e/a - 2*r*u/a)*(1 - u^2) - (c - l*u)^2), where a is the equatorial reciprocal
/// inertia, e the energy without the part of the spin, l the momentum along the axis, c that along
/// the vertical. Then u = u1 + (u2 - u1)*sn^2 between the two lower roots of the cubic, for r > 0.
Real height(Real a, Real r, Real e, Real l, Real c, Real u0, Real v0, Real t) {
  const Real lead = 2 * r / a;
  const auto [u1, u2, u3] = roots_of_cubic(
      -(2 * e / a + l * l) / lead, (2 * c * l - 2 * r / a) / lead, (2 * e / a - c * c) / lead);
  const Real rate = std::sqrt(a * r * (u3 - u1) / 2), k = std::sqrt((u2 - u1) / (u3 - u1));
  const Real sn = std::sqrt(std::max(u0 - u1, 0.0L)), cn = std::sqrt(std::max(u2 - u0, 0.0L));
  const Jacobi now = jacobi(k, sn, std::copysign(cn, v0), rate, t);
  return u1 + (u2 - u1) * now.sn * now.sn;
}

Values lagrange_top(const Setting& s, Real t) {
  const Real a = s.a("a1"), r = s.a("r");
  const Real m1 = s.x("M1"), m2 = s.x("M2"), m3 = s.x("M3");
  const Real g1 = s.x("g1"), g2 = s.x("g2"), g3 = s.x("g3");
  const Real e = a * (m1 * m1 + m2 * m2) / 2 + r * g3;
  const Real c = m1 * g1 + m2 * g2 + m3 * g3;
  return {{"g3", height(a, r, e, m3, c, g3, a * (g1 * m2 - g2 * m1), t)}, {"M3", m3}};
}

/// The pendulum is a top that may spin about its rod: its moment about the rod, (N, e), takes the
/// part of M3, and the kinetic energy of that spin is left out of e.
Values spherical_pendulum(const Setting& s, Real t) {
  const Real a = 1 / s.a("m"), w = s.a("w");
  const Real n1 = s.x("N1"), n2 = s.x("N2"), n3 = s.x("N3");
  const Real e1 = s.x("e1"), e2 = s.x("e2"), e3 = s.x("e3");
  const Real spin = n1 * e1 + n2 * e2 + n3 * e3;
  const Real e = a * (n1 * n1 + n2 * n2 + n3 * n3 - spin * spin) / 2 + w * e3;
  return {{"e3", height(a, w, e, spin, n3, e3, a * (n1 * e2 - n2 * e1), t)}, {"N3", n3}};
}

/// A gyrostat with a1 = a2 and its rotor along axis 3: M1 + i*M2 turns uniformly.
Values symmetric_gyrostat(const Setting& s, Real t) {
  const Real m1 = s.x("M1"), m2 = s.x("M2"), m3 = s.x("M3");
  const Real angle = ((s.a("a1") - s.a("a3")) * m3 - s.a("k3")) * t;
  return {{"M1", m1 * std::cos(angle) - m2 * std::sin(angle)},
          {"M2", m1 * std::sin(angle) + m2 * std::cos(angle)},
          {"M3", m3}};
}

/// {M1, M2} = M1 with a quadratic Hamiltonian of determinant d > 0: y = a22*M2 + a12*M1 obeys
/// y' = y^2 - c^2 with c^2 = 2*a22*H = y^2 + d*M1^2, and M1' = M1*y.
Values solvable_algebra(const Setting& s, Real t) {
  const Real a11 = s.a("a11"), a22 = s.a("a22"), a12 = s.a("a12");
  const Real d = a11 * a22 - a12 * a12, m1 = s.x("M1");
  const Real y = a22 * s.x("M2") + a12 * m1, c = std::sqrt(y * y + d * m1 * m1);
  // atanh(y/c) in a form that keeps its digits next to the line of rest
  const Real u = c * t - std::asinh(y / (std::sqrt(d) * m1));
  const Real now = c / std::sqrt(d) / std::cosh(u);
  return {{"M1", now}, {"M2", (-c * std::tanh(u) - a12 * now) / a22}};
}

/// The same with q = log(M1).
Values toda(const Setting& s, Real t) {
  Setting algebra = s;
  algebra.initial = {{"M1", std::exp(s.x("q"))}, {"M2", s.x("p")}};
  const Values now = solvable_algebra(algebra, t);
  return {{"q", std::log(now.at("M1"))}, {"p", now.at("M2")}};
}

TEST(ExactSolution, EulerTopRoundTheAxisOfLeastInertia) {
  for (const char* scene : {"default", "generic"})
    expect_exact(euler_top, setting_in(bundled("euler"), scene), {"1/3", "1", "10", "100"});
}

TEST(ExactSolution, EulerTopRoundTheAxisOfGreatestInertia) {
  const Folder folder;
  for (const char* m3 : {"2", "-2"}) {
    const Setting s = own_setting(folder, "euler",
                                  "parameters = { a1 = \"1\", a2 = \"1/2\", a3 = \"1/3\" }\n"
                                  "initial = { M1 = \"-1/2\", M2 = \"1/4\", M3 = \"" +
                                      std::string(m3) + "\" }\n");
    expect_exact(euler_top, s, {"1/3", "1", "10", "100"});
  }
}

TEST(ExactSolution, EulerTopFromAPlaneOfSymmetry) {
  const Folder folder;
  for (const char* m1 : {"1", "1/3"}) {  // round axis 1, round axis 3
    const Setting s = own_setting(folder, "euler",
                                  "parameters = { a1 = \"1\", a2 = \"1/2\", a3 = \"1/4\" }\n"
                                  "initial = { M1 = \"" +
                                      std::string(m1) + "\", M2 = \"0\", M3 = \"1\" }\n");
    expect_exact(euler_top, s, {"1/3", "1", "10", "100"});
  }
}

TEST(ExactSolution, EulerTopOnTheSeparatrix) {
  // h = a2*G^2 exactly; rounding leaves it exponentially, so the time is short.
  const Folder folder;
  const Setting s = own_setting(folder, "euler",
                                "parameters = { a1 = \"5/4\", a2 = \"1\", a3 = \"0\" }\n"
                                "initial = { M1 = \"1\", M2 = \"0\", M3 = \"1/2\" }\n");
  expect_exact(euler_top, s, {"1/3", "1", "5"});
}

TEST(ExactSolution, LagrangeTop) {
  for (const char* scene : {"default", "generic"})
    expect_exact(lagrange_top, setting_in(bundled("lagrange"), scene), {"1/3", "1", "10", "100"});
}

TEST(ExactSolution, LagrangeTopFromATurningPoint) {
  const Folder folder;
  for (const char* m1 : {"1", "-2"}) {
    const Setting s = own_setting(folder, "lagrange",
                                  "parameters = { a1 = \"1/2\", a3 = \"2\", r = \"3/4\" }\n"
                                  "initial = { M1 = \"" +
                                      std::string(m1) +
                                      "\", M2 = \"0\", M3 = \"1\", g1 = \"4/5\", g2 = \"0\", g3 = "
                                      "\"-3/5\" }\n");
    expect_exact(lagrange_top, s, {"1/3", "1", "10", "100"});
  }
}

TEST(ExactSolution, SphericalPendulum) {
  for (const char* scene : {"default", "spinning"})
    expect_exact(spherical_pendulum, setting_in(bundled("spherical-pendulum"), scene),
                 {"1/3", "1", "10", "50"});
  expect_exact(spherical_pendulum,
               setting_in(bundled("spherical-pendulum"), "default", {"m=3/2", "w=2/3"}),
               {"1/3", "1", "10", "50"});
}

TEST(ExactSolution, SymmetricGyrostat) {
  const std::string file = bundled("zhukovskii-volterra");
  expect_exact(symmetric_gyrostat, setting_in(file, "default", {"a2=1", "k1=0", "k2=0"}),
               {"1/3", "1", "10", "100"});
  expect_exact(symmetric_gyrostat, setting_in(file, "strong-rotor", {"a2=1"}), {"1/3", "2"});
}

TEST(ExactSolution, SolvableAlgebra) {
  const std::string file = bundled("solvable-algebra");
  for (const char* scene : {"default", "round-trip"})
    expect_exact(solvable_algebra, setting_in(file, scene), {"1/3", "1", "10", "30"});
  expect_exact(solvable_algebra, setting_in(file, "stiff"), {"1/100", "1/10", "10"});
}

TEST(ExactSolution, TodaLattice) {
  const std::string file = bundled("toda-log-coordinates");
  for (const char* scene : {"default", "reflection"})
    expect_exact(toda, setting_in(file, scene), {"1/3", "1", "10", "25"});
  expect_exact(toda, setting_in(file, "wall"), {"1/1000", "1/10"});
}

}  // namespace
}  // namespace casimir::test

#pragma once

#include <string>

#include "symbolic/case_file.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/system.hpp"

namespace casimir::test {

/// The model of a case file.
inline Model model_of(const std::string& toml) {
  return build_model(parse_case(toml, "test.toml"));
}

/// q'' = -q.
struct Oscillator {
  GiNaC::symbol q{"q"}, p{"p"};
  Model model = hamiltonian_system("oscillator", {q}, {p}, (q * q + p * p) / 2);
  /// From q = 1 at rest: q = cos t, p = -sin t.
  Scene scene(const GiNaC::ex& duration) const { return scene_from(model, {1, 0}, duration); }
};

/// Equations in one variable x, which begins at 1.
inline Model one_equation(const std::string& rate, const std::string& duration,
                          const std::string& more = {}) {
  return model_of("title = \"t\"\n[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"" + rate +
                  "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\" }\nduration = \"" +
                  duration + "\"\n" + more);
}

/// Equations in x and the time t, from x = 0.
inline Model driven_equation(const std::string& rate) {
  return model_of(
      "title = \"driven\"\n[phase_space]\nvariables = [\"x\"]\ntime = \"t\"\n"
      "[equations]\nx = \"" +
      rate + "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"0\" }\nduration = \"4\"\n");
}

/// A rotation, whose G is an integral where x > 0 alone, which it leaves.
inline constexpr const char* kLeavesItsDomain = R"toml(
title = "leaves"
[phase_space]
variables = ["x", "y", "z"]
domain = ["x > 0"]
[equations]
x = "y"
y = "-x"
z = "y"
[integrals]
F = "x^2 + y^2"
G = "z - sqrt(x^2)"
[[scene]]
name = "default"
initial = { x = "1", y = "0", z = "0" }
duration = "100"
)toml";

}  // namespace casimir::test

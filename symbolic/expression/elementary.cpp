#include "symbolic/expression/elementary.hpp"

#include <algorithm>
#include <array>

namespace casimir {
namespace {

using GiNaC::ex;

/// |a| of real numbers. That of an exponential is itself: under the root GiNaC would write
/// exp(2*z), which overflows before exp(z) does.
ex modulus(const ex& a) {
  return GiNaC::is_the_function<GiNaC::exp_SERIAL>(a) ? a : GiNaC::sqrt(GiNaC::pow(a, 2));
}

constexpr std::array kElementaryFunctions = {
    ElementaryFunction{.name = "sqrt",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::sqrt(a); }},
    ElementaryFunction{.name = "sin",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::sin(a); },
                       .everywhere = true},
    ElementaryFunction{.name = "cos",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::cos(a); },
                       .everywhere = true},
    ElementaryFunction{.name = "tan",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::tan(a); }},
    ElementaryFunction{
        .name = "cot",
        .apply = [](const ex& a, const ex&) -> ex { return GiNaC::cos(a) / GiNaC::sin(a); },
        .uses = 2},
    ElementaryFunction{.name = "sinh",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::sinh(a); },
                       .everywhere = true},
    ElementaryFunction{.name = "cosh",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::cosh(a); },
                       .everywhere = true},
    ElementaryFunction{.name = "tanh",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::tanh(a); }},
    ElementaryFunction{.name = "exp",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::exp(a); },
                       .everywhere = true},
    ElementaryFunction{.name = "log",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::log(a); }},
    ElementaryFunction{.name = "asin",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::asin(a); }},
    ElementaryFunction{.name = "acos",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::acos(a); }},
    ElementaryFunction{.name = "atan",
                       .apply = [](const ex& a, const ex&) -> ex { return GiNaC::atan(a); }},
    ElementaryFunction{.name = "atan2",
                       .arity = 2,
                       .apply = [](const ex& a, const ex& b) -> ex { return GiNaC::atan2(a, b); }},
    ElementaryFunction{.name = "abs",
                       .apply = [](const ex& a, const ex&) -> ex { return modulus(a); },
                       .uses = 2,
                       .real = true},
    ElementaryFunction{.name = "sign",
                       .apply = [](const ex& a, const ex&) -> ex { return a / modulus(a); },
                       .uses = 3,
                       .real = true},
};

}  // namespace

const ElementaryFunction* find_elementary_function(const std::string& name) {
  const auto it = std::find_if(kElementaryFunctions.begin(), kElementaryFunctions.end(),
                               [&](const ElementaryFunction& f) { return f.name == name; });
  return it == kElementaryFunctions.end() ? nullptr : &*it;
}

std::vector<std::string> elementary_function_names() {
  std::vector<std::string> names;
  for (const ElementaryFunction& f : kElementaryFunctions) names.emplace_back(f.name);
  return names;
}

std::optional<GiNaC::ex> by_exponentials(const GiNaC::function& f) {
  const std::string name = f.get_name();
  if (name != "sinh" && name != "cosh" && name != "tanh") return std::nullopt;
  const ex forward = GiNaC::exp(f.op(0)), back = GiNaC::exp(-f.op(0));
  if (name == "sinh") return (forward - back) / 2;
  if (name == "cosh") return (forward + back) / 2;
  return (forward - back) / (forward + back);
}

}  // namespace casimir

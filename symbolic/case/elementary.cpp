#include "symbolic/case/elementary.hpp"

#include <algorithm>
#include <array>

namespace casimir {
namespace {

using GiNaC::ex;

constexpr std::array kElementaryFunctions = {
    ElementaryFunction{"sqrt", 1, [](const ex& a, const ex&) -> ex { return GiNaC::sqrt(a); }},
    ElementaryFunction{"sin", 1, [](const ex& a, const ex&) -> ex { return GiNaC::sin(a); }},
    ElementaryFunction{"cos", 1, [](const ex& a, const ex&) -> ex { return GiNaC::cos(a); }},
    ElementaryFunction{"tan", 1, [](const ex& a, const ex&) -> ex { return GiNaC::tan(a); }},
    ElementaryFunction{"exp", 1, [](const ex& a, const ex&) -> ex { return GiNaC::exp(a); }},
    ElementaryFunction{"log", 1, [](const ex& a, const ex&) -> ex { return GiNaC::log(a); }},
    ElementaryFunction{"asin", 1, [](const ex& a, const ex&) -> ex { return GiNaC::asin(a); }},
    ElementaryFunction{"acos", 1, [](const ex& a, const ex&) -> ex { return GiNaC::acos(a); }},
    ElementaryFunction{"atan", 1, [](const ex& a, const ex&) -> ex { return GiNaC::atan(a); }},
    ElementaryFunction{"atan2", 2,
                       [](const ex& a, const ex& b) -> ex { return GiNaC::atan2(a, b); }},
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

}  // namespace casimir

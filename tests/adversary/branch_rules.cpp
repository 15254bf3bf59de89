// Rules that hold for one sign, or on one branch only: claims made of them are false elsewhere.
#include "tests/adversary/rule_parts.hpp"

namespace casimir::adversary {
const std::vector<Rule>& branch_rules() {
  static const std::vector<Rule> rules{
      {"absolute-value",
       [](Made o) -> Sides {
         return {absolute(o.v), o.v};
       }},
      {"hyperbolic",
       [](Made o) -> Sides {
         return {sqrt(square(cosh(o.v)) - 1), sinh(o.v)};
       }},
      {"hyperbolic",
       [](Made o) -> Sides {
         return {sqrt(1 - 1 / square(cosh(o.v))), tanh(o.v)};
       }},
      {"absolute-value",
       [](Made o) -> Sides {
         return {absolute(o.v), -o.v};
       }},
      {"absolute-value",
       [](Made o) -> Sides {
         return {absolute(o.v + o.w), absolute(o.v) + absolute(o.w)};
       }},
      {"absolute-value",
       [](Made o) -> Sides {
         return {pow(square(o.v), Expr(3, 2)), cube(o.v)};
       }},
      {"absolute-value",
       [](Made o) -> Sides {
         return {sqrt(square(1 - o.p)), o.p - 1};
       }},
      {"nested-root",
       [](Made o) -> Sides {
         return {sqrt(o.p + 4 - 4 * sqrt(o.p)), sqrt(o.p) - 2};
       }},
      {"nested-root",
       [](Made o) -> Sides {
         return {sqrt(hypot(o.v, o.w) + o.v) * sqrt(hypot(o.v, o.w) - o.v), o.w};
       }},
      {"half-angle",
       [](Made o) -> Sides {
         return {sqrt((1 - cos(o.v)) / 2), sin(o.v / 2)};
       }},
      {"half-angle",
       [](Made o) -> Sides {
         return {sqrt(kTwo) * sin(atan2(o.v, o.w) / 2), sqrt(1 - o.w / hypot(o.v, o.w))};
       }},
      {"angle-sum",
       [](Made o) -> Sides {
         return {sqrt(1 - square(sin(o.v))), cos(o.v)};
       }},
      {"angle-sum",
       [](Made o) -> Sides {
         return {1 / sqrt(1 + square(tan(o.v))), cos(o.v)};
       }},
      {"inverse",
       [](Made o) -> Sides {
         return {atan2(o.v, o.w), atan(o.v / o.w)};
       }},
      {"inverse",
       [](Made o) -> Sides {
         return {asin(2 * o.v / (1 + square(o.v))), 2 * atan(o.v)};
       }},
      {"inverse",
       [](Made o) -> Sides {
         return {asin(sin(o.v)), o.v};
       }},
      {"inverse",
       [](Made o) -> Sides {
         return {acos(cos(o.v)), o.v};
       }},
      {"inverse",
       [](Made o) -> Sides {
         return {atan(o.v) + atan(1 / o.v), Expr::pi() / 2};
       }},
      {"inverse",
       [](Made o) -> Sides {
         return {acos((1 - square(o.v)) / (1 + square(o.v))), 2 * atan(o.v)};
       }},
      {"exp-log",
       [](Made o) -> Sides {
         return {exp(log(square(o.v)) / 2), o.v};
       }},
      {"exp-log",
       [](Made o) -> Sides {
         return {sqrt(square(log(o.p))), log(o.p)};
       }},
  };
  return rules;
}

}  // namespace casimir::adversary

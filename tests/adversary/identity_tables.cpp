// The identities by which true claims are disguised, and false ones made to look true. Those of
// elementary functions are in Abramowitz and Stegun, chapters 3 and 4; the oracle checks each at
// random points whenever it is used.
#include "tests/adversary/identity_tables.hpp"

#include "tests/adversary/rule_parts.hpp"

namespace casimir::adversary {
namespace {

std::vector<Rule> angles() {
  const std::string half = "half-angle", third = "third-angle", sum = "angle-sum";
  return {
      {half,
       [](Made o) -> Sides {
         return {2 * square(cos(o.v / 2)), 1 + cos(o.v)};
       }},
      {half,
       [](Made o) -> Sides {
         return {2 * square(sin(o.v / 2)), 1 - cos(o.v)};
       }},
      {half,
       [](Made o) -> Sides {
         return {2 * sin(o.v / 2) * cos(o.v / 2), sin(o.v)};
       }},
      {half,
       [](Made o) -> Sides {
         return {2 * square(cos(atan2(o.v, o.w) / 2)), 1 + o.w / hypot(o.v, o.w)};
       }},
      {half,
       [](Made o) -> Sides {
         return {hypot(o.v, o.w) * 2 * sin(atan2(o.v, o.w) / 2) * cos(atan2(o.v, o.w) / 2), o.v};
       }},
      {half,
       [](Made o) -> Sides {
         return {tan(atan2(o.v, o.w) / 2), o.v / (o.w + hypot(o.v, o.w))};
       }},
      {half,
       [](Made o) -> Sides {
         return {2 * square(cos(acos(o.u) / 2)), 1 + o.u};
       }},
      {half,
       [](Made o) -> Sides {
         return {8 * square(square(cos(o.v / 4))), 3 + 4 * cos(o.v / 2) + cos(o.v)};
       }},
      {third,
       [](Made o) -> Sides {
         return {4 * cube(cos(o.v / 3)) - 3 * cos(o.v / 3), cos(o.v)};
       }},
      {third,
       [](Made o) -> Sides {
         return {4 * cube(cos(acos(o.u) / 3)) - 3 * cos(acos(o.u) / 3), o.u};
       }},
      {third,
       [](Made o) -> Sides {
         return {3 * sin(asin(o.u) / 3) - 4 * cube(sin(asin(o.u) / 3)), o.u};
       }},
      {third,
       [](Made o) -> Sides {
         return {4 * cube(cos(atan2(o.v, o.w) / 3)) - 3 * cos(atan2(o.v, o.w) / 3),
                 o.w / hypot(o.v, o.w)};
       }},
      {sum,
       [](Made o) -> Sides {
         return {square(sin(o.v)) + square(cos(o.v)), 1};
       }},
      {sum,
       [](Made o) -> Sides {
         return {sin(o.v + o.w), sin(o.v) * cos(o.w) + cos(o.v) * sin(o.w)};
       }},
      {sum,
       [](Made o) -> Sides {
         return {cos(2 * o.v), 2 * square(cos(o.v)) - 1};
       }},
      {sum,
       [](Made o) -> Sides {
         return {sin(3 * o.v), 3 * sin(o.v) - 4 * cube(sin(o.v))};
       }},
      {sum,
       [](Made o) -> Sides {
         return {cos(o.v + Expr::pi() / 2), -sin(o.v)};
       }},
      {sum,
       [](Made o) -> Sides {
         return {(1 + square(tan(o.v))) * square(cos(o.v)), 1};
       }},
      {sum,
       [](Made o) -> Sides {
         return {2 * sin(o.v) * sin(o.w), cos(o.v - o.w) - cos(o.v + o.w)};
       }},
      {sum,
       [](Made o) -> Sides {
         return {cos(o.v + Expr::pi() / 3) + cos(o.v - Expr::pi() / 3), cos(o.v)};
       }},
  };
}

std::vector<Rule> hyperbolic_functions() {
  const std::string hyperbolic = "hyperbolic";
  return {
      {hyperbolic,
       [](Made o) -> Sides {
         return {square(cosh(o.v)) - square(sinh(o.v)), 1};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {sinh(o.v) + cosh(o.v), exp(o.v)};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {2 * square(cosh(o.v / 2)), 1 + cosh(o.v)};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {2 * sinh(o.v / 2) * cosh(o.v / 2), sinh(o.v)};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {tanh(o.v) * cosh(o.v), sinh(o.v)};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {tanh(o.v / 2) * (1 + cosh(o.v)), sinh(o.v)};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {cosh(o.v + o.w), cosh(o.v) * cosh(o.w) + sinh(o.v) * sinh(o.w)};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {sinh(3 * o.v), 3 * sinh(o.v) + 4 * cube(sinh(o.v))};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {sqrt(1 + square(sinh(o.v))), cosh(o.v)};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {2 * cosh(log(o.p)), o.p + 1 / o.p};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {(1 - square(tanh(o.v))) * square(cosh(o.v)), 1};
       }},
      {hyperbolic,
       [](Made o) -> Sides {
         return {tanh(log(o.p) / 2) * (o.p + 1), o.p - 1};
       }},
  };
}

std::vector<Rule> inverse_functions() {
  const std::string inverse = "inverse";
  return {
      {inverse,
       [](Made o) -> Sides {
         return {asin(o.u) + acos(o.u), Expr::pi() / 2};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {2 * square(sin(asin(o.u) / 2 + acos(o.u) / 2)), 1};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {cos(asin(o.u)), sqrt(1 - square(o.u))};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {sin(2 * asin(o.u)), 2 * o.u * sqrt(1 - square(o.u))};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {acos(-o.u), Expr::pi() - acos(o.u)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {asin(-o.u), -asin(o.u)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {asin(o.v / sqrt(1 + square(o.v))), atan(o.v)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {cos(atan(o.v)), 1 / sqrt(1 + square(o.v))};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {atan(o.p) + atan(1 / o.p), Expr::pi() / 2};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {atan2(o.v, o.p), atan(o.v / o.p)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {atan2(o.p, o.v), Expr::pi() / 2 - atan(o.v / o.p)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {sin(atan2(o.v, o.w)), o.v / hypot(o.v, o.w)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {atan2(o.p * o.v, o.p * o.w), atan2(o.v, o.w)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {acos((1 - square(o.v)) / (1 + square(o.v))), 2 * atan(absolute(o.v))};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {atan(-o.v) + atan(o.v), 0};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {2 * atan(o.v / (1 + sqrt(1 + square(o.v)))), atan(o.v)};
       }},
      {inverse,
       [](Made o) -> Sides {
         return {2 * asin(sqrt((1 - o.u) / 2)), acos(o.u)};
       }},
  };
}

std::vector<Rule> roots() {
  const std::string nested = "nested-root", root = "root", abs = "absolute-value";
  return {
      {nested,
       [](Made o) -> Sides {
         return {sqrt(o.p + o.r + 2 * sqrt(o.p * o.r)), sqrt(o.p) + sqrt(o.r)};
       }},
      {nested,
       [](Made o) -> Sides {
         return {sqrt(o.p + o.r + 2 * sqrt(o.p) * sqrt(o.r)), sqrt(o.p) + sqrt(o.r)};
       }},
      {nested,
       [](Made o) -> Sides {
         return {sqrt(o.p + 1 + sqrt(2 * o.p + 1)), (sqrt(2 * o.p + 1) + 1) / sqrt(kTwo)};
       }},
      {nested,
       [](Made o) -> Sides {
         return {sqrt(sqrt(1 + square(o.v)) + o.v) * sqrt(sqrt(1 + square(o.v)) - o.v), 1};
       }},
      {nested,
       [](Made o) -> Sides {
         return {sqrt(o.p + o.r - 2 * sqrt(o.p * o.r)), absolute(sqrt(o.p) - sqrt(o.r))};
       }},
      {nested,
       [](Made o) -> Sides {
         return {sqrt(2 * hypot(o.v, o.w) + 2 * o.v) * sqrt(2 * hypot(o.v, o.w) - 2 * o.v),
                 2 * absolute(o.w)};
       }},
      {nested,
       [](Made o) -> Sides {
         return {sqrt(4 + 2 * o.p + 2 * sqrt(square(o.p) + 4 * o.p + 3)),
                 sqrt(o.p + 1) + sqrt(o.p + 3)};
       }},
      {root,
       [](Made o) -> Sides {
         return {sqrt(o.p) * sqrt(o.r), sqrt(o.p * o.r)};
       }},
      {root,
       [](Made o) -> Sides {
         return {pow(pow(o.p, 3), Expr(1, 3)), o.p};
       }},
      {root,
       [](Made o) -> Sides {
         return {pow(o.p, Expr(2, 3)), square(pow(o.p, Expr(1, 3)))};
       }},
      {root,
       [](Made o) -> Sides {
         return {sqrt(sqrt(o.p)), pow(o.p, Expr(1, 4))};
       }},
      {root,
       [](Made o) -> Sides {
         return {sqrt(square(o.p)), o.p};
       }},
      {root,
       [](Made o) -> Sides {
         return {sqrt(o.p / o.r), sqrt(o.p * o.r) / o.r};
       }},
      {root,
       [](Made o) -> Sides {
         return {1 / (sqrt(o.p + 1) - sqrt(o.p)), sqrt(o.p + 1) + sqrt(o.p)};
       }},
      {abs,
       [](Made o) -> Sides {
         return {square(absolute(o.v)), square(o.v)};
       }},
      {abs,
       [](Made o) -> Sides {
         return {absolute(o.v) * absolute(o.w), absolute(o.v * o.w)};
       }},
      {abs,
       [](Made o) -> Sides {
         return {(absolute(o.v) + o.v) * (absolute(o.v) - o.v), 0};
       }},
      {abs,
       [](Made o) -> Sides {
         return {absolute(o.v * o.p), o.p * absolute(o.v)};
       }},
      {abs,
       [](Made o) -> Sides {
         return {square(absolute(o.v + o.w) + absolute(o.v - o.w)),
                 2 * square(o.v) + 2 * square(o.w) + 2 * absolute(square(o.v) - square(o.w))};
       }},
  };
}

std::vector<Rule> exponentials() {
  const std::string power = "exp-log";
  return {
      {power,
       [](Made o) -> Sides {
         return {exp(o.v) * exp(o.w), exp(o.v + o.w)};
       }},
      {power,
       [](Made o) -> Sides {
         return {log(o.p * o.r), log(o.p) + log(o.r)};
       }},
      {power,
       [](Made o) -> Sides {
         return {log(exp(o.v)), o.v};
       }},
      {power,
       [](Made o) -> Sides {
         return {exp(o.k * log(o.p)), pow(o.p, o.k)};
       }},
      {power,
       [](Made o) -> Sides {
         return {exp(log(o.p) / 2), sqrt(o.p)};
       }},
      {power,
       [](Made o) -> Sides {
         return {pow(o.p, o.v + 1), o.p * pow(o.p, o.v)};
       }},
      {power,
       [](Made o) -> Sides {
         return {exp(o.v * log(o.p)), pow(o.p, o.v)};
       }},
      {power,
       [](Made o) -> Sides {
         return {pow(o.p * o.r, o.v), pow(o.p, o.v) * pow(o.r, o.v)};
       }},
      {power,
       [](Made o) -> Sides {
         return {sqrt(exp(2 * o.v)), exp(o.v)};
       }},
      {power,
       [](Made o) -> Sides {
         return {log(o.v + sqrt(1 + square(o.v))), -log(sqrt(1 + square(o.v)) - o.v)};
       }},
      {power,
       [](Made o) -> Sides {
         return {log(square(o.v)), 2 * log(absolute(o.v))};
       }},
      {power,
       [](Made o) -> Sides {
         return {log(1 / o.p), -log(o.p)};
       }},
      {power,
       [](Made o) -> Sides {
         return {square(exp(o.v) + exp(-o.v)) - square(exp(o.v) - exp(-o.v)), 4};
       }},
  };
}

std::vector<Rule> constants() {
  const std::string constant = "constant";
  const auto add = [&](const Expr& left, const Expr& right) {
    return Rule{constant, [left, right](Made o) -> Sides { return {o.v * left, o.v * right}; }};
  };
  const Expr seventh = cos(Expr::pi() / 7), ninth = sin(Expr::pi() / 18), pi = Expr::pi();
  return {
      add(8 * cube(seventh) - 4 * square(seventh), 4 * seventh - 1),
      add(8 * cube(ninth), 6 * ninth - 1),
      add(cos(2 * pi / 7) + cos(4 * pi / 7) + cos(6 * pi / 7), Expr(-1, 2)),
      add(sqrt(3 + 2 * sqrt(kTwo)), 1 + sqrt(kTwo)),
      add(sqrt(5 + 2 * sqrt(Expr(6))), sqrt(kTwo) + sqrt(Expr(3))),
      add(sqrt(7 - 4 * sqrt(Expr(3))), 2 - sqrt(Expr(3))),
      add(pow(2 + sqrt(Expr(5)), Expr(1, 3)), (1 + sqrt(Expr(5))) / 2),
      add(pow(26 + 15 * sqrt(Expr(3)), Expr(1, 3)), 2 + sqrt(Expr(3))),
      add(tan(pi / 8), sqrt(kTwo) - 1),
      add(4 * cos(pi / 5), 1 + sqrt(Expr(5))),
      add(4 * sin(pi / 12), sqrt(Expr(6)) - sqrt(kTwo)),
      add(atan(Expr(1, 2)) + atan(Expr(1, 3)), pi / 4),
      add(4 * atan(Expr(1, 5)) - atan(Expr(1, 239)), pi / 4),
      add(log(kTwo) + log(Expr(3)), log(Expr(6))),
      add(exp(log(Expr(3)) / 2), sqrt(Expr(3))),
      add(sqrt(kTwo) * sqrt(Expr(3)), sqrt(Expr(6))),
      add(acos(Expr(1, 3)) + asin(Expr(1, 3)), pi / 2),
      add(2 * square(cos(acos(Expr(1, 3)) / 2)), Expr(4, 3)),
      add(asin(Expr(3, 5)) + asin(Expr(4, 5)), pi / 2),
      add(pow(kTwo, Expr(1, 3)) * pow(Expr(4), Expr(1, 3)), 2),
      add(sin(kTwo / 3) * 2 * cos(kTwo / 3), sin(Expr(4) / 3)),
  };
}

}  // namespace

const std::vector<Rule>& true_rules() {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> all;
    for (const auto& part : {angles(), inverse_functions(), roots(), exponentials(), constants(),
                             hyperbolic_functions()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return rules;
}

}  // namespace casimir::adversary

// What is printed reads back as what it is: parse(print(e)) = e for whatever users may feed back.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "symbolic/functions/function_ring.hpp"
#include "symbolic/functions/short_text.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

Model plane() {
  return model_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = { assume = \"a > 0\" }\nb = "
      "{}\n"
      "[equations]\nx = \"1\"\ny = \"a + b\"\n");
}

/// Random expressions in the notation of case files.
class Expressions {
 public:
  explicit Expressions(unsigned seed) : random_(seed) {}

  std::string sum(int depth) {
    std::string result = number() + "*" + factor(depth);
    for (int k = pick(3); k > 0; --k) {
      result += pick(2) == 0 ? " + " : " - ";
      result += product(depth);
    }
    return result;
  }

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  std::string number() {
    const std::vector<std::string> numbers{"1", "2", "1/2", "(-3/4)", "5", "(-1)"};
    return numbers[random_() % numbers.size()];
  }
  std::string product(int depth) {
    std::string result = factor(depth);
    for (int k = pick(2); k > 0; --k) result += "*" + factor(depth);
    return number() + "*" + result;
  }
  std::string factor(int depth) {
    const std::vector<std::string> names{"x", "y", "a", "b"};
    if (depth == 0) return names[random_() % names.size()];
    // What roots and logarithms are taken of is positive.
    const std::string inner = "(" + sum(depth - 1) + ")";
    const std::string positive = "(1 + (" + factor(depth - 1) + ")^2)";
    switch (pick(14)) {
      case 0:
        return positive + "^(1/3)";
      case 1:
        return positive + "^(2/3)";
      case 2:
        return "sqrt" + positive;
      case 3:
        return positive + "^(-3/4)";
      case 4:
        return positive + "^(-2)";
      case 5:
        return inner + "^2";
      case 6:
        return "sin(" + names[random_() % names.size()] + ")^2";
      case 7:
        return "exp(2*" + names[random_() % names.size()] + ")";
      case 8:
        return "log" + positive + "^2";
      case 9:
        return "atan(" + names[random_() % names.size()] + ")^3";
      case 10:
        return "log(x^2 + x*y)^2";
      case 11:
        return "(a*x)^(2/3)";
      default:
        return names[random_() % names.size()] + "^" + std::to_string(1 + pick(3));
    }
  }

  std::mt19937 random_;
};

/// By GiNaC alone, where everything is positive.
double number_at_a_point(const Model& model, const GiNaC::ex& e) {
  GiNaC::exmap point;
  long next = 7;
  for (const auto* list : {&model.variables, &model.parameters})
    for (const GiNaC::symbol& s : *list) point[s] = GiNaC::numeric(next += 4, 9);
  return GiNaC::ex_to<GiNaC::numeric>(e.subs(point).evalf()).to_double();
}

class Printed : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Each, Printed, testing::Range(1U, 81U));

TEST_P(Printed, ReadsBackAsItself) {
  const Model model = plane();
  std::vector<GiNaC::symbol> symbols = model.variables;
  symbols.insert(symbols.end(), model.parameters.begin(), model.parameters.end());
  Expressions expressions(GetParam());
  const std::string source = expressions.sum(2);
  const GiNaC::ex e = model.parse(text(source));
  FunctionRing ring(symbols, model.assumptions, {e}, model.limits);
  const Polynomial p = ring.reduced(ring.convert(e));
  const std::vector<bool> constant = [&] {
    std::vector<bool> result(ring.ring().size(), true);
    for (std::size_t i = 0; i < result.size(); ++i)
      for (const std::size_t v : {0, 1})
        if (!ring.derivative(ring.ring().variable(i), v).is_zero()) result[i] = false;
    return result;
  }();
  const double value = number_at_a_point(model, e);
  // short_text is free to change the sign.
  EXPECT_NEAR(number_at_a_point(model, model.parse(text(ring.text(p)))) / value, 1, 1e-9)
      << source << " is written " << ring.text(p);
  const std::string shorter = search::short_text(ring, p, constant);
  EXPECT_NEAR(std::abs(number_at_a_point(model, model.parse(text(shorter))) / value), 1, 1e-9)
      << source << " is written " << shorter;
}

TEST(Printed, APowerOfARootIsNotTheRootOfAPower) {
  const Model model = plane();
  for (const char* source : {"x^(2/3)", "(x + y)^(4/5)", "(2*x)^(2/3)*y", "sqrt(x)^3",
                             "(x^(1/3) + y)^(2/5)", "log(x^2 + y)^2"}) {
    const GiNaC::ex e = model.parse(text(source));
    std::vector<GiNaC::symbol> symbols = model.variables;
    symbols.insert(symbols.end(), model.parameters.begin(), model.parameters.end());
    FunctionRing ring(symbols, model.assumptions, {e}, model.limits);
    const GiNaC::ex back = model.parse(text(ring.text(ring.convert(e))));
    FunctionRing both(symbols, model.assumptions, {e, back}, model.limits);
    EXPECT_EQ(both.convert(e), both.convert(back))
        << source << " is written " << ring.text(ring.convert(e));
  }
}

}  // namespace
}  // namespace casimir::test

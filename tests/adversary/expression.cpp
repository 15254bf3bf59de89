#include "tests/adversary/expression.hpp"

#include <algorithm>

namespace casimir::adversary {
namespace {

/// How tightly the outermost operation of a text binds.
enum Binding { kSum, kProduct, kPower, kAtom };

struct Printed {
  std::string text;
  Binding binding;
};

Printed printed(const Expr& e);

std::string enclosed(const Expr& e, Binding least) {
  const Printed p = printed(e);
  return p.binding >= least ? p.text : "(" + p.text + ")";
}

Printed printed_number(const Node& n) {
  if (n.denominator != 1)
    return {std::to_string(n.numerator) + "/" + std::to_string(n.denominator),
            n.numerator < 0 ? kSum : kProduct};
  return {std::to_string(n.numerator), n.numerator < 0 ? kSum : kAtom};
}

std::string printed_arguments(const Node& n) {
  std::string text;
  for (const Expr& argument : n.arguments)
    text += (text.empty() ? "" : ", ") + printed(argument).text;
  return text;
}

Printed printed(const Expr& e) {
  const Node& n = e.node();
  switch (n.op) {
    case Op::number:
      return printed_number(n);
    case Op::pi:
      return {"Pi", kAtom};
    case Op::imaginary:
      return {"I", kAtom};
    case Op::symbol:
      return {n.name, kAtom};
    case Op::add:
      return {enclosed(n.arguments[0], kSum) + " + " + enclosed(n.arguments[1], kProduct), kSum};
    case Op::mul:
      return {enclosed(n.arguments[0], kProduct) + "*" + enclosed(n.arguments[1], kPower),
              kProduct};
    case Op::power:
      return {enclosed(n.arguments[0], kAtom) + "^" + enclosed(n.arguments[1], kAtom), kPower};
    case Op::function:
      return {n.name + "(" + printed_arguments(n) + ")", kAtom};
  }
  return {};
}

template <typename Test>
bool any_of(const Expr& e, const Test& test) {
  const Node& n = e.node();
  return test(n) || std::any_of(n.arguments.begin(), n.arguments.end(),
                                [&](const Expr& argument) { return any_of(argument, test); });
}

}  // namespace

Expr::Expr(long value) : Expr(value, 1) {}

Expr::Expr(long numerator, long denominator) {
  auto node = std::make_shared<Node>();
  node->numerator = numerator;
  node->denominator = denominator;
  node_ = std::move(node);
}

Expr::Expr(const std::string& symbol) {
  auto node = std::make_shared<Node>();
  node->op = Op::symbol;
  node->name = symbol;
  node_ = std::move(node);
}

Expr Expr::make(Op op, std::vector<Expr> arguments, std::string name) {
  auto node = std::make_shared<Node>();
  node->op = op;
  node->arguments = std::move(arguments);
  node->name = std::move(name);
  return Expr(std::shared_ptr<const Node>(std::move(node)));
}

Expr Expr::pi() { return make(Op::pi, {}); }
Expr Expr::imaginary() { return make(Op::imaginary, {}); }

bool Expr::is_number() const { return node_->op == Op::number; }

bool Expr::is(long value) const {
  return is_number() && node_->denominator == 1 && node_->numerator == value;
}

std::string Expr::text() const { return printed(*this).text; }

Expr operator+(const Expr& a, const Expr& b) {
  if (a.is(0)) return b;
  if (b.is(0)) return a;
  return Expr::make(Op::add, {a, b});
}

Expr operator-(const Expr& a) { return Expr(-1) * a; }
Expr operator-(const Expr& a, const Expr& b) { return a + -b; }

Expr operator*(const Expr& a, const Expr& b) {
  if (a.is(0) || b.is(0)) return 0;
  if (a.is(1)) return b;
  if (b.is(1)) return a;
  return Expr::make(Op::mul, {a, b});
}

Expr operator/(const Expr& a, const Expr& b) { return a * pow(b, -1); }
Expr pow(const Expr& base, const Expr& exponent) {
  return exponent.is(1) ? base : Expr::make(Op::power, {base, exponent});
}

Expr call(const std::string& name, const Expr& a) { return Expr::make(Op::function, {a}, name); }
Expr sqrt(const Expr& a) { return call("sqrt", a); }
Expr sin(const Expr& a) { return call("sin", a); }
Expr cos(const Expr& a) { return call("cos", a); }
Expr tan(const Expr& a) { return call("tan", a); }
Expr sinh(const Expr& a) { return call("sinh", a); }
Expr cosh(const Expr& a) { return call("cosh", a); }
Expr tanh(const Expr& a) { return call("tanh", a); }
Expr exp(const Expr& a) { return call("exp", a); }
Expr log(const Expr& a) { return call("log", a); }
Expr asin(const Expr& a) { return call("asin", a); }
Expr acos(const Expr& a) { return call("acos", a); }
Expr atan(const Expr& a) { return call("atan", a); }
Expr atan2(const Expr& y, const Expr& x) { return Expr::make(Op::function, {y, x}, "atan2"); }
Expr absolute(const Expr& a) { return sqrt(pow(a, 2)); }

Expr substitute(const Expr& e, const Substitution& values) {
  const Node& n = e.node();
  if (n.op == Op::symbol) {
    const auto it = values.find(n.name);
    return it == values.end() ? e : it->second;
  }
  if (n.arguments.empty()) return e;
  std::vector<Expr> arguments;
  for (const Expr& argument : n.arguments) arguments.push_back(substitute(argument, values));
  return Expr::make(n.op, std::move(arguments), n.name);
}

bool contains(const Expr& e, const std::string& symbol) {
  return any_of(e, [&](const Node& n) { return n.op == Op::symbol && n.name == symbol; });
}

bool is_complex(const Expr& e) {
  return any_of(e, [](const Node& n) { return n.op == Op::imaginary; });
}

}  // namespace casimir::adversary

#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace casimir::adversary {

/// What stands at a node of an expression tree.
enum class Op { number, pi, imaginary, symbol, add, mul, power, function };

struct Node;

/// An expression as the generator knows it: a tree that prints itself in the notation of case files
/// and that `evaluate` gives a value. It simplifies nothing, so that what a reader of the text gets
/// is what was meant; and it shares no code with what it tests.
class Expr {
 public:
  Expr() : Expr(0L) {}
  Expr(long value);
  Expr(int value) : Expr(static_cast<long>(value)) {}
  Expr(long numerator, long denominator);
  /// A variable, a parameter or a name of the case.
  explicit Expr(const std::string& symbol);

  const Node& node() const { return *node_; }
  bool is_number() const;
  /// A number that is this one, as 0 or 1.
  bool is(long value) const;
  /// As a case file has it.
  std::string text() const;

  static Expr pi();
  static Expr imaginary();
  static Expr make(Op op, std::vector<Expr> arguments, std::string name = {});

 private:
  explicit Expr(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

struct Node {
  Op op = Op::number;
  long numerator = 0, denominator = 1;  ///< of a number
  std::string name;                     ///< of a symbol or a function
  std::vector<Expr> arguments;
};

Expr operator+(const Expr& a, const Expr& b);
Expr operator-(const Expr& a, const Expr& b);
Expr operator-(const Expr& a);
Expr operator*(const Expr& a, const Expr& b);
Expr operator/(const Expr& a, const Expr& b);
Expr pow(const Expr& base, const Expr& exponent);
/// A function of case files by its name.
Expr call(const std::string& name, const Expr& a);
Expr sqrt(const Expr& a);
Expr sin(const Expr& a);
Expr cos(const Expr& a);
Expr tan(const Expr& a);
Expr sinh(const Expr& a);
Expr cosh(const Expr& a);
Expr tanh(const Expr& a);
Expr exp(const Expr& a);
Expr log(const Expr& a);
Expr asin(const Expr& a);
Expr acos(const Expr& a);
Expr atan(const Expr& a);
Expr atan2(const Expr& y, const Expr& x);
/// sqrt(a^2), which is how case files write an absolute value.
Expr absolute(const Expr& a);

using Substitution = std::map<std::string, Expr>;
/// With expressions for symbols, all at once.
Expr substitute(const Expr& e, const Substitution& values);
/// Whether the symbol stands in it.
bool contains(const Expr& e, const std::string& symbol);
/// Whether I stands in it, so that its values need not be real.
bool is_complex(const Expr& e);

}  // namespace casimir::adversary

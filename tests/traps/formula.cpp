#include "tests/traps/formula.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace casimir::traps {

/// Recursive descent: a sum of products of powers.
class Reader {
 public:
  using Op = Formulas::Op;
  Reader(Formulas& out, const std::map<std::string, int>& names, const std::string& text)
      : out_(out), names_(names), text_(text) {}

  int all() {
    const int line = sum();
    if (skip() != '\0') fail();
    return line;
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error("no expression: " + text_ + ", at " + std::to_string(at_));
  }

  char skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (skip() != c) return false;
    ++at_;
    return true;
  }
  void need(char c) {
    if (!take(c)) fail();
  }

  int put(Op op, int a = 0, int b = 0, Real value = 0) {
    out_.lines_.push_back({op, a, b, value});
    return static_cast<int>(out_.lines_.size()) - 1;
  }

  int sum() {
    int left = product();
    for (;;) {
      if (take('+'))
        left = put(Op::add, left, product());
      else if (take('-'))
        left = put(Op::subtract, left, product());
      else
        return left;
    }
  }

  int product() {
    int left = sign();
    for (;;) {
      if (take('*'))
        left = put(Op::multiply, left, sign());
      else if (take('/'))
        left = put(Op::divide, left, sign());
      else
        return left;
    }
  }

  int sign() {
    if (take('-')) return put(Op::negate, sign());
    if (take('+')) return sign();
    const int base = atom();
    if (!take('^')) return base;
    const std::size_t before = at_;
    const bool minus = take('-');
    skip();
    const std::size_t digits = at_;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) ++at_;
    if (at_ > digits && skip() != '^' && skip() != '.') {
      const int n = std::stoi(text_.substr(digits, at_ - digits));
      return put(Op::whole_power, base, minus ? -n : n);
    }
    at_ = before;
    return put(Op::power, base, sign());
  }

  int atom() {
    if (take('(')) {
      const int inner = sum();
      need(')');
      return inner;
    }
    const char c = skip();
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(c))) return name();
    fail();
  }

  int number() {
    char* end = nullptr;
    const Real value = std::strtold(text_.c_str() + at_, &end);
    at_ = static_cast<std::size_t>(end - text_.c_str());
    return put(Op::constant, 0, 0, value);
  }

  int name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    if (word == "Pi") return put(Op::constant, 0, 0, std::acos(Real(-1)));
    if (const auto known = names_.find(word); known != names_.end()) return known->second;
    static const std::map<std::string, Op> functions = {
        {"sqrt", Op::sqrt}, {"sin", Op::sin},     {"cos", Op::cos},      {"tan", Op::tan},
        {"exp", Op::exp},   {"log", Op::log},     {"asin", Op::asin},    {"acos", Op::acos},
        {"atan", Op::atan}, {"atan2", Op::atan2}, {"sinh", Op::sinh},    {"cosh", Op::cosh},
        {"tanh", Op::tanh}, {"cot", Op::cot},     {"abs", Op::absolute}, {"sign", Op::sign}};
    const auto function = functions.find(word);
    if (function == functions.end()) fail();
    need('(');
    const int a = sum();
    int b = 0;
    if (function->second == Op::atan2) {
      need(',');
      b = sum();
    }
    need(')');
    return put(function->second, a, b);
  }

  Formulas& out_;
  const std::map<std::string, int>& names_;
  const std::string& text_;
  std::size_t at_ = 0;
};

Formulas::Formulas(const Texts& symbols, const Named& definitions, const Texts& texts) {
  std::map<std::string, int> names;
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    lines_.push_back({Op::symbol, static_cast<int>(i), 0, 0});
    names[symbols[i]] = static_cast<int>(i);
  }
  for (const auto& [name, text] : definitions) names[name] = Reader(*this, names, text).all();
  for (const std::string& text : texts) results_.push_back(Reader(*this, names, text).all());
  values_.resize(lines_.size());
}

void Formulas::operator()(const Real* symbols, Real* values) {
  for (std::size_t i = 0; i < lines_.size(); ++i) values_[i] = value_of(lines_[i], symbols);
  for (std::size_t i = 0; i < results_.size(); ++i)
    values[i] = values_[static_cast<std::size_t>(results_[i])];
}

namespace {

Real whole_power(Real base, int n) {
  Real result = 1;
  for (int k = std::abs(n); k > 0; k /= 2, base *= base)
    if (k % 2 != 0) result *= base;
  return n < 0 ? 1 / result : result;
}

}  // namespace

Real Formulas::value_of(const Line& line, const Real* symbols) const {
  const Real a = values_[static_cast<std::size_t>(line.a)];
  const auto b = [&] { return values_[static_cast<std::size_t>(line.b)]; };
  switch (line.op) {
    case Op::constant:
      return line.value;
    case Op::symbol:
      return symbols[line.a];
    case Op::add:
      return a + b();
    case Op::subtract:
      return a - b();
    case Op::multiply:
      return a * b();
    case Op::divide:
      return a / b();
    case Op::negate:
      return -a;
    case Op::whole_power:
      return whole_power(a, line.b);
    case Op::power:
      return std::pow(a, b());
    case Op::sqrt:
      return std::sqrt(a);
    case Op::sin:
      return std::sin(a);
    case Op::cos:
      return std::cos(a);
    case Op::tan:
      return std::tan(a);
    case Op::exp:
      return std::exp(a);
    case Op::log:
      return std::log(a);
    case Op::asin:
      return std::asin(a);
    case Op::acos:
      return std::acos(a);
    case Op::atan:
      return std::atan(a);
    case Op::atan2:
      return std::atan2(a, b());
    case Op::sinh:
      return std::sinh(a);
    case Op::cosh:
      return std::cosh(a);
    case Op::tanh:
      return std::tanh(a);
    case Op::cot:
      return 1 / std::tan(a);
    case Op::absolute:
      return std::abs(a);
    case Op::sign:
      return static_cast<Real>((a > 0) - (a < 0));
  }
  return 0;
}

Real constant(const std::string& text) {
  Real value = 0;
  Formulas({}, {}, {text})(nullptr, &value);
  return value;
}

}  // namespace casimir::traps

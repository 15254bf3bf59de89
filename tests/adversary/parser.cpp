#include "tests/adversary/parser.hpp"

#include <cctype>
#include <stdexcept>

namespace casimir::adversary {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text) {}

  Expr whole() {
    const Expr e = sum();
    if (peek() != '\0') fail();
    return e;
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error("cannot read '" + text_ + "' at " + std::to_string(at_));
  }

  char peek() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  Expr sum() {
    Expr e = take('-') ? -product() : product();
    for (;;) {
      if (take('+')) {
        e = e + product();
      } else if (take('-')) {
        e = e - product();
      } else {
        return e;
      }
    }
  }

  Expr product() {
    Expr e = power();
    for (;;) {
      if (take('*')) {
        e = e * power();
      } else if (take('/')) {
        e = e / power();
      } else {
        return e;
      }
    }
  }

  Expr power() {
    const Expr base = atom();
    if (!take('^')) return base;
    const bool negative = take('-');
    const Expr exponent = folded(power());
    return pow(base, negative ? folded(-exponent) : exponent);
  }

  /// A quotient of numbers as one number, so that a root is seen as one.
  static Expr folded(const Expr& e) {
    const Node& n = e.node();
    if (n.op != Op::mul || !n.arguments[0].is_number()) return e;
    const Node& a = n.arguments[0].node();
    const Node& b = n.arguments[1].node();
    if (b.op == Op::number) return {a.numerator * b.numerator, a.denominator * b.denominator};
    if (b.op == Op::power && b.arguments[1].is(-1) && b.arguments[0].is_number()) {
      const Node& d = b.arguments[0].node();
      return {a.numerator * d.denominator, a.denominator * d.numerator};
    }
    return e;
  }

  Expr atom() {
    const char c = peek();
    if (take('(')) {
      const Expr e = sum();
      if (!take(')')) fail();
      return e;
    }
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) return number();
    if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') return name();
    fail();
  }

  /// Long ones by parts of nine digits: a number of the tree is a machine word.
  Expr number() {
    constexpr std::size_t kDigits = 9;
    Expr result = 0;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0) {
      long part = 0, scale = 1;
      for (std::size_t k = 0; k < kDigits && at_ < text_.size() &&
                              std::isdigit(static_cast<unsigned char>(text_[at_])) != 0;
           ++k, ++at_) {
        part = 10 * part + (text_[at_] - '0');
        scale *= 10;
      }
      result = result.is(0) ? Expr(part) : result * scale + part;
    }
    return result;
  }

  Expr name() {
    const std::size_t first = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    const std::string word = text_.substr(first, at_ - first);
    if (take('(')) {
      const Expr a = sum();
      if (word == "atan2") {
        if (!take(',')) fail();
        const Expr b = sum();
        if (!take(')')) fail();
        return atan2(a, b);
      }
      if (!take(')')) fail();
      return call(word, a);
    }
    return word == "Pi" ? Expr::pi() : word == "I" ? Expr::imaginary() : Expr(word);
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

Expr parse(const std::string& text) { return Reader(text).whole(); }

Assumption parse_assumption(const std::string& text) {
  for (const char* relation : {"!=", "==", "<=", ">=", "<", ">"}) {
    const std::size_t place = text.find(relation);
    if (place == std::string::npos) continue;
    return {parse(text.substr(0, place)) - parse(text.substr(place + std::string(relation).size())),
            relation};
  }
  throw std::runtime_error("no relation in '" + text + "'");
}

}  // namespace casimir::adversary

#include "symbolic/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

namespace casimir {
namespace {

struct Function {
  std::string_view name;
  std::size_t arity;
  GiNaC::ex (*apply)(const GiNaC::ex&, const GiNaC::ex&);
};

using GiNaC::ex;

constexpr std::array kFunctions = {
    Function{"sqrt", 1, [](const ex& a, const ex&) -> ex { return GiNaC::sqrt(a); }},
    Function{"sin", 1, [](const ex& a, const ex&) -> ex { return GiNaC::sin(a); }},
    Function{"cos", 1, [](const ex& a, const ex&) -> ex { return GiNaC::cos(a); }},
    Function{"tan", 1, [](const ex& a, const ex&) -> ex { return GiNaC::tan(a); }},
    Function{"exp", 1, [](const ex& a, const ex&) -> ex { return GiNaC::exp(a); }},
    Function{"log", 1, [](const ex& a, const ex&) -> ex { return GiNaC::log(a); }},
    Function{"asin", 1, [](const ex& a, const ex&) -> ex { return GiNaC::asin(a); }},
    Function{"acos", 1, [](const ex& a, const ex&) -> ex { return GiNaC::acos(a); }},
    Function{"atan", 1, [](const ex& a, const ex&) -> ex { return GiNaC::atan(a); }},
    Function{"atan2", 2, [](const ex& a, const ex& b) -> ex { return GiNaC::atan2(a, b); }},
};

const Function* find_function(const std::string& name) {
  const auto it = std::find_if(kFunctions.begin(), kFunctions.end(),
                               [&](const Function& f) { return f.name == name; });
  return it == kFunctions.end() ? nullptr : &*it;
}

bool is_name_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_name_part(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

double bit_length(const GiNaC::numeric& number) {
  return std::max<double>(number.numer().int_length(), number.denom().int_length());
}

/// Recursive descent over one range of the text. Sums and products are collected before GiNaC sees
/// them, since adding term by term costs quadratic time.
class Parser {
 public:
  Parser(const Text& text, Names& names, std::size_t begin, std::size_t end)
      : text_(text), names_(names), at_(begin), end_(end) {}

  Quantity parse() {
    Quantity result = sum();
    if (peek() != '\0') fail("unexpected " + here() + ", expected an operator or the end");
    return result;
  }

 private:
  class Depth {
   public:
    explicit Depth(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kMaxNesting) {
        parser_.fail(fmt::format("the expression is nested more than {} deep", kMaxNesting));
      }
    }
    ~Depth() { --parser_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    Parser& parser_;
  };

  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
    throw text_.error(what, at_, hint);
  }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what,
                            const std::string& hint = {}) const {
    throw text_.error(what, offset, hint);
  }

  char peek() {
    while (at_ < end_ && std::isspace(static_cast<unsigned char>(text_.value[at_]))) ++at_;
    return at_ < end_ ? text_.value[at_] : '\0';
  }

  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  std::string here() {
    if (peek() == '\0' && at_ >= end_) return "end of the expression";
    std::size_t length = 1;
    while (at_ + length < end_ &&
           (static_cast<unsigned char>(text_.value[at_ + length]) & 0xC0) == 0x80) {
      ++length;  // the rest of a UTF-8 sequence
    }
    return "'" + printable(text_.value.substr(at_, length)) + "'";
  }

  Quantity checked(Quantity q, std::size_t offset) const {
    if (q.degree > kMaxDegree)
      fail_at(offset, fmt::format("the degree here exceeds {:.0f}", kMaxDegree));
    if (q.bits > kMaxBits)
      fail_at(offset, fmt::format("a number here would have more than {:.0f} bits", kMaxBits));
    if (q.nodes > kMaxNodes)
      fail_at(offset,
              fmt::format("the expression has more than {:.0f} terms and factors", kMaxNodes));
    return q;
  }

  Quantity sum() {
    const Depth depth(*this);
    Quantity total = product();
    GiNaC::exvector terms{total.value};
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      const std::size_t offset = at_++;
      const Quantity next = product();
      terms.push_back(c == '+' ? next.value : -next.value);
      total.bits = std::max(total.bits, next.bits) + 1;
      total.degree = std::max(total.degree, next.degree);
      total.nodes += next.nodes;
      checked({0, 0, total.degree, total.nodes}, offset);
    }
    if (terms.size() > 1) {
      total.bits -= static_cast<double>(terms.size()) - 1 -
                    std::ceil(std::log2(static_cast<double>(terms.size())));
      total.value = GiNaC::add(terms);
    }
    return total;
  }

  Quantity product() {
    Quantity total = unary();
    GiNaC::exvector factors{total.value};
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      const std::size_t offset = at_++;
      if (c == '*' && at_ < end_ && text_.value[at_] == '*')
        fail("unexpected '**'", "write a power as x^2");
      const Quantity next = unary();
      if (c == '/' && next.value.is_zero()) fail_at(offset, "division by zero");
      factors.push_back(c == '*' ? next.value : GiNaC::pow(next.value, -1));
      total.bits += next.bits;
      total.degree += next.degree;
      total.nodes += next.nodes;
      checked(total, offset);
    }
    if (factors.size() > 1) total.value = GiNaC::mul(factors);
    return total;
  }

  Quantity unary() {
    const Depth depth(*this);
    if (accept('-')) {
      Quantity q = unary();
      q.value = -q.value;
      return q;
    }
    if (accept('+')) return unary();
    return power();
  }

  Quantity power() {
    const Quantity base = primary();
    if (peek() != '^') return base;
    const std::size_t offset = at_++;
    const Quantity exponent = unary();
    Quantity q{0, base.bits, base.degree, base.nodes + exponent.nodes};
    if (GiNaC::is_a<GiNaC::numeric>(exponent.value)) {
      const GiNaC::numeric e = GiNaC::ex_to<GiNaC::numeric>(exponent.value);
      if (base.value.is_zero() && !e.is_positive())
        fail_at(offset, "zero to a power that is not positive");
      const double size = std::max(1.0, std::abs(e.to_double()));
      q.bits *= size;
      q.degree *= size;
      checked(q, offset);
    } else {
      q.degree += exponent.degree;
      q.bits += exponent.bits;
      if (base.value.is_zero()) fail_at(offset, "zero to a power that is not a number");
    }
    q.value = evaluated(offset, [&] { return ex(GiNaC::pow(base.value, exponent.value)); });
    return checked(q, offset);
  }

  /// Runs one GiNaC operation that may meet a pole.
  template <class Operation>
  ex evaluated(std::size_t offset, Operation operation) const {
    try {
      return operation();
    } catch (const GiNaC::pole_error&) {
      fail_at(offset, "this has no value: division by zero or a pole of the function");
    } catch (const std::exception& problem) {
      fail_at(offset, fmt::format("this has no value ({})", printable(problem.what(), 80)));
    }
  }

  Quantity primary() {
    const char c = peek();
    if (c == '(') {
      ++at_;
      Quantity q = sum();
      if (!accept(')')) fail("unexpected " + here() + ", expected ')'");
      return q;
    }
    if (is_digit(c) || c == '.') return number();
    if (is_name_start(c)) return name();
    const bool ascii = static_cast<unsigned char>(c) < 0x80;
    fail("unexpected " + here() + ", expected a number, a name or '('",
         ascii ? "" : "names consist of the ASCII letters, digits and '_'");
  }

  std::string digits() {
    const std::size_t start = at_;
    while (at_ < end_ && is_digit(text_.value[at_])) ++at_;
    return text_.value.substr(start, at_ - start);
  }

  Quantity number() {
    const std::size_t start = at_;
    std::string mantissa = digits();
    long exponent = 0;
    if (at_ < end_ && text_.value[at_] == '.') {
      ++at_;
      const std::string fraction = digits();
      exponent = -static_cast<long>(fraction.size());
      mantissa += fraction;
    }
    if (mantissa.empty()) fail_at(start, "a decimal point without digits");
    if (at_ < end_ && (text_.value[at_] == 'e' || text_.value[at_] == 'E'))
      exponent += exponent_part(start);
    if (at_ < end_ && is_name_start(text_.value[at_]))
      fail("unexpected " + here() + " after a number", "write products with '*'");
    const double bits =
        (static_cast<double>(mantissa.size()) + std::abs(static_cast<double>(exponent))) * 3.33;
    checked({0, bits, 0, 1}, start);
    const GiNaC::numeric digits_value(mantissa.c_str());
    const GiNaC::numeric value =
        digits_value * GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(exponent));
    return {value, std::max(1.0, bit_length(value)), 0, 1};
  }

  long exponent_part(std::size_t start) {
    ++at_;
    const bool negative = at_ < end_ && text_.value[at_] == '-';
    if (at_ < end_ && (text_.value[at_] == '-' || text_.value[at_] == '+')) ++at_;
    const std::string value = digits();
    if (value.empty()) fail_at(start, "a number with an empty exponent");
    if (value.size() > 6)
      fail_at(start, fmt::format("a number here would have more than {:.0f} bits", kMaxBits));
    return (negative ? -1 : 1) * std::stol(value);
  }

  Quantity name() {
    const std::size_t start = at_;
    while (at_ < end_ && is_name_part(text_.value[at_])) ++at_;
    const std::string word = text_.value.substr(start, at_ - start);
    if (const Function* function = find_function(word)) return call(*function, start);
    if (peek() == '(' && names_.find(word) == nullptr) {
      std::vector<std::string> functions;
      for (const Function& f : kFunctions) functions.emplace_back(f.name);
      fail_at(start, fmt::format("unknown function '{}'", printable(word)),
              suggest(word, functions));
    }
    if (word == "Pi") return {GiNaC::Pi, 1, 0, 1};
    if (word == "I") return {GiNaC::I, 1, 0, 1};
    if (const Quantity* known = names_.find(word)) return *known;
    fail_at(start, fmt::format("'{}' is not declared", printable(word)),
            suggest(word, names_.known()));
  }

  Quantity call(const Function& function, std::size_t start) {
    if (!accept('('))
      fail_at(start, fmt::format("'{}' is a function and needs '('", function.name));
    std::vector<Quantity> arguments;
    if (peek() != ')') {
      do {
        arguments.push_back(sum());
      } while (accept(','));
    }
    if (!accept(')')) fail("unexpected " + here() + ", expected ',' or ')'");
    if (arguments.size() != function.arity) {
      fail_at(start, fmt::format("'{}' takes {} argument{}, {} given", function.name,
                                 function.arity, function.arity == 1 ? "" : "s", arguments.size()));
    }
    const Quantity& first = arguments.front();
    const Quantity& last = arguments.back();
    Quantity q{0, first.bits + last.bits, std::max(1.0, first.degree + last.degree),
               1 + first.nodes + last.nodes};
    q.value = evaluated(start, [&] { return function.apply(first.value, last.value); });
    return checked(q, start);
  }

  const Text& text_;
  Names& names_;
  std::size_t at_;
  std::size_t end_;
  int depth_ = 0;
};

Quantity parse_range(const Text& text, Names& names, std::size_t begin, std::size_t end) {
  if (text.value.size() > kMaxExpressionBytes) {
    throw text.error(fmt::format("the expression has {} bytes; the limit is {}", text.value.size(),
                                 kMaxExpressionBytes));
  }
  return Parser(text, names, begin, end).parse();
}

const std::set<std::string_view>& cpp_keywords() {
  static const std::set<std::string_view> words = {
      "alignas",       "alignof",     "and",
      "and_eq",        "asm",         "auto",
      "bitand",        "bitor",       "bool",
      "break",         "case",        "catch",
      "char",          "char8_t",     "char16_t",
      "char32_t",      "class",       "compl",
      "concept",       "const",       "consteval",
      "constexpr",     "constinit",   "const_cast",
      "continue",      "co_await",    "co_return",
      "co_yield",      "decltype",    "default",
      "delete",        "do",          "double",
      "dynamic_cast",  "else",        "enum",
      "explicit",      "export",      "extern",
      "false",         "float",       "for",
      "friend",        "goto",        "if",
      "inline",        "int",         "long",
      "mutable",       "namespace",   "new",
      "noexcept",      "not",         "not_eq",
      "nullptr",       "operator",    "or",
      "or_eq",         "private",     "protected",
      "public",        "register",    "reinterpret_cast",
      "requires",      "return",      "short",
      "signed",        "sizeof",      "static",
      "static_assert", "static_cast", "struct",
      "switch",        "template",    "this",
      "thread_local",  "throw",       "true",
      "try",           "typedef",     "typeid",
      "typename",      "union",       "unsigned",
      "using",         "virtual",     "void",
      "volatile",      "wchar_t",     "while",
      "xor",           "xor_eq"};
  return words;
}

}  // namespace

const Quantity* NameTable::find(const std::string& name) {
  const auto it = table_.find(name);
  return it == table_.end() ? nullptr : &it->second;
}

std::vector<std::string> NameTable::known() const {
  std::vector<std::string> names;
  for (const auto& [name, quantity] : table_) names.push_back(name);
  return names;
}

Quantity parse_expression(const Text& text, Names& names) {
  return parse_range(text, names, 0, text.value.size());
}

GiNaC::ex parse_constant(const Text& text) {
  NameTable empty;
  return parse_expression(text, empty).value;
}

Relation parse_relation(const Text& text, Names& names) {
  const std::string& s = text.value;
  const std::size_t at = s.find_first_of("!=<>");
  if (at == std::string::npos) {
    throw text.error("expected a condition such as 'r != 0' or 'G > 0'");
  }
  const bool two = at + 1 < s.size() && s[at + 1] == '=';
  std::string relation = s.substr(at, two ? 2 : 1);
  if (relation == "=") relation = "==";
  if (relation == "!") throw text.error("unexpected '!', expected '!='", at);
  return {parse_range(text, names, 0, at).value, relation,
          parse_range(text, names, at + (two ? 2 : 1), s.size()).value};
}

void check_name(const Text& name, const std::string& what) {
  const std::string& s = name.value;
  const std::string shown = printable(s);
  if (s.empty() || !is_name_start(s[0]) || !std::all_of(s.begin(), s.end(), is_name_part)) {
    throw name.error(fmt::format("'{}' cannot name {}", shown, what), 0,
                     "a name is an ASCII letter or '_', then letters, digits and '_'");
  }
  if (s.size() > kMaxNameLength) {
    throw name.error(
        fmt::format("the name '{}' is longer than {} characters", shown, kMaxNameLength));
  }
  if (find_function(s) != nullptr || s == "Pi" || s == "I") {
    throw name.error(fmt::format("'{}' is a function or constant and cannot name {}", s, what));
  }
  if (cpp_keywords().contains(s)) {
    throw name.error(fmt::format("'{}' is a C++ keyword and cannot name {}", s, what));
  }
}

}  // namespace casimir

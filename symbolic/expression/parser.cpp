// Expressions: the grammar of sums, products, powers and numbers.
#include "symbolic/expression/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "symbolic/expression/expression_size.hpp"
#include "symbolic/expression/name_characters.hpp"
#include "symbolic/expression/notation.hpp"
#include "symbolic/expression/principal_values.hpp"
#include "symbolic/expression/read_decimal.hpp"
#include "symbolic/expression/spelling.hpp"

namespace casimir {

using GiNaC::ex;

Quantity Parser::parse() {
  Quantity result = sum();
  if (peek() != '\0') unexpected("an operator or the end");
  if (!parts_.empty()) result.parts = std::make_shared<const std::vector<ex>>(std::move(parts_));
  return result;
}

void Parser::fail(const std::string& what, const std::string& hint) const {
  fail_at(at_, what, hint);
}

void Parser::fail_at(std::size_t offset, const std::string& what, const std::string& hint,
                     double Limits::*limit) const {
  const std::string escape = spelling_of_escape(text_.value, text_.excerpt.text());
  throw text_.error(what, offset, escape.empty() ? hint : escape, limit);
}

void Parser::unexpected(const std::string& expected) {
  fail("unexpected " + here() + ", expected " + expected, hint_for(peek()));
}

std::string Parser::hint_for(char c) const {
  if (c == '(' || is_name_part(c)) return "write products with '*'";
  if (static_cast<unsigned char>(c) < 0x80) return spelling_of_sign(text_.value, at_);
  const std::string spelling = spelling_of_character(character());
  return spelling.empty() ? "names consist of the ASCII letters, digits and '_'" : spelling;
}

char Parser::peek() {
  while (at_ < end_) {
    const bool space = std::isspace(static_cast<unsigned char>(text_.value[at_])) != 0;
    const std::size_t length = space ? 1 : latex_space(text_.value, at_);
    if (length == 0) break;
    at_ += length;
  }
  return at_ < end_ ? text_.value[at_] : '\0';
}

bool Parser::accept(char c) {
  if (peek() != c) return false;
  ++at_;
  return true;
}

std::string Parser::here() {
  if (peek() == '\0' && at_ >= end_) return "end of the expression";
  return "'" + printable(character()) + "'";
}

std::string Parser::character() const { return utf8_character(text_.value, at_, end_); }

void Parser::check(double value, double Limits::*limit, std::size_t offset,
                   const char* what) const {
  if (value <= limits_.*limit) return;  // false also for what is not a number
  fail_at(offset, fmt::format(fmt::runtime(what), limits_.*limit), limits_.hint(limit), limit);
}

Quantity Parser::checked(Quantity q, std::size_t offset) const {
  check(q.degree, &Limits::degree, offset, "the degree here exceeds {:.0f}");
  check(q.bits, &Limits::bits, offset, "a number here would have more than {:.0f} bits");
  check(q.nodes, &Limits::size, offset, "the expression has more than {:.0f} terms and factors");
  check(q.depth, &Limits::depth, offset, "the tree of the expression has more than {:.0f} levels");
  return q;
}

Quantity Parser::sum() {
  const Depth depth(*this);
  const std::size_t start = at_;
  Quantity total = product();
  GiNaC::exvector terms{total.value};
  for (char c = peek(); c == '+' || c == '-'; c = peek()) {
    const std::size_t offset = at_++;
    const Quantity next = product();
    if (next.vector != total.vector) fail_at(offset, "a vector and a number are added");
    terms.push_back(c == '+' ? next.value : -next.value);
    total.bits = std::max(total.bits, next.bits) + 1;
    total.degree = std::max(total.degree, next.degree);
    total.nodes += next.nodes;
    total.depth = std::max(total.depth, next.depth);
    checked({0, 0, total.degree, total.nodes}, offset);
  }
  if (terms.size() > 1) {
    total.depth += 1;
    total.bits -= static_cast<double>(terms.size()) - 1 -
                  std::ceil(std::log2(static_cast<double>(terms.size())));
    total.value = evaluated(start, [&] { return ex(GiNaC::add(terms)); });
  }
  return total;
}

char Parser::product_sign() {
  const char c = peek();
  if (c == '*' || c == '/') return c;
  const std::string_view command = latex_command(text_.value, at_);
  return command == "cdot" || command == "times" ? '*' : '\0';
}

bool Parser::accept_power() {
  if (accept('^')) return true;
  if (text_.value.compare(at_, 2, "**") != 0 || at_ + 2 > end_) return false;
  at_ += 2;
  return true;
}

Quantity Parser::braced() {
  if (!accept('{'))
    fail("unexpected " + here() + ", expected '{'", "as in \\frac{a}{b}, with both in braces");
  const std::size_t start = at_;
  const Quantity q = number_of(start, sum());
  if (!accept('}')) unexpected("'}'");
  return q;
}

Quantity Parser::product() {
  const std::size_t start = at_;
  Quantity total = unary();
  GiNaC::exvector factors{total.value};
  for (char c = product_sign(); c != '\0'; c = product_sign()) {
    const std::size_t offset = at_;
    at_ += std::max<std::size_t>(1, 1 + latex_command(text_.value, at_).size());
    const Quantity next = unary();
    if (next.vector && (c == '/' || total.vector))
      fail_at(offset, c == '/' ? "this divides by a vector" : "a vector times a vector",
              "write dot(a, b) or cross(a, b)");
    total.vector = total.vector || next.vector;
    if (c == '/' && next.value.is_zero()) fail_at(offset, "division by zero");
    factors.push_back(c == '*' ? next.value
                               : evaluated(offset, [&] { return ex(GiNaC::pow(next.value, -1)); }));
    if (c == '/') add_part(factors.back());
    total.bits += next.bits;
    total.degree += next.degree;
    total.nodes += next.nodes;
    total.depth = std::max(total.depth, next.depth);
    checked(total, offset);
  }
  if (factors.size() > 1) {
    total.depth += 1;
    total.value = evaluated(start, [&] { return ex(GiNaC::mul(factors)); });
  }
  return total;
}

Quantity Parser::unary() {
  const Depth depth(*this);
  if (accept('-')) {
    Quantity q = unary();
    q.value = -q.value;
    return q;
  }
  if (accept('+')) return unary();
  return power();
}

Quantity Parser::power() {
  const Quantity base = primary();
  peek();
  const std::size_t offset = at_;
  if (!accept_power()) return base;
  if (base.vector) fail_at(offset, "a vector has no powers", "its square is dot(a, a)");
  const Quantity exponent = number_of(offset, peek() == '{' ? braced() : unary());
  Quantity q{0, base.bits, base.degree, base.nodes + exponent.nodes,
             1 + std::max(base.depth, exponent.depth)};
  if (GiNaC::is_a<GiNaC::numeric>(exponent.value)) {
    const GiNaC::numeric e = GiNaC::ex_to<GiNaC::numeric>(exponent.value);
    if (base.value.is_zero() && !e.is_positive())
      fail_at(offset, "zero to a power that is not positive");
    const double size =
        std::max(1.0, e.is_real() ? std::abs(e.to_double()) : GiNaC::abs(e).to_double());
    q.bits *= size;
    q.degree *= size;
    checked(q, offset);
  } else {
    q.degree += exponent.degree;
    q.bits += exponent.bits;
    if (base.value.is_zero()) fail_at(offset, "zero to a power that is not a number");
  }
  q.value = real_value(
      evaluated(offset,
                [&] { return principal_power(base.value, exponent.value, complex_numbers()); }),
      offset);
  if (!exponent.value.info(GiNaC::info_flags::nonnegint)) add_part(q.value);
  return checked(q, offset);
}

ex Parser::real_value(const ex& value, std::size_t offset) const {
  if (!complex_numbers() && is_complex_constant(value))
    fail_at(offset, "this has no real value",
            "roots and logarithms are those of real numbers unless the case has I");
  return value;
}

Quantity Parser::primary() {
  const char c = peek();
  if (c == '(') {
    ++at_;
    Quantity q = sum();
    if (!accept(')')) unexpected("')'");
    return q;
  }
  if (c == '{') return bracket();
  if ((c >= '0' && c <= '9') || c == '.') return number();
  if (is_name_start(c)) return name();
  if (const std::string_view command = latex_command(text_.value, at_); !command.empty())
    return latex(command);
  unexpected("a number, a name or '('");
}

Quantity Parser::number() {
  const std::size_t start = at_;
  const Decimal read = read_decimal(std::string_view(text_.value).substr(0, end_), at_);
  at_ = read.end;
  if (!read.problem.empty()) fail_at(start, read.problem);
  if (at_ < end_ && is_name_start(text_.value[at_]))
    fail("unexpected " + here() + " after a number", "write products with '*'");
  checked({0, read.bits, 0, 1}, start);
  const GiNaC::numeric value = read.value();
  return {value, std::max(1.0, bit_length(value)), 0, 1};
}

Quantity Parser::latex(std::string_view command) {
  const std::size_t start = at_++;
  if (command == "frac" || command == "dfrac" || command == "tfrac") {
    at_ += command.size();
    const Quantity top = braced(), bottom = braced();
    if (bottom.value.is_zero()) fail_at(start, "division by zero");
    Quantity q{evaluated(start, [&] { return top.value / bottom.value; }), top.bits + bottom.bits,
               top.degree + bottom.degree, top.nodes + bottom.nodes,
               1 + std::max(top.depth, bottom.depth)};
    add_part(GiNaC::pow(bottom.value, -1));
    return checked(q, start);
  }
  return name();
}

void Parser::add_parts_of(const Quantity& quantity) {
  if (!quantity.parts) return;
  for (const ex& part : *quantity.parts) add_part(part);
}

void Parser::add_part(const ex& part) {
  if (!GiNaC::is_a<GiNaC::numeric>(part) && seen_.insert(part).second) parts_.push_back(part);
}

}  // namespace casimir

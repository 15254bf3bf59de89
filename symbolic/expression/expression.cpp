#include "symbolic/expression/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/arbitrary_call.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/expression/expression_range.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/expression/indices.hpp"
#include "symbolic/expression/name_characters.hpp"
#include "symbolic/expression/notation.hpp"
#include "symbolic/expression/principal_values.hpp"
#include "symbolic/expression/read_decimal.hpp"
#include "symbolic/expression/spelling.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Recursive descent over one range of the text. Sums and products are collected before GiNaC sees
/// them, since adding term by term costs quadratic time.
class Parser {
  /// A body of so many characters is as much work as a term.
  static constexpr double kCharactersOfTerm = 1000;

 public:
  Parser(const Text& text, Scope& names, std::size_t begin, std::size_t end)
      : text_(text), names_(names), at_(begin), end_(end) {}

  Quantity parse() {
    Quantity result = sum();
    if (peek() != '\0') unexpected("an operator or the end");
    if (!parts_.empty()) result.parts = std::make_shared<const std::vector<ex>>(std::move(parts_));
    return result;
  }

 private:
  class Depth {
   public:
    explicit Depth(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > limits().nesting)
        parser_.fail(
            fmt::format("the expression is nested more than {:.0f} deep", limits().nesting),
            limit_hint(&Limits::nesting));
    }
    ~Depth() { --parser_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    Parser& parser_;
  };

  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
    fail_at(at_, what, hint);
  }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what,
                            const std::string& hint = {}) const {
    const std::string escape = spelling_of_escape(text_.value, text_.excerpt.text());
    throw text_.error(what, offset, escape.empty() ? hint : escape);
  }

  /// What stands here cannot: `expected` could.
  [[noreturn]] void unexpected(const std::string& expected) {
    fail("unexpected " + here() + ", expected " + expected, hint_for(peek()));
  }

  /// What people mean who write this character where no expression has it.
  std::string hint_for(char c) const {
    if (c == '(' || is_name_part(c)) return "write products with '*'";
    if (static_cast<unsigned char>(c) < 0x80) return spelling_of_sign(text_.value, at_);
    const std::string spelling = spelling_of_character(character());
    return spelling.empty() ? "names consist of the ASCII letters, digits and '_'" : spelling;
  }

  char peek() {
    while (at_ < end_) {
      const bool space = std::isspace(static_cast<unsigned char>(text_.value[at_])) != 0;
      const std::size_t length = space ? 1 : latex_space(text_.value, at_);
      if (length == 0) break;
      at_ += length;
    }
    return at_ < end_ ? text_.value[at_] : '\0';
  }

  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  std::string here() {
    if (peek() == '\0' && at_ >= end_) return "end of the expression";
    return "'" + printable(character()) + "'";
  }

  std::string character() const { return utf8_character(text_.value, at_, end_); }

  void check(double value, double Limits::*limit, std::size_t offset, const char* what) const {
    if (value <= limits().*limit) return;  // false also for what is not a number
    fail_at(offset, fmt::format(fmt::runtime(what), limits().*limit), limit_hint(limit));
  }

  Quantity checked(Quantity q, std::size_t offset) const {
    check(q.degree, &Limits::degree, offset, "the degree here exceeds {:.0f}");
    check(q.bits, &Limits::bits, offset, "a number here would have more than {:.0f} bits");
    check(q.nodes, &Limits::size, offset, "the expression has more than {:.0f} terms and factors");
    check(q.depth, &Limits::depth, offset,
          "the tree of the expression has more than {:.0f} levels");
    return q;
  }

  Quantity sum() {
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

  /// '*' or '/', if one of them or a cross or dot of LaTeX stands here.
  char product_sign() {
    const char c = peek();
    if (c == '*' || c == '/') return c;
    const std::string_view command = latex_command(text_.value, at_);
    return command == "cdot" || command == "times" ? '*' : '\0';
  }

  /// `^`, or `**` as in Python.
  bool accept_power() {
    if (accept('^')) return true;
    if (text_.value.compare(at_, 2, "**") != 0 || at_ + 2 > end_) return false;
    at_ += 2;
    return true;
  }

  /// {a} after a sign or command that takes it so; braces are brackets of Poisson elsewhere.
  Quantity braced() {
    if (!accept('{'))
      fail("unexpected " + here() + ", expected '{'", "as in \\frac{a}{b}, with both in braces");
    const std::size_t start = at_;
    const Quantity q = number_of(start, sum());
    if (!accept('}')) unexpected("'}'");
    return q;
  }

  Quantity product() {
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
      factors.push_back(c == '*' ? next.value : evaluated(offset, [&] {
        return ex(GiNaC::pow(next.value, -1));
      }));
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
        evaluated(
            offset,
            [&] { return principal_power(base.value, exponent.value, names_.complex_numbers()); }),
        offset);
    if (!exponent.value.info(GiNaC::info_flags::nonnegint)) add_part(q.value);
    return checked(q, offset);
  }

  /// GiNaC gives log(-3) and sqrt(-4) complex values. Where numbers are real they have none, and an
  /// expression with one is about nothing.
  ex real_value(const ex& value, std::size_t offset) const {
    if (!names_.complex_numbers() && !imaginary_unit_ && is_complex_constant(value))
      fail_at(offset, "this has no real value",
              "roots and logarithms are those of real numbers unless the case has I");
    return value;
  }

  /// Runs one GiNaC operation that may meet a pole.
  template <class Operation>
  ex evaluated(std::size_t offset, Operation operation) const {
    try {
      return operation();
    } catch (const GiNaC::pole_error&) {
      fail_at(offset, "this has no value: division by zero or a pole of the function");
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const CaseError&) {
      throw;
    } catch (const std::exception& problem) {  // GiNaC's own errors have no common type
      fail_at(offset, fmt::format("this has no value ({})", printable(problem.what(), 80)));
    }
  }

  Quantity primary() {
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

  Quantity number() {
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

  /// What starts with a command of LaTeX: a fraction, a root, or a name.
  Quantity latex(std::string_view command) {
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

  Quantity name() {
    const std::size_t start = at_;
    std::string word = read_name(text_.value, at_, end_);
    if (const std::optional<long> index = value_of_index(word, start))
      return {GiNaC::numeric(*index), 20, 0, 1};
    if (names_.find(word) == nullptr) word = usual_name(word);
    if (peek() == '[' && find_elementary_function(word) == nullptr) word = member_of(word);
    if (const ElementaryFunction* function = find_elementary_function(word))
      return call(*function, start);
    if (peek() == '(' && names_.find(word) == nullptr) {
      if (word == "diff") return partial_derivative(start);
      if (word == "rate") return rate(start);
      if (word == "sum" || word == "product") return repeated(word == "sum", start);
      if (word == "mod") return remainder(start);
      if (word == "dot") return scalar_product(start);
      if (word == "cross") return vector_product(start);
      if (const EllipticFunction* function = find_elliptic_function(word))
        return call(*function, start);
      if (find_with_subscript(word, names_) == nullptr)
        fail_at(start, fmt::format("unknown function '{}'", printable(word)),
                hint_for_function(word));
    }
    if (word == "Pi") return {GiNaC::Pi, 1, 0, 1};
    if (word == "I") {
      imaginary_unit_ = true;
      return {GiNaC::I, 1, 0, 1};
    }
    const Quantity* known = names_.find(word);
    if (known == nullptr) known = find_with_subscript(word, names_);
    if (known == nullptr && component_) return component_of(word, start);
    if (known == nullptr) undeclared(word, start);
    if (const auto function = named_function(known->value))
      return arbitrary_call(known->value, *function, start);
    for (const ex& part : known->parts ? *known->parts : std::vector<ex>{}) add_part(part);
    return *known;
  }

  /// What a letter with a range stands for here; of no other name.
  std::optional<long> value_of_index(const std::string& word, std::size_t start) {
    std::optional<long> value;
    for (const auto& [letter, now] : indices_)
      if (letter == word) value = now;
    if (!value && text_.indices && text_.indices->contains(word)) value = text_.indices->at(word);
    if (value && names_.find(word) != nullptr)
      fail_at(start, fmt::format("'{}' has a range here and is a name of this case as well", word));
    return value;
  }

  /// An integer that is known where it is read.
  long integer(const char* what) {
    peek();
    const std::size_t start = at_;
    const ex value = number_of(start, sum()).value;
    constexpr long kMost = 1000000000;
    if (!value.info(GiNaC::info_flags::integer) || GiNaC::abs(value) > kMost)
      fail_at(start, fmt::format("{} has to be an integer", what),
              "one that is known here, as 3, or n where [definitions] has n = 3");
    return GiNaC::ex_to<GiNaC::numeric>(value).to_long();
  }

  /// The indices behind the name of a family, and the name of the member that they are of.
  std::string member_of(const std::string& family) {
    ++at_;
    std::vector<long> places;
    do {
      const std::size_t start = at_;
      places.push_back(integer("an index"));
      if (places.back() < 0) fail_at(start, "an index is not negative");
    } while (accept(','));
    if (!accept(']')) unexpected("',' or ']'");
    return indexed_name(family, places);
  }

  /// mod(a, b): what is left of the integer a, from 0 to b - 1.
  Quantity remainder(std::size_t start) {
    if (!accept('(')) unexpected("'('");
    const long a = integer("what is divided");
    if (!accept(',')) unexpected("',' of mod(a, b)");
    const long b = integer("what it is divided by");
    if (!accept(')')) unexpected("')'");
    if (b <= 0) fail_at(start, "mod(a, b) needs b > 0");
    return {GiNaC::numeric((a % b + b) % b), 20, 0, 1};
  }

  /// sum(i, a, b, F) and product(i, a, b, F): F for i = a .. b, of which nothing is left if b < a.
  Quantity repeated(bool is_sum, std::size_t start) {
    const Depth depth(*this);
    if (!accept('(')) unexpected("'('");
    const std::string letter = this->letter();
    if (!accept(',')) unexpected("',' and the first value");
    const long first = integer("the first value");
    if (!accept(',')) unexpected("',' and the last value");
    const long last = integer("the last value");
    if (!accept(',')) unexpected(is_sum ? "',' and the terms" : "',' and the factors");
    const std::size_t body = at_;
    Quantity total{is_sum ? 0 : 1};
    GiNaC::exvector parts;
    for (long k = first; k <= last; ++k) {
      check(++repetitions_, &Limits::repetitions, start,
            "sums here write out more than {:.0f} terms");
      at_ = body;
      indices_.emplace_back(letter, k);
      const Quantity next = sum();
      indices_.pop_back();
      if (next.vector && !is_sum) fail_at(start, "a product of vectors");
      if (k > first && next.vector != total.vector)
        fail_at(start, "a vector and a number are added");
      total.vector = next.vector;
      parts.push_back(next.value);
      total.bits = is_sum ? std::max(total.bits, next.bits) : total.bits + next.bits;
      total.degree = is_sum ? std::max(total.degree, next.degree) : total.degree + next.degree;
      total.nodes += next.nodes;
      total.depth = std::max(total.depth, next.depth + 1);
      checked(total, start);
      // A body of blanks is read as often as any other.
      repetitions_ += static_cast<double>(at_ - body) / kCharactersOfTerm;
    }
    if (parts.empty()) at_ = end_of_argument(body);
    if (!accept(')')) unexpected("')'");
    if (is_sum) total.bits += std::ceil(std::log2(1 + static_cast<double>(parts.size())));
    total.value =
        evaluated(start, [&] { return is_sum ? ex(GiNaC::add(parts)) : ex(GiNaC::mul(parts)); });
    return checked(total, start);
  }

  /// The letter that a sum goes over.
  std::string letter() {
    peek();
    const std::size_t start = at_;
    if (at_ >= end_ || !is_name_start(text_.value[at_])) unexpected("the letter of the index");
    std::string word = read_name(text_.value, at_, end_);
    if (names_.find(word) != nullptr)
      fail_at(start, fmt::format("'{}' is a name of this case, and no index", printable(word)));
    Text given = text_;
    given.value = word;
    given.where.column += static_cast<int>(start);
    check_name(given, "an index");
    if (value_of_index(word, start))
      fail_at(start, fmt::format("the index '{}' has a range already", printable(word)));
    return word;
  }

  /// Where the argument that begins there ends, which nobody reads.
  std::size_t end_of_argument(std::size_t at) const {
    int open = 0;
    for (; at < end_; ++at) {
      const char c = text_.value[at];
      if (c == '(' || c == '[' || c == '{') ++open;
      if (c == ')' || c == ']' || c == '}') --open;
      if (open < 0) break;
    }
    return at;
  }

  /// Of a part of the text where no vector can stand.
  const Quantity& number_of(std::size_t start, const Quantity& q) const {
    if (q.vector) fail_at(start, "a number stands here, and no vector");
    return q;
  }

  /// How many of x1, x2, .. are there.
  long members(const std::string& family) {
    long count = 0;
    while (names_.find(indexed_name(family, {count + 1})) != nullptr) ++count;
    return count;
  }

  /// The component that is asked for of x = (x1, x2, ..). All vectors of a `dot` are as long.
  Quantity component_of(const std::string& family, std::size_t start) {
    const long count = members(family);
    if (count == 0) undeclared(family, start);
    if (dimension_ == 0) dimension_ = count;
    if (count != dimension_)
      fail_at(start, fmt::format("'{}' has {} components, and {} are needed here", family, count,
                                 dimension_));
    const Quantity& known = *names_.find(indexed_name(family, {*component_}));
    for (const ex& part : known.parts ? *known.parts : std::vector<ex>{}) add_part(part);
    Quantity q = known;
    q.vector = true;
    return q;
  }

  /// The component k of the vector that is written from `begin` on; leaves its end as the place.
  Quantity component_at(std::size_t begin, long k) {
    check(++repetitions_, &Limits::repetitions, begin,
          "sums here write out more than {:.0f} terms");
    const std::optional<long> before = component_;
    component_ = k;
    at_ = begin;
    Quantity q = sum();
    component_ = before;
    repetitions_ += static_cast<double>(at_ - begin) / kCharactersOfTerm;
    if (!q.vector)
      fail_at(begin, "a vector stands here",
              "a name x is one where x1, x2, .. are declared, and x is not");
    return q;
  }

  /// a1*b1 + a2*b2 + .., or minus the last one.
  Quantity combined(const std::vector<std::pair<Quantity, Quantity>>& pairs, bool difference,
                    std::size_t start) const {
    Quantity total{0};
    GiNaC::exvector terms;
    for (const auto& [a, b] : pairs) {
      const ex term = a.value * b.value;
      terms.push_back(difference && !terms.empty() ? -term : term);
      total.bits = std::max(total.bits, a.bits + b.bits);
      total.degree = std::max(total.degree, a.degree + b.degree);
      total.nodes += a.nodes + b.nodes;
      total.depth = std::max({total.depth, a.depth + 2, b.depth + 2});
      checked(total, start);
    }
    total.bits += std::ceil(std::log2(1 + static_cast<double>(pairs.size())));
    total.value = evaluated(start, [&] { return ex(GiNaC::add(terms)); });
    return checked(total, start);
  }

  /// dot(a, b) of vectors of any length.
  Quantity scalar_product(std::size_t start) {
    const Depth depth(*this);
    if (!accept('(')) unexpected("'('");
    const long before = std::exchange(dimension_, 0);
    const std::size_t left = at_;
    std::vector<std::pair<Quantity, Quantity>> pairs;
    for (long k = 1; k == 1 || k <= dimension_; ++k) {
      const Quantity a = component_at(left, k);
      if (!accept(',')) unexpected("',' of dot(a, b)");
      const std::size_t right = at_;
      const Quantity b = component_at(right, k);
      pairs.emplace_back(a, b);
    }
    if (!accept(')')) unexpected("')'");
    dimension_ = before;
    return combined(pairs, false, start);
  }

  /// The component k of cross(a, b), of which `left` is the place of a. Its place is then its end.
  Quantity component_of_product(std::size_t left, long k, std::size_t start) {
    const long next = k % 3 + 1, last = next % 3 + 1;
    std::vector<std::pair<Quantity, Quantity>> pairs;
    for (const auto& [i, j] : {std::pair(next, last), std::pair(last, next)}) {
      const Quantity a = component_at(left, i);
      if (!accept(',')) unexpected("',' of cross(a, b)");
      const Quantity b = component_at(at_, j);
      pairs.emplace_back(a, b);
    }
    if (!accept(')')) unexpected("')'");
    Quantity q = combined(pairs, true, start);
    q.vector = true;
    return q;
  }

  /// cross(a, b) within `dot` and `cross`, and cross(a, b)[k] everywhere.
  Quantity vector_product(std::size_t start) {
    const Depth depth(*this);
    if (!accept('(')) unexpected("'('");
    const std::size_t left = at_;
    const long before = std::exchange(dimension_, 3);
    if (before != 0 && before != 3)
      fail_at(start, fmt::format("cross(a, b) has 3 components, and {} are needed here", before));
    Quantity q = component_of_product(left, component_.value_or(1), start);
    if (peek() == '[') {
      ++at_;
      dimension_ = before;
      const std::size_t place = at_;
      const long k = integer("an index");
      if (k < 1 || k > 3) fail_at(place, "a vector of cross(a, b) has the components 1 to 3");
      if (!accept(']')) unexpected("']'");
      const std::size_t end = std::exchange(at_, left);
      dimension_ = 3;
      q = component_of_product(left, k, start);
      q.vector = false;
      at_ = end;
      dimension_ = before;
      return q;
    }
    if (!component_)
      fail_at(start, "cross(a, b) is a vector",
              "it stands in dot(.., ..), or has an index: cross(a, b)[1]");
    return q;  // and all vectors beside it have three components
  }

  /// U(r), U'(r), .. of an arbitrary function.
  Quantity arbitrary_call(const ex& symbol, const FunctionName& function, std::size_t start) {
    peek();
    const std::vector<unsigned> orders = read_orders(text_, at_, end_, function);
    const Quantity q =
        value_of_arbitrary(symbol, orders, arguments(function.name, orders.size(), start));
    add_part(q.value);
    return checked(q, start);
  }

  [[noreturn]] void undeclared(const std::string& word, std::size_t start) {
    fail_at(start, fmt::format("'{}' is not declared", printable(word)),
            hint_for_name(word, names_.known()));
  }

  std::vector<Quantity> arguments(std::string_view function, std::size_t arity, std::size_t start) {
    if (arity == 1 && peek() == '{') return {braced()};
    if (!accept('('))
      fail_at(start, fmt::format("'{}' is a function and needs '('", function),
              fmt::format("as in {}(x), powers behind: {}(x)^2", function, function));
    std::vector<Quantity> given;
    if (peek() != ')') {
      do {
        const std::size_t offset = at_;
        given.push_back(number_of(offset, sum()));
      } while (accept(','));
    }
    if (!accept(')')) unexpected("',' or ')'");
    if (given.size() != arity) {
      fail_at(start, fmt::format("'{}' takes {} argument{}, {} given", function, arity,
                                 arity == 1 ? "" : "s", given.size()));
    }
    return given;
  }

  /// What differentiating may make of an expression: each factor is differentiated in turn.
  static double derivative_nodes(const Quantity& q) { return q.nodes * std::max(1.0, q.degree); }

  /// {F, G}
  Quantity bracket() {
    const std::size_t start = at_++;
    const Quantity f = number_of(start, sum());
    if (!accept(',')) unexpected("',' of a bracket {F, G}");
    const Quantity g = number_of(start, sum());
    if (!accept('}')) unexpected("'}'");
    const Dynamics* dynamics = names_.dynamics();
    if (dynamics == nullptr || !dynamics->has_bracket())
      fail_at(start, "there is no Poisson bracket here");
    const auto n = static_cast<double>(dynamics->dimension());
    Quantity q{0, f.bits + g.bits, f.degree + g.degree,
               n * n * (derivative_nodes(f) + derivative_nodes(g)),
               3 + 2 * std::max(f.depth, g.depth)};
    checked(q, start);
    q.value = evaluated(start, [&] { return dynamics->bracket(f.value, g.value); });
    return q;
  }

  /// rate(F) = dF/dt
  Quantity rate(std::size_t start) {
    const Quantity f = arguments("rate", 1, start).front();
    const Dynamics* dynamics = names_.dynamics();
    if (dynamics == nullptr || !dynamics->has_flow())
      fail_at(start, "the equations of motion are not known here");
    const auto n = static_cast<double>(dynamics->dimension());
    Quantity q{0, f.bits * 2, f.degree * 2, n * n * derivative_nodes(f), 3 + 2 * f.depth};
    checked(q, start);
    q.value = evaluated(start, [&] { return dynamics->rate(f.value); });
    return q;
  }

  /// diff(F, x)
  Quantity partial_derivative(std::size_t start) {
    const std::vector<Quantity> given = arguments("diff", 2, start);
    if (!GiNaC::is_a<GiNaC::symbol>(given[1].value))
      fail_at(start, "the second argument of 'diff' must be a variable or a parameter");
    Quantity q = given[0];
    q.nodes = derivative_nodes(given[0]);
    q.depth = 1 + 2 * q.depth;
    checked(q, start);
    q.value = evaluated(
        start, [&] { return given[0].value.diff(GiNaC::ex_to<GiNaC::symbol>(given[1].value)); });
    return q;
  }

  Quantity call(const ElementaryFunction& function, std::size_t start) {
    const std::vector<Quantity> arguments = this->arguments(function.name, function.arity, start);
    const Quantity& first = arguments.front();
    const Quantity& last = arguments.back();
    if (function.real && names_.complex_numbers())
      fail_at(start, fmt::format("'{}' is for real numbers, and this case has complex ones",
                                 function.name));
    const double uses = function.uses;
    Quantity q{0, uses * first.bits, uses * first.degree, uses * (1 + first.nodes),
               (uses > 1 ? 3 : 1) + std::max(first.depth, last.depth)};
    if (arguments.size() > 1) {
      q.bits += last.bits;
      q.degree += last.degree;
      q.nodes += last.nodes;
    }
    q.degree = std::max(1.0, q.degree);
    checked(q, start);
    // GiNaC says 0, but no direction leads to the origin.
    if (function.name == "atan2" && first.value.is_zero() && last.value.is_zero())
      fail_at(start, "this has no value: atan2(0, 0)");
    q.value = real_value(evaluated(start,
                                   [&] {
                                     return function.name == "sqrt"
                                                ? principal_power(first.value, GiNaC::numeric(1, 2),
                                                                  names_.complex_numbers())
                                                : function.apply(first.value, last.value);
                                   }),
                         start);
    if (!function.everywhere) add_part(q.value);
    return checked(q, start);
  }

  Quantity call(const EllipticFunction& function, std::size_t start) {
    const std::vector<Quantity> given = arguments(function.name, function.arity, start);
    if (names_.complex_numbers())
      fail_at(start, fmt::format("'{}' is for real numbers, and this case has complex ones",
                                 function.name));
    Quantity q{0, 0, 1, 1, 1};
    GiNaC::exvector values;
    for (const Quantity& argument : given) {
      q.bits += argument.bits;
      q.degree += argument.degree;
      q.nodes += argument.nodes;
      q.depth = std::max(q.depth, 1 + argument.depth);
      values.push_back(argument.value);
    }
    checked(q, start);
    q.value = evaluated(start, [&] { return function.apply(values); });
    add_part(q.value);
    return checked(q, start);
  }

  /// Each once; numbers have values everywhere.
  void add_part(const ex& part) {
    if (!GiNaC::is_a<GiNaC::numeric>(part) && seen_.insert(part).second) parts_.push_back(part);
  }

  const Text& text_;
  Scope& names_;
  std::size_t at_;
  std::size_t end_;
  int depth_ = 0;
  std::optional<long> component_;                      ///< of vectors that is asked for
  long dimension_ = 0;                                 ///< of all vectors here; 0: not known yet
  double repetitions_ = 0;                             ///< of all sums and products
  std::vector<std::pair<std::string, long>> indices_;  ///< of those that are open
  bool imaginary_unit_ = false;                        ///< `I` has been read
  std::vector<ex> parts_;
  std::unordered_set<ex> seen_;
};

}  // namespace

Quantity parse_range(const Text& text, Scope& names, std::size_t begin, std::size_t end) {
  if (static_cast<double>(text.value.size()) > limits().file_bytes) {
    throw text.error(fmt::format("the expression has {} bytes; the limit is {:.0f}",
                                 text.value.size(), limits().file_bytes),
                     0, limit_hint(&Limits::file_bytes));
  }
  return Parser(text, names, begin, end).parse();
}

Quantity parse_expression(const Text& text, Scope& names) {
  return parse_range(text, names, 0, text.value.size());
}

}  // namespace casimir

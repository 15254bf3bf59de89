// Expressions: members of families, sums over them, and products of vectors.
#include "symbolic/expression/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "symbolic/expression/expression_size.hpp"
#include "symbolic/expression/indices.hpp"
#include "symbolic/expression/name_characters.hpp"
#include "symbolic/expression/notation.hpp"

namespace casimir {

using GiNaC::ex;

std::optional<long> Parser::value_of_index(const std::string& word, std::size_t start) {
  std::optional<long> value;
  for (const auto& [letter, now] : indices_)
    if (letter == word) value = now;
  if (!value && text_.indices && text_.indices->contains(word)) value = text_.indices->at(word);
  if (value && names_.find(word) != nullptr)
    fail_at(start, fmt::format("'{}' has a range here and is a name of this case as well", word));
  return value;
}

long Parser::integer(const char* what) {
  peek();
  const std::size_t start = at_;
  const ex value = number_of(start, sum()).value;
  constexpr long kMost = 1000000000;
  if (!value.info(GiNaC::info_flags::integer) || GiNaC::abs(value) > kMost)
    fail_at(start, fmt::format("{} has to be an integer", what),
            "one that is known here, as 3, or n where [definitions] has n = 3");
  return GiNaC::ex_to<GiNaC::numeric>(value).to_long();
}

std::string Parser::member_of(const std::string& family) {
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

Quantity Parser::known_integer(long value) {
  const GiNaC::numeric n(value);
  return {n, std::max(1.0, bit_length(n)), 0, 1};
}

Quantity Parser::remainder(std::size_t start) {
  if (!accept('(')) unexpected("'('");
  const long a = integer("what is divided");
  if (!accept(',')) unexpected("',' of mod(a, b)");
  const long b = integer("what it is divided by");
  if (!accept(')')) unexpected("')'");
  if (b <= 0) fail_at(start, "mod(a, b) needs b > 0");
  return known_integer((a % b + b) % b);
}

Quantity Parser::repeated(bool is_sum, std::size_t start) {
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
    if (k > first && next.vector != total.vector) fail_at(start, "a vector and a number are added");
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

std::string Parser::letter() {
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

std::size_t Parser::end_of_argument(std::size_t at) const {
  int open = 0;
  for (; at < end_; ++at) {
    const char c = text_.value[at];
    if (c == '(' || c == '[' || c == '{') ++open;
    if (c == ')' || c == ']' || c == '}') --open;
    if (open < 0) break;
  }
  return at;
}

const Quantity& Parser::number_of(std::size_t start, const Quantity& q) const {
  if (q.vector) fail_at(start, "a number stands here, and no vector");
  return q;
}

long Parser::members(const std::string& family) {
  long count = 0;
  while (names_.find(indexed_name(family, {count + 1})) != nullptr) ++count;
  return count;
}

Quantity Parser::component_of(const std::string& family, std::size_t start) {
  const long count = members(family);
  if (count == 0) undeclared(family, start);
  if (dimension_ == 0) dimension_ = count;
  if (count != dimension_)
    fail_at(start, fmt::format("'{}' has {} components, and {} are needed here", family, count,
                               dimension_));
  const Quantity& known = *names_.find(indexed_name(family, {*component_}));
  add_parts_of(known);
  Quantity q = known;
  q.vector = true;
  return q;
}

Quantity Parser::component_at(std::size_t begin, long k) {
  check(++repetitions_, &Limits::repetitions, begin, "sums here write out more than {:.0f} terms");
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

Quantity Parser::combined(const std::vector<std::pair<Quantity, Quantity>>& pairs, bool difference,
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

Quantity Parser::scalar_product(std::size_t start) {
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

Quantity Parser::component_of_product(std::size_t left, long k, std::size_t start) {
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

Quantity Parser::vector_product(std::size_t start) {
  const Depth depth(*this);
  if (!accept('(')) unexpected("'('");
  const std::size_t left = at_;
  const long before = std::exchange(dimension_, 3);
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
  if (before != 0 && before != 3)
    fail_at(start, fmt::format("cross(a, b) has 3 components, and {} are needed here", before));
  return q;  // and all vectors beside it have three components
}

}  // namespace casimir

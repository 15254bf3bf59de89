#include "symbolic/case/name_families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression_range.hpp"
#include "symbolic/expression/name_characters.hpp"

namespace casimir {
namespace {

constexpr int kMostBrackets = 8;
constexpr std::size_t kMostCharacters = 500;
constexpr const char* kOfBounds =
    " +-*0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

class Expansion {
 public:
  Expansion(const Text& text, const Indices& known, const Limits& limits)
      : text_(text), known_(known), limits_(limits) {}

  std::vector<FamilyMember> members() {
    const std::string& text = text_.value;
    if (text.size() > kMostCharacters)
      throw text_.error(
          fmt::format("a name with indices is longer than {} characters", kMostCharacters));
    if (std::ranges::count(text, '[') > kMostBrackets)
      throw text_.error(fmt::format("more than {} families in one name", kMostBrackets));
    go_on(0, {}, {});
    return std::move(members_);
  }

 private:
  /// Behind `done`, which is what the text before `at` has become.
  void go_on(std::size_t at, std::string done, const Indices& indices) {
    const std::string& text = text_.value;
    const std::size_t open = text.find('[', at);
    if (open == std::string::npos) {
      add(done + text.substr(at), indices);
      return;
    }
    const std::size_t close = text.find(']', open);
    if (close == std::string::npos) throw text_.error("'[' is not closed", open);
    done += text.substr(at, open - at);
    if (done.empty() || !is_name_part(done.back()))
      throw text_.error("an index stands behind a name", open, "as in q[1..3] or q[i=1..n]");
    items(open + 1, close, {}, done, indices);
  }

  /// The indices from `begin` on of the brackets that end at `close`, after those in `places`.
  void items(std::size_t begin, std::size_t close, std::vector<long> places,
             const std::string& done, const Indices& indices) {
    if (begin > close) {
      std::size_t name = done.size();
      while (name > 0 && is_name_part(done[name - 1])) --name;
      go_on(close + 1, done.substr(0, name) + indexed_name(done.substr(name), places), indices);
      return;
    }
    const std::string& text = text_.value;
    const std::size_t end = std::min(text.find(',', begin), close), dots = text.find("..", begin);
    if (dots >= end) {
      places.push_back(index(begin, end, indices));
      items(end + 1, close, std::move(places), done, indices);
      return;
    }
    const std::size_t sign = text.find('=', begin);
    const std::string letter = sign < dots ? letter_at(begin, sign, indices) : std::string();
    const long low = index(sign < dots ? sign + 1 : begin, dots, indices),
               high = integer(dots + 2, end, indices);
    places.push_back(low);
    Indices inner = indices;
    for (long k = low; k <= high; ++k) {
      count();
      places.back() = k;
      if (!letter.empty()) inner[letter] = k;
      items(end + 1, close, places, done, inner);
    }
  }

  std::string letter_at(std::size_t begin, std::size_t end, const Indices& indices) const {
    Text letter = text_;
    while (begin < end && letter.value[begin] == ' ') ++begin;
    while (end > begin && letter.value[end - 1] == ' ') --end;
    letter.value = text_.value.substr(begin, end - begin);
    letter.where.column += static_cast<int>(begin);
    check_name(letter, "an index");
    if (indices.contains(letter.value))
      throw text_.error(fmt::format("the index '{}' has a range already", letter.value), begin);
    if (known_.contains(letter.value))
      throw text_.error(fmt::format("'{}' is a number of this case, and no index", letter.value),
                        begin);
    return letter.value;
  }

  void check_known(std::size_t begin, std::size_t end, const Indices& indices) const {
    for (std::size_t at = begin; at < end;) {
      std::size_t to = at;
      while (to < end && is_name_part(text_.value[to])) ++to;
      const std::string word = text_.value.substr(at, to - at);
      if (!word.empty() && is_name_start(word[0]) && !known_.contains(word) &&
          !indices.contains(word))
        throw text_.error(fmt::format("'{}' is no integer that is known here", word), at,
                          "a bound is an integer, or a name that [definitions] says is one: n = 3");
      at = std::max(to, at + 1);
    }
  }

  long integer(std::size_t begin, std::size_t end, const Indices& indices) const {
    const std::size_t other = text_.value.find_first_not_of(kOfBounds, begin);
    if (other < end) throw text_.error("a bound has integers, letters, +, - and * only", other);
    check_known(begin, end, indices);
    NameTable names(limits_);
    for (const Indices& table : {known_, indices})
      for (const auto& [name, value] : table) names.add(name, {GiNaC::numeric(value)});
    const GiNaC::ex value = parse_range(text_, names, begin, end).value;
    constexpr long kMost = 1000000000;
    if (!value.info(GiNaC::info_flags::integer) || GiNaC::abs(value) > kMost)
      throw text_.error(
          "this has to be an integer", begin,
          "as in q[1..3], or q[1..n] with n = 3 in [definitions]; names have no other brackets");
    return GiNaC::ex_to<GiNaC::numeric>(value).to_long();
  }

  long index(std::size_t begin, std::size_t end, const Indices& indices) const {
    const long value = integer(begin, end, indices);
    if (value < 0) throw text_.error("an index is not negative", begin);
    return value;
  }

  void count() {
    if (++counted_ > limits_.repetitions)
      throw text_.beyond(
          limits_, &Limits::repetitions,
          fmt::format("this stands for more than {:.0f} names", limits_.repetitions));
  }

  void add(std::string name, const Indices& indices) {
    Text text = text_;
    text.value = std::move(name);
    members_.push_back({std::move(text), indices});
  }

  const Text& text_;
  const Indices& known_;
  const Limits& limits_;
  std::vector<FamilyMember> members_;
  double counted_ = 0;
};

}  // namespace

std::vector<FamilyMember> members_of(const Text& text, const Indices& known, const Limits& limits) {
  if (text.value.find('[') == std::string::npos) return {{text, {}}};
  return Expansion(text, known, limits).members();
}

}  // namespace casimir

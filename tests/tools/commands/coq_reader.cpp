#include "tests/tools/commands/coq_reader.hpp"

#include <cctype>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace casimir::test {
namespace {

using GiNaC::ex;

std::string without_comments(const std::string& text) {
  std::string result;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "(*") == 0) {
      ++depth;
      ++i;
    } else if (text.compare(i, 2, "*)") == 0) {
      if (--depth < 0) throw std::runtime_error("a comment ends that did not begin");
      ++i;
      result += ' ';
    } else if (depth == 0) {
      result += text[i];
    } else if (text[i] == '"') {
      throw std::runtime_error("a string begins in a comment");
    }
  }
  if (depth != 0) throw std::runtime_error("a comment does not end");
  return result;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

/// The tactic that unfolds some definitions and leaves the rest to `ring`.
bool is_tactic(const std::string& line) {
  const std::string begin = "Ltac casimir_identity := intros; cbv beta delta [";
  const std::string end = "]; ring";
  return line.starts_with(begin) && line.ends_with(end) &&
         line.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_ ",
                                begin.size()) == line.size() - end.size();
}

}  // namespace

/// sum := ['-'] product {('+' | '-') product}, product := factor {'*' factor},
/// factor := number | variable | function atom .. | '(' sum ')' | '(' number '#' number ')'.
class CoqReader::Parser {
 public:
  Parser(const CoqReader& reader, const std::string& text, const Names& names,
         const std::set<std::string>& zero)
      : reader_(reader), text_(text), names_(names), zero_(zero) {}

  ex whole() {
    const ex result = sum();
    if (peek() != '\0') fail("text after the expression");
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(what + " at: " + text_.substr(at_, 60));
  }
  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  ex sum() {
    const bool minus = accept('-');
    ex result = product();
    if (minus) result = -result;
    for (;;) {
      if (accept('+'))
        result += product();
      else if (accept('-'))
        result -= product();
      else
        return result;
    }
  }
  ex product() {
    ex result = factor();
    while (accept('*')) result *= factor();
    return result;
  }
  std::string run(bool (*belongs)(char)) {
    const std::size_t start = at_;
    while (at_ < text_.size() && belongs(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_part(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  }
  bool at_atom() {
    const char c = peek();
    return c == '(' || is_part(c);
  }
  ex atom() {
    if (accept('(')) {
      const ex inside = sum();
      if (accept('#')) {
        peek();
        const GiNaC::numeric below(run(is_digit).c_str());
        if (!accept(')')) fail("')' expected");
        return inside / below;
      }
      if (!accept(')')) fail("')' expected");
      return inside;
    }
    if (is_digit(peek())) return GiNaC::numeric(run(is_digit).c_str());
    const std::string name = run(is_part);
    const auto known = names_.find(name);
    if (known == names_.end()) fail("unknown name " + name);
    return known->second;
  }
  ex factor() {
    const char c = peek();
    if (is_digit(c) || c == '(') return atom();
    const std::size_t start = at_;
    const std::string name = run(is_part);
    if (!reader_.defines(name)) {
      at_ = start;
      return atom();
    }
    std::vector<ex> arguments;
    while (at_atom()) arguments.push_back(atom());
    return zero_.contains(name) ? ex(0) : reader_.value(name, arguments);
  }

  const CoqReader& reader_;
  const std::string& text_;
  const Names& names_;
  const std::set<std::string>& zero_;
  std::size_t at_ = 0;
};

CoqReader::CoqReader(const std::string& text) {
  const std::string code = without_comments(text);
  std::string sentence;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '.' &&
        (i + 1 == code.size() || std::isspace(static_cast<unsigned char>(code[i + 1])) != 0)) {
      read_sentence(sentence);
      sentence.clear();
    } else {
      sentence += code[i];
    }
  }
  if (!words(sentence).empty()) throw std::runtime_error("no full stop after: " + sentence);
}

void CoqReader::read_sentence(const std::string& sentence) {
  // Only heads are matched: std::regex takes a stack frame for each character of a body.
  static const std::regex definition(R"(^\s*Definition (\w+) \(([\w ]+) : Q\) : Q :=\s)");
  static const std::regex statement(R"(^\s*(Theorem|Lemma) (\w+) : forall ([\w ]+) : Q,\s)");
  constexpr auto kHead = std::regex_constants::match_continuous;
  const std::vector<std::string> parts = words(sentence);
  std::string line;
  for (const std::string& part : parts) line += (line.empty() ? "" : " ") + part;
  std::smatch head;
  if (std::regex_search(sentence, head, definition, kHead)) {
    if (!functions_.emplace(head[1], Function{words(head[2]), head.suffix()}).second)
      throw std::runtime_error("defined twice: " + line.substr(0, 200));
  } else if (std::regex_search(sentence, head, statement, kHead)) {
    (head[1] == "Theorem" ? theorems_ : lemmas_).push_back(head[2]);
    const std::string sides = head.suffix();
    const std::size_t equal = sides.find("==");
    if (equal == std::string::npos) throw std::runtime_error("no equation: " + line.substr(0, 200));
    const Statement s{words(head[3]), sides.substr(0, equal), sides.substr(equal + 2)};
    if (!statements_.emplace(head[2], s).second)
      throw std::runtime_error("stated twice: " + line.substr(0, 200));
  } else if (line != "From Coq Require Import QArith Ring" && line != "Open Scope Q_scope" &&
             line != "Proof" && line != "casimir_identity" && line != "Qed" && !is_tactic(line)) {
    throw std::runtime_error("not a sentence of a certificate: " + line.substr(0, 200));
  }
}

ex CoqReader::value(const std::string& function, const std::vector<ex>& arguments) const {
  const Function& f = functions_.at(function);
  if (f.parameters.size() != arguments.size())
    throw std::runtime_error("wrong number of arguments of " + function);
  Names names;
  for (std::size_t i = 0; i < arguments.size(); ++i) names[f.parameters[i]] = arguments[i];
  return value(f.body, names);
}

ex CoqReader::value(const std::string& expression, const Names& names,
                    const std::set<std::string>& zero) const {
  return Parser(*this, expression, names, zero).whole().expand();
}

}  // namespace casimir::test

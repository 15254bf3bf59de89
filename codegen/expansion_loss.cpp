#include "codegen/expansion_loss.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "codegen/optimise/lower.hpp"

namespace casimir {
namespace {

/// What a line of the program is made of.
struct Shape {
  std::set<int> states;
  bool is_sum = false;        ///< of several terms, one of which has a state
  bool has_constant = false;  ///< as one of the terms, or within one

  bool is_constant() const { return states.empty(); }
};

Shape joined(const Shape& a, const Shape& b) {
  Shape result = a;
  result.states.insert(b.states.begin(), b.states.end());
  result.is_sum = a.is_sum || b.is_sum;
  result.has_constant = a.has_constant || b.has_constant;
  return result;
}

bool may_vanish_together(const Shape& a, const Shape& b) {
  if (a.has_constant || b.has_constant) return true;
  return std::ranges::any_of(a.states, [&](int state) { return b.states.contains(state); });
}

class Reader {
 public:
  explicit Reader(const Program& program) : program_(program) {}

  bool multiplies_sums() {
    bool found = false;
    for (const Instruction& code : program_.code) {
      if (code.op == Op::mul) {
        const Shape &a = at(code.a), &b = at(code.b);
        found = found || (a.is_sum && b.is_sum && may_vanish_together(a, b));
      }
      shapes_.push_back(shape(code));
    }
    return found;
  }

 private:
  const Shape& at(int line) const { return shapes_[static_cast<std::size_t>(line)]; }

  Shape shape(const Instruction& code) const {
    if (code.op == Op::constant || code.op == Op::pi) return {};
    if (code.op == Op::input) {
      Shape result;
      if (code.a < static_cast<int>(program_.outputs.size())) result.states.insert(code.a);
      return result;
    }
    if (code.b < 0) return at(code.a);
    Shape result = joined(at(code.a), at(code.b));
    if ((code.op == Op::add || code.op == Op::sub) && !result.is_constant()) {
      result.is_sum = true;
      result.has_constant =
          result.has_constant || at(code.a).is_constant() || at(code.b).is_constant();
    }
    return result;
  }

  const Program& program_;
  std::vector<Shape> shapes_;
};

}  // namespace

bool expansion_loses_digits(const Program& rhs) {
  const Program program = codegen::without_dead_code(rhs);
  return Reader(program).multiplies_sums();
}

}  // namespace casimir

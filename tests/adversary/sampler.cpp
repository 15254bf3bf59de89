#include "tests/adversary/sampler.hpp"

#include <algorithm>
#include <stdexcept>

namespace casimir::adversary {
namespace {

/// A number of 40 random bits between -3 and 3, now and then, if not near, between -12 and 12.
Ball random_number(Random& random, bool near) {
  constexpr long kScale = 1L << 40;
  constexpr int kFarInAll = 5;
  const long low = random(1 << 20), high = random(1 << 20);
  const long range = !near && random.one_in(kFarInAll) ? 12 : 3;
  return Ball::ratio(range * (2 * ((high << 20) + low) - kScale), kScale);
}

Ball special_number(Random& random) {
  static const std::vector<long> numbers{0, 0, 0, 0, 1, -1};
  return Ball(random.of(numbers));
}

/// The symbol, if the assumption says that it is positive (1) or negative (-1).
int assumed_sign(const Assumption& a, const std::string& symbol) {
  const Node& n = a.left.node();
  if (n.op != Op::symbol || n.name != symbol) return 0;
  return a.relation[0] == '>' ? 1 : a.relation[0] == '<' ? -1 : 0;
}

Ball with_sign(const Ball& value, int sign) {
  return (value.is_negative() && sign > 0) || (value.is_positive() && sign < 0) ? Ball() - value
                                                                                : value;
}

}  // namespace

bool holds(const Assumption& assumption, const Point& point) {
  const Ball left = value(assumption.left, point);
  const std::string& r = assumption.relation;
  const bool zero = left.is_tiny();
  if (r == "!=") return left.is_nonzero();
  if (r == "==") return zero;
  if (zero) return r == ">=" || r == "<=";
  return r[0] == '>' ? left.is_positive() : left.is_negative();
}

std::vector<Expr> level_of(const Case& claim) {
  if (claim.kind == Kind::conditional) return claim.conditionals.front().on;
  if (claim.kind == Kind::identity) return claim.identities.front().on;
  if (claim.kind != Kind::invariant_relation) return {};
  std::vector<Expr> on = claim.invariant_relations.front().on;
  on.push_back(claim.invariant_relations.front().expression);
  return on;
}

Sampler::Sampler(const Case& claim, const std::vector<Assumption>& more, bool generic,
                 Random& random)
    : case_(claim),
      assumptions_(claim.system.assumptions()),
      names_(names_of(claim)),
      generic_(generic),
      random_(random),
      agreed_(std::max<std::size_t>(claim.pieces.size(), 1)),
      doubtful_(agreed_.size()) {
  assumptions_.insert(assumptions_.end(), more.begin(), more.end());
}

Point Sampler::free_values() {
  std::vector<std::string> symbols = case_.system.symbols();
  for (const Lax& pair : case_.lax) {
    if (!pair.spectral.empty()) symbols.push_back(pair.spectral);
  }
  Point point;
  // Orbits that start far out may be too fast for the steps that follow them, and what is small
  // there may be too small for ranks.
  const bool near = generic_ || !level_of(case_).empty();
  for (const std::string& symbol : symbols) {
    point[symbol] = random_number(random_, near);
    for (const Assumption& a : assumptions_) {
      if (const int sign = assumed_sign(a, symbol); sign != 0)
        point[symbol] = with_sign(point[symbol], sign);
    }
  }
  // What is assumed may hold in another way where one or two of the symbols are zero, or one.
  if (generic_ || random_.one_in(2)) return point;
  for (int count = random_.between(1, 2); count > 0; --count) {
    const std::size_t first = random_.one_in(2) ? case_.system.variables.size() : 0;
    const std::size_t left = symbols.size() - std::min(first, symbols.size() - 1);
    point[symbols[symbols.size() - left +
                  static_cast<std::size_t>(random_(static_cast<int>(left)))]] =
        special_number(random_);
  }
  return point;
}

bool Sampler::admits(const Point& point) const {
  for (const Assumption& a : assumptions_) {
    if (!holds({substitute(a.left, names_), a.relation}, point)) return false;
  }
  return true;
}

bool Sampler::is_settled() const {
  for (std::size_t i = 0; i < agreed_.size(); ++i) {
    if (doubtful_[i] && !agreed_[i]) return false;
  }
  return true;
}

std::optional<Point> Sampler::draw() {
  piece_ = (piece_ + 1) % agreed_.size();
  try {
    Point point = free_values();
    if (!case_.pieces.empty()) {
      const Point free = point;
      for (const auto& [name, solved] : case_.pieces[piece_]) point[name] = value(solved, free);
    }
    if (!admits(point)) return std::nullopt;
    for (const Expr& f : level_of(case_)) {
      if (value(substitute(f, names_), point).is_nonzero())
        throw std::logic_error("a piece is not on its level");
    }
    return point;
  } catch (const NotReal&) {
  } catch (const Unknown&) {
    note(false);
  }
  return std::nullopt;
}

}  // namespace casimir::adversary

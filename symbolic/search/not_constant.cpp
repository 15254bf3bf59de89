#include "symbolic/search/not_constant.hpp"

#include <algorithm>
#include <random>

#include "symbolic/algebra/ball_evaluator.hpp"

namespace casimir::search {
namespace {

using GiNaC::ex;

/// Whether some of the derivatives is certainly not zero at the point, which is inside of every
/// assumption and of the function's domain.
bool changes_at(BallEvaluator& at, const Model& model, const ex& function,
                const std::vector<ex>& slopes) {
  try {
    for (const Assumption& assumption : model.assumptions) {
      const auto sign = at.sign(assumption.difference);
      if (!sign || !holds(assumption.comparison, *sign)) return false;
    }
    at(function);
  } catch (const NotCertified&) {
    return false;
  }
  return std::any_of(slopes.begin(), slopes.end(), [&](const ex& slope) {
    try {
      return !at(slope).contains_zero();
    } catch (const NotCertified&) {
      return false;  // another one may have a value
    }
  });
}

}  // namespace

bool is_certainly_not_constant(const Model& model, const ex& function) {
  constexpr long kBits = 160;
  constexpr int kTries = 60;
  std::vector<GiNaC::symbol> moving = model.variables;
  if (model.time) moving.push_back(*model.time);
  std::vector<GiNaC::symbol> all = moving;
  all.insert(all.end(), model.parameters.begin(), model.parameters.end());
  std::vector<ex> slopes;
  for (const GiNaC::symbol& s : moving) slopes.push_back(function.diff(s));
  std::mt19937 random(19);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    BallEvaluator at(BallEvaluator::Numbers::real, kBits);
    // The fewer signs are mixed, the more functions have a value.
    const long least = attempt % 3 == 0 ? 1 : -40;
    for (const GiNaC::symbol& s : all)
      at.set(s, GiNaC::numeric(static_cast<long>(random() % 81) + least, 20));
    if (changes_at(at, model, function, slopes)) return true;
  }
  return false;
}

}  // namespace casimir::search

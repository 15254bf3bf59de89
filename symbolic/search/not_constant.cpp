// Balls are Arb's: a value is certainly in its ball, whatever the rounding was.
#include "symbolic/search/not_constant.hpp"

#include <arb.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <random>
#include <sstream>

namespace casimir::search {
namespace {

using GiNaC::ex;

constexpr slong kBits = 160;

class Ball {
 public:
  Ball() { arb_init(value_); }
  Ball(const Ball& other) : Ball() { arb_set(value_, other.value_); }
  Ball& operator=(const Ball& other) {
    arb_set(value_, other.value_);
    return *this;
  }
  ~Ball() { arb_clear(value_); }
  arb_ptr raw() { return value_; }
  arb_srcptr raw() const { return value_; }

 private:
  arb_t value_;
};

/// Real values only; empty where there is none, or the function is not known.
class Evaluator {
 public:
  explicit Evaluator(const GiNaC::exmap& point) : point_(point) {}

  std::optional<Ball> value(const ex& e) const;

 private:
  std::optional<Ball> number(const GiNaC::numeric& n) const;
  std::optional<Ball> power(const ex& base, const ex& exponent) const;
  std::optional<Ball> function(const GiNaC::function& f) const;

  const GiNaC::exmap& point_;
};

std::optional<Ball> finite(Ball ball) {
  if (arb_is_finite(ball.raw()) == 0) return std::nullopt;
  return ball;
}

std::optional<Ball> Evaluator::number(const GiNaC::numeric& n) const {
  if (!n.is_rational()) return std::nullopt;
  const auto part = [](const GiNaC::numeric& integer) {
    std::ostringstream stream;
    stream << cln::the<cln::cl_I>(integer.to_cl_N());
    Ball ball;
    arb_set_str(ball.raw(), stream.str().c_str(), kBits);
    return ball;
  };
  Ball result = part(n.numer());
  arb_div(result.raw(), result.raw(), part(n.denom()).raw(), kBits);
  return finite(result);
}

std::optional<Ball> Evaluator::power(const ex& base, const ex& exponent) const {
  const std::optional<Ball> b = value(base);
  if (!b) return std::nullopt;
  Ball result;
  if (exponent.info(GiNaC::info_flags::integer)) {
    const GiNaC::numeric& n = GiNaC::ex_to<GiNaC::numeric>(exponent);
    constexpr int kMostBits = 20;
    if (n.int_length() > kMostBits) return std::nullopt;
    arb_pow_ui(result.raw(), b->raw(), static_cast<ulong>(std::abs(n.to_long())), kBits);
    if (n.is_negative()) arb_inv(result.raw(), result.raw(), kBits);
    return finite(result);
  }
  const std::optional<Ball> e = value(exponent);
  if (!e || arb_is_positive(b->raw()) == 0) return std::nullopt;
  arb_pow(result.raw(), b->raw(), e->raw(), kBits);
  return finite(result);
}

std::optional<Ball> Evaluator::function(const GiNaC::function& f) const {
  const std::optional<Ball> x = value(f.op(0));
  if (!x) return std::nullopt;
  const std::string name = f.get_name();
  Ball result;
  using Function = void (*)(arb_t, const arb_t, slong);
  const std::vector<std::pair<const char*, Function>> known{
      {"sin", arb_sin}, {"cos", arb_cos},   {"tan", arb_tan},   {"exp", arb_exp},
      {"log", arb_log}, {"atan", arb_atan}, {"asin", arb_asin}, {"acos", arb_acos}};
  for (const auto& [own, evaluate] : known) {
    if (name != own) continue;
    evaluate(result.raw(), x->raw(), kBits);
    return finite(result);
  }
  if (name != "atan2") return std::nullopt;
  const std::optional<Ball> second = value(f.op(1));
  if (!second) return std::nullopt;
  arb_atan2(result.raw(), x->raw(), second->raw(), kBits);
  return finite(result);
}

std::optional<Ball> Evaluator::value(const ex& e) const {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return number(GiNaC::ex_to<GiNaC::numeric>(e));
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    const auto place = point_.find(e);
    return place == point_.end() ? std::nullopt : value(place->second);
  }
  if (GiNaC::is_a<GiNaC::constant>(e)) {
    if (!e.is_equal(GiNaC::Pi)) return std::nullopt;
    Ball pi;
    arb_const_pi(pi.raw(), kBits);
    return pi;
  }
  if (GiNaC::is_a<GiNaC::power>(e)) return power(e.op(0), e.op(1));
  if (GiNaC::is_a<GiNaC::function>(e)) return function(GiNaC::ex_to<GiNaC::function>(e));
  const bool sum = GiNaC::is_a<GiNaC::add>(e);
  if (!sum && !GiNaC::is_a<GiNaC::mul>(e)) return std::nullopt;
  Ball result;
  arb_set_si(result.raw(), sum ? 0 : 1);
  for (const ex& part : e) {
    const std::optional<Ball> own = value(part);
    if (!own) return std::nullopt;
    if (sum)
      arb_add(result.raw(), result.raw(), own->raw(), kBits);
    else
      arb_mul(result.raw(), result.raw(), own->raw(), kBits);
  }
  return finite(result);
}

}  // namespace

bool is_certainly_not_constant(const Model& model, const ex& function) {
  std::vector<GiNaC::symbol> moving = model.variables;
  if (model.time) moving.push_back(*model.time);
  std::vector<GiNaC::symbol> all = moving;
  all.insert(all.end(), model.parameters.begin(), model.parameters.end());
  std::vector<ex> slopes;
  for (const GiNaC::symbol& s : moving) slopes.push_back(function.diff(s));
  std::mt19937 random(19);
  constexpr int kTries = 60;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    GiNaC::exmap point;
    // The fewer signs are mixed, the more functions have a value.
    const long least = attempt % 3 == 0 ? 1 : -40;
    for (const GiNaC::symbol& s : all)
      point[s] = GiNaC::numeric(static_cast<long>(random() % 81) + least, 20);
    if (!std::all_of(model.assumptions.begin(), model.assumptions.end(),
                     [&](const Assumption& a) { return a.holds_at(point); }))
      continue;
    const Evaluator evaluator(point);
    if (!evaluator.value(function)) continue;  // outside its domain
    for (const ex& slope : slopes) {
      const std::optional<Ball> value = evaluator.value(slope);
      if (value && arb_contains_zero(value->raw()) == 0) return true;
    }
  }
  return false;
}

}  // namespace casimir::search

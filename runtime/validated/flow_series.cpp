#include "runtime/validated/flow_series.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/validated/wide_registers.hpp"

namespace casimir::validated {

using Balls = Arithmetic<MidRad>;

namespace {

/// Terms of a sum of products that are added side by side.
constexpr std::size_t kTerms = 8;

/// So many numbers has each array of a factor: the coefficients, and zeros behind them, so that a
/// sum may begin with terms that are none.
std::size_t length_of(std::size_t order) { return (order / kTerms + 2) * kTerms; }

/// What the loops of an expansion need.
struct Expansion {
  const std::vector<PolynomialJet::Step>& steps;
  const std::vector<PolynomialJet::State>& states;
  std::size_t order, length;
  bool forwards;
};

// A factor with the coefficients m_j and radii r_j, or two of them, has arrays of `length` numbers,
//   m_j and its noise r_j + (j/8 + 6) u (|m_j| + kUnderflow), for j = 0..N, and
//   m_{N-i}, r_{N-i}, and the reach |m_{N-i}| + r_{N-i} with the larger radius, for i = 0..N,
// the rest being zero. So both factors of a convolution are read forwards.

/// Puts coefficient k into the arrays of a factor.
template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void publish(double* factor, const Expansion& work, std::size_t k,
                                   const MidRad* const (&value)[2]) {
  const std::size_t length = work.length, behind = work.order - k;
  const double mid = value[0][k].mid, size = std::abs(mid);
  const double roundings = kUnit * static_cast<double>(k / kTerms + 6) * (size + kUnderflow);
  if (k % kTerms == 0) {
    // What is left of the last expansion may be infinite, and must not meet the zeros.
    for (std::size_t r = 0; r <= kRadii; ++r)
      std::memset(factor + r * length + k, 0, kTerms * sizeof(double));
  }
  factor[k] = mid;
  double* const back = factor + (1 + kRadii) * length + behind;
  back[0] = mid;
  double widest = 0;  // where a radius is a NaN it is that of both arrays: that is enough
  for (std::size_t r = 0; r < kRadii; ++r) {
    const double rad = value[r][k].rad;
    factor[(1 + r) * length + k] = rad + roundings;
    back[(1 + r) * length] = rad;
    widest = std::max(widest, rad);
  }
  back[(1 + kRadii) * length] = size + widest;
}

constexpr std::size_t kLanes = 4, kHalves = kTerms / kLanes;
using Quad = LanesOf<kLanes>;

/// Of eight numbers, in pairs.
CASIMIR_INLINE_ALWAYS double sum_of(const Quad (&halves)[kHalves]) {
  const Quad four = halves[0] + halves[1];
  const LanesOf<2> two =
      __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
  return two[0] + two[1];
}

/// sum over j = 0..k of a_j b_{k-j}
///
/// Eight terms, j = 8 i .. 8 i + 7, are added to eight sums for falling i, and these in three
/// rounds of pairs: so the term j passes at most j/8 + 1 additions to its sum (j/8 rounded down), 3
/// further ones, and one product. The midpoint is thus off by at most gamma_{j/8+5} |a_j b_{k-j}|
/// for each term, gamma_n = n u / (1 - n u) <= (n + 1) u (Higham, Accuracy and Stability of
/// Numerical Algorithms, 2002, Sec. 3.1, whatever the order and where products are fused). Together
/// with the radii,
///   |x y - m_a m_b| <= |m_a| rad(b) + rad(a) (|m_b| + rad(b)),
/// and (j/8 + 6) u |m_a| beside rad(a), which is the noise of a. A reach that is larger than
/// |m_b| + rad(b), since it is that of another radius, only adds to that. kUnderflow beside |m_a|
/// keeps the noise from underflowing. The radius passes at most k/8 + 12 roundings, which `upwards`
/// covers for k below 3500; products that underflow lose 2^-1075 each, which it covers too. The
/// terms with j > k are coefficients that are zero as yet, times the zeros behind the other factor.
template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void product_of(const PolynomialJet::Step& step, const Expansion& work,
                                      std::size_t k) {
  const std::size_t length = work.length;
  const double* const a = step.left;
  const double* const b = step.right + (1 + kRadii) * length + (work.order - k);
  Quad mid[kHalves]{}, rad[kRadii][kHalves]{};
  for (std::size_t i = k / kTerms + 1; i-- > 0;) {
    for (std::size_t half = 0; half < kHalves; ++half) {
      const std::size_t j = i * kTerms + half * kLanes;
      Quad one, other, reach;
      load<kLanes>(one, a + j);
      load<kLanes>(other, b + j);
      load<kLanes>(reach, b + j + (1 + kRadii) * length);
      mid[half] += one * other;
      absolute<kLanes>(one);
      for (std::size_t r = 0; r < kRadii; ++r) {
        Quad noise, radius;
        load<kLanes>(noise, a + j + (1 + r) * length);
        load<kLanes>(radius, b + j + (1 + r) * length);
        rad[r][half] += one * radius + noise * reach;
      }
    }
  }
  const double middle = sum_of(mid);
  for (std::size_t r = 0; r < kRadii; ++r) step.out[r][k] = {middle, upwards(sum_of(rad[r]))};
}

/// x + y with the exact error of the sum (Knuth's, which holds for all doubles that do not
/// overflow): so zeros add nothing, and what is exact stays so. A radius that is zero is the sum of
/// three zeros.
template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void added(const PolynomialJet::Step& step, std::size_t k, double sign) {
  const double x = step.a[0][k].mid, y = sign * step.b[0][k].mid;
  const double mid = x + y, part = mid - x;
  const double lost = std::abs((x - (mid - part)) + (y - part));
  for (std::size_t r = 0; r < kRadii; ++r) {
    const double rad = step.a[r][k].rad + step.b[r][k].rad + lost;
    step.out[r][k] = {mid, rad == 0 ? 0 : upwards(rad)};
  }
}

/// c x for a constant c, as the product of balls.
template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void scaled(const PolynomialJet::Step& step, std::size_t k) {
  const MidRad& by = step.a[0][0];
  const double x = step.b[0][k].mid, mid = by.mid * x;
  const double size = std::abs(by.mid), lost = kUnit * std::abs(mid);
  for (std::size_t r = 0; r < kRadii; ++r) {
    const double rad = step.b[r][k].rad;
    const bool nothing = x == 0 && rad == 0;
    step.out[r][k] = {mid, nothing ? 0 : upwards(size * rad + by.rad * (std::abs(x) + rad) + lost)};
  }
}

/// The same where c is a power of two, which rounds nothing.
template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void scaled_exactly(const PolynomialJet::Step& step, std::size_t k) {
  const double by = step.a[0][0].mid, x = step.b[0][k].mid, mid = by * x;
  for (std::size_t r = 0; r < kRadii; ++r) {
    const double rad = step.b[r][k].rad;
    const bool exact = rad == 0 && (x == 0 || std::abs(x) > kUnderflow);
    step.out[r][k] = {mid, exact ? 0 : upwards(rad * std::abs(by))};
  }
}

/// Coefficient k of every line, from those of the states up to k.
template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void work_out(const Expansion& work, std::size_t k) {
  using Kind = PolynomialJet::Kind;
  for (const PolynomialJet::Step& step : work.steps) {
    switch (step.kind) {
      case Kind::add:
        added<kRadii>(step, k, 1);
        break;
      case Kind::sub:
        added<kRadii>(step, k, -1);
        break;
      case Kind::neg:
        for (std::size_t r = 0; r < kRadii; ++r) step.out[r][k] = -step.a[r][k];
        break;
      case Kind::scale:
        scaled<kRadii>(step, k);
        break;
      case Kind::scale_exactly:
        scaled_exactly<kRadii>(step, k);
        break;
      case Kind::product:
        // One product is known better than a sum of them.
        if (k == 0)
          for (std::size_t r = 0; r < kRadii; ++r) step.out[r][0] = step.a[r][0] * step.b[r][0];
        else
          product_of<kRadii>(step, work, k);
        break;
      case Kind::quotient:
        for (std::size_t r = 0; r < kRadii; ++r) step.out[r][k] = step.a[r][k] / step.b[r][0];
        break;
    }
    if (step.factor) publish<kRadii>(step.factor, work, k, {step.out[0], step.out[1]});
  }
}

/// x_{k+1} = +-f_k / (k + 1), as Arithmetic<MidRad>::over.
template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void step_up(const Expansion& work, const PolynomialJet::State& state,
                                   std::size_t k) {
  const double divisor = static_cast<double>(k + 1), share = 1 / divisor;
  const bool exact = ((k + 1) & k) == 0;
  const double x = state.rate[0][k].mid, quotient = x / divisor;
  const double lost = exact ? 0 : kUnit * std::abs(quotient);
  const bool is_exact = x == 0 || (exact && std::abs(x) > kUnderflow);
  for (std::size_t r = 0; r < kRadii; ++r) {
    const double rad = state.rate[r][k].rad;
    state.series[r][k + 1] = {work.forwards ? quotient : -quotient,
                              is_exact && rad == 0 ? 0 : upwards(rad * share + lost)};
  }
  if (state.factor) publish<kRadii>(state.factor, work, k + 1, {state.series[0], state.series[1]});
}

template <std::size_t kRadii>
CASIMIR_INLINE_ALWAYS void expand_states(const Expansion& work) {
  for (const PolynomialJet::State& state : work.states)
    if (state.factor) publish<kRadii>(state.factor, work, 0, {state.series[0], state.series[1]});
  for (std::size_t k = 0; k < work.order; ++k) {
    work_out<kRadii>(work, k);
    for (const PolynomialJet::State& state : work.states) step_up<kRadii>(work, state, k);
  }
}

CASIMIR_FOR_WIDE_REGISTERS
void expand_one(const Expansion& work) { expand_states<1>(work); }
CASIMIR_FOR_WIDE_REGISTERS
void expand_two(const Expansion& work) { expand_states<2>(work); }

}  // namespace

PolynomialJet::PolynomialJet(const Program& program, int order, std::size_t radii)
    : program_(program), order_(static_cast<std::size_t>(order)), radii_(radii) {
  const std::size_t lines = program.code.size(), states = program.outputs.size();
  for (const Instruction& line : program.code)
    constant_.push_back(is_literal(line) ||
                        (line.op != Op::input && constant_[static_cast<std::size_t>(line.a)] &&
                         (line.b < 0 || constant_[static_cast<std::size_t>(line.b)])));
  for (std::size_t r = 0; r < radii_; ++r) {
    states_[r].assign(states, Series(order_ + 1));
    own_[r].resize(lines);
  }
  for (std::size_t i = 0; i < lines; ++i) {
    const auto input = static_cast<std::size_t>(program.code[i].a);
    const bool is_input = program.code[i].op == Op::input, is_state = is_input && input < states;
    if (is_input && !is_state) times_.push_back(i);
    for (std::size_t r = 0; r < radii_; ++r) {
      if (!is_state) own_[r][i].resize(order_ + 1);
      lines_[r].push_back(is_state ? &states_[r][input] : &own_[r][i]);
    }
  }
  find_factors();
  for (std::size_t i = 0; i < lines; ++i)
    if (!constant_[i] && program.code[i].op != Op::input) add_step(i);
  for (std::size_t i = 0; i < states; ++i) {
    State state{};
    for (std::size_t r = 0; r < radii_; ++r) {
      state.series[r] = states_[r][i].data();
      state.rate[r] = lines_[r][static_cast<std::size_t>(program.outputs[i])]->data();
    }
    state.factor = factor_of(&states_[0][i]);
    rates_.push_back(state);
  }
}

/// Gives every series that is a factor of a product its place.
void PolynomialJet::find_factors() {
  for (const Instruction& line : program_.code) {
    if (line.op != Op::mul) continue;
    const auto a = static_cast<std::size_t>(line.a), b = static_cast<std::size_t>(line.b);
    if (constant_[a] || constant_[b]) continue;
    for (const std::size_t factor : {a, b}) places_.try_emplace(lines_[0][factor], places_.size());
  }
  factors_.resize(places_.size() * arrays() * length_of(order_));
}

double* PolynomialJet::factor_of(const Series* series) {
  const auto known = places_.find(series);
  if (known == places_.end()) return nullptr;
  return factors_.data() + known->second * arrays() * length_of(order_);
}

/// What is free of states and time: its other coefficients stay zero.
/// \throws std::domain_error  where a constant has no value.
void PolynomialJet::find_constants() {
  const Balls balls;
  for (std::size_t i = 0; i < program_.code.size(); ++i) {
    const Instruction& line = program_.code[i];
    const auto a = static_cast<std::size_t>(line.a);
    const auto b = static_cast<std::size_t>(line.b < 0 ? line.a : line.b);
    if (!constant_[i]) continue;
    own_[0][i][0] = is_literal(line) ? literal_value(program_, line, balls)
                                     : applied(line.op, own_[0][a][0], own_[0][b][0], balls);
    for (std::size_t r = 1; r < radii_; ++r) own_[r][i][0] = own_[0][i][0];
  }
  for (Step& step : steps_) {
    if (step.kind != Kind::scale) continue;
    const MidRad& by = step.a[0][0];
    if (is_exact(by) && is_power_of_two(by.mid)) step.kind = Kind::scale_exactly;
  }
  constants_known_ = true;
}

void PolynomialJet::add_step(std::size_t line) {
  const Instruction& code = program_.code[line];
  auto a = static_cast<std::size_t>(code.a);
  auto b = static_cast<std::size_t>(code.b < 0 ? code.a : code.b);
  Step step{};
  step.kind = Kind::neg;
  if (code.op == Op::add) step.kind = Kind::add;
  if (code.op == Op::sub) step.kind = Kind::sub;
  if (code.op == Op::div) step.kind = Kind::quotient;
  if (code.op == Op::mul) {
    step.kind = constant_[a] || constant_[b] ? Kind::scale : Kind::product;
    if (constant_[b]) std::swap(a, b);
  }
  for (std::size_t r = 0; r < radii_; ++r) {
    step.out[r] = own_[r][line].data();
    step.a[r] = lines_[r][a]->data();
    step.b[r] = lines_[r][b]->data();
  }
  step.factor = factor_of(lines_[0][line]);
  step.left = factor_of(lines_[0][a]);
  step.right = factor_of(lines_[0][b]);
  steps_.push_back(step);
}

void PolynomialJet::run(const MidRad& t, const MidRad& unit) {
  if (!constants_known_) find_constants();
  const std::size_t length = length_of(order_);
  const Expansion work{steps_, rates_, order_, length, unit.mid > 0};
  for (const std::size_t line : times_) {
    for (std::size_t r = 0; r < radii_; ++r) {
      own_[r][line][0] = t;
      if (order_ > 0) own_[r][line][1] = unit;
    }
    if (double* const factor = factor_of(lines_[0][line])) {
      const MidRad* const value[2] = {own_[0][line].data(), own_[radii_ - 1][line].data()};
      for (std::size_t k = 0; k <= order_; ++k)
        radii_ == 1 ? publish<1>(factor, work, k, value) : publish<2>(factor, work, k, value);
    }
  }
  radii_ == 1 ? expand_one(work) : expand_two(work);
}

const std::vector<PolynomialJet::Series>& PolynomialJet::expand(const MidRad& t,
                                                                const std::vector<MidRad>& x,
                                                                const MidRad& unit) {
  for (std::size_t i = 0; i < x.size(); ++i) states_[0][i][0] = x[i];
  run(t, unit);
  return states_[0];
}

void PolynomialJet::expand_both(const MidRad& t, const std::vector<MidRad>& middle,
                                const std::vector<MidRad>& box, const MidRad& unit) {
  for (std::size_t i = 0; i < middle.size(); ++i) {
    states_[0][i][0] = middle[i];
    states_[1][i][0] = {middle[i].mid, box[i].rad};
  }
  run(t, unit);
}

}  // namespace casimir::validated

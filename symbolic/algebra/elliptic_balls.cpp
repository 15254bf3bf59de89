#include "symbolic/algebra/elliptic_balls.hpp"

#include <acb_elliptic.h>
#include <acb_modular.h>
#include <arb.h>

#include <cmath>
#include <cstdlib>

#include "symbolic/algebra/number_text.hpp"

namespace casimir {
namespace {

/// Some complex balls that end with the scope.
class Balls {
 public:
  explicit Balls(slong count) : count_(count), first_(_acb_vec_init(count)) {}
  ~Balls() { _acb_vec_clear(first_, count_); }
  Balls(const Balls&) = delete;
  Balls& operator=(const Balls&) = delete;
  acb_ptr operator[](slong i) { return first_ + i; }

 private:
  slong count_;
  acb_ptr first_;
};

bool is_real(acb_srcptr x) { return arb_is_zero(acb_imagref(x)) && acb_is_finite(x); }

/// sn, cn and dn of u by theta functions of the nome of k, and u/(2K): DLMF 22.2.4 to 22.2.6.
bool jacobi(Balls& values, acb_ptr part, acb_srcptr u, acb_srcptr k, slong bits) {
  Balls work(14);
  acb_ptr m = work[0], m1 = work[1], quarter = work[2], other = work[3], tau = work[4],
          zero = work[5];
  acb_mul(m, k, k, bits);
  acb_sub_ui(m1, m, 1, bits);
  acb_neg(m1, m1);
  if (!arb_is_positive(acb_realref(m1))) return false;
  acb_elliptic_k(quarter, m, bits);
  acb_elliptic_k(other, m1, bits);
  if (acb_contains_zero(m)) return false;  // the nome of 0 has no logarithm
  acb_div(tau, other, quarter, bits);
  acb_mul_onei(tau, tau);
  acb_div(part, u, quarter, bits);
  acb_mul_2exp_si(part, part, -1);
  acb_modular_theta(work[6], work[7], work[8], work[9], part, tau, bits);
  acb_modular_theta(work[10], work[11], work[12], work[13], zero, tau, bits);
  // theta_1 .. theta_4 stand in 6 .. 9, and at zero in 10 .. 13.
  acb_mul(values[0], work[12], work[6], bits);
  acb_mul(other, work[11], work[9], bits);
  acb_div(values[0], values[0], other, bits);
  acb_mul(values[1], work[13], work[7], bits);
  acb_div(values[1], values[1], other, bits);
  acb_mul(values[2], work[13], work[8], bits);
  acb_mul(other, work[12], work[9], bits);
  acb_div(values[2], values[2], other, bits);
  for (slong i = 0; i < 3; ++i) arb_zero(acb_imagref(values[i]));  // of real u and k
  return true;
}

/// The amplitude turns once while u/(2K) grows by 2.
bool amplitude(acb_t result, Balls& values, acb_srcptr part, slong bits) {
  Balls work(2);
  arb_t turns, angle;
  arb_init(turns);
  arb_init(angle);
  arb_mul_2exp_si(turns, acb_realref(part), -1);
  // The whole turns that are nearest; near a half the angle is taken from the other side.
  const double near = arf_get_d(arb_midref(turns), ARF_RND_NEAR);
  const double whole = std::floor(near + 0.5);
  arb_set_d(turns, whole);
  const bool back = near - whole > 0.25 || near - whole < -0.25;
  if (back) {
    // From the opposite point, so that the cut of the arctangent is far away.
    arb_neg(acb_realref(work[0]), acb_realref(values[0]));
    arb_neg(acb_realref(work[1]), acb_realref(values[1]));
    arb_atan2(angle, acb_realref(work[0]), acb_realref(work[1]), bits);
    arb_set_d(turns, near > whole ? whole + 0.5 : whole - 0.5);
  } else {
    arb_atan2(angle, acb_realref(values[0]), acb_realref(values[1]), bits);
  }
  arb_const_pi(acb_realref(result), bits);
  arb_mul_2exp_si(acb_realref(result), acb_realref(result), 1);
  arb_mul(acb_realref(result), acb_realref(result), turns, bits);
  arb_add(acb_realref(result), acb_realref(result), angle, bits);
  arb_zero(acb_imagref(result));
  // A ball of more than an eighth of a turn leaves open which turn it is.
  const bool sure = mag_cmp_2exp_si(arb_radref(acb_realref(part)), -3) < 0;
  arb_clear(turns);
  arb_clear(angle);
  return sure;
}

}  // namespace

bool elliptic_ball(const std::string& name, acb_t result, const std::vector<acb_srcptr>& arguments,
                   slong bits) {
  for (const acb_srcptr argument : arguments)
    if (!is_real(argument)) return false;
  if (name[0] == 'R') {
    for (const acb_srcptr argument : arguments)
      if (!arb_is_positive(acb_realref(argument))) return false;
    if (name == "R_F")
      acb_elliptic_rf(result, arguments[0], arguments[1], arguments[2], 0, bits);
    else
      acb_elliptic_rj(result, arguments[0], arguments[1], arguments[2],
                      arguments[name == "R_D" ? 2 : 3], 0, bits);
    arb_zero(acb_imagref(result));
    return acb_is_finite(result) != 0;
  }
  Balls values(3), part(1);
  if (!jacobi(values, part[0], arguments[0], arguments[1], bits)) return false;
  if (name == "am") return amplitude(result, values, part[0], bits) && acb_is_finite(result);
  acb_set(result, values[name == "sn" ? 0 : name == "cn" ? 1 : 2]);
  return acb_is_finite(result) != 0;
}

std::optional<GiNaC::numeric> elliptic_decimal(const std::string& name,
                                               const std::vector<GiNaC::numeric>& arguments) {
  constexpr double kBitsPerDigit = 3.33;
  constexpr slong kMoreBits = 64;
  const auto digits = static_cast<slong>(GiNaC::Digits);
  const slong bits = static_cast<slong>(kBitsPerDigit * static_cast<double>(digits)) + kMoreBits;
  Balls balls(static_cast<slong>(arguments.size()) + 1);
  std::vector<acb_srcptr> given;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!arguments[i].is_real()) return std::nullopt;
    acb_ptr ball = balls[static_cast<slong>(i) + 1];
    const std::string decimal = expression_text(GiNaC::ex(arguments[i]).evalf());
    if (arb_set_str(acb_realref(ball), decimal.c_str(), bits) != 0) return std::nullopt;
    mag_zero(arb_radref(acb_realref(ball)));
    given.push_back(ball);
  }
  if (!elliptic_ball(name, balls[0], given, bits)) return std::nullopt;
  char* const text = arb_get_str(acb_realref(balls[0]), digits + 5, ARB_STR_NO_RADIUS);
  const std::string value = text;
  std::free(text);
  try {
    return GiNaC::numeric(value.c_str());
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace casimir

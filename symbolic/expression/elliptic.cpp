#include "symbolic/expression/elliptic.hpp"

#include <algorithm>
#include <array>

#include "symbolic/algebra/elliptic_balls.hpp"
#include "symbolic/error.hpp"

namespace casimir {
namespace elliptic {

using GiNaC::ex;

namespace {

[[noreturn]] void refuse_modulus() {
  throw TooLarge(
      "the modulus of an elliptic function depends on what is differentiated by: derivatives by "
      "the modulus are not known here");
}

/// To as many digits as GiNaC computes with.
ex value_of(const char* name, const GiNaC::exvector& arguments, const ex& unevaluated) {
  std::vector<GiNaC::numeric> numbers;
  for (const ex& argument : arguments) {
    const ex value = argument.evalf();
    if (!GiNaC::is_a<GiNaC::numeric>(value)) return unevaluated;
    numbers.push_back(GiNaC::ex_to<GiNaC::numeric>(value));
  }
  const auto value = elliptic_decimal(name, numbers);
  return value ? ex(*value) : unevaluated;
}

ex am_evalf(const ex& u, const ex& k) { return value_of("am", {u, k}, am(u, k).hold()); }
ex sn_evalf(const ex& u, const ex& k) { return value_of("sn", {u, k}, sn(u, k).hold()); }
ex cn_evalf(const ex& u, const ex& k) { return value_of("cn", {u, k}, cn(u, k).hold()); }
ex dn_evalf(const ex& u, const ex& k) { return value_of("dn", {u, k}, dn(u, k).hold()); }
ex R_F_evalf(const ex& x, const ex& y, const ex& z) {
  return value_of("R_F", {x, y, z}, R_F(x, y, z).hold());
}
ex R_D_evalf(const ex& x, const ex& y, const ex& z) {
  return value_of("R_D", {x, y, z}, R_D(x, y, z).hold());
}
ex R_J_evalf(const ex& x, const ex& y, const ex& z, const ex& p) {
  return value_of("R_J", {x, y, z, p}, R_J(x, y, z, p).hold());
}

ex am_derivative(const ex& u, const ex& k, unsigned place) {
  if (place != 0) refuse_modulus();
  return dn(u, k);
}
ex sn_derivative(const ex& u, const ex& k, unsigned place) {
  if (place != 0) refuse_modulus();
  return cn(u, k) * dn(u, k);
}
ex cn_derivative(const ex& u, const ex& k, unsigned place) {
  if (place != 0) refuse_modulus();
  return -sn(u, k) * dn(u, k);
}
ex dn_derivative(const ex& u, const ex& k, unsigned place) {
  if (place != 0) refuse_modulus();
  return -k * k * sn(u, k) * cn(u, k);
}

/// The derivative of R_F is -R_D/6, with the argument differentiated by in the last place.
ex R_F_derivative(const ex& x, const ex& y, const ex& z, unsigned place) {
  if (place == 0) return -R_D(y, z, x) / 6;
  if (place == 1) return -R_D(x, z, y) / 6;
  return -R_D(x, y, z) / 6;
}

/// Of R_D by one of the arguments that stand before the last one.
ex slope_of_R_D(const ex& by, const ex& other, const ex& last) {
  if ((last - by).expand().is_zero())
    throw ModelError(
        "R_D of two equal arguments is an elementary function: it has to be written "
        "as that to be differentiated");
  return (R_D(by, other, last) - R_D(other, last, by)) / (2 * (last - by));
}

/// By partial fractions; the last one since R_D is homogeneous of degree -3/2.
ex R_D_derivative(const ex& x, const ex& y, const ex& z, unsigned place) {
  if (place == 0) return slope_of_R_D(x, y, z);
  if (place == 1) return slope_of_R_D(y, x, z);
  return -(ex(3) / 2 * R_D(x, y, z) + x * slope_of_R_D(x, y, z) + y * slope_of_R_D(y, x, z)) / z;
}

ex slope_of_R_J(const ex& by, const ex& second, const ex& third, const ex& p) {
  if ((p - by).expand().is_zero())
    throw ModelError(
        "R_J(x, y, z, z) is R_D(x, y, z), and has to be written as that to be "
        "differentiated");
  return (R_J(by, second, third, p) - R_D(second, third, by)) / (2 * (p - by));
}

ex R_J_derivative(const ex& x, const ex& y, const ex& z, const ex& p, unsigned place) {
  if (place == 0) return slope_of_R_J(x, y, z, p);
  if (place == 1) return slope_of_R_J(y, x, z, p);
  if (place == 2) return slope_of_R_J(z, x, y, p);
  return -(ex(3) / 2 * R_J(x, y, z, p) + x * slope_of_R_J(x, y, z, p) +
           y * slope_of_R_J(y, x, z, p) + z * slope_of_R_J(z, x, y, p)) /
         p;
}

}  // namespace

REGISTER_FUNCTION(am, evalf_func(am_evalf).derivative_func(am_derivative))
REGISTER_FUNCTION(sn, evalf_func(sn_evalf).derivative_func(sn_derivative))
REGISTER_FUNCTION(cn, evalf_func(cn_evalf).derivative_func(cn_derivative))
REGISTER_FUNCTION(dn, evalf_func(dn_evalf).derivative_func(dn_derivative))
REGISTER_FUNCTION(am_by_modulus, dummy())
REGISTER_FUNCTION(dn_by_modulus, dummy())
REGISTER_FUNCTION(R_F, evalf_func(R_F_evalf).derivative_func(R_F_derivative))
REGISTER_FUNCTION(R_D, evalf_func(R_D_evalf).derivative_func(R_D_derivative))
REGISTER_FUNCTION(R_J, evalf_func(R_J_evalf).derivative_func(R_J_derivative))

}  // namespace elliptic

namespace {

using GiNaC::ex;

/// For k = 0 they are circular functions, and for k = 1 hyperbolic ones.
void check_modulus(const ex& k) {
  if (!GiNaC::is_a<GiNaC::numeric>(k)) return;
  const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(k);
  if (!number.is_real() || GiNaC::abs(number) >= 1)
    throw ModelError(
        "the modulus of Jacobi's functions, the second argument, lies between -1 and 1");
}

constexpr std::array kEllipticFunctions = {
    EllipticFunction{"sn", 2,
                     [](const GiNaC::exvector& a) -> ex {
                       check_modulus(a[1]);
                       if (a[0].is_zero()) return 0;
                       return a[1].is_zero() ? ex(GiNaC::sin(a[0])) : ex(elliptic::sn(a[0], a[1]));
                     }},
    EllipticFunction{"cn", 2,
                     [](const GiNaC::exvector& a) -> ex {
                       check_modulus(a[1]);
                       if (a[0].is_zero()) return 1;
                       return a[1].is_zero() ? ex(GiNaC::cos(a[0])) : ex(elliptic::cn(a[0], a[1]));
                     }},
    EllipticFunction{"dn", 2,
                     [](const GiNaC::exvector& a) -> ex {
                       check_modulus(a[1]);
                       if (a[0].is_zero() || a[1].is_zero()) return 1;
                       return elliptic::dn(a[0], a[1]);
                     }},
    EllipticFunction{"am", 2,
                     [](const GiNaC::exvector& a) -> ex {
                       check_modulus(a[1]);
                       if (a[0].is_zero() || a[1].is_zero()) return a[0];
                       return elliptic::am(a[0], a[1]);
                     }},
    EllipticFunction{
        "R_F", 3, [](const GiNaC::exvector& a) -> ex { return elliptic::R_F(a[0], a[1], a[2]); }},
    EllipticFunction{
        "R_D", 3, [](const GiNaC::exvector& a) -> ex { return elliptic::R_D(a[0], a[1], a[2]); }},
    EllipticFunction{
        "R_J", 4,
        [](const GiNaC::exvector& a) -> ex { return elliptic::R_J(a[0], a[1], a[2], a[3]); }},
};

}  // namespace

const EllipticFunction* find_elliptic_function(const std::string& name) {
  const auto it = std::find_if(kEllipticFunctions.begin(), kEllipticFunctions.end(),
                               [&](const EllipticFunction& f) { return f.name == name; });
  return it == kEllipticFunctions.end() ? nullptr : &*it;
}

std::vector<std::string> elliptic_function_names() {
  std::vector<std::string> names;
  for (const EllipticFunction& f : kEllipticFunctions) names.emplace_back(f.name);
  return names;
}

bool is_elliptic_function(const GiNaC::function& f) {
  return find_elliptic_function(f.get_name()) != nullptr;
}

bool has_elliptic_function(const ex& expression) {
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::function>(*part) &&
        is_elliptic_function(GiNaC::ex_to<GiNaC::function>(*part)))
      return true;
  return false;
}

}  // namespace casimir

#pragma once

#include <ginac/ginac.h>

#include <string>
#include <string_view>
#include <vector>

namespace casimir {

/// A function of expressions that is no elementary one: Jacobi's amplitude am(u, k) of the modulus
/// k, -1 < k < 1, with sn = sin am, cn = cos am and dn = sqrt(1 - k^2 sn^2), and Carlson's
/// symmetric integrals (NIST Digital Library of Mathematical Functions, 22.2, 22.16, 19.16):
///
///   R_F(x, y, z)    = 1/2 integral from 0 to infinity of dt / s,  s = sqrt((t+x)(t+y)(t+z))
///   R_D(x, y, z)    = 3/2 integral of dt / (s (t + z))
///   R_J(x, y, z, p) = 3/2 integral of dt / (s (t + p))
///
/// of positive arguments. A case may use these names for variables of its own: they are functions
/// only where nothing of the case is called so.
struct EllipticFunction {
  std::string_view name;
  std::size_t arity;
  /// \throws ModelError  for a modulus that is a number beyond -1 and 1
  GiNaC::ex (*apply)(const GiNaC::exvector& arguments);
};

/// The function of that name, or null.
const EllipticFunction* find_elliptic_function(const std::string& name);

/// sn, cn, dn, am, R_F, R_D, R_J.
std::vector<std::string> elliptic_function_names();

/// Whether one of these occurs in an expression.
bool has_elliptic_function(const GiNaC::ex& expression);

/// Whether a function of GiNaC is one of these.
bool is_elliptic_function(const GiNaC::function& f);

/// Of these functions, which GiNaC calls by their names. Jacobi's have derivatives by u alone:
/// where the modulus depends on what is differentiated by, diff throws TooLarge. Those of
/// Carlson's integrals have differences of the arguments in their denominators.
namespace elliptic {
DECLARE_FUNCTION_2P(am)
DECLARE_FUNCTION_2P(sn)
DECLARE_FUNCTION_2P(cn)
DECLARE_FUNCTION_2P(dn)
/// The derivatives of am and dn by the modulus, which have no value here and no derivative.
DECLARE_FUNCTION_2P(am_by_modulus)
DECLARE_FUNCTION_2P(dn_by_modulus)
DECLARE_FUNCTION_3P(R_F)
DECLARE_FUNCTION_3P(R_D)
DECLARE_FUNCTION_4P(R_J)
}  // namespace elliptic

}  // namespace casimir

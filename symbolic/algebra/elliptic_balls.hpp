#pragma once

#include <acb.h>
#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

namespace casimir {

/// A ball that contains the value of sn, cn, dn, am, R_F, R_D or R_J (see EllipticFunction) for all
/// real arguments in these balls, by Arb: theta functions and the duplication of Carlson.
/// \return  false where an argument may be complex, the modulus not between -1 and 1, or one of
///     Carlson's arguments not positive
bool elliptic_ball(const std::string& name, acb_t result, const std::vector<acb_srcptr>& arguments,
                   slong bits);

/// The value at numbers, to as many digits as GiNaC computes with; nothing where there is none.
std::optional<GiNaC::numeric> elliptic_decimal(const std::string& name,
                                               const std::vector<GiNaC::numeric>& arguments);

}  // namespace casimir

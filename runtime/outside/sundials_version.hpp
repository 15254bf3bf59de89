#pragma once

#include <string>

namespace casimir {

/// The version of the SUNDIALS library that runs, such as "6.4.1".
std::string sundials_version();

}  // namespace casimir

#pragma once

#include <string>

namespace casimir {

/// 17 significant digits: reads back as the same double.
std::string exact_text(double value);

/// The same for a number that may be beyond the range of double.
std::string exact_text(long double value);

}  // namespace casimir

#pragma once

#include <map>
#include <string>
#include <vector>

namespace casimir {

/// Integers that letters stand for in a part of a case file, as i for "q[i=1..4]".
using Indices = std::map<std::string, long>;

/// The name of a member of a family: x[12] is x12, x[1, 2] is x12 as well, and where a number has
/// two digits or more they are told apart, as x1_12 for x[1, 12].
/// \param indices  not negative, at least one.
std::string indexed_name(const std::string& family, const std::vector<long>& indices);

}  // namespace casimir

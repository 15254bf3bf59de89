#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/analysis/run/ensemble_check.hpp"

namespace casimir::tools {

/// Which of several results have an estimate of their error, and how large it is at most: a line.
/// \param what  they are: "member" or "point"
/// \param all   how many there are
std::string checked_text(const std::vector<CheckedMember>& checked, const std::string& what,
                         std::size_t all);

/// The same: numbers, which begin with 1, with estimates, which are null where nothing confirms the
/// result.
nlohmann::ordered_json checked_json(const std::vector<CheckedMember>& checked,
                                    const std::string& what);

/// The warnings about each of them.
std::vector<std::string> warnings_of(const std::vector<CheckedMember>& checked,
                                     const std::string& what, bool constant_step);

}  // namespace casimir::tools

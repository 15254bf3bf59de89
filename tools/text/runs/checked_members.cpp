#include "tools/text/runs/checked_members.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/text/runs/trust_report.hpp"

namespace casimir::tools {

std::string checked_text(const std::vector<CheckedMember>& checked, const std::string& what,
                         std::size_t all) {
  std::vector<std::size_t> numbers;
  double largest = 0;
  bool confirmed = true;
  for (const CheckedMember& member : checked) {
    numbers.push_back(member.member + 1);
    largest = std::max(largest, member.trust.error_estimate);
    confirmed = confirmed && !member.trust.unconfirmed;
  }
  std::string text =
      fmt::format("errors estimated of {}{} {}{}", what, numbers.size() == 1 ? "" : "s",
                  fmt::join(numbers, ", "), numbers.size() < all ? " alone" : "");
  return confirmed ? text + fmt::format(": at most about {:.0e}", largest) : text;
}

nlohmann::ordered_json checked_json(const std::vector<CheckedMember>& checked,
                                    const std::string& what) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const CheckedMember& member : checked) {
    json.push_back({{what, member.member + 1}, {"error_estimate", nullptr}});
    if (!member.trust.unconfirmed) json.back()["error_estimate"] = member.trust.error_estimate;
  }
  return json;
}

std::vector<std::string> warnings_of(const std::vector<CheckedMember>& checked,
                                     const std::string& what, bool constant_step) {
  std::vector<std::string> warnings;
  for (const CheckedMember& member : checked)
    for (const std::string& warning : warnings_of(member.trust, constant_step))
      warnings.push_back(fmt::format("{} {}: {}", what, member.member + 1, warning));
  return warnings;
}

}  // namespace casimir::tools

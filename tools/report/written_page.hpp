#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/report/index.hpp"

namespace casimir::tools {

/// A page that has been written.
struct WrittenPage {
  IndexEntry entry;
  nlohmann::ordered_json json;        ///< what `report --json` says of it
  int status = 0;                     ///< the exit status that is due to it
  std::vector<std::string> problems;  ///< for standard error
};

/// For another process of this program.
nlohmann::ordered_json to_json(const WrittenPage& page);

/// The page that `to_json` has written.
/// \throws nlohmann::json::exception  for anything else
WrittenPage written_page_from_json(const nlohmann::ordered_json& json);

}  // namespace casimir::tools

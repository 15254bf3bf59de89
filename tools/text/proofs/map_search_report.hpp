#pragma once

#include <nlohmann/json.hpp>

#include "symbolic/discrete/map_darboux.hpp"
#include "symbolic/discrete/search_map.hpp"

namespace casimir::tools {

/// The document of `search` on a map.
nlohmann::ordered_json to_json(const Model& base, int degree, const discrete::MapSearch& found,
                               double seconds);

/// The same for people.
void print(const Model& base, int degree, const discrete::MapSearch& found, double seconds);

nlohmann::ordered_json to_json(const Model& base, int degree, const discrete::MapDarboux& found,
                               double seconds);
void print(const Model& base, int degree, const discrete::MapDarboux& found, double seconds);

}  // namespace casimir::tools

#pragma once

#include <nlohmann/json.hpp>

// All JSON of ours keeps the order of its keys. Its class is compiled once, in ordered_json.cpp,
// and not for each source that writes a document: that takes two seconds each time.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/case_file.hpp"
#include "symbolic/search/search.hpp"
#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// `--weights NAME=W,..`
/// \param more  what the help says beyond that
void add_weights(CLI::App& command, std::vector<std::string>& weights,
                 const std::string& more = "");

/// NAME=W,NAME=W split into names and weights, with their places.
/// \throws UsageError
std::vector<std::pair<Text, Text>> weights_of(const std::vector<std::string>& values);

/// `--degree-in NAME,..=N`
void add_degree_in(CLI::App& command, std::vector<std::string>& limits);

/// NAME,..=N split into names and degrees, with their places.
/// \throws UsageError
std::vector<search::DegreeIn> degree_in_of(const std::vector<std::string>& values);

/// What was typed after an option, with its place. Commas separate where `list` is set.
std::vector<Text> texts_of(const std::vector<std::string>& values, const std::string& option,
                           bool list = false);

}  // namespace casimir::tools

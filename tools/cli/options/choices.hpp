#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace casimir::tools {

/// A check that a value is one of these names; what is said of another has the nearest of them.
/// Its description is the list, as "{text,json}", which help shows and shells complete from.
CLI::Validator one_of(const std::vector<std::string>& names);

/// "'jsn' is none of text, json; did you mean 'json'?"
std::string none_of_them(const std::string& given, const std::vector<std::string>& names);

}  // namespace casimir::tools

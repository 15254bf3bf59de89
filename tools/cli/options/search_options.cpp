#include "tools/cli/options/search_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

/// The parts between commas.
std::vector<Text> parts_of(const std::string& value, const std::string& option) {
  std::vector<Text> result;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find(',', begin), value.size());
    result.push_back(
        {value.substr(begin, end - begin), {option, 1, static_cast<int>(begin) + 1}, value});
    begin = end + 1;
  }
  return result;
}

}  // namespace

void add_weights(CLI::App& command, std::vector<std::string>& weights, const std::string& more) {
  command
      .add_option("--weights", weights,
                  "Weights of variables, as whole numbers; 1 for those that are not named" + more)
      ->allow_extra_args(false)
      ->type_name("NAME=W,..");
}

std::vector<std::pair<Text, Text>> weights_of(const std::vector<std::string>& values) {
  std::vector<std::pair<Text, Text>> result;
  for (const std::string& value : values) {
    for (const Text& part : parts_of(value, "--weights")) {
      // The last one: a declared function may be named as it is written.
      const std::size_t equals = part.value.rfind('=');
      if (equals == std::string::npos) {
        throw UsageError(
            fmt::format("--weights '{}': expected NAME=W,NAME=W, such as --weights M1=1,g1=2",
                        printable(value)));
      }
      Location where = part.where;
      where.column += static_cast<int>(equals) + 1;
      result.emplace_back(Text{part.value.substr(0, equals), part.where, value},
                          Text{part.value.substr(equals + 1), where, value});
    }
  }
  return result;
}

void add_degree_in(CLI::App& command, std::vector<std::string>& limits) {
  command
      .add_option(
          "--degree-in", limits,
          "Highest degree in these variables, such as momenta=4 or g1,g2,g3=6; rest=N is of "
          "all others (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME,..=N");
}

std::vector<search::DegreeIn> degree_in_of(const std::vector<std::string>& values) {
  std::vector<search::DegreeIn> result;
  for (const std::string& value : values) {
    const std::size_t equals = value.rfind('=');
    if (equals == std::string::npos) {
      throw UsageError(fmt::format(
          "--degree-in '{}': expected NAME,..=N, such as --degree-in momenta=4", printable(value)));
    }
    search::DegreeIn own{
        parts_of(value.substr(0, equals), "--degree-in"),
        Text{value.substr(equals + 1), {"--degree-in", 1, static_cast<int>(equals) + 2}, value}};
    for (Text& name : own.names) name.excerpt = value;
    result.push_back(std::move(own));
  }
  return result;
}

std::vector<Text> texts_of(const std::vector<std::string>& values, const std::string& option,
                           bool list) {
  std::vector<Text> result;
  for (const std::string& value : values) {
    if (!list) {
      result.push_back({value, {option, 1, 1}, value});
      continue;
    }
    const std::vector<Text> parts = parts_of(value, option);
    result.insert(result.end(), parts.begin(), parts.end());
  }
  return result;
}

}  // namespace casimir::tools

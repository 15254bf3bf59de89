#include "tools/cli/resources.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "symbolic/case/memory.hpp"
#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/options/number_checks.hpp"

namespace casimir::tools {
namespace {

constexpr double kGigabyte = 1e9;
constexpr double kDefaultMemory = 4;  // gigabytes

std::optional<double> g_memory;

/// A sanitizer's own memory is more than any limit.
constexpr bool kSanitized =
#if defined(__SANITIZE_ADDRESS__)
    true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
    true;
#else
    false;
#endif
#else
    false;
#endif

void set_limit(Limits& limits, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  std::vector<std::string> names;
  for (const LimitName& limit : limit_names()) {
    names.emplace_back(limit.name);
    if (name != limit.name) continue;
    const char* const begin = text.data() + std::min(equals, text.size() - 1) + 1;
    const char* const end = text.data() + text.size();
    double value = 0;
    const auto [rest, problem] = std::from_chars(begin, end, value);
    if (problem != std::errc() || rest != end || !(value >= 1 && value <= limit.most)) {
      throw UsageError(fmt::format("--limit '{}': expected {}=N with N from 1 to {:g}",
                                   printable(text), limit.name, limit.most));
    }
    limits.*limit.value = value;
    return;
  }
  throw UsageError(fmt::format("--limit '{}': there is no such limit\n  hint: {}", printable(text),
                               suggest_or_list(name, names)));
}

}  // namespace

void add_resources(CLI::App& command, Resources& resources) {
  std::string names;
  for (const LimitName& limit : limit_names())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", limit.name);
  command
      .add_option("--limit", resources.limits,
                  "NAME=N: how large what a case asks for may become (repeatable): " + names)
      ->allow_extra_args(false)
      ->type_name("NAME=N");
  command
      .add_option("--memory-limit", resources.memory,
                  fmt::format("Refuse what takes more memory (default {}; 2 for the equations of a "
                              "search)",
                              kDefaultMemory))
      ->type_name("GB")
      ->check(positive_number());
}

Limits limits_of(const Resources& resources) {
  Limits result;
  result.how_to_raise = "--limit {}=N allows more";
  result.how_to_get_memory = "--memory-limit GB allows more";
  for (const std::string& text : resources.limits) set_limit(result, text);
  return result;
}

void limit_memory(const Resources& resources) {
  throw_when_out_of_memory();
  if (resources.memory) g_memory = *resources.memory * kGigabyte;
  if (kSanitized) return;
  rlimit limit = {};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const auto bytes =
      static_cast<rlim_t>(std::min(resources.memory.value_or(kDefaultMemory), 1e9) * kGigabyte);
  limit.rlim_cur = std::min(bytes, limit.rlim_max);
  setrlimit(RLIMIT_DATA, &limit);  // at worst the limit is that of the machine
}

std::optional<double> memory_allowed() { return g_memory; }

std::string out_of_memory_text() {
  return fmt::format("out of memory: the limit is {:g} GB; --memory-limit GB sets another",
                     g_memory ? *g_memory / kGigabyte : kDefaultMemory);
}

}  // namespace casimir::tools

#include "tools/stress/transport.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "symbolic/error.hpp"
#include "tools/analysis/proof/exact_text.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNotSaid = std::numeric_limits<double>::quiet_NaN();

Json exact(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(exact_text(value));
  return list;
}

std::vector<double> numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& text : list)
    values.push_back(std::strtod(text.get<std::string>().c_str(), nullptr));
  return values;
}

/// A number as `integrate` writes it; not a number where it wrote none.
double said_number(const Json& value) {
  if (value.is_number()) return value.get<double>();
  return value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr) : kNotSaid;
}

/// The first line of what the program said on standard error, without its name.
std::string complaint(const std::string& text) {
  constexpr std::string_view kBefore = "casimir: error: ";
  std::string line = text.substr(0, text.find('\n'));
  if (line.starts_with(kBefore)) line.erase(0, kBefore.size());
  return printable(line, 200);
}

/// The status of that name.
Status status_named(const std::string& name) {
  constexpr Status kStatuses[] = {
      Status::ok,        Status::singularity,    Status::non_finite,     Status::step_underflow,
      Status::max_steps, Status::no_convergence, Status::drift_exceeded, Status::stopped,
      Status::at_jump};
  return *std::ranges::find(kStatuses, name, [](Status status) { return to_string(status); });
}

double largest_drift(const Json& invariants) {
  double largest = 0;
  for (const auto& [name, record] : invariants.items()) {
    const double drift = said_number(record.at("drift"));
    if (!(drift <= largest)) largest = drift;  // one that is no number stays
    if (std::isnan(largest)) break;
  }
  return largest;
}

}  // namespace

Json packed(const SceneReference& truth) {
  Json json = {{"states", truth.states},
               {"source", truth.source},
               {"has_end", truth.has_end},
               {"growth", exact_text(truth.growth)}};
  if (truth.singular_time) json["singular_time"] = exact_text(*truth.singular_time);
  if (truth.truth) {
    json["state"] = exact(truth.truth->state);
    json["rest"] = exact(truth.truth->rest);
    json["scale"] = exact(truth.truth->scale);
  }
  return json;
}

SceneReference unpacked(const Json& json) {
  const auto number = [&](const char* key) {
    return std::strtod(json.at(key).get<std::string>().c_str(), nullptr);
  };
  SceneReference truth{.states = json.at("states").get<std::vector<std::string>>(),
                       .source = json.at("source").get<std::string>(),
                       .has_end = json.at("has_end").get<bool>(),
                       .growth = number("growth")};
  if (json.contains("singular_time")) truth.singular_time = number("singular_time");
  if (json.contains("state"))
    truth.truth = ReferenceState{numbers(json.at("state")), numbers(json.at("rest")),
                                 numbers(json.at("scale"))};
  return truth;
}

StressAnswer answer_of(const Reply& reply) {
  using Kind = StressAnswer::Kind;
  const Json said = Json::parse(reply.out, nullptr, false);
  if (said.is_discarded() || said.contains("error") || reply.killed)
    return {.kind = reply.killed      ? Kind::killed
                    : reply.exit >= 0 ? Kind::refused
                                      : Kind::crashed,
            .says_done = reply.exit == 0,
            .unsuitable = reply.exit == kBadInput,
            .complaint = complaint(reply.err),
            .stopped_at = {}};
  StressAnswer answer{.says_done = reply.exit == 0,
                      .status = status_named(said.at("status").get<std::string>()),
                      .tolerance = said_number(said.at("tolerance")),
                      .rtol = said_number(said.at("rtol")),
                      .atol = said_number(said.at("atol")),
                      .drift = largest_drift(said.at("invariants")),
                      .seconds = said.at("seconds").at("integrate").get<double>(),
                      .compile_seconds = said.at("seconds").at("compile").get<double>(),
                      .steps = said.at("steps").get<unsigned long long>(),
                      .evaluations = said.at("evaluations").get<unsigned long long>(),
                      .warned = said.at("end_in_doubt").get<bool>(),
                      .warnings = said.at("warnings").dump(),
                      .stopped_at = {}};
  for (const auto& [name, value] : said.at("state").items())
    answer.state.emplace_back(name, said_number(value));
  if (said.contains("stopped")) {
    answer.stopped_at = said_number(said.at("stopped").at("time"));
    answer.stop_reason = said.at("stopped").value("reason", "");
  }
  return answer;
}

}  // namespace casimir::tools

#include "symbolic/case/limits.hpp"

#include <fmt/format.h>

#include <utility>

#include "symbolic/error.hpp"

namespace casimir {
namespace {

thread_local WorkMeter* g_meter = nullptr;

}  // namespace

const std::vector<LimitName>& limit_names() {
  constexpr double kAny = 1e15;
  static const std::vector<LimitName> names = {
      {"file-bytes", &Limits::file_bytes, "bytes of a case file, or of an expression", kAny},
      {"variables", &Limits::variables, "variables of a phase space", 1e5},
      {"parameters", &Limits::parameters, "parameters of a case", 1e5},
      {"scenes", &Limits::scenes, "scenes of a case", 1e5},
      {"claims", &Limits::claims, "claims of a case", 1e5},
      {"nesting", &Limits::nesting, "brackets inside each other, or definitions", 1000},
      {"depth", &Limits::depth, "levels of the tree of an expression", 3000},
      {"degree", &Limits::degree, "total degree of an expression", 1e9},
      {"bits", &Limits::bits, "bits of a number", 1e9},
      {"size", &Limits::size, "terms and factors of an expression as it is written", kAny},
      {"terms", &Limits::terms, "terms of an expanded polynomial", kAny},
      {"repetitions", &Limits::repetitions,
       "names of a family, or terms that the sums of an expression write out", kAny},
      {"work", &Limits::work, "products of two terms in the proof of one claim, for each variable",
       kAny}};
  return names;
}

std::string name_of(double Limits::*limit) {
  for (const LimitName& name : limit_names()) {
    if (name.value == limit) return name.name;
  }
  return {};
}

std::string Limits::hint(double Limits::*limit) const {
  return fmt::format(fmt::runtime(how_to_raise), name_of(limit));
}

std::string Limits::out_of_memory() const {
  return how_to_get_memory.empty() ? "out of memory" : "out of memory: " + how_to_get_memory;
}

WorkMeter::WorkMeter(Limits limits) : limits_(std::move(limits)), outer_(g_meter) {
  g_meter = this;
}

WorkMeter::~WorkMeter() { g_meter = outer_; }

void WorkMeter::spend(double products) {
  if (g_meter == nullptr) return;
  g_meter->done_ += products;
  const Limits& limits = g_meter->limits_;
  if (g_meter->done_ > limits.work)
    throw TooLarge(fmt::format("the products of terms are more work than {:g}", limits.work),
                   limits, &Limits::work);
}

}  // namespace casimir

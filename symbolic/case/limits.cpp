#include "symbolic/case/limits.hpp"

#include <fmt/format.h>

#include "symbolic/error.hpp"

namespace casimir {
namespace {

Limits g_limits;
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

const Limits& limits() { return g_limits; }

void set_limits(const Limits& limits) { g_limits = limits; }

std::string limit_hint(double Limits::*limit) {
  for (const LimitName& name : limit_names()) {
    if (name.value == limit) return fmt::format(fmt::runtime(g_limits.how_to_raise), name.name);
  }
  return {};
}

std::string out_of_memory() {
  return g_limits.how_to_get_memory.empty() ? "out of memory"
                                            : "out of memory: " + g_limits.how_to_get_memory;
}

WorkMeter::WorkMeter() : outer_(g_meter) { g_meter = this; }

WorkMeter::~WorkMeter() { g_meter = outer_; }

void WorkMeter::spend(double products) {
  if (g_meter == nullptr) return;
  g_meter->done_ += products;
  if (g_meter->done_ > g_limits.work)
    throw TooLarge(fmt::format("the products of terms are more work than {:g}; {}", g_limits.work,
                               limit_hint(&Limits::work)));
}

}  // namespace casimir

#include "tools/section/symmetric_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/section/symmetric_cycle.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::pair<std::string, GiNaC::ex>> read_symmetry(
    const Model& model, const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, GiNaC::ex>> images;
  std::vector<std::string> names;
  for (const GiNaC::symbol& x : model.variables) names.push_back(x.get_name());
  for (const std::string& text : texts) {
    const Text option{text, {"--symmetry", 1, 1}, text};
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw option.error("expected NAME=EXPR, such as q1=q3");
    std::string name = text.substr(0, equals);
    std::erase(name, ' ');
    if (std::ranges::count(names, name) == 0)
      throw option.error(fmt::format("there is no variable '{}'", printable(name)), 0,
                         suggest_or_list(name, names));
    for (const auto& [other, ignored] : images)
      if (other == name) throw option.error(fmt::format("there are two images of '{}'", name));
    images.emplace_back(
        name, model.parse(Text{
                  text.substr(equals + 1), {"--symmetry", 1, static_cast<int>(equals) + 2}, text}));
  }
  return images;
}

double guess_of(const SymmetricSectionRequest& request, const PreparedScene& run) {
  if (request.period.empty()) return duration_of(run);
  const Text text{request.period, {"--period", 1, 1}, request.period};
  const auto value =
      real_decimal(parse_constant(text, request.model.limits), request.model.limits.bits);
  if (!value || !value->is_positive()) throw text.error("expected a period, a positive number");
  return value->to_double();
}

const char* words_of(const SymmetricCycle& cycle) {
  switch (cycle.stability()) {
    case SpectralStability::stable:
      return cycle.reciprocal
                 ? "all on the unit circle to 1e-5: spectrally stable, as far as that tells"
                 : "all but the one along the motion inside of the unit circle: attracting";
    case SpectralStability::unstable:
      return "not all on the unit circle: unstable";
    default:
      return cycle.reciprocal
                 ? "not decided: rounding may have moved them off the unit circle"
                 : "not decided: some are on the unit circle, as far as rounding tells";
  }
}

class SymmetricReport {
 public:
  SymmetricReport(const SymmetricSectionRequest& request, const PreparedScene& run,
                  const PhaseSymmetry& symmetry, const SymmetricCycle& cycle)
      : request_(request),
        names_(run.specialisation.states),
        order_(symmetry.order),
        cycle_(cycle),
        warnings_(cycle.warnings()) {}

  Json json() const {
    Json json = {{"case", request_.model.name},
                 {"scene", request_.scene.name},
                 {"order", order_},
                 {"period", exact_text(cycle_.period)},
                 {"period_error", exact_text(cycle_.period_error)},
                 {"state", Json::object()},
                 {"state_error", exact_text(cycle_.state_error)},
                 {"residual", exact_text(cycle_.residual)},
                 {"closure", exact_text(cycle_.closure)},
                 {"multipliers", Json::array()},
                 {"stable", Json()},
                 {"stability", to_string(cycle_.stability())},
                 {"rounds", cycle_.rounds},
                 {"warnings", warnings_}};
    if (cycle_.stability() != SpectralStability::undecided)
      json["stable"] = cycle_.stability() == SpectralStability::stable;
    for (std::size_t i = 0; i < names_.size(); ++i)
      json["state"][names_[i]] = exact_text(cycle_.state[i]);
    for (const auto& m : cycle_.multipliers)
      json["multipliers"].push_back({exact_text(m.real()), exact_text(m.imag())});
    return json;
  }

  void print() const {
    fmt::print("{}, scene '{}': a cycle with x(t + T/{}) = S x(t)\n", request_.model.name,
               printable(request_.scene.name), order_);
    fmt::print("  T = {} +- {:.0e}, found in {} rounds of Newton's method\n",
               exact_text(cycle_.period), cycle_.period_error, cycle_.rounds);
    for (std::size_t i = 0; i < names_.size(); ++i)
      fmt::print("  {:<10} {:>25}\n", names_[i], exact_text(cycle_.state[i]));
    fmt::print("  the state to about {:.0e}; x(T/{}) is S x(0) to {:.0e}, x(T) is x(0) to {:.0e}\n",
               cycle_.state_error, order_, cycle_.residual, cycle_.closure);
    fmt::print("  multipliers over T/{}:", order_);
    for (const auto& m : cycle_.multipliers)
      fmt::print(" {:.6f}{}", m.real(),
                 std::abs(m.imag()) < 5e-7 ? "" : fmt::format("{:+.6f}i", m.imag()));
    fmt::print("\n  {}\n", words_of(cycle_));
    for (const std::string& warning : warnings_) fmt::print("  warning: {}\n", warning);
  }

 private:
  const SymmetricSectionRequest& request_;
  const std::vector<std::string>& names_;
  int order_;
  const SymmetricCycle& cycle_;
  std::vector<std::string> warnings_;
};

}  // namespace

int section_with_symmetry(const SymmetricSectionRequest& request) {
  const PreparedScene run =
      prepare(request.model, request.scene, {.observe = std::vector<std::string>{}});
  const PhaseSymmetry symmetry =
      phase_symmetry(request.model, request.scene, read_symmetry(request.model, request.symmetry));
  SymmetricCycleRequest how{.guess = guess_of(request, run),
                            .keep_period = request.keep_period,
                            .tolerance = request.tolerance};
  how.give_up = time_limit(request.common.time_limit);
  const SymmetricCycle cycle = symmetric_cycle(request.model, request.scene, run, symmetry, how);
  if (!cycle.found) {
    std::cerr << fmt::format(
        "casimir: error: no cycle was found: {}\n  hint: begin nearer to one, by --initial "
        "NAME=VALUE and --period T\n",
        cycle.reason);
    return how.give_up && how.give_up() ? kEnvironment : kNotContinued;
  }
  const SymmetricReport report(request, run, symmetry, cycle);
  if (request.common.json)
    print_json(report.json());
  else if (!request.common.quiet)
    report.print();
  return kDone;
}

}  // namespace casimir::tools

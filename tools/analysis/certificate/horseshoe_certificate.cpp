#include "tools/analysis/certificate/horseshoe_certificate.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "runtime/certificate/hex_float.hpp"
#include "runtime/program/exact_number.hpp"
#include "symbolic/case/limits.hpp"
#include "tools/analysis/certificate/run_certificate.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/horseshoe/horseshoe.hpp"

namespace casimir {
namespace {

using horseshoe::Arrows;
using horseshoe::HSet;
using validated::ArbBall;

/// Of all that is proved.
constexpr slong kHorseshoeBits = 96;
/// Enough for the ends of a level: they have few bits.
constexpr slong kEndBits = 1024;

/// Why the certificate of a horseshoe does not hold: a sentence.
struct HorseshoeRefuted {
  std::string reason;
};

std::vector<std::string> texts_of(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double x : numbers) texts.push_back(traced_text(x));
  return texts;
}

/// \throws std::invalid_argument  for a number that is not a whole one times a power of two.
std::string end_text(const cln::cl_RA& end) {
  const validated::BallPrecision precision(kEndBits);
  const ArbBall ball(end);
  if (!is_exact(ball)) throw std::invalid_argument("the end of a level has too many bits");
  return certificate::middle_text(ball);
}

/// The double that a text is, and of a moderate size.
double double_of(const std::string& text) {
  constexpr double kMost = 1e100;
  const cln::cl_RA exact = traced_number(text);
  if (cln::zerop(exact)) return 0;
  const double value = cln::double_approx(exact);
  if (!(std::abs(value) < kMost && std::abs(value) > 1 / kMost) || exact_number(value) != exact)
    throw HorseshoeRefuted{"a number of an h-set is no double of a moderate size"};
  return value;
}

std::vector<double> doubles_of(const std::vector<std::string>& texts, std::size_t size) {
  if (texts.size() != size)
    throw HorseshoeRefuted{"an h-set has not the numbers that the states need"};
  std::vector<double> values;
  for (const std::string& text : texts) values.push_back(double_of(text));
  return values;
}

Model plain_model_of(const HorseshoeCertificate& certificate) {
  RunCertificate run;
  run.of_case = certificate.of_case;
  run.equations = certificate.equations;
  run.limits = certificate.limits;
  return model_of_certificate(run);
}

/// One certificate, from its equations to its theorem.
class HorseshoeCheck {
 public:
  HorseshoeCheck(const HorseshoeCertificate& certificate, const std::function<bool()>& give_up)
      : certificate_(certificate),
        give_up_(give_up),
        model_(plain_model_of(certificate)),
        system_(system_of()),
        map_(system_),
        precision_(kHorseshoeBits),
        coverings_(system_, map_, settings()) {}

  void operator()(CheckedHorseshoe& result) {
    result.level_names = system_.level_names;
    result.levels = system_.levels;
    const Arrows arrows = read_arrows();
    place_sets();
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      std::vector<const HSet*> targets;
      for (const auto& [from, to] : arrows)
        if (from == i) targets.push_back(&sets_[to]);
      const horseshoe::CoveringOutcome outcome = coverings_.check(sets_[i], targets);
      result.parts += outcome.parts;
      if (!outcome.proved) throw HorseshoeRefuted{outcome.reason};
    }
    if (!horseshoe::strongly_connected(sets_.size(), arrows))
      throw HorseshoeRefuted{"not every h-set leads to every other"};
    const cln::cl_RA radius = horseshoe::spectral_radius_above(sets_.size(), arrows);
    if (!(radius > 1)) throw HorseshoeRefuted{"the graph of the coverings has one cycle only"};
    result.entropy = horseshoe::logarithm_below(radius);
  }

 private:
  horseshoe::SectionSystem system_of() const {
    if (has_lost_parts(model_, certificate_.plane))
      throw HorseshoeRefuted{"a part cancels in it that need not have a value"};
    SectionRequest request;
    request.plane =
        FunctionText{model_.parse({certificate_.plane, {"plane", 1, 1}, certificate_.plane}),
                     certificate_.plane};
    request.upwards = true;
    horseshoe::SectionSystem system =
        horseshoe::section_system(model_, model_.scenes.front(), request);
    if (system.levels.size() != certificate_.levels.size() ||
        system.levels.size() != model_.integrals.size())
      throw HorseshoeRefuted{"there is not one level for each integral that is proved"};
    for (std::size_t a = 0; a < system.levels.size(); ++a) {
      system.levels[a] = {traced_number(certificate_.levels[a][0]),
                          traced_number(certificate_.levels[a][1])};
      if (system.levels[a].low > system.levels[a].high)
        throw HorseshoeRefuted{"a level has its ends in the wrong order"};
    }
    return system;
  }

  horseshoe::CoveringSettings settings() const {
    horseshoe::CoveringSettings settings;
    settings.give_up = give_up_;
    return settings;
  }

  Arrows read_arrows() const {
    Arrows arrows;
    const auto count = static_cast<int>(certificate_.sets.size());
    for (const auto& [from, to] : certificate_.coverings) {
      if (from < 0 || from >= count || to < 0 || to >= count)
        throw HorseshoeRefuted{"a covering is of an h-set that is not there"};
      arrows.emplace_back(static_cast<std::size_t>(from), static_cast<std::size_t>(to));
    }
    return arrows;
  }

  void place_sets() {
    const std::size_t n = system_.states();
    for (const CertifiedSet& set : certificate_.sets) {
      validated::Matrix<double> frame(n, n);
      frame.entries = doubles_of(set.frame, n * n);
      const std::vector<double> sheet = doubles_of(set.sheet, n - 2);
      if (std::ranges::any_of(sheet, [](double half) { return !(half > 0); }))
        throw HorseshoeRefuted{"the sheet of an h-set has no width"};
      // The name is of a stranger, and stands in reasons.
      const std::string name = printable(set.name, 40);
      auto proved = coverings_.chart().proved(name, doubles_of(set.centre, n), frame, sheet);
      if (!proved)
        throw HorseshoeRefuted{fmt::format("{} is not certain to lie on the surface", name)};
      sets_.push_back(std::move(*proved));
    }
    for (std::size_t i = 0; i < sets_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!coverings_.chart().disjoint(sets_[i], sets_[j]))
          throw HorseshoeRefuted{fmt::format("{} and {} are not certain to be disjoint",
                                             sets_[j].name, sets_[i].name)};
  }

  const HorseshoeCertificate& certificate_;
  const std::function<bool()>& give_up_;
  const Model model_;
  const horseshoe::SectionSystem system_;
  const horseshoe::NumericReturn map_;
  const validated::BallPrecision precision_;
  horseshoe::Coverings<ArbBall> coverings_;
  std::vector<HSet> sets_;
};

}  // namespace

HorseshoeCertificate certificate_of(const Horseshoe& proof, const std::string& of_case,
                                    const std::string& equations, const std::string& plane,
                                    const Limits& limits) {
  HorseshoeCertificate certificate;
  certificate.of_case = of_case;
  certificate.equations = equations;
  certificate.limits = limits;
  certificate.plane = plane;
  for (const RationalInterval& level : proof.system.levels)
    certificate.levels.push_back({end_text(level.low), end_text(level.high)});
  for (const HSet& set : proof.sets)
    certificate.sets.push_back(
        {set.name, texts_of(set.centre), texts_of(set.frame.entries), texts_of(set.sheet)});
  for (const auto& [from, to] : proof.coverings)
    certificate.coverings.emplace_back(static_cast<int>(from), static_cast<int>(to));
  return certificate;
}

CheckedHorseshoe check_horseshoe(const HorseshoeCertificate& certificate,
                                 const std::function<bool()>& give_up) {
  CheckedHorseshoe result;
  try {
    HorseshoeCheck(certificate, give_up)(result);
  } catch (const HorseshoeRefuted& refuted) {
    result.reason = refuted.reason;
  } catch (const RequestError& refused) {
    result.reason = refused.what();
  } catch (const std::domain_error& problem) {
    result.reason =
        fmt::format("the functions are not certain to have a value: {}", problem.what());
  }
  result.stopped = !result.holds() && give_up && give_up();
  return result;
}

}  // namespace casimir

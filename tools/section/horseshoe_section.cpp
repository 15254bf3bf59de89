// casimir section --horseshoe: chaos as a theorem.
#include "tools/section/horseshoe_section.hpp"

#include <fmt/format.h>

#include <iostream>

#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/horseshoe/horseshoe.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/runs/certified_horseshoe.hpp"
#include "tools/text/runs/horseshoe_report.hpp"

namespace casimir::tools {
namespace {

/// Writes it, if it holds. \return  kDone, or another exit status where it is not known to.
int write_certificate(const std::string& path, const HorseshoeCertificate& certificate,
                      const Common& common, const std::function<bool()>& late) {
  const CheckedHorseshoe checked = [&] {
    Progress progress(!common.quiet);
    progress.begin(certificate.of_case + ": certificate");
    return check_horseshoe(certificate, late);
  }();
  if (!checked.holds()) {
    std::cerr << fmt::format("casimir: error: no certificate is written: {}\n", checked.reason);
    return checked.stopped ? kEnvironment : kNotContinued;
  }
  OutputFile file(path);
  file.stream() << certificate_text(certificate);
  file.commit();
  if (!common.quiet && !common.json) fmt::print("  wrote {}\n", printable(path, 200));
  return kDone;
}

}  // namespace

int prove_horseshoe(const Common& common, const Model& model, const SectionRequest& request,
                    std::size_t longest, const std::string& certificate) {
  /// Where nobody says how long: an integrable system would be searched for ever.
  constexpr double kSeconds = 120;
  HorseshoeOptions options;
  options.request = request;
  if (longest > 0) options.longest_cycle = longest;
  options.give_up = time_limit(common.time_limit > 0 ? common.time_limit : kSeconds);
  const Stopwatch watch;
  const Horseshoe answer = [&] {
    Progress progress(!common.quiet);
    progress.begin(model.name + ": horseshoe");
    options.progress = [&](const std::string& stage, double share) {
      progress.name(model.name + ": " + stage);
      progress.show(share);
    };
    return find_horseshoe(model, model.scene(common.scene), options);
  }();
  const HorseshoeReport report{model.name, model.scene(common.scene).name, answer, watch.seconds()};
  if (common.json)
    print_json(to_json(report));
  else if (!common.quiet)
    print_text(report);
  if (!answer.proved) return kUndecided;
  if (certificate.empty()) return kDone;
  std::cout.flush();
  const Scene& scene = model.scene(common.scene);
  return write_certificate(certificate, certified_horseshoe(answer, model, scene, request), common,
                           options.give_up);
}

}  // namespace casimir::tools

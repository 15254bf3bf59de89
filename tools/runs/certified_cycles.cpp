#include "tools/runs/certified_cycles.hpp"

#include <cln/float.h>
#include <cln/real.h>

#include "runtime/program/exact_number.hpp"
#include "tools/show/notation.hpp"
#include "tools/text/files/plain_case.hpp"

namespace casimir::tools {
namespace {

/// The double next to the middle of an interval, exactly.
GiNaC::ex middle_double(const RationalInterval& interval) {
  const double middle = cln::double_approx((interval.low + interval.high) / 2);
  if (middle == 0) return 0;
  return GiNaC::numeric(cln::cl_N(exact_number(middle)));
}

}  // namespace

std::vector<CycleCertificate> certified_cycles(const Model& model, const Scene& scene,
                                               const SectionProblem& problem,
                                               const std::vector<ProvedCycle>& proofs) {
  std::vector<std::string> states;
  for (const GiNaC::symbol& x : model.variables) states.push_back(x.get_name());
  const std::string plane = Notation(model).case_text(problem.plane_function);
  std::vector<CycleCertificate> certificates;
  for (const ProvedCycle& proof : proofs) {
    if (!proof.proved) continue;
    Scene middle = scene;
    middle.name = "cycle";
    for (std::size_t i = 0; i < states.size(); ++i)
      middle.initial[i] = middle_double(proof.state[i]);
    middle.duration = middle_double(proof.period);
    auto certificate =
        certify_cycle(model.name, plain_case(model, middle, {}, states, problem.level_names), plane,
                      problem.levels, model.limits);
    if (certificate) certificates.push_back(std::move(*certificate));
  }
  return certificates;
}

}  // namespace casimir::tools

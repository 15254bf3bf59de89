#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"
#include "tools/analysis/proof/prove_in_process.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"

namespace casimir::python {

/// Thrown to leave a computation after Ctrl-C.
struct Interrupted {};

/// Watches a search: the time that it may take in seconds, and Ctrl-C.
/// \param seconds  0: no limit
/// \param memory   in bytes; 0: the usual limit
search::Watch watched(Interrupt& interrupt, double seconds, double memory);

/// A proof with all that is known of it.
pybind11::dict to_python(const Proof& proof);

/// What Python typed, as candidates for proofs.
Candidates candidates_of(const Names& integrals, const Names& casimirs, const Names& relations,
                         const Names& identities, const Names& on);

/// Does exact work without Python's lock, where no other thread does any; Ctrl-C ends it where it
/// looks for that.
/// \param convert  makes what Python sees of the outcome, with Python's lock.
template <class Work, class Convert>
pybind11::object exactly(Interrupt& interrupt, const Work& work, const Convert& convert) {
  pybind11::object result;
  try {
    const ExactAlgebra guard;
    const auto outcome = work();
    const pybind11::gil_scoped_acquire python;
    result = convert(outcome);
  } catch (const Interrupted&) {
  }
  interrupt.raise();
  return result;
}

/// Proves the claims of a case, of a flow or a map, or the candidates.
/// \param system   the model of a flow, or of a map
/// \param proving  `prove` or `prove_map`
/// \param base     the model that says which claims count
/// \param seconds  0: no limit
/// \param also     adds facts to these, from the proofs and the verdict
template <class System, class Proving>
pybind11::object verified(
    const System& system, const Model& base, const Candidates& candidates, double seconds,
    const Proving& proving,
    const std::function<void(pybind11::dict&, const std::vector<Proof>&, Verdict)>& also = {}) {
  using namespace pybind11::literals;
  Interrupt interrupt;
  const auto prove_all = [&] {
    if (seconds > 0) return prove_within(seconds, system, candidates, [](const Proof&) {});
    return proving(system, candidates, [&](const Proof&) { return !interrupt(); });
  };
  return exactly(interrupt, prove_all, [&](const std::vector<Proof>& outcome) {
    pybind11::list proofs;
    for (const Proof& proof : outcome) proofs.append(to_python(proof));
    const Verdict verdict = overall(base, outcome);
    pybind11::dict facts("verdict"_a = to_string(verdict), "proofs"_a = proofs);
    if (also) also(facts, outcome, verdict);
    return facts;
  });
}

}  // namespace casimir::python

#pragma once

#include <pybind11/pybind11.h>

namespace casimir::python {

/// The exceptions of the libraries as those of the Python package, which it has made by then.
void bind_errors(pybind11::module_& module);
/// Cases: reading, proofs, searches, code.
void bind_case(pybind11::module_& module);
/// Maps: reading, proofs, searches, degrees, orbits.
void bind_maps(pybind11::module_& module);
/// Invariant tensors, Poisson brackets, rational integrals, isomorphisms.
void bind_structure(pybind11::module_& module);
/// Runs of one initial state and of many.
void bind_motion(pybind11::module_& module);
/// What a motion conserves, its frequencies, methods compared.
void bind_measured(pybind11::module_& module);
/// The same study at every point of a grid.
void bind_sweep(pybind11::module_& module);
/// Runs with any number of digits, and enclosures.
void bind_exact_runs(pybind11::module_& module);
/// What a file of certificates proves.
void bind_certificates(pybind11::module_& module);
/// Chaos as a theorem.
void bind_horseshoe(pybind11::module_& module);
/// Cycles that a symmetry makes of a part of themselves.
void bind_symmetric_cycle(pybind11::module_& module);
/// Poincare sections and equilibria.
void bind_section(pybind11::module_& module);

}  // namespace casimir::python

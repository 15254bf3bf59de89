// The module casimir._core: the libraries as they are. What is comfortable is in Python, beside it.
#include "tools/python/core/bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The C++ libraries behind the package casimir";
  module.attr("__version__") = CASIMIR_VERSION;
  casimir::python::bind_errors(module);
  casimir::python::bind_case(module);
  casimir::python::bind_maps(module);
  casimir::python::bind_structure(module);
  casimir::python::bind_motion(module);
  casimir::python::bind_measured(module);
  casimir::python::bind_sweep(module);
  casimir::python::bind_exact_runs(module);
  casimir::python::bind_certificates(module);
  casimir::python::bind_horseshoe(module);
  casimir::python::bind_section(module);
  casimir::python::bind_symmetric_cycle(module);
}

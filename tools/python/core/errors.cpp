#include <pybind11/pybind11.h>

#include "codegen/compile.hpp"
#include "symbolic/error.hpp"
#include "symbolic/search/watch.hpp"
#include "tools/analysis/error.hpp"
#include "tools/python/core/bindings.hpp"

namespace casimir::python {
namespace py = pybind11;

namespace {

/// Raises the exception of the package that has this name.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const py::object type = py::module_::import("casimir._errors").attr(name);
  const py::object error = type(arguments...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const CaseError& problem) {
    raise("CaseError", problem.what(), problem.text(), problem.where().file, problem.where().line,
          problem.where().column, problem.hint());
  } catch (const search::NoAnswer& problem) {
    raise("NoAnswer", problem.what());
  } catch (const search::TooMuchMemory& problem) {
    raise("NoAnswer", problem.what());
  } catch (const SingularPoint& problem) {
    raise("SingularPoint", problem.what());
  } catch (const ModelError& problem) {
    raise("ModelError", problem.what());
  } catch (const RequestError& problem) {
    raise("RequestError", problem.what());
  } catch (const EnvironmentError& problem) {
    raise("EnvironmentProblem", problem.what());
  }
}

}  // namespace

void bind_errors(py::module_&) { py::register_exception_translator(translate); }

}  // namespace casimir::python

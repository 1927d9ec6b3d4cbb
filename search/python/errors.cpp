// Translates this program's exceptions into Python's `misalign.Error`: the same exit codes and
// sentences, in which parameters have their Python names.
#include <exception>
#include <utility>

#include "search/python/bindings.hpp"
#include "search/verbs/border.hpp"

namespace misalign::search::python {

namespace py = pybind11;

void bind_errors(py::module_& module) {
  // The package defines the type and passes it before anything can fail.
  module.def(
      "_use_error",
      [](py::object type) {
        static PyObject* error_type = nullptr;
        const bool is_first = error_type == nullptr;
        error_type = type.release().ptr();  // never released
        if (!is_first) return;
        py::register_exception_translator([](std::exception_ptr thrown) {
          try {
            std::rethrow_exception(std::move(thrown));
          } catch (const py::builtin_exception&) {
            throw;  // pybind's own: TypeError and the like
          } catch (const py::error_already_set&) {
            throw;
          } catch (const std::exception& error) {
            const schema::UserError failure = failure_of(error);
            const auto error_class = py::reinterpret_borrow<py::object>(error_type);
            const py::object made = error_class(failure.what(), exit_code_of(failure.cause()));
            PyErr_SetObject(error_type, made.ptr());
          }
        });
      },
      py::arg("type"));
}

}  // namespace misalign::search::python

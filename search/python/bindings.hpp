// Declares the parts of the compiled module `_misalign`, which converts for the package `misalign`;
// the package has the documentation.
#pragma once

#include <pybind11/pybind11.h>

namespace misalign::search::python {

void bind_errors(pybind11::module_& module);
void bind_sheets(pybind11::module_& module);
void bind_foldings(pybind11::module_& module);
void bind_judging(pybind11::module_& module);
void bind_catalogues(pybind11::module_& module);
void bind_studies(pybind11::module_& module);
void bind_gradients(pybind11::module_& module);

}  // namespace misalign::search::python

#include "search/python/bindings.hpp"

PYBIND11_MODULE(_misalign, module) {
  using namespace misalign::search::python;
  module.attr("__version__") = MISALIGN_VERSION;
  bind_errors(module);
  bind_sheets(module);
  bind_foldings(module);
  bind_judging(module);
  bind_catalogues(module);
  bind_studies(module);
  bind_gradients(module);
}

// Miscut copies of a sheet as Python asks for them.
#pragma once

#include <cstdint>

#include "search/python/signals.hpp"
#include "search/sheets/tolerance.hpp"

namespace misalign::search::python {

/// So many, on the widest registers there are; Ctrl-C ends them.
inline ToleranceOptions copies_of(std::uint64_t trials, int jobs) {
  ToleranceOptions options;
  options.trials = trials;
  options.jobs = jobs;
  options.set = solver::available_instruction_sets().back();
  options.progress = [](const CopiesDone&) {
    const pybind11::gil_scoped_acquire lock;
    check_signals();
  };
  return options;
}

}  // namespace misalign::search::python

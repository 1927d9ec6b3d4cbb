// Handles Ctrl-C while numbers are computed.
#pragma once

#include <pybind11/pybind11.h>

namespace misalign::search::python {

/// Runs Python's signal handlers, and throws their exception (KeyboardInterrupt). Requires the GIL;
/// does nothing outside the main thread.
inline void check_signals() {
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

/// Does the same from work that runs without the GIL.
inline void watch_signals() {
  const pybind11::gil_scoped_acquire lock;
  check_signals();
}

/// Does the work without the GIL, so that other threads can run.
template <class Work>
auto unlocked(const Work& work) {
  const pybind11::gil_scoped_release release;
  return work();
}

}  // namespace misalign::search::python

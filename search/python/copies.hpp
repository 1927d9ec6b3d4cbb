// Prepares miscut copies of a sheet for Python.
#pragma once

#include <cstdint>

#include "schema/pattern/parameters.hpp"
#include "search/python/signals.hpp"
#include "search/sheets/tolerance.hpp"

namespace misalign::search::python {

/// Checks a number of copies, or of threads, by schema::check_parameter().
template <class Count>
Count checked_count(const char* study, const char* name, std::int64_t count) {
  schema::check_parameter(study, name, static_cast<double>(count));
  return static_cast<Count>(count);
}

/// Returns the options of `trials` copies in `jobs` threads, with the widest instruction set;
/// Ctrl-C ends them.
inline ToleranceOptions copies_of(std::int64_t trials, std::int64_t jobs) {
  ToleranceOptions options;
  options.trials = checked_count<std::uint64_t>("tolerance", "trials", trials);
  options.jobs = checked_count<int>("", "jobs", jobs);
  options.set = solver::available_instruction_sets().back();
  options.progress = [](const CopiesDone&) { watch_signals(); };
  return options;
}

}  // namespace misalign::search::python

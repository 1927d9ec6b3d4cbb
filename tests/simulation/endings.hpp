// Compares the ends of lives with the manual (search/manual/reference/exit-codes.md).
#pragma once

#include <string>

#include "tests/simulation/plan.hpp"

namespace misalign::simulation {

/// The acts of others during a life.
struct Circumstances {
  bool was_disturbed = false;   ///< somebody came
  bool was_locked = false;      ///< another program held the lock of SQLite's writer
  bool was_taken_away = false;  ///< its file was
  bool lost_index = false;      ///< the index of its log was cut short
};

/// Returns whether a search says that its campaign is complete.
bool says_complete(const LifeEnd& end, const std::string& file);

/// Returns whether a search ended early and well: as it was asked, with the exit code for that.
bool ended_early(const LifeEnd& end, const Planned& planned, const std::string& file);

/// Returns what no page explains of the end of a search, empty if nothing: exit code 0 for a
/// complete campaign alone, --stopped-exit for one that was asked to stop, any other with a
/// sentence and a cause.
std::string unexplained(const LifeEnd& end, const Planned& planned,
                        const Circumstances& circumstances, const std::string& file);

}  // namespace misalign::simulation

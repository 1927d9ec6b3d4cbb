// Computes remembered numbers of studies again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/catalogue/finding.hpp"
#include "schema/memory/study_memory.hpp"

namespace misalign::search {

/// Counts of the remembered numbers of a catalogue's design.
struct MemoryReport {
  std::uint64_t checked = 0, current = 0;
  std::uint64_t stale = 0;  ///< numbers of other designs or versions, which nothing uses
};

/// Computes `sample` of the numbers beside the catalogue at `path` again, spread evenly (none: all)
/// and on all cores. Findings are a file that is not used, and numbers that differ by more than
/// 1e-6 of themselves: bent panels and contacts are found by iterations to a tenth of that. Numbers
/// that this build cannot compute are not checked.
MemoryReport check_memory(SQLite::Database& database, const schema::Campaign& campaign,
                          const std::string& path, std::optional<std::uint64_t> sample,
                          std::vector<schema::Finding>& findings);

}  // namespace misalign::search

// Completes the record of a path's function by states that were solved exactly.
#pragma once

#include <optional>
#include <vector>

#include "solver/records/found_slopes.hpp"
#include "solver/records/path_record.hpp"
#include "solver/records/requested_states.hpp"

namespace misalign::solver {

/// The record of a path by its function.
struct UnfinishedRecord {
  bool is_sure = false;      ///< false: it is left to close steps
  bool is_accepted = false;  ///< it deploys from the threshold, so that the record is completed
  PathRecord record;
  RequestedStates requested;
  FoundSlopes slopes;
  int least_step_sample = 0;
};

/// Puts the results at the requested states into the record of an accepted path, which becomes
/// unsure if they are not those of the function.
void complete(UnfinishedRecord& made, const std::vector<SolvedState>& solved,
              std::optional<double> miscut_margin_mm);

/// Sheets of a block to be completed, and sheets for close steps.
void find_incomplete(const std::vector<UnfinishedRecord>& records, std::vector<int>& sheets);
void find_unsure(const std::vector<UnfinishedRecord>& records, std::vector<int>& sheets);

/// Moves the records of a block into `merged`, those of unsure sheets from their histories.
void merge(std::vector<UnfinishedRecord>& records, const std::vector<FoldingHistory>& histories,
           const Mechanism& mechanism, std::vector<PathRecord>& merged);

}  // namespace misalign::solver

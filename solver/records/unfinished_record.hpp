// Completes the record of a path: what its function says, with the states that were solved exactly.
#pragma once

#include <optional>
#include <vector>

#include "solver/records/found_slopes.hpp"
#include "solver/records/path_record.hpp"
#include "solver/records/requested_states.hpp"

namespace misalign::solver {

/// The record of a path as its function has it.
struct UnfinishedRecord {
  bool is_sure = false;      ///< otherwise it is for the close steps
  bool is_accepted = false;  ///< it deploys from the threshold: the record is to be complete
  PathRecord record;
  RequestedStates requested;
  FoundSlopes slopes;
  int least_step_sample = 0;
};

/// Puts what was found at each of its requested states into the record of an accepted path, which
/// is not sure any more where that is not what the function has there.
void complete(UnfinishedRecord& made, const std::vector<SolvedState>& solved,
              std::optional<double> miscut_margin_mm);

/// Those of a block that are to be completed, and those that are for the close steps.
void find_incomplete(const std::vector<UnfinishedRecord>& records, std::vector<int>& sheets);
void find_unsure(const std::vector<UnfinishedRecord>& records, std::vector<int>& sheets);

/// Moves the records of a block into `merged`, those of unsure ones from their histories.
void merge(std::vector<UnfinishedRecord>& records, const std::vector<FoldingHistory>& histories,
           const Mechanism& mechanism, std::vector<PathRecord>& merged);

}  // namespace misalign::solver

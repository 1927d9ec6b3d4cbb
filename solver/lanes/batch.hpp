// Judges many sheets of one model at once, in the machine's widest registers. Rejection tests turn
// most of them away; the others' full paths are followed.
#pragma once

#include <memory>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/model/rejection.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::solver {

enum class InstructionSet {
  baseline,  ///< two lanes, on every machine of this architecture
  avx2,      ///< four lanes
  avx512     ///< eight
};

const char* instruction_set_name(InstructionSet set);
/// Sets that both this build and this machine have, narrowest first.
std::vector<InstructionSet> available_instruction_sets();

class Batch {
 public:
  virtual ~Batch();

  /// One result per sheet: rejected for certain, or not decided.
  virtual const std::vector<Rejection>& reject(const ShiftBlock& block) = 0;
  /// Verdicts of all sheets on their full paths, where PivotedFallback has the last word; what
  /// that loses too is `undecided`.
  virtual const std::vector<Verdict>& judge(const ShiftBlock& block) = 0;
  /// Records of the sheets that no test rejects, each with its verdict: all that metrics need, or
  /// the verdict alone where the sheet does not deploy from the threshold.
  virtual const std::vector<PathRecord>& measure(const ShiftBlock& block) = 0;
  /// Whole histories, past faults, every sample solved.
  virtual std::vector<FoldingHistory>& record(const ShiftBlock& block) = 0;
  /// The same without residuals, singular values and isometry errors, which are 0.
  virtual std::vector<FoldingHistory>& record_lengths(const ShiftBlock& block) = 0;
  /// Pilot angle of the base folding at the level of the tables that reject() reads first; 0: there
  /// are no tables, or none yet.
  virtual double tables_deg() const = 0;
  /// Effort so far; that of paths counts judging, measuring and recording.
  virtual Effort rejection_effort() const = 0;
  virtual Effort path_effort() const = 0;
};

/// `model` must outlive the batch. The verdicts are the same for every instruction set.
std::unique_ptr<Batch> make_batch(InstructionSet set, const Model& model);

}  // namespace misalign::solver

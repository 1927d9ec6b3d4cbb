// Many sheets of one model at once, in the widest registers there are: the rejection tests that
// turn most of them away, and the full path of the others.
#pragma once

#include <memory>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/model/rejection.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::solver {

enum class InstructionSet {
  baseline,  ///< what every machine of this architecture has: two lanes
  avx2,      ///< four lanes
  avx512     ///< eight
};

const char* instruction_set_name(InstructionSet set);
/// Of this build and this machine, narrowest first.
std::vector<InstructionSet> available_instruction_sets();

class Batch {
 public:
  virtual ~Batch();

  /// One result per sheet: rejected for certain, or not decided.
  virtual const std::vector<Rejection>& reject(const ShiftBlock& block) = 0;
  /// Verdicts of all sheets on their full paths, where dense matrices have the last word (see
  /// dense_fallback); what those lose too is `undecided`.
  virtual const std::vector<Verdict>& judge(const ShiftBlock& block) = 0;
  /// What metrics need of each path, with its verdict: of the sheets that no test rejects. Where it
  /// does not deploy from the threshold only the verdict.
  virtual const std::vector<PathRecord>& measure(const ShiftBlock& block) = 0;
  /// Whole histories, past faults, every sample solved.
  virtual std::vector<FoldingHistory>& record(const ShiftBlock& block) = 0;
  /// The same without residuals, singular values and isometry errors, which are 0.
  virtual std::vector<FoldingHistory>& record_lengths(const ShiftBlock& block) = 0;
  /// The pilot angle of the base folding at the level of the tables that reject() asks first; 0:
  /// there are none, or none yet.
  virtual double tables_deg() const = 0;
  /// Of everything so far; of paths, those that were judged, measured and recorded.
  virtual Effort rejection_effort() const = 0;
  virtual Effort path_effort() const = 0;
};

/// `model` must outlive the batch. The verdicts are the same for every instruction set.
std::unique_ptr<Batch> make_batch(InstructionSet set, const Model& model);

}  // namespace misalign::solver

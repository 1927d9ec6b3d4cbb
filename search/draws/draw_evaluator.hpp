// The science of draws: draw -> displaced pattern -> rejected for certain -> path -> diagonals ->
// verdict -> metrics -> unit.
#pragma once

#include <span>

#include "schema/campaign/campaign.hpp"
#include "schema/records/fault_sample.hpp"
#include "schema/records/unit_record.hpp"
#include "search/draws/block_size.hpp"
#include "search/draws/parts.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Draws and their shifts, which travel with them.
struct Draws {
  std::vector<std::uint64_t> numbers;
  solver::ShiftBlock shifts;

  std::size_t size() const { return numbers.size(); }
  void clear();
  /// Another one, with these shifts of all shifted vertices in turn.
  void add(std::uint64_t number, std::span<const double> shifts_mm);
  /// The k-th of others.
  void add(const Draws& others, std::size_t k);
  std::span<const double> shifts_mm(std::size_t k) const;
};

/// Metrics of sheets that the campaign accepts, with their shifts, in their order; draws number
/// themselves from 0 on.
std::vector<schema::Candidate> measured(const solver::Model& model, solver::Batch& batch,
                                        const solver::ShiftBlock& shifts);

/// One campaign made ready: what all of its draws share, and the workspace of this rank.
class DrawEvaluator {
 public:
  /// Uses the widest registers of this machine, or those of `set`. Accepted draws are certified,
  /// and go on to where they end, if the campaign asks for it and the part is given.
  explicit DrawEvaluator(schema::Campaign campaign,
                         solver::InstructionSet set = solver::available_instruction_sets().back(),
                         const Parts& parts = {});
  DrawEvaluator(const DrawEvaluator&) = delete;
  DrawEvaluator& operator=(const DrawEvaluator&) = delete;

  /// Those of its accepted draws to where they end; none where they are kept as they are.
  std::optional<Ascents> ascents() const;
  /// Adds its certificate, if they are made.
  void certify(schema::Candidate& candidate) const;

  /// How many draws a block may have at most.
  std::uint64_t largest_block() const { return search::largest_block(model_); }
  /// Evaluates a range of draws no larger than that. What the rejection tests reject for certain is
  /// added to `unit` at once; the other draws, and those of the fault sample by its rule, wait for
  /// their full paths until `paths_are_due` says yes to their number: the more there are, the
  /// fuller the lanes. An empty range only follows what waits.
  using PathsAreDue = std::function<bool(std::size_t waiting)>;
  void evaluate(const schema::DrawRange& range, schema::UnitRecord& unit,
                const schema::FaultSampleRule& sampled, const PathsAreDue& paths_are_due);
  std::size_t waiting() const { return waiting_.size(); }
  /// What one candidate takes in a message, in bytes; rather more.
  std::size_t bytes_of_candidate() const;

  /// Verdicts of a range of draws no larger than a block, each on its full path.
  const std::vector<solver::Verdict>& judge(const schema::DrawRange& block);
  /// Shifts of one draw, one column per vertex of the sheet.
  Eigen::Matrix2Xd shifts_mm(std::uint64_t draw) const;

  const schema::Campaign& campaign() const { return campaign_; }
  const solver::Model& model() const { return model_; }
  const solver::Mechanism& mechanism() const { return model_.mechanism(); }
  const solver::Batch& batch() const { return *batch_; }

 private:
  void make(const schema::DrawRange& range);
  void record(schema::UnitRecord& unit);

  const schema::Campaign campaign_;
  const solver::Model model_;
  std::unique_ptr<solver::Batch> batch_;
  const CertifyDraw certify_;  // empty: none are certified
  const BeginAscent ascend_;   // null: draws are kept as they are
  Draws drawn_, waiting_, sampled_, to_measure_;
};

/// What the results of a unit may take before it ends early: they are one message of MPI, whose
/// length is an int, and in memory twice on rank 0. A block adds as much again at most.
inline constexpr std::size_t kMostUnit_bytes = 256 << 20;

/// A range of draws being worked off, one block at a time. Of an optimising search a block's draws
/// count once all that were accepted are where they end.
class UnitWork {
 public:
  UnitWork(DrawEvaluator& evaluator, const schema::DrawRange& range,
           const schema::FaultSampleRule& sampled = schema::FaultSampleRule(),
           std::size_t most_bytes = kMostUnit_bytes);

  bool finished() const { return next_ == range_.hi && !(ascents_ && ascents_->under_way()); }
  /// Whether its results, and those of draws that wait, take all that they may: the rest of the
  /// range is for another unit.
  bool is_full() const;
  /// As many draws as BlockSize says, or a part of what makes accepted ones better.
  void run_next_block();
  /// What has been done so far; draws that still wait for their full paths are not in it.
  const schema::UnitRecord& so_far() const { return record_; }
  /// The same as a whole: from the range's start up to the next draw, or to that of a block which
  /// is on its way to its ends, and will be done again.
  schema::UnitRecord take();

 private:
  void evaluate(const schema::DrawRange& block, schema::UnitRecord& into,
                const DrawEvaluator::PathsAreDue& paths_are_due);
  void begin_block();
  void advance_ascents();

  DrawEvaluator& evaluator_;
  schema::DrawRange range_;
  schema::FaultSampleRule sampled_;
  std::size_t most_bytes_;
  std::uint64_t next_;
  BlockSize block_size_;
  double seconds_per_path_;
  schema::UnitRecord record_;
  std::optional<Ascents> ascents_;  // of an optimising search
  double block_s_ = 0;              // of the block on its way there
};

/// A whole range at once, in one unit.
schema::UnitRecord work_off(DrawEvaluator& evaluator, const schema::DrawRange& range);
/// One draw that was undecided, for UnitWriter::settle(): with its fault sample, whichever rule its
/// unit was made by.
schema::UnitRecord judge_again(DrawEvaluator& evaluator, std::uint64_t draw);

}  // namespace misalign::search

// Evaluates draws: draw -> displaced pattern -> rejection tests -> path -> diagonals -> verdict ->
// metrics -> unit.
#pragma once

#include <span>

#include "schema/campaign/campaign.hpp"
#include "schema/records/fault_sample.hpp"
#include "schema/records/unit_record.hpp"
#include "search/draws/block_size.hpp"
#include "search/draws/parts.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Draws with their shifts.
struct Draws {
  std::vector<std::uint64_t> numbers;
  solver::ShiftBlock shifts;

  std::size_t size() const { return numbers.size(); }
  void clear();
  /// Adds a draw, with the shifts of all shifted vertices in turn.
  void add(std::uint64_t number, std::span<const double> shifts_mm);
  /// Adds the k-th of the others.
  void add(const Draws& others, std::size_t k);
  std::span<const double> shifts_mm(std::size_t k) const;
};

/// Measures accepted sheets and returns them in their order, numbered from 0.
std::vector<schema::Candidate> measured(const solver::Model& model, solver::Batch& batch,
                                        const solver::ShiftBlock& shifts);

/// The model of a campaign, and the workspace of this rank.
class DrawEvaluator {
 public:
  /// Uses the widest instruction set of this machine, or `set`. Accepted draws are certified and
  /// optimised if the campaign says so and the part is given.
  explicit DrawEvaluator(schema::Campaign campaign,
                         solver::InstructionSet set = solver::available_instruction_sets().back(),
                         const Parts& parts = {});
  DrawEvaluator(const DrawEvaluator&) = delete;
  DrawEvaluator& operator=(const DrawEvaluator&) = delete;

  /// Returns ascents from accepted draws; none if draws are kept unchanged.
  std::optional<Ascents> ascents() const;
  /// Adds the certificate, if the campaign makes certificates.
  void certify(schema::Candidate& candidate) const;

  /// Returns the largest size of a block.
  std::uint64_t largest_block() const { return search::largest_block(model_); }
  /// Evaluates a range of draws no larger than that. Draws that a rejection test rejects are added
  /// to `unit` at once. The others, and those of the fault sample, wait for their full paths until
  /// `paths_are_due` is true of their number: many fill the lanes. An empty range follows the
  /// waiting paths alone.
  using PathsAreDue = std::function<bool(std::size_t waiting)>;
  void evaluate(const schema::DrawRange& range, schema::UnitRecord& unit,
                const schema::FaultSampleRule& sampled, const PathsAreDue& paths_are_due);
  /// Adds all draws of the unit's range, no larger than a block, as candidates without metrics: the
  /// starts of descents, whose ends are judged.
  void add_starts(schema::UnitRecord& unit);
  std::size_t waiting() const { return waiting_.size(); }
  /// Returns an upper estimate of a candidate's size in a message, in bytes.
  std::size_t bytes_of_candidate() const;

  /// Judges a range of draws no larger than a block, each on its full path.
  const std::vector<solver::Verdict>& judge(const schema::DrawRange& block);
  /// Returns the shifts of a draw, one column per vertex of the sheet.
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

/// Size of a unit's results at which it ends early: they are one MPI message, whose length is an
/// int, and twice in rank 0's memory. A block at most doubles it.
inline constexpr std::size_t kMostUnit_bytes = 256 << 20;

/// Work on a range of draws, one block at a time. In an optimising search a block counts once all
/// its ascents have ended.
class UnitWork {
 public:
  UnitWork(DrawEvaluator& evaluator, const schema::DrawRange& range,
           const schema::FaultSampleRule& sampled = schema::FaultSampleRule(),
           std::size_t most_bytes = kMostUnit_bytes);

  bool finished() const { return next_ == range_.hi && !(ascents_ && ascents_->under_way()); }
  /// Returns whether its results, with those of waiting draws, are full: the rest of the range is
  /// for another unit.
  bool is_full() const;
  /// Evaluates a block of the size that BlockSize chooses, or continues ascents.
  void run_next_block();
  /// Returns the results so far, without draws that wait for their full paths.
  const schema::UnitRecord& so_far() const { return record_; }
  /// Returns the complete results from the range's start up to the next draw. A block whose ascents
  /// are under way is left out, and will be done again.
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
  std::optional<Ascents> ascents_;  // of an optimising search alone
  double block_s_ = 0;              // time of the block whose ascents are under way
};

/// Evaluates a whole range at once, in one unit.
schema::UnitRecord work_off(DrawEvaluator& evaluator, const schema::DrawRange& range);
/// Judges an undecided draw again for UnitWriter::settle(), with its fault sample, whatever the
/// rule of its unit.
schema::UnitRecord judge_again(DrawEvaluator& evaluator, std::uint64_t draw);

}  // namespace misalign::search

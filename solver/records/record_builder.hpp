// Builds the records of paths that are functions, one in each lane, and lists the states to be
// solved exactly.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "solver/continuation/path_follower.hpp"
#include "solver/judging/dense_fallback.hpp"
#include "solver/judging/function_judge.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/model/model.hpp"
#include "solver/records/found_slopes.hpp"
#include "solver/records/state_measure.hpp"

namespace misalign::solver {

/// A state of a path that is to be solved: near it, with the pilot at this angle.
struct WantedState {
  int sample = 0;  ///< 0: none
  double pilot_deg = 0;
  HalfAngle<double> pilot{1, 0};
  FoldState<double> near;
};

/// What was found there.
struct SolvedState {
  SolveQuality quality;
  std::vector<double> lengths, slopes;  ///< panel widths, per radian of pilot
};

/// Which states of a path are wanted: those of the model's margin_samples, and these, in this
/// order.
enum class Wanted {
  first,
  second,
  before_d,
  at_d,
  before_least_step,
  after_least_step,
  least_slope,
  reversal
};
inline constexpr int kWantedBesideMargin = 8;

/// One sheet of a block.
struct UnfinishedRecord {
  bool is_sure = false;      ///< otherwise it is for the close steps
  bool is_accepted = false;  ///< it deploys from the threshold: the record is complete
  PathRecord record;
  std::vector<WantedState> wanted;  ///< of margin_samples, and of Wanted
  FoundSlopes slopes;
  int least_step_sample = 0;
};

class RecordBuilder final : public QueueObserver {
 public:
  RecordBuilder(const Model& model, const QueueLanes& lanes);
  ~RecordBuilder() override;

  void begin(const SheetBlock& block);
  ObserverResult see(const PathFunction& function, int lane);
  void ended(PathResult path, int lane);
  /// What is to be solved of the path that was just seen, and where it goes on if it is unfinished.
  const std::vector<NearState>& near_states() const { return near_states_; }

  /// Paths whose nodes ended after the verdict, but before the path did: for close steps, from the
  /// last station before.
  class Ends {
   public:
    explicit Ends(RecordBuilder& records) : records_(records) {}
    bool see(const Station&, int) { return true; }
    void ended(const PathResult& path, int lane) { records_.finish(path, lane); }

   private:
    RecordBuilder& records_;
  };
  SheetQueue& queue_of_ends();

  /// Every sheet of the block is for the close steps.
  void leave_all();
  /// The sheets whose wanted states are to be solved; those that are for the close steps.
  const std::vector<int>& complete();
  const std::vector<int>& left();
  int wanted_count() const { return wanted_index(Wanted::reversal) + 1; }
  const WantedState& wanted(int sheet, int k) const;
  /// Where what is found at the k-th wanted state of a lane's sheet is to be written.
  SolvedState& solved(int lane, int k);
  /// Whether the reversal of the lane's sheet, as it was solved, is to be solved once more where
  /// wanted() has it now.
  bool wants_again(int sheet, int lane);
  /// Takes what was found at the wanted states of a sheet, in this lane, into its record.
  void take(int sheet, int lane, std::optional<double> miscut_margin_mm);
  /// All of the block, those that were left by their histories.
  const std::vector<PathRecord>& merge(const std::vector<FoldingHistory>& left);

 private:
  struct Lane {
    FunctionJudge judge;
    ExtremeFinder finder;
    UnfinishedRecord record{};
    const PathFunction* function = nullptr;  // once it was seen
    std::size_t next = 0;                    // station
    bool fault_seen = false;
    double least_step = 0;

    bool has_reversed() const { return finder.first_reversal().diagonal >= 0; }
  };

  void begin_sheet(PathStart& start, int lane) override;
  bool is_the_same(const PathRecord& record, const WantedState& wanted,
                   const SolvedState& solved) const;
  void go_on_later(const PathResult& path, int sheet, const PathFunction& function);
  void finish(const PathResult& path, int lane);
  static bool ends_are_least(const std::vector<double>& singular_values, int in_order);
  void look_up_to(double end_deg, const PathFunction& function, Lane& lane);
  void want_d(int sample, const PathFunction& function, Lane& lane);
  void note_least_step(const Station& station, Lane& lane);
  void want(int index, const Station& station, const PathFunction& function, Lane& lane);
  void want(int index, double pilot_deg, double x, Lane& lane);
  int wanted_index(Wanted wanted) const {
    return static_cast<int>(model_.margin_samples().size()) + static_cast<int>(wanted);
  }
  const Station& station_of(int sample) const { return *samples_[sample - 1]; }

  std::vector<const Station*> samples_;  // of the model's path
  std::vector<Lane> lanes_;
  std::vector<UnfinishedRecord> records_;
  std::vector<PathRecord> merged_;
  std::vector<std::vector<SolvedState>> solved_;  // of lanes
  std::vector<int> complete_, left_;
  std::vector<QueuedStart> ends_;
  std::deque<FoldState<double>> ends_near_;  // their states, which stay where they are
  std::vector<NearState> near_states_;
  PathFunction::Estimate here_;
  const FoldState<double> near_;  // of the size that a state has
};

}  // namespace misalign::solver

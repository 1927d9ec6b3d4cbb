// A Batch in registers of one kind: T holds doubles, Single floats. A rejection test compares
// sheets at the same angle, one per lane; on full paths each lane has its own angle.
#pragma once

#include "solver/judging/verdict_observers.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/lanes/expansion_test.hpp"
#include "solver/lanes/lane_test.hpp"
#include "solver/records/function_recorder.hpp"
#include "solver/records/recorder.hpp"

namespace misalign::solver {

template <class T, class Single>
class LaneBatch final : public Batch {
 public:
  explicit LaneBatch(const Model& model)
      : model_(model),
        rejection_(model),
        functions_(model, lanes_of<T>()),
        judging_(model, lanes_of<T>()),
        states_(model.mechanism()),
        long_follower_(model.mechanism(), model.elimination()),
        follower_(model.mechanism(), model.elimination()),
        single_test_(model),
        double_test_(model) {}

  const std::vector<Rejection>& reject(const ShiftBlock& block) override {
    rejection_.begin(block.sheets);
    states_.begin();
    if (!expansion_test_) expansion_test_.emplace(model_);
    expansion_test_->run(block, rejection_);
    open_undecided(block);
    if (!model_.tests().empty()) run_tests(block);
    return rejection_.results();
  }

  const std::vector<Verdict>& judge(const ShiftBlock& block) override {
    const SheetBlock sheets(model_, block);
    judging_.begin(sheets);
    if (model_.bumps() != BumpRule::by_cubic) {
      functions_.begin(sheets, judging_.verdicts());
      long_follower_.run(functions_.queue(), functions_);
      judging_.only_later(functions_);
      follower_.run(judging_.queue(), judging_);
      judging_.only_left(functions_);
    }
    follower_.run(judging_.queue(), judging_);
    judging_.fall_back();
    return judging_.verdicts();
  }

  const std::vector<PathRecord>& measure(const ShiftBlock& block) override {
    return recorders().of_functions.record(SheetBlock(model_, block));
  }

  std::vector<FoldingHistory>& record(const ShiftBlock& block) override {
    return recorders().of_samples.record(SheetBlock(model_, block));
  }

  std::vector<FoldingHistory>& record_lengths(const ShiftBlock& block) override {
    return recorders().of_samples.record_lengths(SheetBlock(model_, block));
  }

  double tables_deg() const override { return expansion_test_ ? expansion_test_->late_deg() : 0; }

  Effort rejection_effort() const override {
    Effort effort = single_test_.effort();
    effort.add(double_test_.effort());
    return effort;
  }
  Effort path_effort() const override {
    Effort effort = judging_.effort();
    effort.add(functions_.effort());
    if (recorders_) {
      effort.add(recorders_->of_functions.effort());
      effort.add(recorders_->of_samples.effort());
    }
    return effort;
  }

 private:
  static constexpr int kFar = Model::kFar, kMiddle = Model::kMiddle, kNear = Model::kNear;
  static constexpr int kShiftSteps[] = {1, 8, 32};  // by which large shifts grow
  static constexpr int kMostSteps = 100;  // steps ahead; from the middle place about ten suffice

  // Recorders are large; callers that want verdicts alone never make them.
  struct Recorders {
    explicit Recorders(LaneBatch& batch)
        : of_samples(batch.model_, batch.follower_),
          of_functions(batch.model_, batch.long_follower_, batch.follower_, of_samples) {}
    Recorder<T> of_samples;
    FunctionRecorder<T> of_functions;
  };
  Recorders& recorders() {
    if (!recorders_) recorders_.emplace(*this);
    return *recorders_;
  }

  // Single precision comes first: twice as many sheets at once. The sheets that a test leaves are
  // packed into full registers for the next. Those with a state at the far level are tested again
  // in double precision, and followed from there; the others from the middle level.
  void run_tests(const ShiftBlock& block) {
    // The expansion knows already in which direction diagonals set out; the energy always rises
    // near flat.
    const bool near_tells = !expansion_test_->is_there() && !model_.criterion().energy;
    run(single_test_, kFar, true, block, open_);
    if (near_tells) run(single_test_, kNear, false, block, open_);
    lost_ = open_;
    open_.clear();
    take_found(kFar, block);
    run(single_test_, kMiddle, true, block, lost_);
    take_found(kMiddle, block);
    // Large shifts start nearer to flat, and grow step by step.
    for (const int shift_steps : kShiftSteps) {
      double_test_.run(kNear, true, block, lost_, rejection_, states_, shift_steps);
      drop_decided(lost_);
      take_found(kNear, block);
    }
    for (int place = kNear; near_tells && place > kFar; --place) {
      run(double_test_, place, false, block, open_);
    }
    // Sheets without further states are left to the full path.
    const auto has_ended = [&](Undecided& sheet) {
      return sheet.kept_state < 0 || !states_.of(sheet).goes_on;
    };
    for (int step = 0; step < kMostSteps; ++step) {
      std::erase_if(open_, has_ended);
      if (open_.empty()) break;
      double_test_.run_ahead(block, open_, rejection_, states_);
      drop_decided(open_);
    }
    if (near_tells || model_.criterion().energy) return;
    // A level takes 20 us a sheet, a full path with its record 500.
    open_undecided(block);
    for (int place = kFar + 1; place < kMiddle; ++place) {
      run(double_test_, place, false, block, open_);
    }
    run(double_test_, kNear, false, block, open_);
  }

  void open_undecided(const ShiftBlock& block) {
    open_.clear();
    for (int sheet = 0; sheet < block.sheets; ++sheet)
      if (!rejection_.decided(sheet)) open_.push_back({sheet, -1});
  }

  // Opens lost sheets again that have a state at this place, and tests them in double precision.
  void take_found(int place, const ShiftBlock& block) {
    reopened_.clear();
    std::erase_if(lost_, [&](const Undecided& sheet) {
      const bool is_reopened = sheet.kept_state >= 0;
      if (is_reopened) reopened_.push_back(sheet);
      return is_reopened;
    });
    if (place != kNear) double_test_.run_again(place, block, reopened_, rejection_, states_);
    drop_decided(reopened_);
    open_.insert(open_.end(), reopened_.begin(), reopened_.end());
  }

  template <class Test>
  void run(Test& test, int place, bool keeps, const ShiftBlock& block,
           std::vector<Undecided>& open) {
    test.run(place, keeps, block, open, rejection_, states_);
    drop_decided(open);
  }
  void drop_decided(std::vector<Undecided>& open) {
    std::erase_if(open, [&](const Undecided& sheet) { return rejection_.decided(sheet.sheet); });
  }

  const Model& model_;
  RejectionTest rejection_;
  FunctionObserver functions_;
  JudgingObserver judging_;
  KeptStates states_;
  PathFollower<T, LongSteps> long_follower_;
  PathFollower<T> follower_;
  std::optional<Recorders> recorders_;                      // made when first needed
  std::optional<ExpansionTest<T, Single>> expansion_test_;  // made when first needed
  LaneTest<Single> single_test_;
  LaneTest<T> double_test_;
  std::vector<Undecided> open_, lost_, reopened_;
};

}  // namespace misalign::solver

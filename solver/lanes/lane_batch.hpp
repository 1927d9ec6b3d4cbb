// Batch in registers of one kind. T is a register of doubles, Single one of floats; the rejection
// tests look at as many sheets as they have lanes at the same angle, full paths are followed each
// at its own.
#pragma once

#include "solver/lanes/expansion_test.hpp"
#include "solver/lanes/lane_test.hpp"
#include "solver/lanes/observers.hpp"
#include "solver/records/function_recorder.hpp"
#include "solver/records/recorder.hpp"

namespace misalign::solver {

template <class T, class Single>
class LaneBatch final : public Batch {
 public:
  explicit LaneBatch(const Model& model)
      : model_(model),
        rejection_(model),
        functions_(model, kLanes<T>),
        judging_(model, kLanes<T>),
        approach_(model, kLanes<T>),
        long_follower_(model.mechanism(), model.elimination()),
        follower_(model.mechanism(), model.elimination()),
        approach_follower_(model.mechanism(), model.elimination(), approach_options()),
        single_test_(model, model.tests()),
        double_test_(model, model.tests()),
        beyond_test_(model, model.beyond()) {}

  const std::vector<Rejection>& reject(const ShiftBlock& block) override {
    const SheetBlock sheets(model_, block);
    rejection_.begin(block.sheets);
    approach_.begin(sheets, rejection_);
    if (!expansion_test_) expansion_test_.emplace(model_);
    expansion_test_->run(block, rejection_);
    open_.clear();
    for (int sheet = 0; sheet < block.sheets; ++sheet) {
      if (!rejection_.decided(sheet)) open_.push_back({sheet, -1});
    }
    if (!model_.tests().empty()) run_tests(block);
    if (!model_.approach().stations.empty()) {
      approach_follower_.run(approach_.queue_of(open_), approach_);
    }
    return rejection_.results();
  }

  const std::vector<Verdict>& judge(const ShiftBlock& block) override {
    const SheetBlock sheets(model_, block);
    judging_.begin(sheets);
    if (model_.bumps() != BumpRule::by_cubic) {
      functions_.begin(sheets, judging_.verdicts());
      long_follower_.run(functions_.queue(), functions_);
      judging_.only(functions_.left());
    }
    follower_.run(judging_.queue(), judging_);
    judging_.fall_back();
    return judging_.verdicts();
  }

  const std::vector<PathRecord>& measure(const ShiftBlock& block) override {
    Recorders& to = recorders();
    return measure_paths(SheetBlock(model_, block), to.of_functions, to.of_samples);
  }

  std::vector<FoldingHistory>& record(const ShiftBlock& block) override {
    return recorders().of_samples.record(SheetBlock(model_, block));
  }

  std::vector<FoldingHistory>& record_lengths(const ShiftBlock& block) override {
    return recorders().of_samples.record_lengths(SheetBlock(model_, block));
  }

  Effort rejection_effort() const override {
    Effort effort = approach_.effort();
    effort.add(single_test_.effort());
    effort.add(double_test_.effort());
    effort.add(beyond_test_.effort());
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
  static constexpr int kFar = 0, kNear = 1;  // of the model's tests

  // Large, and not needed by those who ask for verdicts alone.
  struct Recorders {
    explicit Recorders(LaneBatch& batch)
        : of_functions(batch.model_, batch.long_follower_, batch.follower_),
          of_samples(batch.model_, batch.follower_) {}
    FunctionRecorder<T> of_functions;
    Recorder<T> of_samples;
  };
  Recorders& recorders() {
    if (!recorders_) recorders_.emplace(*this);
    return *recorders_;
  }

  // In single precision first, twice as many sheets at once. What a test leaves is packed into full
  // registers for the next.
  void run_tests(const ShiftBlock& block) {
    const bool has_near = model_.tests().size() > 1;
    // The expansion knows already in which direction diagonals set out.
    const bool near_tells = has_near && !expansion_test_->is_there();
    run(single_test_, kFar, block, open_);
    if (near_tells) run(single_test_, kNear, block, open_);
    if (model_.departs_from() == kFar) {
      go_on_from_far(block, has_near, near_tells);
    } else {
      run(double_test_, kFar, block, open_);
      run(double_test_, kNear, block, open_);
    }
  }

  // Those with a state at the far angle: once more in double precision, and on from there. The
  // others from the near one.
  void go_on_from_far(const ShiftBlock& block, bool has_near, bool near_tells) {
    lost_.clear();
    lose_all_but(model_.tests()[kFar]);
    double_test_.run_again(kFar, block, open_, rejection_, approach_);
    drop_decided(open_);
    if (near_tells) run(double_test_, kNear, block, open_);
    if (has_near) run(double_test_, kNear, block, lost_);
    // A sheet that loses its way is for the path follower, from the last state it has.
    for (std::size_t i = 0; i < model_.beyond().size(); ++i) {
      lose_all_but(i == 0 ? model_.tests()[kFar] : model_.beyond()[i - 1]);
      beyond_test_.run_ahead(static_cast<int>(i), block, open_, rejection_, approach_);
      drop_decided(open_);
    }
    open_.insert(open_.end(), lost_.begin(), lost_.end());
  }

  // Keeps the sheets open that have a state at this angle.
  void lose_all_but(const TestAngle& angle) {
    std::erase_if(open_, [&](const Undecided& open) {
      const bool is_lost = !approach_.is_kept_at(angle, open);
      if (is_lost) lost_.push_back(open);
      return is_lost;
    });
  }
  template <class Test>
  void run(Test& test, int angle, const ShiftBlock& block, std::vector<Undecided>& open) {
    test.run(angle, angle == model_.departs_from(), block, open, rejection_, approach_);
    drop_decided(open);
  }
  void drop_decided(std::vector<Undecided>& open) {
    std::erase_if(open, [&](const Undecided& sheet) { return rejection_.decided(sheet.sheet); });
  }

  const Model& model_;
  RejectionTest rejection_;
  FunctionObserver functions_;
  JudgingObserver judging_;
  ApproachObserver approach_;
  PathFollower<T, LongSteps> long_follower_;
  PathFollower<T> follower_, approach_follower_;
  std::optional<Recorders> recorders_;                      // made when first needed
  std::optional<ExpansionTest<T, Single>> expansion_test_;  // made when first needed
  LaneTest<Single> single_test_;
  LaneTest<T> double_test_, beyond_test_;
  std::vector<Undecided> open_, lost_;
};

}  // namespace misalign::solver

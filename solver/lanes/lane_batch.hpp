// Batch in registers of one kind. T is a register of doubles, Single one of floats; the rejection
// tests look at as many sheets as they have lanes at the same angle, full paths are followed each
// at its own.
#pragma once

#include "solver/lanes/lane_test.hpp"
#include "solver/lanes/observers.hpp"
#include "solver/verdict/function_recorder.hpp"
#include "solver/verdict/recorder.hpp"

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
        node_follower_(model.mechanism(), model.elimination()),
        follower_(model.mechanism(), model.elimination()),
        approach_follower_(model.mechanism(), model.elimination(), approach_options()),
        function_recorder_(model, node_follower_, follower_),
        recorder_(model, follower_),
        single_test_(model),
        double_test_(model) {}

  // In single precision first, twice as many sheets at once: that turns away six of seven.
  const std::vector<Rejection>& reject(const ShiftBlock& block) override {
    const SheetBlock sheets(model_, block);
    rejection_.begin(block.sheets);
    approach_.begin(sheets, rejection_);
    open_.clear();
    for (int sheet = 0; sheet < block.sheets; ++sheet) open_.push_back({sheet, -1});
    run_tests(single_test_, block);
    run_tests(double_test_, block);
    if (!model_.approach().stations.empty()) {
      approach_.follow(open_);
      approach_follower_.run(approach_);
    }
    return rejection_.results();
  }

  const std::vector<Verdict>& judge(const ShiftBlock& block) override {
    const SheetBlock sheets(model_, block);
    judging_.begin(sheets);
    if (model_.bumps() != BumpRule::by_cubic) {
      functions_.begin(sheets, judging_.verdicts());
      node_follower_.run(functions_);
      judging_.only(functions_.left());
    }
    follower_.run(judging_);
    judging_.fall_back();
    return judging_.verdicts();
  }

  const std::vector<PathRecord>& measure(const ShiftBlock& block) override {
    return measure_paths(SheetBlock(model_, block), function_recorder_, recorder_);
  }

  std::vector<FoldingHistory>& record(const ShiftBlock& block) override {
    return recorder_.record(SheetBlock(model_, block));
  }

  Effort rejection_effort() const override {
    Effort effort = approach_.effort();
    effort.add(single_test_.effort());
    effort.add(double_test_.effort());
    return effort;
  }
  Effort path_effort() const override {
    Effort effort = judging_.effort();
    effort.add(functions_.effort());
    effort.add(function_recorder_.effort());
    effort.add(recorder_.effort());
    return effort;
  }

 private:
  // Far first. What a test leaves is packed into full registers for the next.
  template <class Test>
  void run_tests(Test& test, const ShiftBlock& block) {
    for (int i = 0; i < static_cast<int>(model_.tests().size()); ++i) {
      test.run(i, block, open_, rejection_, approach_);
      std::erase_if(open_, [&](const OpenSheet& open) { return rejection_.decided(open.sheet); });
    }
  }

  const Model& model_;
  RejectionTest rejection_;
  FunctionObserver functions_;
  JudgingObserver judging_;
  ApproachObserver approach_;
  NodeFollower<T> node_follower_;
  PathFollower<T> follower_, approach_follower_;
  FunctionRecorder<T> function_recorder_;
  Recorder<T> recorder_;
  LaneTest<Single> single_test_;
  LaneTest<T> double_test_;
  std::vector<OpenSheet> open_;
};

}  // namespace misalign::solver

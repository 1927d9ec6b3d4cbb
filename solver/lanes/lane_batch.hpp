// Batch in registers of one kind. T is a register of doubles, Single one of floats; the fast tests
// look at as many sheets as they have lanes at the same angle, full paths are followed each at its
// own.
#pragma once

#include "solver/lanes/lane_test.hpp"
#include "solver/lanes/observers.hpp"
#include "solver/verdict/lane_recorder.hpp"
#include "solver/verdict/miscut_margin.hpp"

namespace misalign::solver {

template <class T, class Single>
class LaneBatch final : public Batch {
 public:
  explicit LaneBatch(const SheetFamily& family)
      : family_(family),
        screening_(family),
        judging_(family, kLanes<T>),
        recording_(family, kLanes<T>),
        approach_(family, kLanes<T>),
        tracker_(family.mechanism(), family.elimination()),
        approach_tracker_(family.mechanism(), family.elimination(), approach_options()),
        single_test_(family),
        double_test_(family),
        recording_client_(family.mechanism(), recording_.shape(), tracker_, recording_),
        margin_(family.mechanism(), family.elimination()),
        margin_geometry_(lane_geometry<T>(family.mechanism())),
        margin_state_(flat_state<T>(family.mechanism())) {}

  // In single precision first, twice as many sheets at once: that turns away six of seven.
  const std::vector<Screened>& screen(const ShiftBlock& block) override {
    screening_.begin(block.sheets);
    approach_.begin(block, screening_);
    open_.clear();
    for (int sheet = 0; sheet < block.sheets; ++sheet) open_.push_back({sheet, -1});
    run_tests(single_test_, block);
    run_tests(double_test_, block);
    if (!family_.approach().stops.empty()) {
      for (const OpenSheet& open : open_) {
        if (open.kept_state >= 0) approach_.add(open.sheet, open.kept_state);
      }
      ApproachClient client{approach_, approach_tracker_};
      approach_tracker_.run(client);
    }
    return screening_.results();
  }

  const std::vector<Verdict>& judge(const ShiftBlock& block) override {
    judging_.begin(block);
    JudgingClient client{judging_, tracker_};
    tracker_.run(client);
    return judging_.verdicts();
  }

  std::vector<FoldingHistory>& record(const ShiftBlock& block) override {
    recording_.begin(block);
    tracker_.run(recording_client_);
    margin_sheets_.clear();
    for (int sheet = 0; sheet < block.sheets; ++sheet) {
      const auto& states = recording_.histories()[sheet].margin_states;
      if (states.size() == recording_.margin_samples().size()) margin_sheets_.push_back(sheet);
    }
    for (std::size_t first = 0; first < margin_sheets_.size(); first += kLanes<T>) {
      find_margins(block, first);
    }
    return recording_.histories();
  }

  Effort screening_effort() const override {
    Effort effort = approach_.effort();
    for (const Effort& tests : {single_test_.effort(), double_test_.effort()}) {
      effort.solves += tests.solves;
      effort.iterations += tests.iterations;
    }
    return effort;
  }
  Effort judging_effort() const override { return judging_.effort(); }

 private:
  // Far first. What a test leaves is packed into full registers for the next.
  template <class Test>
  void run_tests(Test& test, const ShiftBlock& block) {
    for (int i = 0; i < static_cast<int>(family_.tests().size()); ++i) {
      test.run(i, block, open_, screening_, approach_);
      std::erase_if(open_, [&](const OpenSheet& open) { return screening_.decided(open.sheet); });
    }
  }

  // Of as many sheets as there are lanes, or those that are left.
  void find_margins(const ShiftBlock& block, std::size_t first) {
    const auto sheet_of_lane = [&](int i) {
      return margin_sheets_[std::min(first + static_cast<std::size_t>(i),
                                     margin_sheets_.size() - 1)];
    };
    for (int i = 0; i < kLanes<T>; ++i) {
      family_.displace(block.of(sheet_of_lane(i)), one_vertices_mm_);
      place(family_.mechanism(), one_vertices_mm_, one_geometry_);
      put_lane(one_geometry_, margin_geometry_, i);
    }
    margin_.begin(margin_geometry_);
    for (std::size_t k = 0; k < recording_.margin_samples().size(); ++k) {
      for (int i = 0; i < kLanes<T>; ++i) {
        put_lane(recording_.histories()[sheet_of_lane(i)].margin_states[k], margin_state_, i);
      }
      margin_.see(margin_state_);
    }
    for (int i = 0; i < kLanes<T>; ++i) {
      recording_.histories()[sheet_of_lane(i)].miscut_margin_mm = margin_.mm(i);
    }
  }

  struct JudgingClient {
    JudgingDesk& desk;
    Tracker<T>& tracker;
    bool next(Departure& departure, int lane) { return desk.next(departure, lane); }
    bool visit(const Stop& stop, int lane) {
      tracker.copy_state(lane, desk.found().state);
      tracker.copy_lengths(lane, desk.found().lengths.data());
      const double misfit =
          desk.wants_slopes() ? tracker.copy_slopes(lane, desk.found().slopes.data()) : 0;
      desk.found().pilot_rate = tracker.pilot_rate(lane);
      return desk.visit(stop, lane, misfit);
    }
    void ended(const PathResult& path, int lane) { desk.ended(path, lane); }
  };

  struct ApproachClient {
    ApproachDesk& desk;
    Tracker<T>& tracker;
    bool next(Departure& departure, int lane) { return desk.next(departure, lane); }
    bool visit(const Stop& stop, int lane) {
      tracker.copy_state(lane, desk.found().state);
      tracker.copy_lengths(lane, desk.found().lengths.data());
      tracker.copy_slopes(lane, desk.found().slopes.data());
      return desk.visit(stop, lane);
    }
    void ended(const PathResult& path, int lane) { desk.ended(path, lane); }
  };

  const SheetFamily& family_;
  Screening screening_;
  JudgingDesk judging_;
  RecordingDesk recording_;
  ApproachDesk approach_;
  Tracker<T> tracker_, approach_tracker_;
  LaneTest<Single> single_test_;
  LaneTest<T> double_test_;
  RecordingClient<T, RecordingDesk> recording_client_;
  std::vector<OpenSheet> open_;
  MiscutMargin<T> margin_;
  SheetGeometry<T> margin_geometry_;
  FlatVertices one_vertices_mm_;  // of a single lane
  SheetGeometry<double> one_geometry_;
  FoldState<T> margin_state_;
  std::vector<int> margin_sheets_;
};

}  // namespace misalign::solver

// Records of paths from a node follower of any width: the paths as functions, then the states that
// their records want exactly, those of as many sheets as there are lanes side by side.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/continuation/node_follower.hpp"
#include "solver/linear/held_correction.hpp"
#include "solver/linear/singular_value.hpp"
#include "solver/records/record_builder.hpp"
#include "solver/records/recorder.hpp"

namespace misalign::solver {

template <class T>
class FunctionRecorder {
 public:
  /// All must outlive this object; the close follower has the last degrees of some paths.
  FunctionRecorder(const Model& model, NodeFollower<T>& follower, PathFollower<T>& close_follower)
      : model_(model),
        mechanism_(model.mechanism()),
        follower_(follower),
        close_follower_(close_follower),
        records_(model, kLanes<T>),
        placed_(mechanism_),
        geometry_(lane_geometry<T>(mechanism_)),
        state_(flat_state<T>(mechanism_)),
        factors_(model.elimination()),
        square_factors_(factors_),
        smallest_(mechanism_.equations),
        residual_(mechanism_.equations, T(0)),
        work_(mechanism_.unknowns, T(0)),
        turn_(work_),
        lengths_(mechanism_.diagonals.size(), T(0)),
        slopes_(lengths_),
        margin_(mechanism_) {}

  /// Of every sheet of the block; says which are left for the close steps.
  const std::vector<int>& record(const SheetBlock& block) {
    records_.begin(block);
    if (model_.bumps() == BumpRule::by_cubic) {
      records_.leave_all();  // cubics between solved samples judge bumps
      return records_.left();
    }
    follower_.run(*this);
    RecordBuilder::Ends ends(records_);
    close_follower_.run(ends);
    const std::vector<int>& complete = records_.complete();
    for (std::size_t first = 0; first < complete.size(); first += kLanes<T>) {
      solve_wanted(block, complete, first);
    }
    return records_.left();
  }
  /// All of the block, those that were left by their histories.
  const std::vector<PathRecord>& merge(const std::vector<FoldingHistory>& left) {
    return records_.merge(left);
  }

  const Effort& effort() const { return records_.effort(); }

  // For the follower.
  bool next(PathStart& start, int lane) { return records_.next(start, lane); }
  ObserverResult see(const PathFunction& function, int lane) {
    return records_.see(function, lane, [&](double x, FoldState<double>& state) {
      follower_.find_state(x, lane, state);
    });
  }
  void ended(const PathResult& path, int lane) {
    records_.ended(
        path, follower_.function(lane), follower_.forward_sign(lane), lane,
        [&](double x, FoldState<double>& state) { follower_.find_state(x, lane, state); });
  }

 private:
  static constexpr int kMostReversalRounds = 5;

  // Of as many sheets as there are lanes, or those that are left.
  void solve_wanted(const SheetBlock& block, const std::vector<int>& sheets, std::size_t first) {
    const auto sheet_of_lane = [&](int i) {
      return sheets[std::min(first + static_cast<std::size_t>(i), sheets.size() - 1)];
    };
    for (int i = 0; i < kLanes<T>; ++i) {
      put_lane(placed_.of(block, sheet_of_lane(i)), geometry_, i);
      smallest_.restart(i);
    }
    const int margins = static_cast<int>(model_.margin_samples().size());
    if (margins > 0) margin_.begin(geometry_);
    for (int k = 0; k < records_.wanted_count(); ++k) {
      for (int i = 0; i < kLanes<T>; ++i) {
        const WantedState& wanted = records_.wanted(sheet_of_lane(i), k);
        put_lane(wanted.near, state_, i);
        lane(state_.creases[mechanism_.pilot].c, i) = wanted.pilot.c;
        lane(state_.creases[mechanism_.pilot].s, i) = wanted.pilot.s;
      }
      solve(k - margins);
      if (k < margins) margin_.see(state_, factors_);
      for (int i = 0; i < kLanes<T>; ++i) keep(records_.solved(i, k), i);
    }
    const std::size_t lanes = std::min<std::size_t>(kLanes<T>, sheets.size() - first);
    find_reversals(sheets.data() + first, static_cast<int>(lanes));
    for (int i = 0; i < static_cast<int>(lanes); ++i) {
      records_.take(sheet_of_lane(i), i, margins > 0 ? margin_.mm(i) : std::nullopt);
    }
  }

  // The states of the first reversals again, until they are there; so many lanes have one.
  void find_reversals(const int* sheets, int lanes) {
    const int reversal = records_.wanted_count() - 1;
    for (int round = 0; round < kMostReversalRounds; ++round) {
      bool any = false;
      std::array<bool, kLanes<T>> again{};
      for (int i = 0; i < lanes; ++i) {
        again[i] = records_.wants_again(sheets[i], i);
        if (!again[i]) continue;
        any = true;
        const WantedState& wanted = records_.wanted(sheets[i], reversal);
        lane(state_.creases[mechanism_.pilot].c, i) = wanted.pilot.c;
        lane(state_.creases[mechanism_.pilot].s, i) = wanted.pilot.s;
      }
      if (!any) return;
      solve(static_cast<int>(Wanted::reversal));
      for (int i = 0; i < lanes; ++i) {
        if (again[i]) keep(records_.solved(i, reversal), i);
      }
    }
  }

  // Two corrections with the pilot held, or four where it may be next to a limit point, whatever
  // the neighbours need; and what is wanted of the state that they reach. For slopes three: what
  // they do not close is for the close steps.
  MISALIGN_FLATTEN void solve(int beside_margin) {
    const bool for_lengths = beside_margin == static_cast<int>(Wanted::before_least_step) ||
                             beside_margin == static_cast<int>(Wanted::after_least_step);
    const bool for_slopes = beside_margin >= static_cast<int>(Wanted::least_slope);
    correct(true);
    correct(!for_slopes);
    if (beside_margin >= static_cast<int>(Wanted::before_d)) {
      if (!for_slopes) correct(!for_lengths);
      correct(!for_lengths);
    }
    open_by_ = evaluate(mechanism_, geometry_, state_, residual_.data(), nullptr);
    factors_.null_vector(-factors_.pilot_coefficient() / factors_.partner_coefficient(), T(1),
                         work_.data(), turn_.data());
    folded_lengths_and_slopes(mechanism_, geometry_, state_, turn_.data(), lengths_.data(),
                              slopes_.data(), residual_.data());
    if (for_lengths || for_slopes) return;
    singular_value_ = smallest_.of(square_factors_);
    model_.shape().place(geometry_, state_, points_);
    isometry_error_ = model_.shape().isometry_error(geometry_, points_);
  }

  void correct(bool new_factors) {
    correct_held(mechanism_, geometry_, new_factors, factors_, residual_, work_, turn_, state_);
  }

  void keep(SolvedState& solved, int i) const {
    solved.open_by = lane(open_by_, i);
    solved.singular_value = lane(singular_value_, i);
    solved.isometry_error = lane(isometry_error_, i);
    for (std::size_t d = 0; d < lengths_.size(); ++d) {
      solved.lengths[d] = lane(lengths_[d], i);
      solved.slopes[d] = lane(slopes_[d], i);
    }
  }

  const Model& model_;
  const Mechanism& mechanism_;
  NodeFollower<T>& follower_;
  PathFollower<T>& close_follower_;
  RecordBuilder records_;
  PlacedSheet placed_;
  SheetGeometry<T> geometry_;
  FoldState<T> state_;
  SparseLu<T> factors_;
  SquareFactors<T> square_factors_;
  SmallestSingularValue<T> smallest_;
  FoldedPoints<T> points_;
  std::vector<T> residual_, work_, turn_, lengths_, slopes_;
  T open_by_, singular_value_, isometry_error_;
  MiscutMargin<T> margin_;
};

/// Every path of the block as a function, or where that is not sure in close steps.
template <class T>
const std::vector<PathRecord>& measure_paths(const SheetBlock& block,
                                             FunctionRecorder<T>& functions,
                                             Recorder<T>& recorder) {
  const std::vector<int>& left = functions.record(block);
  return functions.merge(recorder.measure(block, left));
}

}  // namespace misalign::solver

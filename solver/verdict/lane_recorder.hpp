// Full paths of sheets that somebody looks at, for a tracker of any width: looks closer at the
// stops of all lanes together, and hands each to the recording of its lane.
#pragma once

#include <array>

#include "solver/continuation/path_follower.hpp"
#include "solver/continuation/path_point.hpp"
#include "solver/linear/singular_value.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/history.hpp"

namespace misalign::solver {

/// `Desk` says which sheet is next (`next`), whose recording a lane writes (`of_lane`), and takes
/// the end of each path (`ended`). Lanes arrive at their stops one by one: each one's state and
/// factors are kept until it arrives again or its path ends, and then all that are kept are looked
/// at in one go; with dense factors (`see_densely`) where the kept ones are worth nothing.
template <class T, class Desk>
class RecordingClient {
 public:
  RecordingClient(const Mechanism& mechanism, const FoldedShape& shape, Tracker<T>& tracker,
                  Desk& desk)
      : mechanism_(mechanism),
        shape_(shape),
        tracker_(tracker),
        desk_(desk),
        kept_state_(flat_state<T>(mechanism)),
        kept_factors_(tracker.factors()),
        square_factors_(kept_factors_),
        smallest_(mechanism.equations),
        residual_(mechanism.equations, T(0)),
        work_(mechanism.unknowns, T(0)),
        rates_(work_),
        lengths_(mechanism.diagonals.size(), T(0)),
        slopes_(lengths_),
        copy_(mechanism) {}

  bool next(Departure& departure, int lane) {
    smallest_.restart(lane);
    return desk_.next(departure, lane);
  }

  void arrivals(const T& arrived) {
    bool again = false;
    for (int i = 0; i < kLanes<T>; ++i) again = again || lane(arrived, i) * lane(waits_, i) > 0;
    if (again) look();
    replace(arrived, tracker_.state(), kept_state_);
    kept_factors_.replace(arrived, tracker_.factors());
  }

  bool visit(const Stop& stop, int i) {
    stops_[i] = stop;
    lane(waits_, i) = 1;
    return true;
  }

  void ended(const PathResult& path, int i) {
    if (lane(waits_, i) > 0) look();
    desk_.ended(path, i);
  }

 private:
  MISALIGN_FLATTEN void look() {
    const SheetGeometry<T>& geometry = tracker_.geometry();
    const T open_by = evaluate(mechanism_, geometry, kept_state_, residual_.data(), nullptr);
    const T singular_value = smallest_.of(square_factors_, waits_);
    kept_factors_.null_vector(
        -kept_factors_.pilot_coefficient() / kept_factors_.partner_coefficient(), T(1),
        work_.data(), rates_.data());
    folded_lengths_and_slopes(mechanism_, geometry, kept_state_, rates_.data(), lengths_.data(),
                              slopes_.data(), residual_.data());
    T square(0);
    for (const T& rate : rates_) square = square + rate * rate;
    const T pilot_rate = T(1) / sqrt(square);
    T misfit(0);
    for (const T& rest : residual_) misfit = larger(misfit, magnitude(rest));
    shape_.place(geometry, kept_state_, points_);
    const T isometry_error = shape_.isometry_error(geometry, points_);
    for (int i = 0; i < kLanes<T>; ++i) {
      if (!(lane(waits_, i) > 0)) continue;
      copy_lane(kept_state_, i, copy_.state);
      if (stops_[i].pilot_deg <= kPoorFactorsFrom_deg && lane(misfit, i) <= kLargestMisfit) {
        for (std::size_t k = 0; k < lengths_.size(); ++k) {
          copy_.lengths[k] = lane(lengths_[k], i);
          copy_.slopes[k] = lane(slopes_[k], i);
        }
        desk_.of_lane(i).see({stops_[i], copy_.state, copy_.lengths, copy_.slopes,
                              lane(pilot_rate, i), lane(open_by, i), lane(singular_value, i),
                              lane(isometry_error, i)});
      } else {
        desk_.of_lane(i).see_densely(stops_[i], copy_.state, shape_);
      }
    }
    waits_ = T(0);
  }

  const Mechanism& mechanism_;
  const FoldedShape& shape_;
  Tracker<T>& tracker_;
  Desk& desk_;
  T waits_ = T(0);  // 1: the lane's kept state has not been looked at
  FoldState<T> kept_state_;
  SparseLu<T> kept_factors_;
  SquareFactors<T> square_factors_;
  SmallestSingularValue<T> smallest_;
  FoldedPoints<T> points_;
  std::vector<T> residual_, work_, rates_, lengths_, slopes_;
  std::array<Stop, kLanes<T>> stops_{};
  StopCopy copy_;
};

}  // namespace misalign::solver

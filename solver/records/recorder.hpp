// Whole histories from a path follower of any width: lanes are looked at together at their
// stations, and then how far off the sheets may be cut.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/linear/singular_value.hpp"
#include "solver/model/miscut_margin.hpp"
#include "solver/records/history_observer.hpp"

namespace misalign::solver {

/// Lanes arrive at their stations one by one: each one's state and factors are kept until it
/// arrives again or its path ends, and then all that are kept are looked at in one go; with dense
/// factors where the kept ones are worth nothing.
template <class T>
class Recorder {
 public:
  /// All must outlive this object.
  Recorder(const Model& model, PathFollower<T>& follower, const StationVisitor* visit = nullptr)
      : model_(model),
        mechanism_(model.mechanism()),
        follower_(follower),
        observer_(model, kLanes<T>, visit),
        kept_state_(flat_state<T>(mechanism_)),
        kept_factors_(follower.closure().factors()),
        square_factors_(kept_factors_),
        smallest_(mechanism_.equations),
        residual_(mechanism_.equations, T(0)),
        work_(mechanism_.unknowns, T(0)),
        rates_(work_),
        lengths_(mechanism_.diagonals.size(), T(0)),
        slopes_(lengths_),
        margin_(mechanism_),
        placed_(mechanism_),
        geometry_(lane_geometry<T>(mechanism_)) {}

  std::vector<FoldingHistory>& record(const SheetBlock& block) {
    observer_.begin(block);
    return record_waiting(block);
  }
  /// The same without what says how good they are: residuals, singular values and isometry errors
  /// are 0. In two thirds of the time.
  std::vector<FoldingHistory>& record_lengths(const SheetBlock& block) {
    looks_at_quality_ = false;
    record(block);
    looks_at_quality_ = true;
    return observer_.histories();
  }
  /// Only these sheets of the block, with their extremes; the others' histories are empty.
  std::vector<FoldingHistory>& measure(const SheetBlock& block, const std::vector<int>& sheets) {
    observer_.begin(block);
    observer_.measure_only(sheets);
    return record_waiting(block);
  }

  const Effort& effort() const { return observer_.effort(); }

  // For the follower.
  bool next(PathStart& start, int lane) {
    smallest_.restart(lane);
    return observer_.next(start, lane);
  }
  void arrivals(const T& arrived) {
    bool again = false;
    for (int i = 0; i < kLanes<T>; ++i) again = again || lane(arrived, i) * lane(waits_, i) > 0;
    if (again) look();
    replace(arrived, follower_.state(), kept_state_);
    kept_factors_.replace(arrived, follower_.closure().factors());
  }
  bool see(const Station& station, int i) {
    stations_[i] = station;
    lane(waits_, i) = 1;
    return true;
  }
  void ended(const PathResult& path, int i) {
    if (lane(waits_, i) > 0) look();
    observer_.ended(path, i);
  }

 private:
  std::vector<FoldingHistory>& record_waiting(const SheetBlock& block) {
    follower_.run(*this);
    observer_.fall_back();
    const std::size_t all = model_.margin_samples().size();
    with_margin_.clear();
    for (int sheet = 0; all > 0 && sheet < block.sheets(); ++sheet) {
      if (observer_.histories()[sheet].margin_states.size() == all) with_margin_.push_back(sheet);
    }
    for (std::size_t first = 0; first < with_margin_.size(); first += kLanes<T>) {
      find_margins(block, first);
    }
    return observer_.histories();
  }

  MISALIGN_FLATTEN void look() {
    const SheetGeometry<T>& geometry = follower_.geometry();
    T open_by(0), singular_value(0), isometry_error(0);
    if (looks_at_quality_) {
      open_by = evaluate(mechanism_, geometry, kept_state_, residual_.data(), nullptr);
      singular_value = smallest_.of(square_factors_, waits_);
      model_.shape().place(geometry, kept_state_, points_);
      isometry_error = model_.shape().isometry_error(geometry, points_);
    }
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
    for (int i = 0; i < kLanes<T>; ++i) {
      if (!(lane(waits_, i) > 0)) continue;
      PathPoint& point = observer_.point();
      copy_lane(kept_state_, i, point.state);
      if (stations_[i].pilot_deg > kPoorFactorsFrom_deg || !(lane(misfit, i) <= kLargestMisfit)) {
        observer_.see(stations_[i], i);
        continue;
      }
      for (std::size_t k = 0; k < lengths_.size(); ++k) {
        point.lengths[k] = lane(lengths_[k], i);
        point.slopes[k] = lane(slopes_[k], i);
      }
      point.rates.resize(rates_.size());
      for (std::size_t k = 0; k < rates_.size(); ++k) point.rates[k] = lane(rates_[k], i);
      point.pilot_rate = lane(pilot_rate, i);
      observer_.keep(stations_[i], i,
                     {lane(open_by, i), lane(singular_value, i), lane(isometry_error, i)});
    }
    waits_ = T(0);
  }

  // Of as many sheets as there are lanes, or those that are left.
  void find_margins(const SheetBlock& block, std::size_t first) {
    const auto sheet_of_lane = [&](int i) {
      return with_margin_[std::min(first + static_cast<std::size_t>(i), with_margin_.size() - 1)];
    };
    for (int i = 0; i < kLanes<T>; ++i) {
      put_lane(placed_.of(block, sheet_of_lane(i)), geometry_, i);
    }
    margin_.begin(geometry_);
    for (std::size_t k = 0; k < model_.margin_samples().size(); ++k) {
      for (int i = 0; i < kLanes<T>; ++i) {
        put_lane(observer_.histories()[sheet_of_lane(i)].margin_states[k], kept_state_, i);
      }
      evaluate(mechanism_, geometry_, kept_state_, residual_.data(), kept_factors_.entries());
      kept_factors_.factorize();
      margin_.see(kept_state_, kept_factors_);
    }
    for (int i = 0; i < kLanes<T>; ++i) {
      observer_.histories()[sheet_of_lane(i)].miscut_margin_mm = margin_.mm(i);
    }
  }

  const Model& model_;
  const Mechanism& mechanism_;
  PathFollower<T>& follower_;
  HistoryObserver observer_;
  bool looks_at_quality_ = true;
  T waits_ = T(0);  // 1: the lane's kept state has not been looked at
  FoldState<T> kept_state_;
  SparseLu<T> kept_factors_;
  SquareFactors<T> square_factors_;
  SmallestSingularValue<T> smallest_;
  FoldedPoints<T> points_;
  std::vector<T> residual_, work_, rates_, lengths_, slopes_;
  std::array<Station, kLanes<T>> stations_{};
  MiscutMargin<T> margin_;
  std::vector<int> with_margin_;
  PlacedSheet placed_;
  SheetGeometry<T> geometry_;
};

}  // namespace misalign::solver

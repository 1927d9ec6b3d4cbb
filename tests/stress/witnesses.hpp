// Two witnesses of a path's verdict, neither of them the lanes': dense matrices from sample to
// sample, and the curve itself.
#pragma once

#include <algorithm>

#include "curve.hpp"
#include "solver/continuation/homotopy.hpp"
#include "solver/model/model.hpp"
#include "solver/reference/path_tracker.hpp"

namespace misalign::stress {

using solver::FlatVertices;
using solver::Model;
using solver::Verdict;

// The lengths of a history at its samples up to D, for comparison.
class LengthsOf {
 public:
  explicit LengthsOf(const solver::FoldingHistory& history, double width_mm)
      : history_(history), width_mm_(width_mm) {}

  /// Panel widths; 0 beyond D.
  double largest_difference(const solver::Station& station,
                            const std::vector<double>& lengths) const {
    if (station.sample > history_.verdict.deploys_from_sample) return 0;
    const auto at =
        std::find_if(history_.stations.begin(), history_.stations.end(),
                     [&](const solver::Station& seen) { return seen.sample == station.sample; });
    if (at == history_.stations.end()) return 0;
    double largest = 0;
    for (std::size_t d = 0; d < lengths.size(); ++d) {
      const double there_mm =
          history_.length_mm(at - history_.stations.begin(), static_cast<Eigen::Index>(d));
      largest = std::max(largest, std::abs(lengths[d] - there_mm / width_mm_));
    }
    return largest;
  }

 private:
  const solver::FoldingHistory& history_;
  const double width_mm_;
};

// What both do: judge the samples of one path, and keep how far its lengths up to D are from the
// history's.
class Witness {
 public:
  double length_error() const { return length_error_; }  ///< panel widths

 protected:
  Witness(const Model& model, const solver::PathPlan& plan)
      : plan_(plan),
        mechanism_(model.mechanism()),
        judge_(model.mechanism()),
        lengths_(model.mechanism().diagonals.size()) {}

  void begin(const FlatVertices& vertices_mm) {
    solver::place(mechanism_, vertices_mm, geometry_);
    solver::flat_lengths(mechanism_, geometry_, lengths_.data());
    judge_.begin(lengths_);
    length_error_ = 0;
  }
  bool see(const solver::Station& station, const solver::FoldState<double>& state,
           const LengthsOf& history) {
    solver::folded_lengths(mechanism_, geometry_, state, lengths_.data());
    length_error_ = std::max(length_error_, history.largest_difference(station, lengths_));
    return judge_.see(station, &state, lengths_);
  }
  Verdict conclude(const solver::PathResult& path) const { return judge_.conclude(path); }

  const solver::PathPlan& plan_;
  const solver::Mechanism& mechanism_;
  solver::SheetGeometry<double> geometry_;

 private:
  solver::Judge judge_;
  std::vector<double> lengths_;
  double length_error_ = 0;
};

// The path by dense matrices from sample to sample.
class DensePath : public Witness {
 public:
  DensePath(const Model& model, const solver::PathPlan& plan)
      : Witness(model, plan), tracker_(model.mechanism()) {}

  Verdict judge(const FlatVertices& vertices_mm, const LengthsOf& history) {
    begin(vertices_mm);
    return conclude(tracker_.follow(
        geometry_, plan_,
        [&](const solver::Station& station, const solver::FoldState<double>& state) {
          return station.sample == 0 || see(station, state, history);
        }));
  }

 private:
  solver::PathTracker tracker_;
};

// The same along the curve itself, which no step can leave: slow, for the sheets where dense
// matrices in steps of a degree and the lanes differ.
class CurvePath : public Witness {
 public:
  CurvePath(const Model& model, const solver::PathPlan& plan)
      : Witness(model, plan),
        newton_(model.mechanism()),
        homotopy_(model.mechanism(), model.elimination(), plan, model.base().sheet.vertices_mm),
        start_(model.mechanism()) {}

  Verdict judge(const FlatVertices& vertices_mm, const LengthsOf& history) {
    using solver::PathEnd;
    begin(vertices_mm);
    start_.geometry = geometry_;
    homotopy_.find({&start_, 1});
    if (start_.end != PathEnd::end_reached) {
      return conclude({PathEnd::start_lost, 0, 0, 0, 0});
    }
    Curve curve(mechanism_, geometry_, start_.state);
    constexpr double kStep_rad = 0.02;
    for (const solver::Station& station : plan_.stations) {
      if (station.sample == 0) continue;
      while (curve.pilot_deg() < station.pilot_deg - 1e-9) {
        const Curve before = curve;
        if (!curve.step(kStep_rad)) return conclude({PathEnd::stalled, 0, 0, 0, 0});
        if (curve.pilot_rate() > 0) continue;
        // It turned, perhaps only beyond the sample.
        const double limit_deg = Curve(before).walk_to_turn(kStep_rad);
        if (!(limit_deg >= station.pilot_deg)) {
          return conclude({PathEnd::fold_limit, limit_deg, 0, 0, 0});
        }
        curve = before;
        break;
      }
      solver::FoldState<double> state = curve.state();
      state.creases[mechanism_.pilot] = station.pilot;
      if (newton_.correct(geometry_, state).end != solver::Newton::StopReason::converged) {
        return conclude({PathEnd::stalled, 0, 0, 0, 0});
      }
      if (!see(station, state, history)) break;
    }
    return conclude({PathEnd::end_reached, 0, 0, 0, 0});
  }

 private:
  solver::Newton newton_;
  solver::ShiftHomotopy<double> homotopy_;
  solver::StartFinder::FarStart start_;
};

}  // namespace misalign::stress

// Judges a sheet by the energy of its springs, from vertex coordinates and dense matrices with
// pivoting: it shares with the judges the equations of loop closure alone.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/model/model.hpp"
#include "solver/reference/path_tracker.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

struct CoordinateVerdict {
  int deploys_from_sample = 0;
  Fault first_fault = Fault::none;
  /// Least distance of a comparison from its limit: of an energy's step, as a share of the energy;
  /// of a margin, as a share of what is demanded.
  double nearest = HUGE_VAL;
  double critical_friction = HUGE_VAL;  ///< N mm per mm, from the criterion's threshold

  Verdict verdict() const { return {deploys_from_sample, first_fault, -1, PathEnd::stopped}; }
};

/// Springs of `rate_n_per_mm` on all diagonals, relaxed flat. The path is solved every `step_deg`.
class CoordinateJudge {
 public:
  /// Shifts grow from zero in this number of steps.
  CoordinateJudge(const Model& model, double rate_n_per_mm, double step_deg, int growth_steps = 16)
      : model_(model),
        rate_n_per_mm_(rate_n_per_mm),
        growth_steps_(growth_steps),
        tracker_(model.mechanism()) {
    PathPlanOptions options;
    options.sample_deg = model.sample_deg();
    options.end_deg = model.path().stations.back().pilot_deg;
    options.longest_step_deg = step_deg;
    plan_ =
        plan_path(model.mechanism(), model.base().folding, model.base().sheet.vertices_mm, options);
    start_ = plan_;
    start_.stations.resize(1);
    start_.stations.front().visit = true;
  }

  CoordinateVerdict judge(const FlatVertices& vertices_mm) {
    const EnergyCriterion& asked = *model_.criterion().energy;
    if (!grow(vertices_mm)) return {.first_fault = Fault::fold_limit};
    place(model_.mechanism(), vertices_mm, geometry_);
    CoordinateVerdict verdict;
    std::vector<double> energies_n_mm{0}, turnings_mm{0};
    bool is_over = false;
    const PathResult path = tracker_.follow(
        geometry_, plan_, [&](const Station& station, const FoldState<double>& state) {
          if (station.sample == 0) return true;
          verdict.first_fault = fault_of(state);
          if (verdict.first_fault == Fault::none) {
            energies_n_mm.push_back(energy_n_mm(vertices_mm, state));
            turnings_mm.push_back(turning_mm(vertices_mm, state));
            judge_last(station.sample, asked, energies_n_mm, turnings_mm, verdict);
          }
          is_over = verdict.first_fault != Fault::none;
          if (!is_over) verdict.deploys_from_sample = station.sample;
          return !is_over;
        });
    if (!is_over && path.end != PathEnd::end_reached) {
      verdict.first_fault = path.end == PathEnd::fold_limit ? Fault::fold_limit : Fault::undecided;
    }
    return verdict;
  }

 private:
  // Large shifts grow from zero: their first state may be another branch's otherwise. Returns false
  // where they cannot: the folding of the base ends in a limit before.
  bool grow(const FlatVertices& vertices_mm) {
    const FlatVertices& base_mm = model_.base().sheet.vertices_mm;
    FoldState<double> grown = start_.start;
    for (int k = 1; k < growth_steps_; ++k) {
      const FlatVertices grown_mm = base_mm + (vertices_mm - base_mm) * k / growth_steps_;
      place(model_.mechanism(), grown_mm, geometry_);
      PathPlan next = start_;
      next.start = grown;
      const PathResult path =
          tracker_.follow(geometry_, next, [&](const Station&, const FoldState<double>& state) {
            grown = state;
            return true;
          });
      if (path.end != PathEnd::end_reached) return false;
    }
    plan_.start = grown;
    return true;
  }

  Fault fault_of(const FoldState<double>& state) const {
    const auto& creases = model_.mechanism().creases;
    for (const HalfAngle<double>& angle : state.creases) {
      if (2 * std::atan2(std::abs(angle.s), angle.c) > (180 + 1e-6) * kRadPerDeg) {
        return Fault::over_folded;
      }
    }
    for (std::size_t k = 0; k < creases.size(); ++k) {
      if (state.creases[k].s * creases[k].assignment <= 0) return Fault::assignment_flipped;
    }
    return Fault::none;
  }

  double energy_n_mm(const FlatVertices& vertices_mm, const FoldState<double>& state) const {
    const Eigen::Matrix3Xd folded_mm = model_.shape().vertices_mm(geometry_, state);
    double sum = 0;
    for (const Diagonal& diagonal : model_.mechanism().diagonals) {
      const double flat_mm = (vertices_mm.col(diagonal.to) - vertices_mm.col(diagonal.from)).norm();
      const double mm = (folded_mm.col(diagonal.to) - folded_mm.col(diagonal.from)).norm();
      sum += rate_n_per_mm_ / 2 * (mm - flat_mm) * (mm - flat_mm);
    }
    return sum;
  }

  double turning_mm(const FlatVertices& vertices_mm, const FoldState<double>& state) const {
    double sum = 0;
    for (std::size_t k = 0; k < state.creases.size(); ++k) {
      const Crease& crease = model_.mechanism().creases[k];
      const double mm = (vertices_mm.col(crease.b) - vertices_mm.col(crease.a)).norm();
      sum += mm * 2 * std::atan2(std::abs(state.creases[k].s), state.creases[k].c);
    }
    return sum;
  }

  static void judge_last(int sample, const EnergyCriterion& asked,
                         const std::vector<double>& energies_n_mm,
                         const std::vector<double>& turnings_mm, CoordinateVerdict& verdict) {
    const std::size_t last = energies_n_mm.size() - 1;
    const double step = energies_n_mm[last] - energies_n_mm[last - 1];
    verdict.nearest = std::min(verdict.nearest, std::abs(step) / energies_n_mm[last]);
    if (!(step > 0)) verdict.first_fault = Fault::energy_rises;
    if (verdict.first_fault != Fault::none || sample != asked.from_sample) return;
    for (std::size_t k = 0; k < last; ++k) {
      const double turned_mm = turnings_mm[last] - turnings_mm[k];
      if (turned_mm <= 0) continue;
      verdict.critical_friction =
          std::min(verdict.critical_friction, (energies_n_mm[last] - energies_n_mm[k]) / turned_mm);
    }
    const double demanded = asked.least_friction_n_mm_per_mm;
    if (demanded == 0) return;
    verdict.nearest = std::min(verdict.nearest, std::abs(verdict.critical_friction / demanded - 1));
    if (verdict.critical_friction < demanded) verdict.first_fault = Fault::weak_drive;
  }

  const Model& model_;
  const double rate_n_per_mm_;
  const int growth_steps_;
  PathPlan plan_, start_;  // start_: the first station alone
  PathTracker tracker_;
  SheetGeometry<double> geometry_;
};

}  // namespace misalign::solver

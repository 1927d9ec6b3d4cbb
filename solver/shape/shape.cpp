#include "solver/shape/shape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/low_slopes.hpp"
#include "solver/shape/well_rows.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::VectorXd;

// The first curvature, the largest growth between stages and the least, times the sheet's width;
// and the misfit, in panel widths, of a stage that is repeated after a smaller growth.
constexpr double kFirstCurvature = 0.1, kCurvatureStep = 1.0 / 12, kLeastStep = 1.0 / 96;
// Stages of a surface that is bent more sharply than a sheet can follow: a corner of a grid.
constexpr double kMostStages = 60;
constexpr double kPoorMisfit = 1e-3;
// Misfit, in panel widths, that one degree of the path is worth.
constexpr double kPerDegree = 6e-4;
// Growth of the fold limit between stages.
constexpr double kLimitStep_deg = 8;
// Diagonals keep their directions, and the energy falls, from this far beyond the stowed angle.
constexpr double kPast_deg = 0.3;
// Angle by whose lengths directions are chosen; angles of directions; distance of more from one
// where a diagonal turns back; rounds of these.
constexpr double kSigns_deg = 60, kDirections_deg = 6, kAround_deg = 1.5;
constexpr int kRounds = 4;
// Levels of floors; the largest growth from one to the next, and that which is not lowered again.
constexpr int kMostLevels = 24;
constexpr double kRaise = 2, kLeastRaise = 1.1;

class Shaping {
 public:
  Shaping(SheetSolver& solver, const ShapeOptions& options)
      : options_(options), descent_(solver, options) {}

  StudyResult<ShapeStudy> run() {
    const double shape_deg = options_.at_deg + options_.beyond_deg;
    if (!descent_.begin(WantedRows(shape_deg))) return NoResult::path_lost;
    if (options_.kind == ShapeKind::free) {
      climb_in_curvature();
      keep_best();
    } else {
      // The fold limit rises after the curvature, or is asked for from the start.
      for (const double limit_deg : {shape_deg, stowed_deg()}) {
        descent_.begin(WantedRows(limit_deg));
        climb_in_curvature();
        raise_limit();
        hold();
        if (best_->is_good()) break;
      }
    }
    descent_.move_to(std::move(best_->state));
    descent_.wanted() = best_->wanted;
    if (auto fault = keep_floors()) return *fault;
    return result();
  }

 private:
  // A sheet that is held at its shape, and how far it is from what is asked for: its misfit, with
  // the degrees of its path that are missing.
  struct Held {
    ShapeDescent::State state;
    WantedRows wanted;
    double off_mm, width_mm;
    bool is_good() const { return off_mm < kPoorMisfit * width_mm; }
  };

  const ShapeDescent::State& now() const { return descent_.now(); }
  WantedRows& wanted() { return descent_.wanted(); }
  bool is_poor() const { return now().misfit.rms_mm() > kPoorMisfit * descent_.width_mm(); }
  double top_deg() const { return options_.from_deg + kPast_deg; }
  double stowed_deg() const { return options_.from_deg + options_.beyond_deg; }

  // A stage that ends far from its surface is repeated from the one before it, nearer to that;
  // where this does not help either, the surface is out of reach, and stages are not repeated any
  // more.
  void climb_in_curvature() {
    const double whole = descent_.whole_curvature();
    const double usual = std::max(kCurvatureStep, whole / kMostStages);
    double share = 0, growth = std::max(kFirstCurvature, usual);
    bool is_in_reach = true;
    while (share < 1 && whole > 0) {
      const Matrix2Xd before_mm = now().sheet->shifts_mm();
      const ShapePose before = now().pose;
      const double next = std::min(1.0, share + growth / whole);
      descent_.set_share(next);
      descent_.refresh();
      descent_.improve();
      if (is_poor() && is_in_reach && growth > kLeastStep) {
        growth = std::max(kLeastStep, growth / 2);
        descent_.set_share(share);
        descent_.move_to(before_mm, before);
        continue;
      }
      share = next;
      is_in_reach = is_in_reach && !is_poor();
      growth = is_in_reach ? std::min(growth, usual) : usual;
    }
  }

  // The fold limit rises by levels to beyond the stowed angle.
  void raise_limit() {
    while (wanted().limit_deg < stowed_deg()) {
      const double reached_deg = std::max(now().sheet->way()->end_deg(), wanted().limit_deg);
      wanted().limit_deg = std::min(reached_deg + kLimitStep_deg, stowed_deg());
      descent_.refresh();
      descent_.improve();
    }
  }

  // Directions are those of the shape alone, by the lengths at one angle; of two diagonals of a
  // hole that both grow the smaller is turned.
  void hold() {
    if (options_.kind != ShapeKind::rest) {
      wanted() = WantedRows(stowed_deg());
      wanted().has_wells = true;
      set_angles();
      refine();
      return keep_best();
    }
    const Matrix2Xd shape_mm = now().sheet->shifts_mm();
    const ShapePose shape_pose = now().pose;
    const double end_deg = std::min(now().sheet->way()->end_deg() - 1, options_.from_deg);
    for (const double by_deg : {std::min(kSigns_deg, end_deg), end_deg}) {
      wanted() = WantedRows(stowed_deg());
      if (!descent_.move_to(shape_mm, shape_pose)) continue;
      choose_directions(by_deg);
      refine();
      keep_best();
      if (best_->is_good()) return;
    }
    if (!best_) keep_best();
  }

  void keep_best() {
    const double missing_deg = std::max(0.0, options_.from_deg - driven_from_deg());
    const double off_mm = now().misfit.rms_mm() + kPerDegree * descent_.width_mm() * missing_deg;
    if (best_ && best_->off_mm <= off_mm) return;
    best_.emplace(Held{descent_.take(), wanted(), off_mm, descent_.width_mm()});
  }

  double driven_from_deg() const {
    const double end_deg = std::min(now().sheet->way()->end_deg(), options_.from_deg);
    switch (options_.kind) {
      case ShapeKind::free:
        return 0;
      case ShapeKind::bistable:
        return end_deg;
      case ShapeKind::rest:
        return std::min(now().sheet->deploys_from_deg(), end_deg);
      case ShapeKind::rest_by_energy:
        break;
    }
    const std::vector<double> turns = turns_deg();
    if (turns.empty()) return end_deg;
    return turns.front() > options_.at_deg ? turns.front() - 1 : 0;
  }

  void choose_directions(double by_deg) {
    const FoldingWay& way = *now().sheet->way();
    VectorXd lengths_mm, rates;
    way.find_lengths(way.x_of(by_deg), lengths_mm, rates);
    const VectorXd longer_mm = lengths_mm - way.flat_mm();
    wanted().sides = longer_mm.unaryExpr([](double mm) { return mm < 0 ? -1.0 : 1.0; });
    for (Index d = 0; d + 1 < longer_mm.size(); d += 2) {
      if (wanted().sides(d) < 0 || wanted().sides(d + 1) < 0) continue;
      wanted().sides(longer_mm(d) < longer_mm(d + 1) ? d : d + 1) = -1;
    }
    for (const int d : options_.turned) wanted().sides(d) = -wanted().sides(d);
    set_angles();
  }

  // The last two lie close together, so that directions turn beyond the stowed angle.
  void set_angles() {
    wanted().angles_deg.clear();
    const int count = static_cast<int>(std::ceil(options_.from_deg / kDirections_deg));
    for (int k = 1; k <= count; ++k) wanted().angles_deg.push_back(options_.from_deg * k / count);
    wanted().angles_deg.push_back(top_deg());
  }

  // Improves by the rows that are wanted, and by more of them where they were too far apart.
  void refine() {
    for (int round = 0; round < kRounds; ++round) {
      descent_.refresh();
      descent_.improve();
      if (!add_angles()) break;
    }
  }

  // Floors rise by levels, from what the sheet has to what is asked for. A level whose sheet leaves
  // its surface is repeated from the one before it, and is lower; the last that keeps it is the
  // end. A fault where a goal has no value.
  std::optional<OptionFault> keep_floors() {
    const auto& floors = options_.keeping.floors;
    if (floors.empty()) return {};
    double raise = kRaise;
    for (int level = 0; level < kMostLevels; ++level) {
      auto levels = floor_levels(*now().sheet, options_, raise);
      if (!levels) break;
      const Matrix2Xd before_mm = now().sheet->shifts_mm();
      const ShapePose before = now().pose;
      const bool was_poor = is_poor();
      wanted().floors = *std::move(levels);
      refine();
      if (is_poor() && !was_poor) {
        descent_.move_to(before_mm, before);
        if (raise < kLeastRaise) break;
        raise = std::sqrt(raise);
        continue;
      }
      const auto is_there = [](const WantedRows::Level& now, const OptimiseFloor& asked) {
        return now.least == asked.least;
      };
      if (std::ranges::equal(wanted().floors, floors, is_there)) return {};
    }
    if (wanted().floors.empty()) return no_value(floors);
    for (std::size_t k = 0; k < floors.size(); ++k) wanted().floors[k].least = floors[k].least;
    descent_.refresh();
    return {};
  }

  std::optional<OptionFault> no_value(const std::vector<OptimiseFloor>& floors) const {
    const auto has_none = [&](const OptimiseFloor& floor) {
      return !value_of(*floor.goal, *now().sheet, options_.keeping);
    };
    const auto first = std::ranges::find_if(floors, has_none);
    const Goal& goal = *(first == floors.end() ? floors.front() : *first).goal;
    return OptionFault{"subject_to", std::string(goal.name),
                       "has no value, or no gradient, at the shape without it",
                       "take it out, and call `misalign optimise` for the shaped sheet"};
  }

  // Angles where a diagonal, or the energy, turns back.
  std::vector<double> turns_deg() const {
    const double to_deg = std::min(top_deg(), now().sheet->way()->end_deg());
    if (options_.kind == ShapeKind::rest_by_energy) {
      return energy_turns_deg(*now().sheet, options_.at_deg, to_deg);
    }
    std::vector<double> all_deg;
    if (options_.kind != ShapeKind::rest) return all_deg;
    for (const LowSlope& low : low_slopes(*now().sheet, to_deg)) {
      if (low.mm_per_deg <= 0) all_deg.push_back(low.pilot_deg);
    }
    return all_deg;
  }

  // Adds angles around these. Returns false where there are none.
  bool add_angles() {
    std::vector<double> more_deg;
    for (const double turn_deg : turns_deg()) {
      for (const double off_deg : {-kAround_deg, kAround_deg}) {
        more_deg.push_back(std::round(std::clamp(turn_deg + off_deg, 1.0, top_deg())));
      }
    }
    const std::size_t before = wanted().angles_deg.size();
    std::vector<double>& all_deg = wanted().angles_deg;
    for (const double angle_deg : more_deg) {
      const auto is_near = [&](double other) { return std::abs(other - angle_deg) < 0.9; };
      if (std::ranges::none_of(all_deg, is_near)) all_deg.push_back(angle_deg);
    }
    std::ranges::sort(all_deg);
    return all_deg.size() > before;
  }

  ShapeStudy result() const {
    ShapeStudy study;
    study.shifts_mm = now().sheet->shifts_mm();
    study.pose = now().pose;
    study.sides = descent_.target().sides;
    study.rms_mm = now().misfit.rms_mm();
    study.max_mm = now().misfit.max_mm();
    study.steps = descent_.steps();
    study.evaluations = descent_.evaluations();
    study.deploys_from_deg = now().sheet->deploys_from_deg();
    study.driven_from_deg = driven_from_deg();
    study.limits = descent_.limits();
    study.is_reached = study.rms_mm < kPoorMisfit * descent_.width_mm() &&
                       std::ranges::all_of(study.limits, [](const ShapeLimit& limit) {
                         return limit.missing == 0;
                       });
    return study;
  }

  const ShapeOptions& options_;
  ShapeDescent descent_;
  std::optional<Held> best_;
};

}  // namespace

StudyResult<ShapeStudy> shape(SheetSolver& solver, const ShapeOptions& options) {
  assert(options.at_deg > 0 && options.from_deg > options.at_deg);
  if (solver.model().is_overconstrained()) return NoResult::overconstrained;
  return Shaping(solver, options).run();
}

}  // namespace misalign::solver

// Descends to a sheet of the least merit for a target and rows that are given: sequential quadratic
// programs within a box (trust region).
#pragma once

#include <memory>
#include <optional>

#include "solver/shape/shape_merit.hpp"
#include "solver/shape/shape_options.hpp"

namespace misalign::solver {

/// A limit of a shaped sheet and its price: the share of the merit by which it falls, to first
/// order, where the row is relaxed by one unit, mm, or degrees of fold angles and limits.
struct ShapeLimit {
  ShapeRow::Kind kind;
  int where;
  double pilot_deg;
  double missing;  ///< violation, in the same unit
  double price;
};

class ShapeDescent {
 public:
  /// A sheet on the target.
  struct State {
    std::unique_ptr<const Sheet> sheet;
    ShapePose pose;
    ShapeMisfit misfit;
    double merit;
  };

  /// `solver` and `options` must outlive this object.
  ShapeDescent(SheetSolver& solver, const ShapeOptions& options);

  /// Lays the base, and the start as it, on the target without its curvature. False where they do
  /// not fold to the shape.
  bool begin(const WantedRows& wanted);
  /// The whole target's curvature times the sheet's width; of places that of the arc by which they
  /// rise.
  double whole_curvature() const;
  /// Sets the share of the target's curvature, from 0, a plane or the base's places, to 1.
  void set_share(double share);

  /// The rows beside those of every shape; after a change of them or of the share, `refresh`.
  WantedRows& wanted() { return wanted_; }
  const WantedRows& wanted() const { return wanted_; }
  /// The same sheet with these rows and this share.
  void refresh();
  /// Returns false, and changes nothing, where a sheet is none that can be shaped.
  bool move_to(const Eigen::Matrix2Xd& shifts_mm, const ShapePose& near);
  void move_to(State state) { now_ = std::move(state); }
  /// Takes steps until none gains enough.
  void improve();

  const State& now() const { return now_; }
  /// Leaves this object without a state.
  State take() { return std::move(now_); }
  const ShapeTarget& target() const { return target_; }
  double width_mm() const { return width_mm_; }  ///< a panel's
  int steps() const { return steps_; }
  int evaluations() const { return evaluations_; }
  /// The limits that are violated, and those with the largest prices.
  std::vector<ShapeLimit> limits() const;

 private:
  Eigen::Matrix2Xd start_mm() const;
  std::optional<State> evaluate(const Eigen::Matrix2Xd& shifts_mm, const ShapePose& near);
  std::optional<QuadraticProgram> program(std::vector<ShapeRow>& rows) const;
  QuadraticProgram in_box(const QuadraticProgram& around, double box_mm,
                          std::vector<Eigen::Index>& reached) const;
  double price_of_amplitude(const QuadraticProgram& program, const QuadraticOptimum& best) const;
  std::pair<Eigen::Matrix2Xd, double> best_change(const QuadraticProgram& around,
                                                  double box_mm) const;

  SheetSolver& solver_;
  const ShapeOptions& options_;
  const CreasePattern& base_;
  const double width_mm_, size_mm_;
  const std::vector<int> free_;
  const ShapeMerit merit_;
  ShapeTarget target_;
  std::vector<WantedShape::Place> from_places_;  // on the base
  WantedRows wanted_;
  State now_;
  int steps_ = 0, evaluations_ = 0;
};

}  // namespace misalign::solver

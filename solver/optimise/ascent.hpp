// The ascent of an optimisation (optimise.hpp), one evaluation at a time, for callers that must not
// wait for its end.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "solver/optimise/local_model.hpp"

namespace misalign::solver {

class Ascent {
 public:
  /// Continues from fitted_start(). The sheet's model must outlive this object, the sheet need not.
  Ascent(const Sheet& start, Optimised fitted);
  Ascent(const Ascent&) = delete;
  Ascent& operator=(const Ascent&) = delete;

  bool finished() const { return finished_; }
  /// Evaluates one more sheet, or linearises around the current one.
  void advance();
  /// The current sheet, with its record.
  const Sheet& reached() const { return *now_.sheet; }
  Optimised release() { return std::move(result_); }

 private:
  // A feasible sheet, with its springs and the value of the goal.
  struct Feasible {
    std::unique_ptr<const Sheet> sheet;
    DesignPoint point;
    double value;
  };
  // A change of one variable or two, and the foreseen gain of the goal.
  struct Flip {
    std::array<Eigen::Index, 2> coordinate;  // twice the same: one variable
    std::array<double, 2> by_mm;
    double foreseen = 0;

    double along(const Eigen::VectorXd& row) const {
      return by_mm[0] * row(coordinate[0]) + by_mm[1] * row(coordinate[1]);
    }
  };
  // The changes that are tried next: those of a linear program in a box, or flips: first those with
  // the largest foreseen gain, then all single ones.
  enum class Trying { in_a_box, promising_flips, single_flips };

  void begin_step();
  void end(Optimised::StopReason why);
  void try_box();
  void begin_flips();
  void try_flip();
  void give_up_box();
  void take_step(Feasible next);

  std::optional<Feasible> evaluate(const Eigen::VectorXd& change_mm);
  double least_foreseen() const;
  double least_gain() const;
  double goal_after(const Flip& flip) const;
  bool may_fit(const Flip& flip) const;
  std::vector<Flip> single_flips() const;
  void find_limits();

  OptimiseOptions options_;  // with the springs of the current sheet
  const Coordinates variables_;
  SheetSolver solver_;
  double box_mm_;
  Feasible now_;
  Optimised result_;
  std::optional<LocalModel> linearization_;  // around the current sheet
  Trying trying_ = Trying::in_a_box;
  std::vector<Flip> promising_, singles_;
  std::size_t next_flip_ = 0;
  int evaluations_of_step_ = 0;
  bool finished_ = false;
};

}  // namespace misalign::solver

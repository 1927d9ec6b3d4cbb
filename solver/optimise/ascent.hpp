// Goes from a sheet to better ones near it, a look at a time: one part of an optimisation
// (optimise.hpp), for callers that must not wait for its end.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "solver/optimise/local_model.hpp"

namespace misalign::solver {

/// What is asked of a sheet, as it fits it, and what it is worth by the goal.
struct AscentStart {
  OptimiseOptions options;
  double value;
};

/// Faults and reasons as of optimise().
StudyResult<AscentStart> fitted_start(const Sheet& start, const OptimiseOptions& options);

class Ascent {
 public:
  /// The sheet's model must outlive this object, the sheet need not.
  Ascent(const Sheet& start, AscentStart fitted);
  Ascent(const Ascent&) = delete;
  Ascent& operator=(const Ascent&) = delete;

  bool finished() const { return finished_; }
  /// Looks at one more sheet, or at how those around the one that was reached differ from it.
  void advance();
  /// The sheet that was reached, with what was found of it.
  const Sheet& reached() const { return *now_.sheet; }
  Optimised take() { return std::move(found_); }

 private:
  // A sheet that fits, with its springs, and what it is worth.
  struct Worthy {
    std::unique_ptr<const Sheet> sheet;
    DesignPoint point;
    double value;
  };
  // A change of one coordinate or two, and what it would be worth.
  struct Flip {
    std::array<Eigen::Index, 2> coordinate;  // the same twice: of one
    std::array<double, 2> by_mm;
    double foreseen = 0;

    double along(const Eigen::VectorXd& row) const {
      return by_mm[0] * row(coordinate[0]) + by_mm[1] * row(coordinate[1]);
    }
  };
  // The changes that are tried next: those of a linear program in a box, or flips in their order:
  // those that promise most, then all single ones.
  enum class Trying { in_a_box, promising_flips, single_flips };

  void begin_step();
  void end(OptimiseEnd why);
  void try_box();
  void begin_flips();
  void try_flip();
  void give_up_box();
  void take_step(Worthy next);

  std::optional<Worthy> look(const Eigen::VectorXd& change_mm);
  double least_foreseen() const;
  double goal_after(const Flip& flip) const;
  bool may_fit(const Flip& flip) const;
  std::vector<Flip> single_flips() const;
  void find_limits();

  OptimiseOptions options_;  // with the springs of the sheet that was reached
  const Coordinates by_;
  SheetSolver solver_;
  double box_mm_;
  Worthy now_;
  Optimised found_{};
  std::optional<LocalModel> around_;  // the sheet that was reached
  Trying trying_ = Trying::in_a_box;
  std::vector<Flip> promising_, singles_;
  std::size_t next_flip_ = 0;
  int looks_of_step_ = 0;
  bool finished_ = false;
};

}  // namespace misalign::solver

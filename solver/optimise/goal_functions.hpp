// The functions of each goal of an optimisation. To add a goal: its row in studies/goal.cpp, its
// value and its row here, its linearisation in local_goals.
#pragma once

#include <optional>
#include <vector>

#include "solver/optimise/optimise_options.hpp"
#include "solver/studies/goal.hpp"

namespace misalign::solver {

struct GoalTerm;
struct SheetChanges;

/// Values of goals for one sheet, which is bent once for all of them.
class GoalValues {
 public:
  /// `sheet` and `options` must outlive this object.
  GoalValues(const Sheet& sheet, const OptimiseOptions& options)
      : sheet_(sheet), options_(options) {}

  /// The value for a sheet that can be released, with the sign of Goal::in_unit; none where its
  /// study has no value.
  std::optional<double> value(const Goal& goal);

  const Sheet& sheet() const { return sheet_; }
  const OptimiseOptions& options() const { return options_; }
  const StudyResult<BentPanels>& bent();

 private:
  const Sheet& sheet_;
  const OptimiseOptions& options_;
  std::optional<StudyResult<BentPanels>> bent_;
};
/// The value of one goal alone.
std::optional<double> value_of(const Goal& goal, const Sheet& sheet,
                               const OptimiseOptions& options);
/// The terms next to a sheet, to first order in its shifts and springs.
std::vector<GoalTerm> linearization_of(const Goal& goal, SheetChanges& changes);

}  // namespace misalign::solver

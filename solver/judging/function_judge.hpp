// Judges a path that is a function by its polynomials at every sample. If the verdict depends on
// their errors the sheet is left to close steps.
#pragma once

#include <optional>
#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/judging/function_bumps.hpp"

namespace misalign::solver {

class FunctionJudge {
 public:
  /// Bumps are ignored or exact; cubics between samples are for close steps.
  explicit FunctionJudge(const Mechanism& mechanism, const Criterion& criterion = {});
  ~FunctionJudge();
  FunctionJudge(const FunctionJudge&);

  /// `geometry` as for Judge::begin.
  void begin(const PathPlan& plan, const std::vector<double>& flat_lengths,
             const SheetGeometry<double>* geometry = nullptr);
  /// Judges the new samples of the newest segment; returns `enough` once a fault is known.
  ObserverResult see(const PathFunction& function);
  /// The verdict once the path has ended; none if it is not certain, or depends on the rest of a
  /// lost path.
  std::optional<Verdict> conclude(const PathResult& path) const;

  /// Number of samples in order so far, and the lengths at each (panel widths).
  int samples_in_order() const { return samples_; }
  const double* lengths_at(int sample) const {
    return rows_.data() + static_cast<std::size_t>(sample - 1) * last_.size();
  }
  const Judge& judge() const { return judge_; }

 private:
  ObserverResult see_sample(const Station& station, double x, bool creases_in_order,
                            const PathFunction& function);
  std::optional<bool> find_creases(double x, const PathFunction& function);
  bool is_decisive();
  bool score_is_certain(double x, const PathFunction& function);
  std::optional<double> find_where_goes_back(const Station& station, double rate,
                                             const PathFunction& function);
  std::optional<bool> find_stop_stiff(double x, const PathFunction& function);
  ObserverResult see_drive(const Station& station, double x, const PathFunction& function);
  void know_last_better(const PathFunction& function);
  ObserverResult lost() {
    is_sure_ = false;
    return ObserverResult::lost;
  }
  ObserverResult unsure() {
    is_sure_ = false;
    return ObserverResult::unsure;
  }

  const Mechanism& mechanism_;
  const Criterion criterion_;
  Judge judge_;
  const PathPlan* plan_ = nullptr;
  std::size_t next_ = 0;
  bool is_sure_ = true, fault_known_ = false;
  double last_rad_ = 0, limit_error_rad_ = 0;
  PathFunction::Estimate estimate_, again_;
  int samples_ = 0;
  std::vector<double> last_, last_errors_, before_last_errors_, rows_;
  FoldState<double> state_;
  std::optional<FunctionBumps> bumps_;  // if bumps are exact
};

}  // namespace misalign::solver

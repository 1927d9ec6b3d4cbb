// The verdict on a path that is a function: at every sample whatever its polynomials say for
// certain. What hangs on their error is not said: such a sheet is for the close steps.
#pragma once

#include <optional>
#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/judging/function_bumps.hpp"

namespace misalign::solver {

class FunctionJudge {
 public:
  /// Bumps are ignored or looked for exactly; cubics between samples are for close steps.
  explicit FunctionJudge(const Mechanism& mechanism, const Criterion& criterion = {});
  ~FunctionJudge();
  FunctionJudge(const FunctionJudge&);

  void begin(const PathPlan& plan, const std::vector<double>& flat_lengths);
  /// Looks at the samples of the newest segment that it has not seen yet: enough once a fault is
  /// known.
  ObserverResult see(const PathFunction& function);
  /// The verdict once the path has ended; nothing where that is not certain, or would need to know
  /// how a path goes on that was lost.
  std::optional<Verdict> conclude(const PathResult& path) const;

  /// How many samples are in order so far; the lengths at them, sample by sample (panel widths).
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
  PathFunction::Estimate here_, again_;
  int samples_ = 0;
  std::vector<double> last_, last_errors_, before_last_errors_, rows_;
  FoldState<double> state_;
  std::optional<FunctionBumps> bumps_;  // where they are looked for
};

}  // namespace misalign::solver

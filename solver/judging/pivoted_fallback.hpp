// Follows the rare paths that the fixed order of elimination does not suit again, by factors with
// pivoting. Their verdict is final.
#pragma once

#include <memory>
#include <vector>

#include "solver/continuation/path_follower.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/linear/pivoted_closure.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// The second pass of an observer of full paths. In the first pass it considers every path that has
/// ended, and keeps two kinds of sheets: those whose path was lost, and those whose verdict depends
/// on a fold limit within 1e-3 degrees of 180, where the fixed order's factors are poor and false
/// limits were seen.
class PivotedFallback {
 public:
  /// `mechanism` must outlive this object, whose matrices are made when first needed.
  explicit PivotedFallback(const Mechanism& mechanism);
  ~PivotedFallback();

  /// Returns whether a path's end lies so close to 180 degrees that only pivoting can decide.
  static bool is_doubtful(const PathResult& path);
  /// Begins a block.
  void begin() {
    candidates_.clear();
    under_way_ = false;
  }
  /// Returns whether the second pass is under way.
  bool under_way() const { return under_way_; }
  /// Considers a sheet's path that ended in the first pass; returns true if it is kept.
  bool consider(int sheet, const Verdict& verdict, const PathResult& path);
  /// Returns whether the verdict of the second pass counts: if the first pass was undecided
  /// or this one has decided. A fault before a path was lost stands.
  bool counts(int sheet, const Verdict& second) const;
  /// Follows the kept sheets again.
  template <class Observer>
  void run(SheetQueue& queue, Observer& observer) {
    if (candidates_.empty()) return;
    queue.begin_again(sheets());
    under_way_ = true;
    follow(queue, observer);
    under_way_ = false;
  }
  /// Follows all sheets of the queue, kept or not.
  template <class Observer>
  void follow(SheetQueue& queue, Observer& observer) {
    follower().run(queue, observer);
  }

 private:
  using Follower = PathFollower<double, CloseSteps, PivotedClosure<ClosureSystem>>;
  struct Candidate {
    int sheet;
    bool was_lost, was_undecided;
  };

  Follower& follower();
  const std::vector<int>& sheets();

  const Mechanism& mechanism_;
  std::unique_ptr<ClosureSystem> system_;
  std::unique_ptr<Follower> follower_;
  std::vector<Candidate> candidates_;
  std::vector<int> sheets_;
  bool under_way_ = false;
};

}  // namespace misalign::solver

// The way out for the rare path that the fixed order of elimination does not suit: the same path
// once more, by dense matrices with pivoting. Nothing else judges after them.
#pragma once

#include <memory>
#include <vector>

#include "solver/continuation/path_follower.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/linear/dense_closure.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// The second pass of an observer of full paths. It is asked of every path that has ended; in the
/// first pass it keeps which sheets are for dense matrices:
/// - paths that were lost;
/// - verdicts that hang on a fold limit within 1e-3 degrees of 180, where the fixed order's factors
///   are poor and false limits were seen.
class DenseFallback {
 public:
  /// `mechanism` must outlive this object, whose matrices are made when first needed.
  explicit DenseFallback(const Mechanism& mechanism);
  ~DenseFallback();

  /// Whether a path's end lies so close to 180 degrees that only dense matrices can tell it.
  static bool is_doubtful(const PathResult& path);
  /// A new block.
  void begin() {
    candidates_.clear();
    under_way_ = false;
  }
  /// Whether the second pass goes on.
  bool under_way() const { return under_way_; }
  /// Of the first pass: how a sheet's path ended; true if it is kept.
  bool consider(int sheet, const Verdict& verdict, const PathResult& path);
  /// Of the second: whether the dense verdict counts. It does where the first pass is undecided, or
  /// where this one decided; what was seen before a path was lost stays said.
  bool counts(int sheet, const Verdict& dense) const;
  /// Follows the sheets that were kept once more.
  template <class Observer>
  void run(SheetQueue& queue, Observer& observer) {
    if (candidates_.empty()) return;
    queue.begin_again(sheets());
    under_way_ = true;
    follow(queue, observer);
    under_way_ = false;
  }
  /// Follows what the queue hands out, whatever was kept.
  template <class Observer>
  void follow(SheetQueue& queue, Observer& observer) {
    follower().run(queue, observer);
  }

 private:
  using Follower = PathFollower<double, CloseSteps, DenseClosure<ClosureSystem>>;
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

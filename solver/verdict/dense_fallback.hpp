// The way out for the rare path that the fixed order of elimination does not suit: the same path
// once more, by dense matrices with pivoting. Nothing else judges after them.
#pragma once

#include <memory>

#include "solver/continuation/path_follower.hpp"
#include "solver/linear/dense_closure.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// Whether dense matrices are to have a say: a path was lost; or its verdict hangs on a fold limit
/// within 1e-3 degrees of 180, where the fixed order's factors are poor and false limits were seen
/// (within 1e-4).
bool is_for_dense_matrices(const Verdict& verdict, const PathResult& path);

/// The verdict of both: the dense one where the first is undecided, or where that one decided; but
/// what was seen before a path was lost stays said.
bool dense_verdict_counts(const Verdict& fixed_order, const PathResult& path, const Verdict& dense);

/// A path follower by dense matrices, made when first needed.
class DenseFollower {
 public:
  /// `mechanism` must outlive this object.
  explicit DenseFollower(const Mechanism& mechanism);
  ~DenseFollower();

  template <class Observer>
  void run(Observer& observer) {
    follower().run(observer);
  }

 private:
  using Follower = PathFollower<double, DenseClosure<ClosureSystem>>;
  Follower& follower();

  const Mechanism& mechanism_;
  std::unique_ptr<ClosureSystem> system_;
  std::unique_ptr<Follower> follower_;
};

}  // namespace misalign::solver

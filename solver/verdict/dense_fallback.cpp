#include "solver/verdict/dense_fallback.hpp"

namespace misalign::solver {

bool is_for_dense_matrices(const Verdict& verdict, const PathResult& path) {
  return path.lost() ||
         (verdict.first_fault == Fault::fold_limit && path.fold_limit_deg > 180 - 1e-3);
}

bool dense_verdict_counts(const Verdict& fixed_order, const PathResult& path,
                          const Verdict& dense) {
  return path.lost() ? fixed_order.first_fault == Fault::undecided
                     : dense.first_fault != Fault::undecided;
}

DenseFollower::DenseFollower(const Mechanism& mechanism) : mechanism_(mechanism) {}

DenseFollower::~DenseFollower() = default;

DenseFollower::Follower& DenseFollower::follower() {
  if (!follower_) {
    system_ = std::make_unique<ClosureSystem>(mechanism_);
    follower_ = std::make_unique<Follower>(mechanism_, DenseClosure(*system_));
  }
  return *follower_;
}

}  // namespace misalign::solver

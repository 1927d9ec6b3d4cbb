#include "solver/verdict/dense_fallback.hpp"

namespace misalign::solver {
namespace {

// Of 13 paths that end at 180 degrees, where another branch crosses, dense matrices come to within
// 4e-7 degrees of it.
constexpr double kSingularGap_deg = 1e-5;

// False limits were seen within 1e-4 degrees of 180.
constexpr double kDoubtfulLimitsFrom_deg = 180 - 1e-3;

}  // namespace

bool is_for_dense_matrices(const Verdict& verdict, const PathResult& path) {
  return path.lost() || (verdict.first_fault == Fault::fold_limit &&
                         path.fold_limit_deg > kDoubtfulLimitsFrom_deg);
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
    StepControlOptions options;
    options.arc.singular_gap_rad = kSingularGap_deg * kRadPerDeg;
    follower_ = std::make_unique<Follower>(mechanism_, DenseClosure(*system_), options);
  }
  return *follower_;
}

}  // namespace misalign::solver

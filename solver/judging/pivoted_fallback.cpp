#include "solver/judging/pivoted_fallback.hpp"

#include <algorithm>

namespace misalign::solver {
namespace {

// Largest distance of a singular station. Factors with pivoting reach 180 degrees within 4e-7 on 13
// paths that end there, where another branch crosses.
constexpr double kSingularGap_deg = 1e-5;

// False limits were seen within 1e-4 degrees of 180.
constexpr double kDoubtfulLimitsFrom_deg = 180 - 1e-3;

}  // namespace

PivotedFallback::PivotedFallback(const Mechanism& mechanism) : mechanism_(mechanism) {}

PivotedFallback::~PivotedFallback() = default;

bool PivotedFallback::consider(int sheet, const Verdict& verdict, const PathResult& path) {
  const bool hangs_on_it = verdict.first_fault == Fault::fold_limit && is_doubtful(path);
  if (!path.lost() && !hangs_on_it) return false;
  // A diagonal that is inactive where the path was lost may move beyond.
  const bool is_open =
      verdict.first_fault == Fault::undecided || verdict.first_fault == Fault::inactive_diagonal;
  candidates_.push_back({sheet, path.lost(), is_open});
  return true;
}

bool PivotedFallback::counts(int sheet, const Verdict& second) const {
  const auto first =
      std::find_if(candidates_.begin(), candidates_.end(),
                   [&](const Candidate& candidate) { return candidate.sheet == sheet; });
  return first->was_lost ? first->was_undecided : second.first_fault != Fault::undecided;
}

bool PivotedFallback::is_doubtful(const PathResult& path) {
  return path.end == PathEnd::fold_limit && path.fold_limit_deg > kDoubtfulLimitsFrom_deg;
}

const std::vector<int>& PivotedFallback::sheets() {
  sheets_.clear();
  for (const Candidate& candidate : candidates_) sheets_.push_back(candidate.sheet);
  return sheets_;
}

PivotedFallback::Follower& PivotedFallback::follower() {
  if (!follower_) {
    system_ = std::make_unique<ClosureSystem>(mechanism_);
    CloseSteps::Options options;
    options.arc.singular_gap_rad = kSingularGap_deg * kRadPerDeg;
    follower_ = std::make_unique<Follower>(mechanism_, PivotedClosure(*system_), options);
  }
  return *follower_;
}

}  // namespace misalign::solver

// Follows a homotopy in the shifts (Allgower & Georg, Introduction to Numerical Continuation
// Methods, ch. 1), for sheets too far from the base for Newton's method: the shifts grow from zero
// to those of the sheet, with the pilot held at the first station. It is a path whose pilot is the
// share of the shifts; one is followed in each lane.
#pragma once

#include <array>
#include <span>

#include "solver/continuation/path_follower.hpp"
#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

class StartFinder {
 public:
  /// A sheet that is far from the base, with the homotopy's result. end_reached: `state` is on its
  /// path at the first station. fold_limit: the base folding's branch turns before the shifts are
  /// whole, so this sheet has no such folding next to flat. Anything else is a numerical failure.
  struct FarStart {
    explicit FarStart(const Mechanism& mechanism) : state(flat_state<double>(mechanism)) {}

    int sheet = 0;  ///< its number, for the caller
    SheetGeometry<double> geometry;
    PathEnd end = PathEnd::start_lost;
    FoldState<double> state;
  };

  virtual ~StartFinder();
  /// Finds the start of every sheet.
  virtual void find(std::span<FarStart> sheets) = 0;
};

/// Options and stations of the share's path.
CloseSteps::Options options_of_shares(const HalfAngle<double>& pilot);
PathPlan plan_of_shares(const PathPlan& path, const Mechanism& mechanism);

template <class T>
class ShiftHomotopy final : public StartFinder {
 public:
  /// `mechanism` and `elimination` must outlive this object. `base_vertices_mm` are those of the
  /// unshifted sheet.
  ShiftHomotopy(const Mechanism& mechanism, const Elimination& elimination, const PathPlan& plan,
                const FlatVertices& base_vertices_mm)
      : pilot_(mechanism.pilot),
        first_(plan.stations.front().pilot),
        shares_(plan_of_shares(plan, mechanism)),
        follower_(mechanism, Closure(mechanism, elimination, first_, base_vertices_mm),
                  options_of_shares(first_)) {}

  void find(std::span<FarStart> sheets) override {
    sheets_ = sheets;
    next_ = 0;
    follower_.run(*this, *this);
  }

  // Gives the follower its next path.
  bool next(PathStart& start, int lane) {
    if (next_ == sheets_.size()) return false;
    in_lane_[lane] = next_++;
    start = {&sheets_[in_lane_[lane]].geometry, &shares_.start, &shares_, 0, 0};
    return true;
  }
  bool see(const Station&, int) { return true; }
  void ended(const PathResult& path, int lane) {
    FarStart& sheet = sheets_[in_lane_[lane]];
    sheet.end = path.end;
    copy_lane(follower_.state(), lane, sheet.state);
    sheet.state.creases[pilot_] = first_;
  }

 private:
  // Loop closure of sheets with a share of their shifts, factored in the fixed order; a policy of
  // PathFollower, like SparseClosure. The pilot crease of a state represents the share: half_sine /
  // that of the first station. The joint itself is held there. Its column of the Jacobian is the
  // share's, which occurs in every equation and is kept beside the sparse factors.
  class Closure {
   public:
    // `mechanism` and `elimination` must outlive this object.
    Closure(const Mechanism& mechanism, const Elimination& elimination,
            const HalfAngle<double>& pilot, const FlatVertices& base_vertices_mm)
        : mechanism_(mechanism),
          pilot_{T(pilot.c), T(pilot.s)},
          base_(in_all_lanes<T>(mechanism, base_vertices_mm)),
          geometry_(base_),
          lu_(elimination),
          state_(flat_state<T>(mechanism)),
          residual_(static_cast<std::size_t>(mechanism.unknowns), T(0)),
          before_(residual_),
          after_(residual_),
          of_residual_(residual_),
          of_share_(residual_),
          work_(residual_) {}

    void restart(int) {}
    T linearize(const SheetGeometry<T>& sheet, const FoldState<T>& state);
    void solve(const T& is_free, T* x, T* null);
    T orientation() const { return lu_.orientation(); }

   private:
    // Difference of shares for the residual's rate of change, with an error of 1e-10 that only
    // affects the tangent.
    static constexpr double kDifference = 1e-5;

    void solve_with(const T& of_residual, const T& partner, const T& share, T* x);

    const Mechanism& mechanism_;
    const HalfAngle<T> pilot_;
    SheetGeometry<T> base_, geometry_;
    SparseLu<T> lu_;
    FoldState<T> state_;
    // Columns with one entry more than equations: the residual and the share's column, then L y of
    // each.
    std::vector<T> residual_, before_, after_, of_residual_, of_share_, work_;
  };

  const int pilot_;
  const HalfAngle<double> first_;
  const PathPlan shares_;
  PathFollower<T, CloseSteps, Closure> follower_;
  std::span<FarStart> sheets_;
  std::size_t next_ = 0;
  std::array<std::size_t, kLanes<T>> in_lane_{};
};

template <class T>
T ShiftHomotopy<T>::Closure::linearize(const SheetGeometry<T>& sheet, const FoldState<T>& state) {
  const HalfAngle<T>& carrier = state.creases[mechanism_.pilot];
  const T share = carrier.s / pilot_.s, difference(kDifference);
  const T per_difference = carrier.c / (T(4) * difference * pilot_.s);
  state_ = state;
  state_.creases[mechanism_.pilot] = pilot_;
  put_between(mechanism_, base_, sheet, share - difference, geometry_);
  evaluate(mechanism_, geometry_, state_, before_.data(), nullptr);
  put_between(mechanism_, base_, sheet, share + difference, geometry_);
  evaluate(mechanism_, geometry_, state_, after_.data(), nullptr);
  put_between(mechanism_, base_, sheet, share, geometry_);
  const T open_by = evaluate(mechanism_, geometry_, state_, residual_.data(), lu_.entries());
  lu_.factorize(residual_.data(), of_residual_.data());
  for (std::size_t i = 0; i < after_.size(); ++i)
    after_[i] = (after_[i] - before_[i]) * per_difference;
  lu_.forward(after_.data(), of_share_.data());
  return open_by;
}

template <class T>
void ShiftHomotopy<T>::Closure::solve(const T& is_free, T* x, T* null) {
  const std::size_t last = static_cast<std::size_t>(mechanism_.equations) - 1;
  const T &of_partner = lu_.partner_coefficient(), &of_share = of_share_[last];
  const auto holds_share =
      magnitude(of_partner) >= select(is_free > T(0), magnitude(of_share), T(0));
  const T& rest = of_residual_[last];
  solve_with(T(1), select(holds_share, rest / of_partner, T(0)),
             select(holds_share, T(0), rest / of_share), x);
  solve_with(T(0), -of_share, of_partner, null);
}

// Solves for `of_residual` times the residual less `share` times its column; `share` and `partner`
// satisfy the last equation.
template <class T>
void ShiftHomotopy<T>::Closure::solve_with(const T& of_residual, const T& partner, const T& share,
                                           T* x) {
  for (std::size_t i = 0; i < work_.size(); ++i) {
    work_[i] = of_residual * of_residual_[i] - share * of_share_[i];
  }
  lu_.backward(work_.data(), partner, T(0), x);
  x[mechanism_.unknowns - 1] = share;
}

}  // namespace misalign::solver

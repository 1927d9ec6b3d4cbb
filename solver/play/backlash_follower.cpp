#include "solver/play/backlash_follower.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "solver/continuation/path_follower.hpp"
#include "solver/linear/pivoted_closure.hpp"
#include "solver/linear/sparse_closure.hpp"
#include "solver/play/miscut_stops.hpp"

namespace misalign::solver {
namespace {

// Largest first correction from the state of the sheet without play, all steps together, as a share
// of the pilot's angle. Farther states are found by growing the play.
constexpr double kLongestLooseShare = 0.1;

// Least growth of the play in one step, as a share of it.
constexpr double kLeastGrowth = 1.0 / 256;

// All branches are close near flat: steps along the arc stay below a degree of all joints together.
constexpr double kLongestArc_rad = 0.02;

CloseSteps::Options step_options() {
  CloseSteps::Options options;
  options.longest_start_share = kLongestLooseShare;
  options.arc.longest_step_rad = kLongestArc_rad;
  return options;
}

// Rates by differences of neighbouring energies.
void find_rates(std::vector<DrivenStation>& stations) {
  for (std::size_t k = 0; stations.size() > 1 && k < stations.size(); ++k) {
    const DrivenStation& below = stations[k == 0 ? 0 : k - 1];
    const DrivenStation& above = stations[std::min(k + 1, stations.size() - 1)];
    stations[k].n_mm_per_deg =
        (above.energy_n_mm - below.energy_n_mm) / (above.pilot_deg - below.pilot_deg);
  }
}

}  // namespace

struct BacklashFollower::Followers {
  // Loop closure of a sheet whose joints have play, in the fixed order. The geometry in the
  // follower, that of the sheet as designed, is ignored.
  class Closure {
   public:
    // All must outlive this object; the sheet may change between paths.
    Closure(const Mechanism& mechanism, const Elimination& elimination,
            const LooseSheet<double>& sheet)
        : closure_(mechanism, elimination), sheet_(sheet) {}

    void restart(int lane) { closure_.restart(lane); }
    double linearize(const SheetGeometry<double>&, const FoldState<double>& state) {
      return closure_.linearize(sheet_, state);
    }
    void solve(double is_free, double* x, double* null) { closure_.solve(is_free, x, null); }
    double orientation() const { return closure_.orientation(); }

   private:
    SparseClosure<double> closure_;
    const LooseSheet<double>& sheet_;
  };

  // Loop closure of the sheet with play.
  class Equations : public ClosureSystem {
   public:
    // Both must outlive this object.
    Equations(const Mechanism& mechanism, const LooseSheet<double>& sheet)
        : ClosureSystem(mechanism), sheet_(sheet) {}

    double evaluate(const SheetGeometry<double>&, const FoldState<double>& state) {
      return ClosureSystem::evaluate(sheet_, state);
    }

   private:
    const LooseSheet<double>& sheet_;
  };

  Followers(const Model& model, const LooseSheet<double>& sheet)
      : equations(model.mechanism(), sheet),
        fixed_order(model.mechanism(), Closure(model.mechanism(), model.elimination(), sheet),
                    step_options()),
        pivoted(model.mechanism(), PivotedClosure(equations), step_options()) {}

  Equations equations;
  PathFollower<double, CloseSteps, Closure> fixed_order;
  PathFollower<double, CloseSteps, PivotedClosure<Equations>> pivoted;
};

// One path, up or down, and its results.
class BacklashFollower::Branch {
 public:
  Branch(const BacklashFollower& follower, const PathPlan& plan, bool is_up, bool only_whether)
      : follower_(follower),
        mechanism_(follower.model_.mechanism()),
        plan_(plan),
        is_up_(is_up),
        only_whether_(only_whether),
        lengths_(mechanism_.diagonals.size()),
        half_sines_(mechanism_.creases.size()) {}

  // Follows the branch with this follower, in the fixed order or with pivoting.
  template <class Follower>
  void follow(Follower& follower) {
    state_ = [&]() -> const FoldState<double>& { return follower.last_state(0); };
    fault_ = Fault::none;
    driven_.clear();
    stations_ = 0;
    one_way_deg_ = last_deg_ = follower_.sheet_.start_deg;
    flipped_deg_ = -1;
    gap_ = 0;
    follower.follow({&follower_.loose_, &follower_.start_, &plan_}, *this);
  }

  // Called by the follower.
  void ended(const PathResult& path, int) {
    path_ = path;
    if (!is_up_ && path.end == PathEnd::fold_limit) find_flip_before_turn();
  }
  bool see(const Station& station, int) {
    const double start_deg = follower_.sheet_.start_deg, from_deg = follower_.options_.from_deg;
    const double pilot_deg = is_up_ ? station.pilot_deg : start_deg - station.pilot_deg;
    if (stations_ == 0) first_ = state_();
    const Fault of_creases = check_creases(pilot_deg);
    const bool counts = pilot_deg > from_deg - kSameAngle_deg;
    if (counts) {
      const Fault of_diagonals = check_diagonals();
      if (fault_ == Fault::none) {
        fault_ = of_creases == Fault::none ? of_diagonals : of_creases;
        if (fault_ == Fault::none) one_way_deg_ = pilot_deg;
      }
      if (!only_whether_) look(pilot_deg);
    }
    ++stations_;
    last_deg_ = pilot_deg;
    if (of_creases != Fault::none) return false;
    if (fault_ != Fault::none && (is_up_ || only_whether_)) return false;
    return is_up_ || !only_whether_ || pilot_deg > from_deg + kSameAngle_deg;
  }

  // Fault that ends the range in one way; the fold limit of the path, if nothing else does.
  Fault fault() const {
    const bool falls_short = is_up_ || last_deg_ > follower_.options_.from_deg + kSameAngle_deg;
    return fault_ == Fault::none && path_.end == PathEnd::fold_limit && falls_short
               ? Fault::fold_limit
               : fault_;
  }
  double one_way_deg() const { return one_way_deg_; }
  double gap() const { return gap_; }
  // Energies of the filling at all stations that count, without rates.
  const std::vector<DrivenStation>& driven() const { return driven_; }
  const PathResult& path() const { return path_; }
  const FoldState<double>& first() const { return first_; }
  // End of the branch on the way down, and its angle.
  BacklashTrial::BranchEnd branch_end() const {
    switch (path_.end) {
      case PathEnd::end_reached:
        return BacklashTrial::BranchEnd::flat;
      case PathEnd::fold_limit:
        return flipped_deg_ > 0 ? BacklashTrial::BranchEnd::other_branch
                                : BacklashTrial::BranchEnd::turns;
      case PathEnd::stopped:
        return BacklashTrial::BranchEnd::other_branch;
      default:
        return BacklashTrial::BranchEnd::not_known;
    }
  }
  double branch_end_deg() const {
    if (branch_end() == BacklashTrial::BranchEnd::other_branch) return flipped_deg_;
    return std::max(0.0, follower_.sheet_.start_deg - path_.fold_limit_deg);
  }

 private:
  // The pilot's entry is another angle on the way down; the pilot itself is positive.
  Fault check_creases(double pilot_deg) {
    Fault fault = Fault::none;
    double flipped_deg = -1;
    for (int i = 0; i < static_cast<int>(mechanism_.creases.size()); ++i) {
      if (!is_up_ && i == mechanism_.pilot) continue;
      const HalfAngle<double>& rho = state_().creases[i];
      const double now = rho.s * mechanism_.creases[i].assignment;
      const double before = std::exchange(half_sines_[i], now);
      if (rho.c < kLeastCosine) fault = Fault::over_folded;
      if (now > 0) continue;
      if (fault == Fault::none) fault = Fault::assignment_flipped;
      const double share = stations_ > 0 ? before / (before - now) : 1;
      flipped_deg = std::max(flipped_deg, last_deg_ + share * (pilot_deg - last_deg_));
    }
    flipped_deg_ = flipped_deg < 0 && fault != Fault::none ? pilot_deg : flipped_deg;
    return fault;
  }

  // Finds where a crease has passed 0 since the last station. Near a limit point, where the last
  // accepted state lies, creases are linear in the root of the pilot's distance from it.
  void find_flip_before_turn() {
    const double limit_deg = follower_.sheet_.start_deg - path_.fold_limit_deg;
    for (int i = 0; i < static_cast<int>(mechanism_.creases.size()); ++i) {
      if (i == mechanism_.pilot) continue;
      const double now = state_().creases[i].s * mechanism_.creases[i].assignment;
      if (now > 0) continue;
      const double share = now / (now - half_sines_[i]);
      const double passed_deg = limit_deg + share * share * (last_deg_ - limit_deg);
      flipped_deg_ = std::max(flipped_deg_, passed_deg);
    }
  }

  Fault check_diagonals() {
    std::swap(lengths_, last_lengths_);
    lengths_.resize(last_lengths_.size());
    folded_lengths(mechanism_, follower_.loose_, state_(), lengths_.data());
    if (stations_ == 0) return Fault::none;
    const int up = is_up_ ? 1 : -1;
    for (std::size_t k = 0; k < lengths_.size(); ++k) {
      const double step = up * follower_.sheet_.directions[k] * (lengths_[k] - last_lengths_[k]);
      if (step <= -kStepBand_widths) return Fault::not_monotone;
    }
    return Fault::none;
  }

  void look(double pilot_deg) {
    gap_ = std::max(gap_, vertex_gap(mechanism_, follower_.loose_, state_()));
    if (!follower_.sheet_.filling) return;
    const Eigen::VectorXd lengths_mm =
        Eigen::VectorXd::Map(lengths_.data(), std::ssize(lengths_)) * mechanism_.panel_width_mm;
    driven_.push_back({pilot_deg, follower_.sheet_.filling->energy_n_mm(lengths_mm), 0});
  }

  const BacklashFollower& follower_;
  const Mechanism& mechanism_;
  const PathPlan& plan_;
  const bool is_up_, only_whether_;
  std::function<const FoldState<double>&()> state_;  // last accepted state
  int stations_ = 0;
  Fault fault_ = Fault::none;
  double one_way_deg_ = 0, last_deg_ = 0, flipped_deg_ = 0, gap_ = 0;
  std::vector<double> lengths_, last_lengths_, half_sines_;
  std::vector<DrivenStation> driven_;
  FoldState<double> first_;
  PathResult path_{};
};

BacklashFollower::BacklashFollower(const Model& model, const BacklashStart& sheet,
                                   const BacklashOptions& options)
    : model_(model),
      sheet_(sheet),
      options_(options),
      up_(plan_up(sheet, model.sample_deg())),
      down_(plan_down(sheet, model.sample_deg(), options)),
      loose_{sheet.geometry, {}, {}},
      start_(sheet.start),
      followers_(std::make_unique<Followers>(model, loose_)) {}

BacklashFollower::~BacklashFollower() = default;

// Follows in the fixed order, or where that is lost with pivoting.
PathResult BacklashFollower::follow(Branch& branch) {
  branch.follow(followers_->fixed_order);
  if (branch.path().lost()) branch.follow(followers_->pivoted);
  return branch.path();
}

// Grows the play from the state of the sheet without play, the pilot held.
void BacklashFollower::find_start(const JointOffsets& offsets, double scale) {
  PathPlan plan;
  plan.stations.push_back(up_.stations.front());
  double share = 0, growth = 0.5;
  while (share < 1 && growth >= kLeastGrowth) {
    const double next = std::min(1.0, share + growth);
    loosen(model_.mechanism(), sheet_.geometry, offsets, next * scale, loose_);
    Branch branch(*this, plan, true, true);
    if (follow(branch).lost()) {
      growth *= 0.5;
      continue;
    }
    start_ = branch.first();
    share = next;
  }
  loosen(model_.mechanism(), sheet_.geometry, offsets, scale, loose_);
}

BacklashTrial BacklashFollower::trial(const JointOffsets& offsets, double scale,
                                      bool only_whether) {
  BacklashTrial trial;
  assert(scale >= 0);
  loosen(model_.mechanism(), sheet_.geometry, offsets, scale, loose_);
  start_ = sheet_.start;
  Branch up(*this, up_, true, only_whether);
  if (follow(up).end == PathEnd::start_lost) {
    find_start(offsets, scale);
    follow(up);
  }
  trial.is_known = !up.path().lost();
  trial.one_way_to_deg = up.one_way_deg();
  trial.one_way_from_deg = sheet_.start_deg;
  trial.fault = up.fault();
  if (!trial.is_known || (only_whether && trial.fault != Fault::none)) return trial;
  start_ = up.first();
  start_.creases[model_.mechanism().pilot] = {1, 0};
  count_pilot_down(model_.mechanism(), up_.stations.front().pilot, loose_);
  Branch down(*this, down_, false, only_whether);
  const bool is_lost = follow(down).lost();
  trial.one_way_from_deg = down.one_way_deg();
  if (trial.fault == Fault::none) trial.fault = down.fault();
  trial.is_known = !is_lost || trial.fault != Fault::none ||
                   down.one_way_deg() <= options_.from_deg + kSameAngle_deg;
  trial.lost = down.branch_end();
  trial.lost_deg = down.branch_end_deg();
  trial.gap_widths = std::max(up.gap(), down.gap());
  if (sheet_.filling && !only_whether) {
    std::vector<DrivenStation> driven(down.driven().rbegin(), down.driven().rend());
    // Both branches begin at the start.
    if (!up.driven().empty()) {
      driven.insert(driven.end(), up.driven().begin() + 1, up.driven().end());
    }
    find_rates(driven);
    if (!driven.empty()) trial.stop_deg = stop_deg(driven, driven.back().pilot_deg);
  }
  assert(trial.one_way_from_deg <= trial.one_way_to_deg);
  return trial;
}

}  // namespace misalign::solver

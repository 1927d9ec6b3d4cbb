#include "solver/verdict/function_records.hpp"

#include <algorithm>
#include <cmath>


namespace misalign::solver {
namespace {

// Where the rate of change of a diagonal in its direction falls to zero, from `low`, where it is
// positive, to `high`, where it is not.
double root_of_slope(const PathFunction& function, int diagonal, int direction, double low,
                     double high) {
  for (int k = 0; k < 60 && high - low > 1e-15; ++k) {
    const double middle = 0.5 * (low + high);
    (direction * function.slope(diagonal, middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The point of a stretch where that rate is least, if it has one minimum (golden section).
double least_slope_at(const PathFunction& function, int diagonal, int direction, double low,
                      double high) {
  constexpr double kGolden = 0.6180339887498949;
  const auto slope = [&](double x) { return direction * function.slope(diagonal, x); };
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = slope(a), at_b = slope(b);
  for (int k = 0; k < 30; ++k) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = slope(a = high - kGolden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = slope(b = low + kGolden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

// Between two states that were looked at the least singular value was never below this share of
// the smaller of theirs, where it does not go on falling beyond them.
constexpr double kLeastBetween = 0.5;

// Errors of functions are below this by far; other branches are farther away.
constexpr double kSameLength_widths = 1e-5;

// A reversal is moved by the step that the exact slope asks for, if that is no longer than this.
constexpr double kLongestReversalStep_rad = 1e-4;

}  // namespace

FunctionRecords::FunctionRecords(const Model& model, int lanes)
    : model_(model),
      queue_(model, lanes),
      lanes_(static_cast<std::size_t>(lanes), Lane{FunctionJudge(model.mechanism())}),
      solved_(static_cast<std::size_t>(lanes)),
      flat_(model.mechanism().diagonals.size()),
      here_(model.mechanism()) {
  for (const Station& station : model.path().stations) {
    if (station.sample > 0) samples_.push_back(&station);
  }
  const std::size_t diagonals = flat_.size();
  const SolvedState nothing{0, 0, 0, std::vector<double>(diagonals), std::vector<double>(diagonals)};
  for (auto& of_lane : solved_) of_lane.assign(static_cast<std::size_t>(wanted_count()), nothing);
}

FunctionRecords::~FunctionRecords() = default;

void FunctionRecords::begin(const SheetBlock& block) {
  records_.resize(static_cast<std::size_t>(block.sheets()));
  queue_.begin(block);
}

bool FunctionRecords::next(PathStart& start, int lane) {
  if (!queue_.put_next(start, lane)) return false;
  flat_lengths(model_.mechanism(), *start.geometry, flat_.data());
  Lane& one = lanes_[lane];
  one.judge.begin(*start.plan, flat_);
  one.record = {};
  one.record.record.flat = flat_;
  one.record.wanted.resize(model_.margin_samples().size() + kWantedBesideMargin);
  one.next = 0;
  one.fault_seen = one.reversal_known = false;
  one.last_deg = one.last_x = 0;
  one.least_step = std::numeric_limits<double>::infinity();
  one.last = flat_;
  one.last_slopes.assign(flat_.size(), 0);
  one.back_since_deg.assign(flat_.size(), 0);
  return true;
}

Answer FunctionRecords::look(const PathFunction& function, int lane) {
  requests_.clear();
  Lane& one = lanes_[lane];
  const double end_deg = function.pilot(function.end()) / kRadPerDeg + 1e-9;
  if (one.fault_seen) {
    look_up_to(end_deg, function, one);
    return one.reversal_known ? Answer::go_to_end : Answer::go_on;
  }
  const Answer seen = one.judge.see(function);
  if (seen == Answer::unsure || seen == Answer::lost) return seen;
  const int in_order = one.judge.samples_in_order();
  one.fault_seen = seen == Answer::enough;
  if (one.fault_seen && (in_order == 0 || in_order < model_.threshold_sample())) return seen;
  look_up_to(end_deg, function, one);
  const bool is_last = function.turns() || end_deg >= model_.path().stations.back().pilot_deg;
  if ((one.fault_seen || is_last) && in_order > 0) {
    want(wanted_index(Wanted::before_d), station_of(std::max(in_order - 1, 1)), function, one);
    want(wanted_index(Wanted::at_d), station_of(in_order), function, one);
  }
  return one.fault_seen && one.reversal_known ? Answer::go_to_end : Answer::go_on;
}

// Samples up to the piece's end; beyond D only for the first reversal.
void FunctionRecords::look_up_to(double end_deg, const PathFunction& function, Lane& lane) {
  const int in_order = lane.judge.samples_in_order();
  const std::vector<int>& margin = model_.margin_samples();
  const int least_step_before = lane.record.least_step_sample;
  for (; lane.next < samples_.size() && samples_[lane.next]->pilot_deg <= end_deg; ++lane.next) {
    const Station& station = *samples_[lane.next];
    const bool is_in_order = station.sample <= in_order;
    if (!is_in_order && (!lane.fault_seen || lane.reversal_known)) break;
    const double x = function.locate(station.pilot_deg * kRadPerDeg);
    function.look(x, here_);
    if (is_in_order) {
      std::copy_n(lane.judge.lengths_at(station.sample), here_.lengths.size(),
                  here_.lengths.begin());
      const auto at = std::lower_bound(margin.begin(), margin.end(), station.sample);
      if (at != margin.end() && *at == station.sample) {
        want(static_cast<int>(at - margin.begin()), station, function, lane);
      }
      if (station.sample == 1) want(wanted_index(Wanted::first), station, function, lane);
      if (station.sample <= 2) want(wanted_index(Wanted::second), station, function, lane);
      note_least_step(station, lane);
    }
    look_between_samples(station, x, function, lane);
    lane.last_deg = station.pilot_deg;
    lane.last_x = x;
    std::swap(lane.last, here_.lengths);
    std::swap(lane.last_slopes, here_.slopes);
  }
  const int least = lane.record.least_step_sample;
  if (least == least_step_before) return;
  want(wanted_index(Wanted::before_least_step), station_of(std::max(least - 1, 1)), function, lane);
  want(wanted_index(Wanted::after_least_step), station_of(least), function, lane);
}

void FunctionRecords::note_least_step(const Station& station, Lane& lane) {
  if (station.pilot_deg < kInactiveFrom_deg) return;
  for (std::size_t d = 0; d < lane.last.size(); ++d) {
    const double step = std::abs(here_.lengths[d] - lane.last[d]);
    if (step >= lane.least_step) continue;
    lane.least_step = step;
    lane.record.least_step_sample = station.sample;
    lane.record.least_step_of = static_cast<int>(d);
  }
}

void FunctionRecords::look_between_samples(const Station& station, double x,
                                           const PathFunction& function, Lane& lane) {
  const double step_rad = (station.pilot_deg - lane.last_deg) * kRadPerDeg;
  const bool is_in_order = station.sample <= lane.judge.samples_in_order();
  // The variable may have changed with the last node.
  const auto last_x = [&] {
    return lane.last_deg > 0 ? function.locate(lane.last_deg * kRadPerDeg) : 0;
  };
  PathExtremes& extremes = lane.record.record.extremes;
  double first_x = std::numeric_limits<double>::infinity();
  int first_of = -1;
  for (int d = 0; d < static_cast<int>(lane.last.size()); ++d) {
    const int direction = lane.judge.direction(d);
    if (direction == 0) continue;
    // The cubic's rate is a parabola, above the least of these three (its Bernstein coefficients).
    const double left = direction * lane.last_slopes[d], right = direction * here_.slopes[d];
    const double inner = 3 * direction * (here_.lengths[d] - lane.last[d]) / step_rad - left - right;
    const double above = std::min({left, right, inner});
    if (above >= 0 && (above >= extremes.least_slope || lane.last_deg < kInactiveFrom_deg)) {
      lane.back_since_deg[d] = 0;
      continue;
    }
    const BetweenSamples seen =
        look_between({lane.last[d], lane.last_slopes[d]}, {here_.lengths[d], here_.slopes[d]},
                     step_rad, 1, direction);
    if (is_in_order && lane.last_deg >= kInactiveFrom_deg &&
        seen.least_slope < extremes.least_slope) {
      double least = std::min(left, right);
      if (seen.least_slope < least) {
        const double at = least_slope_at(function, d, direction, last_x(), x);
        least = std::min(least, direction * function.slope(d, at));
      }
      extremes.least_slope = std::min(extremes.least_slope, least);
    }
    const bool goes_on = here_.slopes[d] * direction >= 0;
    if (goes_on && !(seen.least_slope < 0)) {
      lane.back_since_deg[d] = 0;
      continue;
    }
    double from_deg = lane.back_since_deg[d];
    if (from_deg == 0) {
      const double high = goes_on ? least_slope_at(function, d, direction, last_x(), x) : x;
      if (direction * function.slope(d, high) >= 0) continue;
      const double root = root_of_slope(function, d, direction, last_x(), high);
      from_deg = function.pilot(root) / kRadPerDeg;
      if (root < first_x) {
        first_x = root;
        first_of = d;
      }
    }
    lane.back_since_deg[d] = goes_on ? 0 : from_deg;
    if (!is_in_order || !goes_on || seen.back < kBumpBand_widths) continue;
    extremes.bump_deg = std::min(extremes.bump_deg.value_or(from_deg), from_deg);
  }
  if (first_of >= 0 && !lane.reversal_known) note_reversal(first_of, first_x, function, lane);
}

void FunctionRecords::note_reversal(int diagonal, double x, const PathFunction& function,
                                    Lane& lane) {
  lane.reversal_known = true;
  lane.record.reversing = diagonal;
  constexpr double kPart = 1e-3;  // of a piece: for its curvature
  const double by = kPart * (function.to() - function.from());
  lane.record.reversal_curvature =
      (function.slope(diagonal, x + by) - function.slope(diagonal, x - by)) /
      (function.pilot(x + by) - function.pilot(x - by));
  const double pilot_deg = function.pilot(x) / kRadPerDeg;
  want(wanted_index(Wanted::reversal), pilot_deg, half_angle_of_deg(pilot_deg), x, lane);
}

void FunctionRecords::want(int index, const Station& station, const PathFunction& function,
                           Lane& lane) {
  want(index, station.pilot_deg, station.pilot,
       function.locate(station.pilot_deg * kRadPerDeg), lane);
  lane.record.wanted[static_cast<std::size_t>(index)].sample = station.sample;
}

void FunctionRecords::want(int index, double pilot_deg, const HalfAngle<double>& pilot, double x,
                           Lane& lane) {
  WantedState& wanted = lane.record.wanted[static_cast<std::size_t>(index)];
  wanted.pilot_deg = pilot_deg;
  wanted.pilot = pilot;
  wanted.near.creases.resize(model_.mechanism().creases.size());
  wanted.near.balls.resize(model_.mechanism().balls.size());
  requests_.push_back({index, x});
}

void FunctionRecords::ended(const PathResult& path, int lane) {
  effort_.add(path);
  Lane& one = lanes_[lane];
  FunctionRecord& made = records_[static_cast<std::size_t>(queue_.of_lane(lane))];
  const std::optional<Verdict> verdict = one.judge.conclude(path);
  made = std::move(one.record);
  made.is_sure = verdict.has_value();
  if (!verdict) return;
  PathRecord& record = made.record;
  record.verdict = *verdict;
  record.path = path;
  const int in_order = verdict->deploys_from_sample;
  made.is_accepted = in_order > 0 && in_order >= model_.threshold_sample();
  if (!made.is_accepted) return;
  const double* const lengths = one.judge.lengths_at(1);
  record.lengths.assign(lengths, lengths + static_cast<std::size_t>(in_order) * flat_.size());
  // What never came to be wanted is as good as another state that is.
  const WantedState& at_d = made.wanted[static_cast<std::size_t>(wanted_index(Wanted::at_d))];
  for (WantedState& wanted : made.wanted) {
    if (wanted.pilot_deg == 0) wanted = at_d;
  }
}

void FunctionRecords::leave_all() {
  for (FunctionRecord& made : records_) made.is_sure = false;
}

const std::vector<int>& FunctionRecords::complete() {
  complete_.clear();
  for (std::size_t k = 0; k < records_.size(); ++k) {
    if (records_[k].is_sure && records_[k].is_accepted) complete_.push_back(static_cast<int>(k));
  }
  return complete_;
}

const std::vector<int>& FunctionRecords::left() {
  left_.clear();
  for (std::size_t k = 0; k < records_.size(); ++k) {
    if (!records_[k].is_sure) left_.push_back(static_cast<int>(k));
  }
  return left_;
}

const WantedState& FunctionRecords::wanted(int sheet, int k) const {
  return records_[static_cast<std::size_t>(sheet)].wanted[static_cast<std::size_t>(k)];
}

SolvedState& FunctionRecords::solved(int lane, int k) {
  return solved_[static_cast<std::size_t>(lane)][static_cast<std::size_t>(k)];
}

const std::vector<PathRecord>& FunctionRecords::merge(const std::vector<FoldingHistory>& left) {
  merged_.resize(records_.size());
  for (std::size_t k = 0; k < records_.size(); ++k) {
    merged_[k] = records_[k].is_sure ? std::move(records_[k].record)
                                     : record_of(left[k], model_.mechanism());
  }
  return merged_;
}

// Whether a solved state is the one that the function has there.
bool FunctionRecords::is_the_same(const PathRecord& record, const WantedState& wanted,
                                  const SolvedState& solved) const {
  if (!(solved.open_by <= NewtonOptions{}.closure_tolerance)) return false;
  if (wanted.sample == 0) return true;
  const double* const expected =
      record.lengths.data() + static_cast<std::size_t>(wanted.sample - 1) * flat_.size();
  for (std::size_t d = 0; d < flat_.size(); ++d) {
    if (!(std::abs(solved.lengths[d] - expected[d]) <= kSameLength_widths)) return false;
  }
  return true;
}

void FunctionRecords::take(int sheet, int lane, std::optional<double> miscut_margin_mm) {
  FunctionRecord& made = records_[static_cast<std::size_t>(sheet)];
  const std::vector<SolvedState>& solved = solved_[static_cast<std::size_t>(lane)];
  PathRecord& record = made.record;
  record.miscut_margin_mm = miscut_margin_mm;
  for (std::size_t k = 0; k < solved.size(); ++k) {
    made.is_sure = made.is_sure && is_the_same(record, made.wanted[k], solved[k]);
  }
  if (!made.is_sure) return;
  const auto of = [&](Wanted wanted) -> const SolvedState& {
    return solved[static_cast<std::size_t>(wanted_index(wanted))];
  };
  const auto put_lengths = [&](int sample, const SolvedState& state) {
    std::copy(state.lengths.begin(), state.lengths.end(),
              record.lengths.begin() + static_cast<std::ptrdiff_t>(sample - 1) *
                                           static_cast<std::ptrdiff_t>(state.lengths.size()));
  };
  const int in_order = record.verdict.deploys_from_sample;
  put_lengths(std::max(in_order - 1, 1), of(Wanted::before_d));
  put_lengths(in_order, of(Wanted::at_d));
  if (made.least_step_sample > 0) {
    put_lengths(std::max(made.least_step_sample - 1, 1), of(Wanted::before_least_step));
    put_lengths(made.least_step_sample, of(Wanted::after_least_step));
  }
  const std::size_t judged = solved.size() - 1;  // all but the reversal
  for (std::size_t k = 0; k < judged; ++k) {
    record.residual_max = std::max(record.residual_max, solved[k].open_by);
    record.isometry_error = std::max(record.isometry_error, solved[k].isometry_error);
  }
  std::vector<double> values = {of(Wanted::first).singular_value,
                                of(Wanted::second).singular_value};
  for (std::size_t k = 0; k < model_.margin_samples().size(); ++k) {
    if (model_.margin_samples()[k] > 2 && model_.margin_samples()[k] < in_order - 1) {
      values.push_back(solved[k].singular_value);
    }
  }
  values.push_back(of(Wanted::before_d).singular_value);
  values.push_back(of(Wanted::at_d).singular_value);
  record.singular_value_min = *std::min_element(values.begin(), values.end());
  made.is_sure = std::isfinite(record.singular_value_min) && ends_are_least(values, in_order);
  if (made.reversing >= 0) {
    const SolvedState& reversal = of(Wanted::reversal);
    const double step_rad =
        -reversal.slopes[static_cast<std::size_t>(made.reversing)] / made.reversal_curvature;
    made.is_sure = made.is_sure && std::abs(step_rad) <= kLongestReversalStep_rad;
    record.extremes.reverses_deg =
        made.wanted[static_cast<std::size_t>(wanted_index(Wanted::reversal))].pilot_deg +
        step_rad / kRadPerDeg;
  }
}

bool FunctionRecords::ends_are_least(const std::vector<double>& values, int in_order) {
  if (in_order <= 4) return true;  // all were looked at but one
  const std::size_t last = values.size() - 1;
  const double least = std::min(values[0], values[last]);
  const bool falls_to_first = values[0] <= values[1], falls_to_last = values[last] <= values[last - 1];
  for (std::size_t k = 1; k + 2 <= last; ++k) {
    const double here = values[k], next = values[k + 1];
    if (kLeastBetween * std::min(here, next) >= least) continue;
    const bool leads_to_first = k == 1 && falls_to_first && here <= next;
    const bool leads_to_last = k + 2 == last && falls_to_last && next <= here;
    if (!leads_to_first && !leads_to_last) return false;
  }
  return least <= values[1] && least <= values[last - 1];
}

}  // namespace misalign::solver

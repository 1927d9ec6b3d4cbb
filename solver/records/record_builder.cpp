#include "solver/records/record_builder.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::solver {
namespace {

// Between two states that were looked at the least singular value was never below this share of
// the smaller of theirs, where it does not go on falling beyond them.
constexpr double kLeastBetween = 0.5;

// Errors of functions are below this by far; other branches are farther away.
constexpr double kSameLength_widths = 1e-5;

// Where close steps take over at the latest.
constexpr double kLastHandedOver_deg = 178;

// Segments of fewer samples are short.
constexpr int kShortSegment_samples = 4;

// States are foretold between the last nodes; before them they would be extrapolated.
bool reaches_back_to(const Station& station, const PathFunction& function) {
  const int oldest = std::min(function.kept(), kStateNodes) - 1;
  return station.pilot_deg * kRadPerDeg >= function.pilot(function.at(oldest));
}

}  // namespace

RecordBuilder::RecordBuilder(const Model& model, const QueueLanes& lanes)
    : QueueObserver(model, lanes),
      lanes_(lanes.count, Lane{FunctionJudge(model.mechanism(), model.criterion()),
                               ExtremeFinder(model.mechanism().diagonal_count())}),
      solved_(lanes.count),
      here_(model.mechanism()),
      near_(flat_state<double>(model.mechanism())) {
  for (const Station& station : model.path().stations) {
    if (station.sample > 0) samples_.push_back(&station);
  }
  const std::size_t diagonals = flat_.size();
  const SolvedState nothing{
      {0, 0, 0}, std::vector<double>(diagonals), std::vector<double>(diagonals)};
  for (auto& of_lane : solved_) of_lane.assign(static_cast<std::size_t>(wanted_count()), nothing);
}

RecordBuilder::~RecordBuilder() = default;

void RecordBuilder::begin(const SheetBlock& block) {
  records_.resize(static_cast<std::size_t>(block.sheets()));
  queue_.begin(block);
  ends_.clear();
  ends_near_.clear();
}

void RecordBuilder::begin_sheet(PathStart& start, int lane) {
  Lane& one = lanes_[lane];
  one.judge.begin(*start.plan, flat_);
  one.function = nullptr;
  one.record = {};
  one.record.record.flat = flat_;
  one.record.wanted.resize(model_.margin_samples().size() + kWantedBesideMargin);
  one.next = 0;
  one.fault_seen = false;
  one.least_step = std::numeric_limits<double>::infinity();
  one.finder.begin(flat_);
}

ObserverResult RecordBuilder::see(const PathFunction& function, int lane) {
  near_states_.clear();
  Lane& one = lanes_[lane];
  one.function = &function;
  const double end_deg = function.pilot(function.end()) / kRadPerDeg + 1e-9;
  if (one.fault_seen) {
    look_up_to(end_deg, function, one);
    return ObserverResult::go_on;
  }
  const ObserverResult seen = one.judge.see(function);
  if (seen == ObserverResult::unsure || seen == ObserverResult::lost) return seen;
  const int in_order = one.judge.samples_in_order();
  one.fault_seen = seen == ObserverResult::enough;
  if (one.fault_seen && (in_order == 0 || in_order < model_.threshold_sample())) return seen;
  look_up_to(end_deg, function, one);
  const Judge& judge = one.judge.judge();
  if (const int d = judge.between().bump_where; d >= 0) {
    one.finder.note_bump(
        d, goes_back_from_deg(function, d, judge.direction(d), station_of(in_order).pilot_deg,
                              station_of(in_order + 1).pilot_deg));
  }
  const bool is_last = function.turns() || end_deg >= model_.path().stations.back().pilot_deg;
  // After short segments the last nodes may not reach back to D any more: it is noted on the way.
  const double segment_deg = end_deg - function.pilot(function.from()) / kRadPerDeg;
  const bool is_short = segment_deg < kShortSegment_samples * samples_.front()->pilot_deg;
  if ((one.fault_seen || is_last || is_short) && in_order > 0) want_d(in_order, function, one);
  return ObserverResult::go_on;
}

void RecordBuilder::want_d(int sample, const PathFunction& function, Lane& lane) {
  std::vector<WantedState>& all = lane.record.wanted;
  WantedState& at_d = all[static_cast<std::size_t>(wanted_index(Wanted::at_d))];
  WantedState& before = all[static_cast<std::size_t>(wanted_index(Wanted::before_d))];
  const int last = std::max(sample - 1, 1);
  if (at_d.sample == last && before.sample != last && !reaches_back_to(station_of(last), function))
    std::swap(at_d, before);
  if (before.sample != last) want(wanted_index(Wanted::before_d), station_of(last), function, lane);
  if (at_d.sample != sample) want(wanted_index(Wanted::at_d), station_of(sample), function, lane);
}

// Samples up to the segment's end; beyond D only for the first reversal.
void RecordBuilder::look_up_to(double end_deg, const PathFunction& function, Lane& lane) {
  const int in_order = lane.judge.samples_in_order();
  const std::vector<int>& margin = model_.margin_samples();
  const int least_step_before = lane.record.least_step_sample;
  const double least_slope_before = lane.finder.least_slope().slope;
  for (; lane.next < samples_.size() && samples_[lane.next]->pilot_deg <= end_deg; ++lane.next) {
    const Station& station = *samples_[lane.next];
    const bool is_in_order = station.sample <= in_order;
    if (!is_in_order && (!lane.fault_seen || lane.has_reversed())) break;
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
    const bool had_reversed = lane.has_reversed();
    lane.finder.see(station.pilot_deg, is_in_order, x, here_, lane.judge.judge(), function);
    const Reversal& reversal = lane.finder.first_reversal();
    if (had_reversed || !lane.has_reversed() || reversal.pilot_deg == 0) continue;
    want(wanted_index(Wanted::reversal), reversal.pilot_deg, reversal.x, lane);
  }
  if (const LeastSlope& slope = lane.finder.least_slope(); slope.slope < least_slope_before) {
    want(wanted_index(Wanted::least_slope), slope.pilot_deg, slope.x, lane);
  }
  const int least = lane.record.least_step_sample;
  if (least == least_step_before) return;
  want(wanted_index(Wanted::before_least_step), station_of(std::max(least - 1, 1)), function, lane);
  want(wanted_index(Wanted::after_least_step), station_of(least), function, lane);
}

void RecordBuilder::note_least_step(const Station& station, Lane& lane) {
  if (station.pilot_deg < kInactiveFrom_deg) return;
  for (std::size_t d = 0; d < here_.lengths.size(); ++d) {
    const double step = std::abs(here_.lengths[d] - lane.finder.lengths()[d]);
    if (step >= lane.least_step) continue;
    lane.least_step = step;
    lane.record.least_step_sample = station.sample;
  }
}

void RecordBuilder::want(int index, const Station& station, const PathFunction& function,
                         Lane& lane) {
  want(index, station.pilot_deg, function.locate(station.pilot_deg * kRadPerDeg), lane);
  lane.record.wanted[static_cast<std::size_t>(index)].sample = station.sample;
}

void RecordBuilder::want(int index, double pilot_deg, double x, Lane& lane) {
  WantedState& wanted = lane.record.wanted[static_cast<std::size_t>(index)];
  wanted.pilot_deg = pilot_deg;
  wanted.pilot = half_angle_of_deg(pilot_deg);
  wanted.near.creases.resize(model_.mechanism().creases.size());
  wanted.near.balls.resize(model_.mechanism().balls.size());
  near_states_.push_back({x, &wanted.near});
}

void RecordBuilder::ended(PathResult path, int lane) {
  near_states_.clear();
  effort_.add(path);
  if (!queue_.has_ended(path, lane)) return;
  Lane& one = lanes_[lane];
  const int sheet = queue_.of_lane(lane);
  UnfinishedRecord& made = records_[static_cast<std::size_t>(sheet)];
  const std::optional<Verdict> verdict = one.judge.conclude(path);
  made = std::move(one.record);
  made.is_sure = verdict.has_value();
  if (!verdict) return;
  PathRecord& record = made.record;
  record.verdict = *verdict;
  record.path = path;
  record.extremes = one.finder.extremes();
  if (model_.bumps() == BumpRule::exact && one.judge.judge().between().bump_where < 0)
    record.extremes.drop_bump();
  made.slopes.begin(one.finder);
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
  if (path.lost()) go_on_later(path, sheet, *one.function);
}

// A reversal must have been found before, or is looked for in close steps.
void RecordBuilder::go_on_later(const PathResult& path, int sheet, const PathFunction& function) {
  UnfinishedRecord& made = records_[static_cast<std::size_t>(sheet)];
  const auto& stations = model_.path().stations;
  const double last_deg =
      std::min(function.pilot(function.at(0)) / kRadPerDeg, kLastHandedOver_deg);
  const auto next = std::ranges::upper_bound(stations, last_deg, {}, &Station::pilot_deg);
  const auto station = static_cast<std::size_t>(next - stations.begin()) - 1;
  made.is_sure = next != stations.begin() && reaches_back_to(stations[station], function) &&
                 stations[station].sample >= made.record.verdict.deploys_from_sample &&
                 made.slopes.has_reversal();
  if (!made.is_sure) return;
  ends_near_.push_back(near_);
  ends_.push_back({sheet, &ends_near_.back(), &model_.path(), station, path.forward_sign});
  near_states_.push_back(
      {function.locate(stations[station].pilot_deg * kRadPerDeg), &ends_near_.back()});
}

SheetQueue& RecordBuilder::queue_of_ends() {
  queue_.begin_from(ends_);
  return queue_;
}

void RecordBuilder::finish(const PathResult& path, int lane) {
  effort_.add(path);
  UnfinishedRecord& made = records_[static_cast<std::size_t>(queue_.of_lane(lane))];
  made.record.path = path;
  made.is_sure = !path.lost() && !DenseFallback::is_doubtful(path);
}

void RecordBuilder::leave_all() {
  for (UnfinishedRecord& made : records_) made.is_sure = false;
}

const std::vector<int>& RecordBuilder::complete() {
  complete_.clear();
  for (std::size_t k = 0; k < records_.size(); ++k) {
    if (records_[k].is_sure && records_[k].is_accepted) complete_.push_back(static_cast<int>(k));
  }
  return complete_;
}

const std::vector<int>& RecordBuilder::left() {
  left_.clear();
  for (std::size_t k = 0; k < records_.size(); ++k) {
    if (!records_[k].is_sure) left_.push_back(static_cast<int>(k));
  }
  return left_;
}

const WantedState& RecordBuilder::wanted(int sheet, int k) const {
  return records_[static_cast<std::size_t>(sheet)].wanted[static_cast<std::size_t>(k)];
}

SolvedState& RecordBuilder::solved(int lane, int k) {
  return solved_[static_cast<std::size_t>(lane)][static_cast<std::size_t>(k)];
}

const std::vector<PathRecord>& RecordBuilder::merge(const std::vector<FoldingHistory>& left) {
  merged_.resize(records_.size());
  for (std::size_t k = 0; k < records_.size(); ++k) {
    merged_[k] = records_[k].is_sure ? std::move(records_[k].record)
                                     : record_of(left[k], model_.mechanism());
  }
  return merged_;
}

// Whether a solved state is the one that the function has there.
bool RecordBuilder::is_the_same(const PathRecord& record, const WantedState& wanted,
                                const SolvedState& solved) const {
  if (!(solved.quality.open_by <= Newton::Options{}.closure_tolerance)) return false;
  if (wanted.sample == 0) return true;
  const double* const expected =
      record.lengths.data() + static_cast<std::size_t>(wanted.sample - 1) * flat_.size();
  for (std::size_t d = 0; d < flat_.size(); ++d) {
    if (!(std::abs(solved.lengths[d] - expected[d]) <= kSameLength_widths)) return false;
  }
  return true;
}

void RecordBuilder::take(int sheet, int lane, std::optional<double> miscut_margin_mm) {
  UnfinishedRecord& made = records_[static_cast<std::size_t>(sheet)];
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
  const auto judged = static_cast<std::size_t>(wanted_index(Wanted::least_slope));
  for (std::size_t k = 0; k < judged; ++k) {
    record.residual_max = std::max(record.residual_max, solved[k].quality.open_by);
    record.isometry_error = std::max(record.isometry_error, solved[k].quality.isometry_error);
  }
  const auto singular_of = [&](Wanted wanted) { return of(wanted).quality.singular_value_min; };
  std::vector<double> values = {singular_of(Wanted::first), singular_of(Wanted::second)};
  for (std::size_t k = 0; k < model_.margin_samples().size(); ++k) {
    if (model_.margin_samples()[k] > 2 && model_.margin_samples()[k] < in_order - 1) {
      values.push_back(solved[k].quality.singular_value_min);
    }
  }
  for (const Wanted last : {Wanted::before_d, Wanted::at_d}) values.push_back(singular_of(last));
  record.singular_value_min = *std::min_element(values.begin(), values.end());
  made.is_sure =
      made.slopes.put_into(record, of(Wanted::at_d).slopes, of(Wanted::least_slope).slopes,
                           of(Wanted::reversal).slopes) &&
      std::isfinite(record.singular_value_min) && ends_are_least(values, in_order);
}

bool RecordBuilder::wants_again(int sheet, int lane) {
  UnfinishedRecord& made = records_[static_cast<std::size_t>(sheet)];
  const int index = wanted_index(Wanted::reversal);
  const auto next_deg = made.slopes.next_reversal_deg(solved(lane, index).slopes);
  if (next_deg) made.wanted[static_cast<std::size_t>(index)].pilot = half_angle_of_deg(*next_deg);
  return next_deg.has_value();
}

bool RecordBuilder::ends_are_least(const std::vector<double>& values, int in_order) {
  if (in_order <= 4) return true;  // all were looked at
  const std::size_t last = values.size() - 1;
  const double least = std::min(values[0], values[last]);
  const bool falls_to_first = values[0] <= values[1],
             falls_to_last = values[last] <= values[last - 1];
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

#include "solver/records/record_observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

// Last pilot angle at which close steps take over.
constexpr double kLastHandedOver_deg = 178;

// Samples below which a segment is short.
constexpr int kShortSegment_samples = 4;

}  // namespace

RecordObserver::RecordObserver(const Model& model, const QueueLanes& lanes)
    : QueueObserver(model, lanes),
      lanes_(lanes.count,
             Lane{FunctionJudge(model.mechanism(), model.criterion()),
                  FunctionJudge(model.mechanism(), model.criterion().without_margins()),
                  ExtremeFinder(model.mechanism().diagonal_count())}),
      later_(model),
      estimate_(model.mechanism()),
      creases_(model.mechanism().creases.size()) {
  for (const Station& station : model.path().stations) {
    if (station.sample > 0) samples_.push_back(&station);
  }
}

RecordObserver::~RecordObserver() = default;

void RecordObserver::begin(const SheetBlock& block) {
  records_.resize(static_cast<std::size_t>(block.sheets()));
  for (UnfinishedRecord& record : records_) record.is_sure = false;
  queue_.begin(block);
  later_.clear();
}

void RecordObserver::begin_sheet(PathStart& start, int lane) {
  Lane& observed = lanes_[lane];
  observed.judge.begin(*start.plan, flat_, start.geometry);
  observed.energy.begin(*start.plan, flat_, start.geometry);
  observed.energy_falls = false;
  observed.function = nullptr;
  observed.record = {};
  observed.record.record.flat = flat_;
  observed.record.requested.begin(model_);
  observed.next = 0;
  observed.fault_seen = false;
  observed.least_step = std::numeric_limits<double>::infinity();
  observed.finder.begin(flat_);
  if (model_.threshold_sample() > 0) {
    find_crease_lengths(model_.mechanism(), *start.geometry, observed.creases_mm);
  }
}

ObserverResult RecordObserver::see(const PathFunction& function, int lane) {
  near_states_.clear();
  Lane& observed = lanes_[lane];
  observed.function = &function;
  if (const ObserverResult seen = see_energy(function, observed);
      seen == ObserverResult::unsure || seen == ObserverResult::lost) {
    return seen;
  }
  const double end_deg = function.pilot(function.end()) / kRadPerDeg + 1e-9;
  if (observed.fault_seen) {
    evaluate_up_to(end_deg, function, observed);
    return ObserverResult::go_on;
  }
  const ObserverResult seen = observed.judge.see(function);
  if (seen == ObserverResult::unsure || seen == ObserverResult::lost) return seen;
  const int in_order = observed.judge.samples_in_order();
  observed.fault_seen = seen == ObserverResult::enough;
  if (observed.fault_seen && (in_order == 0 || in_order < model_.threshold_sample())) return seen;
  evaluate_up_to(end_deg, function, observed);
  const Judge& judge = observed.judge.judge();
  if (const int d = judge.between().bump_where; d >= 0) {
    observed.finder.note_bump(
        d, goes_back_from_deg(function, d, judge.direction(d), station_of(in_order).pilot_deg,
                              station_of(in_order + 1).pilot_deg));
  }
  const bool is_last = function.turns() || end_deg >= model_.path().stations.back().pilot_deg;
  // D is requested early in short segments, since the last nodes may not reach back to it later.
  const double segment_deg = end_deg - function.pilot(function.from()) / kRadPerDeg;
  const bool is_short = segment_deg < kShortSegment_samples * samples_.front()->pilot_deg;
  if ((observed.fault_seen || is_last || is_short) && in_order > 0)
    request_d(in_order, function, observed);
  return ObserverResult::go_on;
}

// Judges the newest segment by the filling's energy, also beyond the verdict's fault.
ObserverResult RecordObserver::see_energy(const PathFunction& function, Lane& lane) {
  if (lane.energy_falls) return ObserverResult::enough;
  const ObserverResult seen = lane.energy.see(function);
  lane.energy_falls = seen == ObserverResult::enough;
  return seen;
}

void RecordObserver::request_d(int sample, const PathFunction& function, Lane& lane) {
  RequestedStates& requested = lane.record.requested;
  const RequestedState &before = requested.of(Purpose::before_d),
                       &at_d = requested.of(Purpose::at_d);
  const int last = std::max(sample - 1, 1);
  if (at_d.sample == last && before.sample != last &&
      !LaterStarts::reaches_back_to(station_of(last), function))
    requested.swap_d_with_before();
  if (before.sample != last) request(Purpose::before_d, station_of(last), function, lane);
  if (at_d.sample != sample) request(Purpose::at_d, station_of(sample), function, lane);
}

// Evaluates samples up to the segment's end; beyond D only for the first reversal.
void RecordObserver::evaluate_up_to(double end_deg, const PathFunction& function, Lane& lane) {
  const int in_order = lane.judge.samples_in_order();
  const std::vector<int>& margin = model_.margin_samples();
  const int least_step_before = lane.record.least_step_sample;
  const double least_slope_before = lane.finder.least_slope().slope;
  for (; lane.next < samples_.size() && samples_[lane.next]->pilot_deg <= end_deg; ++lane.next) {
    const Station& station = *samples_[lane.next];
    const bool is_in_order = station.sample <= in_order;
    if (!is_in_order && (!lane.fault_seen || lane.has_reversed())) break;
    const double x = function.locate(station.pilot_deg * kRadPerDeg);
    function.look(x, estimate_);
    if (is_in_order) {
      std::copy_n(lane.judge.lengths_at(station.sample), estimate_.lengths.size(),
                  estimate_.lengths.begin());
      const auto at = std::lower_bound(margin.begin(), margin.end(), station.sample);
      if (at != margin.end() && *at == station.sample) {
        request(static_cast<int>(at - margin.begin()), station, function, lane);
      }
      if (station.sample == 1) request(Purpose::first, station, function, lane);
      if (station.sample <= 2) request(Purpose::second, station, function, lane);
      note_least_step(station, lane);
      if (!lane.creases_mm.empty()) {
        function.find_creases(x, creases_);
        lane.record.record.turning_mm.push_back(turning_mm(lane.creases_mm, creases_));
      }
    }
    const bool had_reversed = lane.has_reversed();
    lane.finder.see(station.pilot_deg, is_in_order, x, estimate_, lane.judge.judge(), function);
    const Reversal& reversal = lane.finder.first_reversal();
    if (had_reversed || !lane.has_reversed() || reversal.pilot_deg == 0) continue;
    request(Purpose::reversal, reversal.pilot_deg, reversal.x, lane);
  }
  if (const LeastSlope& slope = lane.finder.least_slope(); slope.slope < least_slope_before) {
    request(Purpose::least_slope, slope.pilot_deg, slope.x, lane);
  }
  const int least = lane.record.least_step_sample;
  if (least == least_step_before) return;
  request(Purpose::before_least_step, station_of(std::max(least - 1, 1)), function, lane);
  request(Purpose::after_least_step, station_of(least), function, lane);
}

void RecordObserver::note_least_step(const Station& station, Lane& lane) {
  if (station.pilot_deg < kInactiveFrom_deg) return;
  for (std::size_t d = 0; d < estimate_.lengths.size(); ++d) {
    const double step = std::abs(estimate_.lengths[d] - lane.finder.lengths()[d]);
    if (step >= lane.least_step) continue;
    lane.least_step = step;
    lane.record.least_step_sample = station.sample;
  }
}

void RecordObserver::request(int k, const Station& station, const PathFunction& function,
                             Lane& lane) {
  const double x = function.locate(station.pilot_deg * kRadPerDeg);
  near_states_.push_back({x, &lane.record.requested.request(k, station.sample, station.pilot_deg)});
}

void RecordObserver::request(Purpose purpose, const Station& station, const PathFunction& function,
                             Lane& lane) {
  request(lane.record.requested.index_of(purpose), station, function, lane);
}

void RecordObserver::request(Purpose purpose, double pilot_deg, double x, Lane& lane) {
  RequestedStates& requested = lane.record.requested;
  near_states_.push_back({x, &requested.request(requested.index_of(purpose), 0, pilot_deg)});
}

void RecordObserver::ended(PathResult path, int lane) {
  near_states_.clear();
  effort_.add(path);
  if (!queue_.has_ended(path, lane)) return;
  Lane& observed = lanes_[lane];
  const int sheet = queue_.of_lane(lane);
  UnfinishedRecord& made = records_[static_cast<std::size_t>(sheet)];
  const std::optional<Verdict> verdict = observed.judge.conclude(path);
  made = std::move(observed.record);
  const std::optional<Verdict> by_energy = observed.energy.conclude(path);
  made.is_sure = verdict && by_energy;
  if (!made.is_sure) return;
  PathRecord& record = made.record;
  record.energy_deploys_from_sample = by_energy->deploys_from_sample;
  record.verdict = *verdict;
  record.path = path;
  record.extremes = observed.finder.extremes();
  if (model_.bumps() == BumpRule::exact && observed.judge.judge().between().bump_where < 0)
    record.extremes.drop_bump();
  made.slopes.begin(observed.finder);
  const int in_order = verdict->deploys_from_sample;
  made.is_accepted = in_order > 0 && in_order >= model_.threshold_sample();
  if (!made.is_accepted) return;
  const double* const lengths = observed.judge.lengths_at(1);
  record.lengths.assign(lengths, lengths + static_cast<std::size_t>(in_order) * flat_.size());
  made.requested.fill();
  if (path.lost()) go_on_later(path, sheet, *observed.function);
}

// Lets a lost path continue in close steps after its verdict, if its reversal is known; else the
// whole path is for close steps.
void RecordObserver::go_on_later(const PathResult& path, int sheet, const PathFunction& function) {
  UnfinishedRecord& made = records_[static_cast<std::size_t>(sheet)];
  const auto& stations = model_.path().stations;
  const double last_deg =
      std::min(function.pilot(function.at(0)) / kRadPerDeg, kLastHandedOver_deg);
  const auto next = std::ranges::upper_bound(stations, last_deg, {}, &Station::pilot_deg);
  const auto station = static_cast<std::size_t>(next - stations.begin()) - 1;
  made.is_sure = next != stations.begin() &&
                 LaterStarts::reaches_back_to(stations[station], function) &&
                 stations[station].sample >= made.record.verdict.deploys_from_sample &&
                 made.slopes.has_reversal();
  if (made.is_sure) {
    near_states_.push_back({function.locate(stations[station].pilot_deg * kRadPerDeg),
                            &later_.add(sheet, station, path.forward_sign)});
  }
}

void RecordObserver::finish(const PathResult& path, int lane) {
  effort_.add(path);
  UnfinishedRecord& made = records_[static_cast<std::size_t>(queue_.of_lane(lane))];
  made.record.path = path;
  made.is_sure = !path.lost() && !PivotedFallback::is_doubtful(path);
}

}  // namespace misalign::solver

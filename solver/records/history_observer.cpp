#include "solver/records/history_observer.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace misalign::solver {
namespace {

Eigen::MatrixXd rows_of(const std::vector<double>& values, std::size_t rows) {
  assert(rows == 0 ? values.empty() : values.size() % rows == 0);
  const Eigen::Index columns = static_cast<Eigen::Index>(rows > 0 ? values.size() / rows : 0);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(rows), columns);
}

std::size_t index_of(const Station& station, const PathPlan& plan) {
  const auto at =
      std::ranges::lower_bound(plan.stations, station.pilot_deg, {}, &Station::pilot_deg);
  return static_cast<std::size_t>(at - plan.stations.begin());
}

}  // namespace

HistoryObserver::HistoryObserver(const Model& model, const QueueLanes& lanes,
                                 const StationVisitor* visit)
    : QueueObserver(model, lanes),
      visit_(visit),
      between_(model.mechanism(), model.elimination()),
      point_(model.mechanism()),
      pivoted_state_(model.mechanism()),
      fallback_(model.mechanism()) {
  for (std::size_t i = 0; i < lanes.count; ++i) lanes_.push_back(new_lane());
}

HistoryObserver::~HistoryObserver() = default;

void HistoryObserver::begin(const SheetBlock& block) {
  histories_.resize(static_cast<std::size_t>(block.sheets()));
  fallback_.begin();
  unfinished_.clear();
  finds_extremes_ = false;
  queue_.begin(block);
}

void HistoryObserver::measure_only(const std::vector<int>& sheets) {
  assert(std::ranges::all_of(sheets, [&](int k) { return k >= 0 && k < std::ssize(histories_); }));
  for (FoldingHistory& history : histories_) history = {};
  finds_extremes_ = true;
  queue_.begin_again(sheets);
}

void HistoryObserver::begin_sheet(PathStart& start, int lane) {
  if (fallback_.under_way() && goes_on(start, lane)) return;
  auto& [judge, energy, history, creases_mm, lengths_mm, slopes_mm_per_deg, angles_deg, last] =
      *lanes_[lane];
  lengths_mm.clear();
  slopes_mm_per_deg.clear();
  angles_deg.clear();
  history = {};
  judge.begin(flat_, *start.geometry, finds_extremes_);
  energy.begin(flat_, start.geometry);
  find_crease_lengths(model_.mechanism(), *start.geometry, creases_mm);
  for (const double length : flat_) {
    history.flat_mm.push_back(length * model_.mechanism().panel_width_mm);
  }
}

bool HistoryObserver::goes_on(PathStart& start, int lane) {
  for (Unfinished& unfinished : unfinished_) {
    if (unfinished.sheet != queue_.of_lane(lane)) continue;
    std::swap(lanes_[lane], unfinished.lane);
    start.state = &lanes_[lane]->last;
    start.first_station = index_of(lanes_[lane]->history.stations.back(), *start.plan);
    return true;
  }
  return false;
}

bool HistoryObserver::see(const Station& station, int lane) {
  const std::vector<Station>& seen = lanes_[lane]->history.stations;
  if (!seen.empty() && station.pilot_deg <= seen.back().pilot_deg) return true;  // goes on from it
  const SheetGeometry<double>& geometry = queue_.geometry_of_lane(lane);
  pivoted_state_.find(geometry, point_.state, point_);
  model_.shape().place(geometry, point_.state, points_);
  evaluate(station, lane,
           {pivoted_state_.open_by(), pivoted_state_.singular_value(),
            model_.shape().isometry_error(geometry, points_)});
  return true;
}

void HistoryObserver::evaluate(const Station& station, int lane, const SolveQuality& quality) {
  if (CloseJudge& judge = lanes_[lane]->judge; station.sample > 0) {
    judge.see(station, point_, true,
              judge.looks_between() ? &queue_.geometry_of_lane(lane) : nullptr);
  }
  keep(station, lane, quality);
}

void HistoryObserver::keep(const Station& station, int lane, const SolveQuality& quality) {
  const double width_mm = model_.mechanism().panel_width_mm;
  assert(std::ssize(point_.lengths) == model_.mechanism().diagonal_count());
  auto& [judge, energy, history, creases_mm, lengths_mm, slopes_mm_per_deg, angles_deg, last] =
      *lanes_[lane];
  history.stations.push_back(station);
  history.turning_mm.push_back(turning_mm(creases_mm, point_.state.creases));
  if (station.sample > 0) energy.see(station, &point_.state, point_.lengths);
  last = point_.state;
  for (const double length : point_.lengths) lengths_mm.push_back(length * width_mm);
  for (const double slope : point_.slopes) {
    slopes_mm_per_deg.push_back(slope * width_mm * kRadPerDeg);
  }
  for (const auto& rho : point_.state.creases) {
    angles_deg.push_back(model_.mechanism().side * angle_deg(rho));
  }
  history.open_by.push_back(quality.open_by);
  history.singular_value_min.push_back(quality.singular_value_min);
  history.isometry_error_mm.push_back(quality.isometry_error * width_mm);
  const std::vector<int>& samples = model_.margin_samples();
  if (std::binary_search(samples.begin(), samples.end(), station.sample)) {
    history.margin_states.push_back(point_.state);
  }
  if (visit_) (*visit_)(station, point_);
}

void HistoryObserver::ended(PathResult path, int lane) {
  if (!fallback_.under_way()) effort_.add(path);
  auto& [judge, energy, history, creases_mm, lengths_mm, slopes_mm_per_deg, angles_deg, last] =
      *lanes_[lane];
  const std::size_t stations = history.stations.size();
  const bool has_not_gone_on = path.end == PathEnd::start_lost && stations > 0;
  if (has_not_gone_on || !queue_.has_ended(path, lane)) return;
  history.path = path;
  history.verdict = judge.conclude(path);
  history.between = judge.between();
  history.energy_deploys_from_sample = energy.samples_in_order();
  if (finds_extremes_) history.extremes = judge.extremes();
  history.length_mm = rows_of(lengths_mm, stations);
  history.slope_mm_per_deg = rows_of(slopes_mm_per_deg, stations);
  history.fold_angle_deg = rows_of(angles_deg, stations);
  const int sheet = queue_.of_lane(lane);
  if (!fallback_.under_way() && fallback_.consider(sheet, history.verdict, path)) {
    histories_[sheet] = history;
    if (stations > 0) unfinished_.push_back({sheet, std::exchange(lanes_[lane], new_lane())});
    return;
  }
  if (fallback_.under_way() && !fallback_.counts(sheet, history.verdict)) {
    const FoldingHistory& before = histories_[sheet];
    if (!before.path.lost()) return;
    history.verdict = before.verdict;  // the earlier verdict stands
  }
  histories_[sheet] = std::move(history);
}

void HistoryObserver::fall_back() { fallback_.run(queue_, *this); }

}  // namespace misalign::solver

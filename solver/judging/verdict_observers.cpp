#include "solver/judging/verdict_observers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Paths that are lost below begin at flat again.
constexpr double kHandedOverFrom_deg = 150;

// Returns whether the samples so far settle all but where the first fault is: that every diagonal
// is active, and that none comes before.
bool is_settled(const PathResult& path, const Judge& judge) {
  const double span = judge.least_span();
  return path.lost() && judge.fault() == Fault::none && std::isfinite(span) &&
         span > 2 * kInactiveBand_widths;
}

}  // namespace

FunctionObserver::FunctionObserver(const Model& model, const QueueLanes& lanes)
    : QueueObserver(model, lanes),
      judges_(lanes.count, FunctionJudge(model.mechanism(), model.criterion())),
      noted_(lanes.count, {0, flat_state<double>(model.mechanism())}),
      later_(model) {}

FunctionObserver::~FunctionObserver() = default;

void FunctionObserver::begin(const SheetBlock& block, std::vector<Verdict>& verdicts) {
  assert(std::ssize(verdicts) == block.sheets());
  verdicts_ = &verdicts;
  left_.clear();
  later_.clear();
  queue_.begin(block);
}

void FunctionObserver::begin_sheet(PathStart& start, int lane) {
  noted_[lane].station = 0;
  judges_[lane].begin(*start.plan, flat_, start.geometry);
}

ObserverResult FunctionObserver::see(const PathFunction& function, int lane) {
  near_states_.clear();
  const ObserverResult seen = judges_[lane].see(function);
  const double end_rad = function.pilot(function.end());
  if (seen == ObserverResult::go_on && end_rad > kHandedOverFrom_deg * kRadPerDeg) {
    note_start(function, lane);
  }
  return seen;
}

// Notes a start of close steps: they solve again as many samples as a function has nodes.
void FunctionObserver::note_start(const PathFunction& function, int lane) {
  const auto& stations = model_.path().stations;
  const int sample = judges_[lane].samples_in_order() - PathFunction::kNodes + 1;
  const auto from = std::ranges::find(stations, sample, &Station::sample);
  if (sample < 2 || !LaterStarts::reaches_back_to(*from, function)) return;
  Lane& noted = noted_[lane];
  noted.station = static_cast<std::size_t>(from - stations.begin());
  near_states_.push_back({function.locate(from->pilot_deg * kRadPerDeg), &noted.state});
}

void FunctionObserver::ended(PathResult path, int lane) {
  near_states_.clear();
  effort_.add(path);
  if (!queue_.has_ended(path, lane)) return;
  const int sheet = queue_.of_lane(lane);
  const std::optional<Verdict> verdict = judges_[lane].conclude(path);
  if (verdict) {
    (*verdicts_)[static_cast<std::size_t>(sheet)] = *verdict;
  } else if (noted_[lane].station > 0 && is_settled(path, judges_[lane].judge())) {
    hand_over(path, lane);
  } else {
    left_.push_back(sheet);
  }
}

void FunctionObserver::hand_over(const PathResult& path, int lane) {
  const auto& [station, state] = noted_[lane];
  const std::size_t number = later_.starts().size();
  later_.add(queue_.of_lane(lane), station, path.forward_sign) = state;
  if (number == known_.size()) known_.emplace_back();
  const FunctionJudge& judge = judges_[lane];
  known_[number].samples = judge.samples_in_order();
  known_[number].lengths.assign(judge.lengths_at(1),
                                judge.lengths_at(model_.path().stations[station].sample));
}

const FunctionObserver::Known& FunctionObserver::known(int sheet) const {
  const auto& starts = later_.starts();
  const auto at = std::ranges::find(starts, sheet, &QueuedStart::sheet);
  assert(at != starts.end());
  return known_[static_cast<std::size_t>(at - starts.begin())];
}

JudgingObserver::JudgingObserver(const Model& model, const QueueLanes& lanes)
    : QueueObserver(model, lanes),
      between_(model.mechanism(), model.elimination()),
      point_(model.mechanism()),
      residual_(model.mechanism().equations),
      pivoted_state_(model.mechanism()),
      fallback_(model.mechanism()) {
  for (std::size_t i = 0; i < lanes.count; ++i) judges_.emplace_back(model, between_);
  if (judges_.front().looks_between()) {
    between_.prepare();
    point_.rates.resize(static_cast<std::size_t>(model.mechanism().unknowns));
  }
}

JudgingObserver::~JudgingObserver() = default;

void JudgingObserver::begin(const SheetBlock& block) {
  verdicts_.assign(static_cast<std::size_t>(block.sheets()), {});
  fallback_.begin();
  queue_.begin(block);
}

void JudgingObserver::only_later(FunctionObserver& functions) {
  functions_ = &functions;
  queue_.begin_from(functions.later());
}

void JudgingObserver::only_left(FunctionObserver& functions) {
  functions_ = nullptr;
  queue_.begin_again(functions.left());
}

void JudgingObserver::begin_sheet(PathStart& start, int lane) {
  judges_[lane].begin(flat_, *start.geometry);
  if (!functions_) return;
  const auto& [lengths, samples] = functions_->known(queue_.of_lane(lane));
  judges_[lane].go_on(*start.plan, lengths, samples);
}

bool JudgingObserver::see(const Station& station, int lane) {
  if (station.sample == 0) return true;
  const bool is_unsure = wants_slopes() && !(point_.misfit <= kLargestMisfit);
  if (is_unsure || station.pilot_deg > kPoorFactorsFrom_deg) {
    const SheetGeometry<double>& geometry = queue_.geometry_of_lane(lane);
    if (is_unsure || is_open(geometry)) pivoted_state_.find(geometry, point_.state, point_);
  }
  CloseJudge& judge = judges_[static_cast<std::size_t>(lane)];
  return judge.see(station, point_, wants_slopes(),
                   judge.looks_between() ? &queue_.geometry_of_lane(lane) : nullptr);
}

bool JudgingObserver::is_open(const SheetGeometry<double>& geometry) {
  return !(evaluate(model_.mechanism(), geometry, point_.state, residual_.data(), nullptr) <=
           Newton::Options{}.closure_tolerance);
}

void JudgingObserver::ended(PathResult path, int lane) {
  if (!fallback_.under_way()) effort_.add(path);
  const int sheet = queue_.of_lane(lane);
  if (functions_ && path.lost()) return functions_->left().push_back(sheet);
  if (!queue_.has_ended(path, lane)) return;
  const Verdict verdict = judges_[lane].conclude(path);
  if (!fallback_.under_way()) fallback_.consider(sheet, verdict, path);
  if (!fallback_.under_way() || fallback_.counts(sheet, verdict)) verdicts_[sheet] = verdict;
}

void JudgingObserver::fall_back() { fallback_.run(queue_, *this); }

}  // namespace misalign::solver

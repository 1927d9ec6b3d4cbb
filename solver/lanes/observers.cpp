#include "solver/lanes/observers.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

FunctionObserver::FunctionObserver(const Model& model, const QueueLanes& lanes)
    : QueueObserver(model, lanes),
      judges_(lanes.count, FunctionJudge(model.mechanism(), model.criterion())) {}

FunctionObserver::~FunctionObserver() = default;

void FunctionObserver::begin(const SheetBlock& block, std::vector<Verdict>& verdicts) {
  assert(std::ssize(verdicts) == block.sheets());
  verdicts_ = &verdicts;
  left_.clear();
  queue_.begin(block);
}

void FunctionObserver::begin_sheet(PathStart& start, int lane) {
  judges_[lane].begin(*start.plan, flat_, start.geometry);
}

void FunctionObserver::ended(PathResult path, int lane) {
  effort_.add(path);
  if (!queue_.has_ended(path, lane)) return;
  const int sheet = queue_.of_lane(lane);
  const std::optional<Verdict> verdict = judges_[lane].conclude(path);
  if (verdict) {
    (*verdicts_)[static_cast<std::size_t>(sheet)] = *verdict;
  } else {
    left_.push_back(sheet);
  }
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

void JudgingObserver::begin_sheet(PathStart& start, int lane) {
  judges_[lane].begin(flat_, *start.geometry);
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
  if (!queue_.has_ended(path, lane)) return;
  const int sheet = queue_.of_lane(lane);
  const Verdict verdict = judges_[lane].conclude(path);
  if (!fallback_.under_way()) fallback_.consider(sheet, verdict, path);
  if (!fallback_.under_way() || fallback_.counts(sheet, verdict)) verdicts_[sheet] = verdict;
}

void JudgingObserver::fall_back() { fallback_.run(queue_, *this); }

}  // namespace misalign::solver

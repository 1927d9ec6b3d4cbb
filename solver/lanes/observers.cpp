#include "solver/lanes/observers.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

FunctionObserver::FunctionObserver(const Model& model, int lanes)
    : QueueObserver(model, lanes),
      judges_(static_cast<std::size_t>(lanes),
              FunctionJudge(model.mechanism(), model.criterion())) {}

FunctionObserver::~FunctionObserver() = default;

void FunctionObserver::begin(const SheetBlock& block, std::vector<Verdict>& verdicts) {
  assert(std::ssize(verdicts) == block.sheets());
  verdicts_ = &verdicts;
  left_.clear();
  queue_.begin(block);
}

void FunctionObserver::begin_sheet(PathStart& start, int lane) {
  judges_[lane].begin(*start.plan, flat_);
}

void FunctionObserver::ended(const PathResult& path, int lane) {
  effort_.add(path);
  const int sheet = queue_.of_lane(lane);
  const std::optional<Verdict> verdict = judges_[lane].conclude(path);
  if (verdict) {
    (*verdicts_)[static_cast<std::size_t>(sheet)] = *verdict;
  } else {
    left_.push_back(sheet);
  }
}

JudgingObserver::JudgingObserver(const Model& model, int lanes)
    : QueueObserver(model, lanes),
      between_(model.mechanism(), model.elimination()),
      point_(model.mechanism()),
      residual_(model.mechanism().equations),
      dense_state_(model.mechanism()),
      fallback_(model.mechanism()) {
  for (int i = 0; i < lanes; ++i) judges_.emplace_back(model, between_);
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

void JudgingObserver::begin_sheet(PathStart&, int lane) { judges_[lane].begin(flat_); }

bool JudgingObserver::see(const Station& station, int lane) {
  if (station.sample == 0) return true;
  const bool is_unsure = wants_slopes() && !(point_.misfit <= kLargestMisfit);
  if (is_unsure || station.pilot_deg > kPoorFactorsFrom_deg) {
    const SheetGeometry<double>& geometry = queue_.geometry_of_lane(lane);
    if (is_unsure || is_open(geometry)) dense_state_.find(geometry, point_.state, point_);
  }
  CloseJudge& judge = judges_[static_cast<std::size_t>(lane)];
  return judge.see(station, point_, wants_slopes(),
                   judge.looks_between() ? &queue_.geometry_of_lane(lane) : nullptr);
}

bool JudgingObserver::is_open(const SheetGeometry<double>& geometry) {
  return !(evaluate(model_.mechanism(), geometry, point_.state, residual_.data(), nullptr) <=
           NewtonOptions{}.closure_tolerance);
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

// After a correction from this far open, lengths are known to 1e-10 panel widths; on the arc only
// the way on is wanted.
constexpr double kStationClosure = 1e-7, kArcClosure = 1e-3;

CloseStepOptions approach_options() {
  CloseStepOptions options;
  options.closure_tolerance = kStationClosure;
  options.arc_closure_tolerance = kArcClosure;
  options.least_corrections = 0;
  options.arc.limit_tolerance_rad = kRejection.approach_limit_deg * kRadPerDeg;
  options.limit_certain_share = 0.5;  // half the way to the threshold
  options.longest_half_sine = kRejection.longest_half_sine;
  options.longest_correction_rad = kRejection.longest_correction_rad;
  options.least_tangent_cosine = 0;
  return options;
}

ApproachObserver::ApproachObserver(const Model& model, int lanes)
    : model_(model), queue_(model, lanes), point_(model.mechanism()) {}

ApproachObserver::~ApproachObserver() = default;

void ApproachObserver::begin(const SheetBlock& block, RejectionTest& rejection) {
  queue_.begin(block);
  rejection_ = &rejection;
  kept_count_ = 0;
}

ApproachObserver::Kept& ApproachObserver::keep(Undecided& sheet) {
  assert(sheet.kept_state < kept_count_ && kept_count_ <= std::ssize(kept_));
  if (sheet.kept_state < 0) sheet.kept_state = kept_count_++;
  if (sheet.kept_state == static_cast<int>(kept_.size())) {
    kept_.push_back({nullptr, point_.state,
                     std::vector<double>(static_cast<std::size_t>(model_.mechanism().unknowns))});
  }
  return kept_[sheet.kept_state];
}

SheetQueue& ApproachObserver::queue_of(const std::vector<Undecided>& open) {
  const auto& stations = model_.approach().stations;
  starts_.clear();
  for (const auto [sheet, kept_state] : open) {
    if (kept_state < 0) continue;
    const Kept& kept = kept_[kept_state];
    const auto first = std::ranges::find(stations, kept.angle->sample, &Station::sample);
    assert(first != stations.end() && kept.angle);
    starts_.push_back({sheet, &kept.state, &model_.approach(),
                       static_cast<std::size_t>(first - stations.begin()),
                       kept.angle->determinant_sign});
  }
  queue_.begin_from(starts_);
  return queue_;
}

bool ApproachObserver::see(const Station& station, int lane) {
  assert(rejection_ && station.sample > 0);
  const int sheet = queue_.of_lane(lane);
  rejection_->observe(sheet, {station.sample, point_.lengths.data(), kRejection.path_length_widths,
                              point_.slopes.data(), kRejection.path_slope_widths_per_rad});
  rejection_->observe(sheet, station.sample, point_.state);
  return !rejection_->decided(sheet);
}

void ApproachObserver::ended(const PathResult& path, int lane) {
  rejection_->path_ended(queue_.of_lane(lane), path);
  effort_.add(path);
}

}  // namespace misalign::solver

#include "solver/lane_desk.hpp"

#include <algorithm>

namespace misalign::solver {
namespace {

void count(const PathResult& path, Effort& effort) {
  effort.solves += static_cast<std::uint64_t>(path.newton_solves + path.arc_steps);
  effort.iterations += static_cast<std::uint64_t>(path.newton_iterations);
}

}  // namespace

StopCopy::StopCopy(const Mechanism& mechanism)
    : state(flat_state<double>(mechanism)),
      lengths(mechanism.diagonals.size()),
      slopes(mechanism.diagonals.size()) {}

StopCopy::~StopCopy() = default;

JudgingDesk::JudgingDesk(const SheetFamily& family, int lanes)
    : family_(family),
      work_of_lane_(lanes),
      judges_(lanes, Judge(family.mechanism())),
      found_(family.mechanism()) {}

JudgingDesk::~JudgingDesk() = default;

void JudgingDesk::begin(const ShiftBlock& block, const std::vector<int>& chosen) {
  block_ = &block;
  chosen_ = &chosen;
  next_ = 0;
  verdicts_.assign(chosen.size(), {});
}

bool JudgingDesk::next(Departure& departure, int lane) {
  if (next_ == chosen_->size()) return false;
  work_of_lane_[lane] = next_;
  family_.displace(block_->of((*chosen_)[next_++]), vertices_mm_);
  place(family_.mechanism(), vertices_mm_, geometry_);
  flat_lengths(family_.mechanism(), geometry_, found_.lengths.data());
  judges_[lane].begin(found_.lengths);
  departure = {&geometry_, &family_.path().start, &family_.path(), 0, 0};
  return true;
}

bool JudgingDesk::visit(const Stop& stop, int lane) {
  return stop.sample == 0 || judges_[lane].see(stop, found_.state, found_.lengths);
}

void JudgingDesk::ended(const PathResult& path, int lane) {
  verdicts_[work_of_lane_[lane]] = judges_[lane].conclude(path);
  count(path, effort_);
}

RecordingDesk::RecordingDesk(const SheetFamily& family, int lanes)
    : family_(family),
      shape_(family.base().sheet, family.base().holes, family.mechanism()),
      work_of_lane_(lanes),
      recordings_(lanes, Recording(family.mechanism(), shape_)) {}

RecordingDesk::~RecordingDesk() = default;

void RecordingDesk::begin(const ShiftBlock& block, const std::vector<int>& chosen) {
  block_ = &block;
  chosen_ = &chosen;
  next_ = 0;
  histories_.resize(chosen.size());
}

bool RecordingDesk::next(Departure& departure, int lane) {
  if (next_ == chosen_->size()) return false;
  work_of_lane_[lane] = next_;
  FlatVertices vertices_mm;
  family_.displace(block_->of((*chosen_)[next_++]), vertices_mm);
  recordings_[lane].begin(vertices_mm);
  departure = {&recordings_[lane].geometry(), &family_.path().start, &family_.path(), 0, 0};
  return true;
}

void RecordingDesk::ended(const PathResult& path, int lane) {
  FoldingHistory& history = histories_[work_of_lane_[lane]];
  history = recordings_[lane].conclude(path);
  if (!history.lost()) return;
  FlatVertices vertices_mm;
  family_.displace(block_->of((*chosen_)[work_of_lane_[lane]]), vertices_mm);
  history = record_densely(family_.mechanism(), shape_, family_.path(), vertices_mm);
}

CourseOptions approach_options() {
  CourseOptions options;
  options.closure_tolerance = 1e-7;
  options.walk.turn_tolerance_rad = kApproachTurn_deg * kRadPerDeg;
  options.turn_certain_share = 0.5;
  options.longest_half_sine = 0.5;
  options.longest_correction_rad = 0.15;
  options.least_tangent_cosine = 0;
  return options;
}

ApproachDesk::ApproachDesk(const SheetFamily& family, int lanes)
    : family_(family), sheet_of_lane_(lanes), found_(family.mechanism()) {}

ApproachDesk::~ApproachDesk() = default;

void ApproachDesk::begin(const ShiftBlock& block, Screening& screening) {
  block_ = &block;
  screening_ = &screening;
  waiting_.clear();
  next_ = 0;
  kept_count_ = 0;
}

FoldState<double>& ApproachDesk::keep(int test, int& kept) {
  kept = kept_count_++;
  if (kept == static_cast<int>(kept_.size())) kept_.push_back({test, found_.state});
  kept_[kept].test = test;
  return kept_[kept].state;
}

bool ApproachDesk::next(Departure& departure, int lane) {
  if (next_ == waiting_.size()) return false;
  const Work& work = waiting_[next_++];
  sheet_of_lane_[lane] = work.sheet;
  family_.displace(block_->of(work.sheet), vertices_mm_);
  place(family_.mechanism(), vertices_mm_, geometry_);
  const Kept& kept = kept_[work.kept];
  const TestAngle& test = family_.tests()[kept.test];
  const auto& stops = family_.approach().stops;
  const auto first = std::find_if(stops.begin(), stops.end(),
                                  [&](const Stop& stop) { return stop.sample == test.sample; });
  departure = {&geometry_, &kept.state, &family_.approach(),
               static_cast<std::size_t>(first - stops.begin()), test.determinant_sign};
  return true;
}

bool ApproachDesk::visit(const Stop& stop, int lane) {
  const int sheet = sheet_of_lane_[lane];
  screening_->observe(sheet, {stop.sample, found_.lengths.data(), kPathLengthError,
                              found_.slopes.data(), kPathSlopeError});
  screening_->observe(sheet, stop.sample, found_.state);
  return !screening_->decided(sheet);
}

void ApproachDesk::ended(const PathResult& path, int lane) {
  screening_->path_ended(sheet_of_lane_[lane], path);
  count(path, effort_);
}

}  // namespace misalign::solver

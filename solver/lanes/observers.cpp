#include "solver/lanes/observers.hpp"

#include <algorithm>

#include "solver/verdict/miscut_margin.hpp"

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

LaneSheets::LaneSheets(const SheetFamily& family, int lanes)
    : family_(family),
      sheet_of_lane_(lanes),
      finder_(family.mechanism(), family.elimination(), family.path(),
              family.base().sheet.vertices_mm) {}

LaneSheets::~LaneSheets() = default;

void LaneSheets::begin(const ShiftBlock& block) {
  block_ = &block;
  next_ = 0;
  found_count_ = next_found_ = 0;
}

bool LaneSheets::put_next(Departure& departure, int lane) {
  const FoldState<double>* start = &family_.path().start;
  if (next_ < block_->sheets) {
    put(next_++, lane);
  } else if (next_found_ < found_count_) {
    const Found& found = found_[next_found_++];
    put(found.sheet, lane);
    start = &found.start;
  } else {
    return false;
  }
  departure = {&geometry_, start, &family_.path(), 0, 0};
  return true;
}

bool LaneSheets::has_ended(PathResult& path, int lane) {
  if (path.end != PathEnd::start_lost) return true;
  const int sheet = sheet_of_lane_[lane];
  for (std::size_t k = 0; k < found_count_; ++k) {
    if (found_[k].sheet == sheet) return true;
  }
  const StartEnd end = finder_.find(vertices_mm_of_lane(lane));
  if (end == StartEnd::branch_ended) path.end = PathEnd::fold_limit;
  if (end != StartEnd::found) return true;
  if (found_count_ == found_.size()) found_.push_back({sheet, finder_.state()});
  Found& found = found_[found_count_++];
  found.sheet = sheet;
  found.start = finder_.state();
  return false;
}

void LaneSheets::put(int sheet, int lane) {
  sheet_of_lane_[lane] = sheet;
  family_.displace(block_->of(sheet), vertices_mm_);
  place(family_.mechanism(), vertices_mm_, geometry_);
}

const FlatVertices& LaneSheets::vertices_mm_of_lane(int lane) {
  family_.displace(block_->of(sheet_of_lane_[lane]), vertices_mm_);
  return vertices_mm_;
}

DenseLooks::DenseLooks(const Mechanism& mechanism)
    : mechanism_(mechanism), residual_(mechanism.equations) {}

DenseLooks::~DenseLooks() = default;

const DenseLook& DenseLooks::at(const FlatVertices& vertices_mm, const FoldState<double>& state) {
  if (!look_) look_ = std::make_unique<DenseLook>(mechanism_);
  place(mechanism_, vertices_mm, geometry_);
  look_->at(geometry_, state);
  return *look_;
}

double DenseLooks::open_by(const FlatVertices& vertices_mm, const FoldState<double>& state) {
  place(mechanism_, vertices_mm, geometry_);
  return evaluate(mechanism_, geometry_, state, residual_.data(), nullptr);
}

JudgingDesk::JudgingDesk(const SheetFamily& family, int lanes)
    : family_(family),
      sheets_(family, lanes),
      judges_(lanes, Judge(family.mechanism(), family.bump_is_fault())),
      found_(family.mechanism()),
      shape_(family.base().sheet, family.base().holes, family.mechanism()),
      dense_(family.mechanism()) {}

JudgingDesk::~JudgingDesk() = default;

void JudgingDesk::begin(const ShiftBlock& block) {
  sheets_.begin(block);
  verdicts_.assign(block.sheets, {});
}

bool JudgingDesk::next(Departure& departure, int lane) {
  if (!sheets_.put_next(departure, lane)) return false;
  flat_lengths(family_.mechanism(), sheets_.geometry(), found_.lengths.data());
  judges_[lane].begin(found_.lengths);
  return true;
}

bool JudgingDesk::visit(const Stop& stop, int lane, double misfit) {
  if (stop.sample == 0) return true;
  const bool is_poor = !(misfit <= kLargestMisfit) ||
                       (stop.pilot_deg > kPoorFactorsFrom_deg &&
                        !(dense_.open_by(sheets_.vertices_mm_of_lane(lane), found_.state) <=
                          NewtonOptions{}.closure_tolerance));
  if (is_poor) {
    const DenseLook& dense = dense_.at(sheets_.vertices_mm_of_lane(lane), found_.state);
    found_.state = dense.state();
    found_.lengths = dense.lengths();
    found_.slopes = dense.slopes();
    found_.pilot_rate = dense.pilot_rate();
  }
  return judges_[lane].see(stop, found_.state, found_.lengths,
                           wants_slopes() ? &found_.slopes : nullptr, found_.pilot_rate);
}

void JudgingDesk::ended(PathResult path, int lane) {
  count(path, effort_);
  if (!sheets_.has_ended(path, lane)) return;
  Verdict& verdict = verdicts_[sheets_.of_lane(lane)];
  verdict = judges_[lane].conclude(path);
  if (!is_for_dense_to_confirm(verdict, path)) return;
  const Verdict dense =
      record_densely(family_.mechanism(), shape_, family_.path(), sheets_.vertices_mm_of_lane(lane),
                     {family_.bump_is_fault(), {}})
          .verdict;
  if (dense.first_fault != Fault::undecided) verdict = dense;
}

RecordingDesk::RecordingDesk(const SheetFamily& family, int lanes)
    : family_(family),
      options_{family.bump_is_fault(),
               {},
               solver::margin_samples(family.sample_deg(), family.threshold_sample())},
      shape_(family.base().sheet, family.base().holes, family.mechanism()),
      sheets_(family, lanes),
      recordings_(lanes, Recording(family.mechanism(), options_)) {}

RecordingDesk::~RecordingDesk() = default;

void RecordingDesk::begin(const ShiftBlock& block) {
  sheets_.begin(block);
  histories_.resize(block.sheets);
}

bool RecordingDesk::next(Departure& departure, int lane) {
  if (!sheets_.put_next(departure, lane)) return false;
  recordings_[lane].begin(sheets_.vertices_mm());
  return true;
}

void RecordingDesk::ended(PathResult path, int lane) {
  if (!sheets_.has_ended(path, lane)) return;
  FoldingHistory& history = histories_[sheets_.of_lane(lane)];
  history = confirmed(recordings_[lane].conclude(path), family_.mechanism(), shape_, family_.path(),
                      recordings_[lane].vertices_mm(), options_);
}

// After a correction from this far open, lengths are known to 1e-10 panel widths; of a walk only
// the way on is wanted.
constexpr double kStopClosure = 1e-7, kWalkClosure = 1e-3;

// What two thirds of a step's way to 150 degrees and steps of 5 degrees beyond it move the creases
// of paths that stay on their curve, with room (rad; sine of half of it).
constexpr double kLongestHalfSine = 0.5, kLongestCorrection_rad = 0.15;

CourseOptions approach_options() {
  CourseOptions options;
  options.closure_tolerance = kStopClosure;
  options.walk_closure_tolerance = kWalkClosure;
  options.walk.turn_tolerance_rad = kApproachTurn_deg * kRadPerDeg;
  options.turn_certain_share = 0.5;  // half the way to the threshold
  options.longest_half_sine = kLongestHalfSine;
  options.longest_correction_rad = kLongestCorrection_rad;
  options.least_tangent_cosine = 0;
  return options;
}

ApproachDesk::ApproachDesk(const SheetFamily& family, int lanes)
    : family_(family), sheets_(family, lanes), found_(family.mechanism()) {}

ApproachDesk::~ApproachDesk() = default;

void ApproachDesk::begin(const ShiftBlock& block, Screening& screening) {
  sheets_.begin(block);
  screening_ = &screening;
  waiting_.clear();
  next_ = 0;
  kept_count_ = 0;
}

FoldState<double>& ApproachDesk::keep(int test, int& kept) {
  if (kept < 0) kept = kept_count_++;
  if (kept == static_cast<int>(kept_.size())) kept_.push_back({test, found_.state});
  kept_[kept].test = test;
  return kept_[kept].state;
}

bool ApproachDesk::next(Departure& departure, int lane) {
  if (next_ == waiting_.size()) return false;
  const Work& work = waiting_[next_++];
  sheets_.put(work.sheet, lane);
  const Kept& kept = kept_[work.kept];
  const TestAngle& test = family_.tests()[kept.test];
  const auto& stops = family_.approach().stops;
  const auto first = std::find_if(stops.begin(), stops.end(),
                                  [&](const Stop& stop) { return stop.sample == test.sample; });
  departure = {&sheets_.geometry(), &kept.state, &family_.approach(),
               static_cast<std::size_t>(first - stops.begin()), test.determinant_sign};
  return true;
}

bool ApproachDesk::visit(const Stop& stop, int lane) {
  const int sheet = sheets_.of_lane(lane);
  screening_->observe(sheet, {stop.sample, found_.lengths.data(), kPathLengthError,
                              found_.slopes.data(), kPathSlopeError});
  screening_->observe(sheet, stop.sample, found_.state);
  return !screening_->decided(sheet);
}

void ApproachDesk::ended(const PathResult& path, int lane) {
  screening_->path_ended(sheets_.of_lane(lane), path);
  count(path, effort_);
}

}  // namespace misalign::solver

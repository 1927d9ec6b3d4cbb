#include "solver/sheet/sheet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "solver/kinematics/diagonals.hpp"
#include "solver/sheet/path_source.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;

// The equations are singular where all is folded flat: angles are known to the root of the closure
// tolerance there, 6e-5 degrees.
constexpr double kShownOverFold_deg = 1e-3;

Eigen::Matrix3Xd laid_over(const Eigen::Matrix3Xd& shape_mm, const FlatVertices& flat_mm) {
  assert(shape_mm.cols() == flat_mm.cols());
  Eigen::Matrix3Xd place_mm = Eigen::Matrix3Xd::Zero(3, flat_mm.cols());
  place_mm.topRows<2>() = flat_mm;
  const Eigen::Isometry3d moved(Eigen::umeyama(shape_mm, place_mm, false));
  return moved * shape_mm;
}

// The first such pair of vertices: a rectangle has two, and rounding must not choose between them.
std::pair<int, int> farthest_apart(const FlatVertices& vertices_mm) {
  constexpr double kLongerBy = 1 + 1e-9;  // far above what a sheet loses that is drawn far off
  std::pair<int, int> span{0, 0};
  double longest = 0;
  for (int a = 0; a < static_cast<int>(vertices_mm.cols()); ++a) {
    for (int b = a + 1; b < static_cast<int>(vertices_mm.cols()); ++b) {
      const double length = (vertices_mm.col(a) - vertices_mm.col(b)).norm();
      if (length > kLongerBy * longest) longest = length, span = {a, b};
    }
  }
  assert(span.first != span.second);
  return span;
}

SheetGeometry<double> placed(const Sheet& sheet) {
  SheetGeometry<double> geometry;
  place(sheet.mechanism(), sheet.vertices_mm(), geometry);
  return geometry;
}

}  // namespace

SheetSolver::SheetSolver(const Model& model)
    : model_(model),
      panels_(panels_of(model.base(), model.mechanism())),
      paths_(path_source_of(model)) {}

SheetSolver::~SheetSolver() = default;

Sheet::Sheet(SheetSolver& solver, Eigen::Matrix2Xd shifts_mm, std::string name)
    : solver_(solver),
      shifts_mm_(std::move(shifts_mm)),
      vertices_mm_(model().base().sheet.vertices_mm + shifts_mm_),
      name_(std::move(name)) {
  assert(shifts_mm_.cols() == model().base().sheet.vertex_count());
  assert(shifts_mm_.allFinite());
}

const PathRecord& Sheet::record() const {
  if (!record_) record_ = solver_.paths_->record(vertices_mm_);
  if (!record_) record_ = record_of(history(), mechanism());
  return *record_;
}

const FoldingHistory& Sheet::history() const {
  if (history_) return *history_;
  history_ = solver_.paths_->history(vertices_mm_, states_);
  const PathExtremes extremes = extremes_of(*history_);
  history_->between.bump_where = extremes.bump_where;
  history_->between.bump_deg = extremes.bump_deg.value_or(0);
  return *history_;
}

// Extremes come from the path as a function, where that was measured.
PathExtremes Sheet::extremes_of(const FoldingHistory& history) const {
  const bool deploys = history.verdict.deploys_from_sample > 0;
  if (deploys && !record().lengths.empty()) return record().extremes;
  return record_of(history, mechanism()).extremes;
}

std::optional<Metrics> Sheet::measure(const FoldingHistory& history) const {
  if (history.verdict.deploys_from_sample == 0) return {};
  PathRecord record = record_of(history, mechanism());
  record.extremes = extremes_of(history);
  return solver::measure(model(), vertices_mm_, record);
}

const Metrics* Sheet::metrics() const {
  if (!metrics_) metrics_ = measure(history());
  return *metrics_ ? &**metrics_ : nullptr;
}

const std::vector<WayStation>& Sheet::states() const {
  history();
  return states_;
}

const std::vector<Eigen::Matrix3Xd>& Sheet::shapes_mm() const {
  if (shapes_mm_.size() == states().size()) return shapes_mm_;
  const SheetGeometry<double> geometry = placed(*this);
  for (const WayStation& at : states()) {
    shapes_mm_.push_back(laid_over(model().shape().vertices_mm(geometry, at.state), vertices_mm_));
  }
  return shapes_mm_;
}

const std::vector<double>& Sheet::span_slope_mm_per_deg() const {
  if (span_slope_mm_per_deg_.size() == states().size()) return span_slope_mm_per_deg_;
  const SheetGeometry<double> geometry = placed(*this);
  const FoldedShape& shape = model().shape();
  const auto [from, to] = farthest_apart(vertices_mm_);
  const double per_deg = mechanism().panel_width_mm * kRadPerDeg;
  FoldedShape::Points<double> points;
  std::vector<FoldedShape::Twist<double>> twists;
  for (const WayStation& at : states()) {
    shape.place(geometry, at.state, points);
    shape.move(geometry, points, at.rates.data(), twists);
    span_slope_mm_per_deg_.push_back(per_deg * shape.distance_rate(points, twists, from, to));
  }
  return span_slope_mm_per_deg_;
}

const FoldingWay* Sheet::way(int stations) const {
  assert(stations >= SmoothTable::kPoints);
  auto way = ways_.find(stations);
  if (way == ways_.end()) {
    way = ways_.emplace(stations, solver_.paths_->way(vertices_mm_, outline_, stations)).first;
  }
  assert(!way->second || std::ssize(way->second->stations()) <= stations);
  return way->second ? &*way->second : nullptr;
}

const Sheet::Pose& Sheet::at(double pilot_deg) const {
  const auto known = poses_.find(pilot_deg);
  if (known != poses_.end()) return known->second;
  assert(way() != nullptr);
  const FoldingWay& path = *way();
  Pose pose{path.stations().front().state, false, {}, {}, {}};
  path.find_state(path.x_of(pilot_deg), pose.state);
  pose.is_closed = solver_.paths_->close(path.geometry(), pose.state);
  pose.vertices_mm = model().shape().vertices_mm(path.geometry(), pose.state);
  pose.fold_deg.resize(std::ssize(pose.state.creases));
  for (Index c = 0; c < pose.fold_deg.size(); ++c) {
    pose.fold_deg(c) =
        mechanism().side * angle_deg(pose.state.creases[static_cast<std::size_t>(c)]);
  }
  pose.length_mm.resize(mechanism().diagonal_count());
  folded_lengths(mechanism(), path.geometry(), pose.state, pose.length_mm.data());
  pose.length_mm *= mechanism().panel_width_mm;
  return poses_.emplace(pilot_deg, std::move(pose)).first->second;
}

std::optional<Index> Sheet::row_at(double pilot_deg) const {
  const std::vector<Station>& stations = history().stations;
  const auto at =
      std::ranges::lower_bound(stations, pilot_deg - kSameAngle_deg, {}, &Station::pilot_deg);
  if (at == stations.end() || at->pilot_deg > pilot_deg + kSameAngle_deg) return {};
  return at - stations.begin();
}

Index Sheet::rows_up_to_d() const {
  Index rows = 0;
  for (std::size_t row = 0; row < history().stations.size(); ++row) {
    const int sample = history().stations[row].sample;
    if (sample > 0 && sample <= history().verdict.deploys_from_sample) {
      rows = static_cast<Index>(row) + 1;
    }
  }
  return rows;
}

Index Sheet::rows_shown() const {
  const Index up_to_d = rows_up_to_d();
  return up_to_d > 0 ? up_to_d : rows_folded_well(mechanism(), history(), kShownOverFold_deg);
}

std::vector<Index> Sheet::rows_to_show(double step_deg) const {
  assert(step_deg > 0);
  std::vector<Index> rows;
  const Index end = rows_shown();
  for (Index row = 0; row < end; ++row) {
    const double away =
        std::remainder(history().stations[static_cast<std::size_t>(row)].pilot_deg, step_deg);
    if (std::abs(away) <= kSameAngle_deg || row + 1 == end) rows.push_back(row);
  }
  return rows;
}

Index rows_folded_well(const Mechanism& mechanism, const FoldingHistory& history, double band_deg) {
  const Eigen::MatrixXd& angle_deg = history.fold_angle_deg;
  assert(angle_deg.rows() == 0 || angle_deg.cols() == std::ssize(mechanism.creases));
  for (Index row = 0; row < angle_deg.rows(); ++row) {
    for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
      const double angle = angle_deg(row, static_cast<Index>(i));
      const bool valley = mechanism.is_valley(mechanism.creases[i]);
      if ((angle > 0) != valley || std::abs(angle) > 180 + band_deg) return row;
    }
  }
  return angle_deg.rows();
}

}  // namespace misalign::solver

#include "solver/play/backlash_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/records/record_sheet.hpp"

namespace misalign::solver {
namespace {

// Largest distance of stations, as on a path without play (PathPlanOptions).
const double kLongestStep_deg = PathPlanOptions{}.longest_step_deg;
// Shares of a sample's distance that are rounding.
constexpr double kSameSample = 1e-9;

// Adds an angle to judge, and solver steps up to it.
void add_station(PathPlan& plan, double pilot_deg) {
  const double from_deg = plan.stations.empty() ? pilot_deg : plan.stations.back().pilot_deg;
  const int steps =
      std::max(1, static_cast<int>(std::ceil((pilot_deg - from_deg) / kLongestStep_deg - 1e-9)));
  for (int k = 1; k <= steps; ++k) {
    const double deg = k == steps ? pilot_deg : from_deg + (pilot_deg - from_deg) * k / steps;
    plan.stations.push_back({deg, half_angle_of_deg(deg), 0, k == steps});
  }
}

}  // namespace

BacklashStart prepare_backlash(const Model& model, const FlatVertices& vertices_mm,
                               const BacklashOptions& options) {
  const Mechanism& mechanism = model.mechanism();
  BacklashStart sheet;
  place(mechanism, vertices_mm, sheet.geometry);
  std::vector<std::pair<Station, FoldState<double>>> samples;
  const StationVisitor keep = [&](const Station& station, const PathPoint& point) {
    if (station.sample > 0) samples.emplace_back(station, point.state);
  };
  sheet.to_sample = record_history(model, vertices_mm, &keep).verdict.deploys_from_sample;
  sheet.own_deg = sheet.to_sample * model.sample_deg();
  if (options.used_from_deg) {
    const double used = std::ceil(*options.used_from_deg / model.sample_deg() - kSameSample);
    sheet.to_sample = std::min(sheet.to_sample, static_cast<int>(used));
  }
  sheet.to_deg = sheet.to_sample * model.sample_deg();
  sheet.shortest_crease_widths = std::numeric_limits<double>::infinity();
  for (const Crease& crease : mechanism.creases) {
    const double length =
        distance(flat_point(sheet.geometry, crease.a), flat_point(sheet.geometry, crease.b));
    sheet.shortest_crease_widths = std::min(sheet.shortest_crease_widths, length);
  }
  if (sheet.to_deg <= options.from_deg) return sheet;
  const double middle_deg = 0.5 * (options.from_deg + sheet.to_deg);
  std::vector<double> before(mechanism.diagonals.size()), lengths(before);
  flat_lengths(mechanism, sheet.geometry, before.data());
  for (const auto& [station, state] : samples) {
    if (station.sample > sheet.to_sample) break;
    if (std::abs(station.pilot_deg - middle_deg) < std::abs(sheet.start_deg - middle_deg)) {
      sheet.start_deg = station.pilot_deg;
      sheet.start = state;
    }
    folded_lengths(mechanism, sheet.geometry, state, lengths.data());
  }
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    sheet.directions.push_back(lengths[k] > before[k] ? 1 : -1);
  }
  return sheet;
}

PathPlan plan_up(const BacklashStart& sheet, double sample_deg) {
  PathPlan plan;
  add_station(plan, sheet.start_deg);
  for (int k = 1; k <= sheet.to_sample; ++k) {
    if (k * sample_deg > sheet.start_deg + kSameAngle_deg) add_station(plan, k * sample_deg);
  }
  return plan;
}

PathPlan plan_down(const BacklashStart& sheet, double sample_deg, const BacklashOptions& options) {
  PathPlan plan;
  add_station(plan, 0);
  const auto add = [&](double pilot_deg) {
    const double dto_deg = sheet.start_deg - pilot_deg;
    if (dto_deg > plan.stations.back().pilot_deg + kSameAngle_deg) add_station(plan, dto_deg);
  };
  for (int k = sheet.to_sample; k > 0 && k * sample_deg > options.from_deg; --k) {
    add(k * sample_deg);
  }
  add(options.from_deg);
  const int steps = static_cast<int>(std::ceil(options.from_deg / options.flat_step_deg - 1e-9));
  for (int k = steps - 1; k >= 0; --k) add(options.from_deg * k / steps);
  return plan;
}

}  // namespace misalign::solver

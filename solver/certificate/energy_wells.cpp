#include "solver/certificate/energy_wells.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/certificate/certifier.hpp"
#include "solver/certificate/energy_slope.hpp"
#include "solver/certificate/simple_roots.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::solver {
namespace {

/// Length to which the part of a stationary point is narrowed. Largest that is taken, and on an
/// interval of at most kShort_deg: on shorter ones errors do not become much smaller.
constexpr double kNarrow_deg = 1e-8, kWidest_deg = 1e-4, kWidestOfShort_deg = 0.01, kShort_deg = 1;
/// More than the resolution of IntervalChart::angle_deg_until.
constexpr double kReach_deg = 1e-7;
/// An interval ends where the slope is at least this many times as large as its error: then the
/// next one, whose error is similar, does not begin next to a root.
constexpr double kClearEnd = 100;

// Finds the stationary points, interval by interval.
class WellFinder {
 public:
  explicit WellFinder(EnergyWells& wells) : wells_(wells) {}

  // Adds those of an interval; returns false where they are not proven.
  bool add(const PathTube& tube, const EnergyAlong& energy) {
    PathModel blurred = energy.slope;
    blurred.radius *= kClearEnd;
    if (sign_at(blurred, Ball(1.0)) == 0) return false;
    const auto roots = isolate_roots(energy.slope);
    if (!roots) return false;
    const std::ptrdiff_t before = std::ssize(wells_.points);
    for (const RootPart& root : *roots) {
      if (add(tube, energy, root)) continue;
      wells_.points.erase(wells_.points.begin() + before, wells_.points.end());
      return false;
    }
    if (tube.chart.interval().from_deg > 0) return true;
    const int sign = sign_at(energy.slope, Ball(-1.0));
    assert(sign != 0);
    wells_.flat = sign > 0 ? Stationary::well : Stationary::top;
    wells_.flat_energy = shown(value_at(energy.n_mm, Ball(-1.0)));
    return true;
  }

 private:
  static ProvenEnergy shown(const Ball& ball) { return {ball.c[0], ball.radius}; }

  // Narrows a root's part in pilot angles.
  bool add(const PathTube& tube, const EnergyAlong& energy, const RootPart& root) {
    const IntervalChart& chart = tube.chart;
    const PathInterval& all = chart.interval();
    const auto sign = [&](double deg) { return sign_at(energy.slope, chart.place_of(deg)); };
    double from_deg = chart.angle_deg_until(root.from);
    double to_deg = std::min(all.to_deg, chart.angle_deg_until(root.to) + kReach_deg);
    const double last_deg = wells_.points.empty() ? all.from_deg : wells_.points.back().to_deg;
    if (from_deg < last_deg || sign(from_deg) != -root.sign_behind) return false;
    if (sign(to_deg) != root.sign_behind) return false;
    while (to_deg - from_deg > kNarrow_deg) {
      const double middle_deg = 0.5 * (from_deg + to_deg);
      const int its = sign(middle_deg);
      if (its == 0) break;
      (its == root.sign_behind ? to_deg : from_deg) = middle_deg;
    }
    const bool is_short = all.to_deg - all.from_deg <= kShort_deg;
    if (to_deg - from_deg > (is_short ? kWidestOfShort_deg : kWidest_deg)) return false;
    const Ball from = chart.place_of(from_deg), to = chart.place_of(to_deg);
    const double middle = 0.5 * (from.c[0] + to.c[0]);
    const double half = std::max((to - Ball(middle)).bound(), (from - Ball(middle)).bound());
    wells_.points.push_back({root.sign_behind > 0 ? Stationary::well : Stationary::top, from_deg,
                             to_deg, shown(value_at(energy.n_mm, Ball::number(middle, half)))});
    return true;
  }

  EnergyWells& wells_;
};

std::optional<OptionFault> fault_of(const Sheet& sheet, const Fill& fill) {
  const auto* const springs = std::get_if<Springs>(&fill);
  double rest_deg = solver::rest_deg(fill);
  if (springs) {
    for (const auto& [diagonal, deg] : springs->other_rests_deg) rest_deg = std::max(rest_deg, deg);
  }
  if (rest_deg > 0 && rest_deg >= sheet.way()->end_deg()) {
    return OptionFault{
        "rest_deg", shown("%g", rest_deg),
        sheet.name() + " folds to " + shown("%.4f", sheet.way()->end_deg()) + " deg only",
        "name a smaller angle"};
  }
  if (const char* const why = why_no_wells(fill, sheet.mechanism().springs)) {
    return OptionFault{
        "fill", {}, std::string("has no proof of its wells (") + why + ")", "change the filling"};
  }
  return {};
}

// The filling as certificates take it: springs that are not relaxed flat by their free lengths.
Fill with_free_lengths(const Sheet& sheet, const Fill& fill) {
  if (why_not_certifiable(fill, sheet.mechanism().springs) == nullptr) return fill;
  const Filling filling = filling_on(*sheet.way(), fill);
  Springs springs;
  for (const Diagonal& diagonal : sheet.mechanism().diagonals) {
    const Eigen::Index d = std::ssize(springs.single);
    const double free_mm = filling.relaxed_mm()(d);
    springs.single.push_back({{diagonal.from, diagonal.to}, filling.rates_n_per_mm()(d), {}});
    if (free_mm != sheet.way()->flat_mm()(d)) springs.single.back().free_mm = free_mm;
  }
  return springs;
}

}  // namespace

const char* name_of(Stationary kind) { return kind == Stationary::well ? "well" : "top"; }

int EnergyWells::wells() const {
  return static_cast<int>(std::ranges::count(points, Stationary::well, &StationaryPoint::kind));
}

StudyResult<EnergyWells> prove_wells(const Sheet& sheet, const Fill& fill, double to_deg) {
  assert(to_deg > 0 && to_deg <= 180 && sheet.mechanism().springs.in_mid_plane());
  if (sheet.model().is_overconstrained()) return NoResult::overconstrained;
  if (sheet.way() == nullptr) return NoResult::path_lost;
  if (auto fault = fault_of(sheet, fill)) return *std::move(fault);
  EnergyWells wells;
  WellFinder finder(wells);
  const Certificate path = Certifier(sheet.model(), false, with_free_lengths(sheet, fill))
                               .certify(sheet.vertices_mm(), to_deg,
                                        [&](const PathTube& tube, const EnergyAlong& energy) {
                                          return finder.add(tube, energy);
                                        });
  wells.asked_deg = to_deg;
  wells.proven_deg = path.certified_deg();
  wells.end = path.end;
  wells.where = path.where;
  return wells;
}

}  // namespace misalign::solver

#include "solver/contact/offset_ends.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

SpringEnds raised_ends(const Mechanism& mechanism, OffsetKind kind, double inset_mm,
                       double offset_mm) {
  SpringEnds ends;
  for (const Loop& loop : mechanism.loops) {
    if (loop.hole < 0) continue;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const Loop::Carrier& carrier = loop.carriers[corner];
      Eigen::Vector3d place_mm = carrier.place_mm;
      if (mechanism.springs.at_vertices()) place_mm = {inset_mm, 0, 0};
      const bool is_first = corner % 2 == 1;  // (corner 1, corner 3), then (corner 2, corner 0)
      place_mm.z() = is_first ? offset_mm : kind == OffsetKind::alternate ? -offset_mm : 0;
      ends.own.push_back({loop.hole, loop.corners[corner], carrier.facet, place_mm});
    }
  }
  return ends;
}

int monotone_diagonals(const FoldingHistory& history, double from_deg) {
  Eigen::Index rows = 0;
  while (rows < std::ssize(history.stations) &&
         history.stations[static_cast<std::size_t>(rows)].pilot_deg <= from_deg + kSameAngle_deg) {
    ++rows;
  }
  int monotone = 0;
  for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
    int longer = 0, shorter = 0;
    double before_mm = history.flat_mm[static_cast<std::size_t>(d)];
    for (Eigen::Index row = 0; row < rows; ++row) {
      const double length_mm = history.length_mm(row, d);
      (length_mm > before_mm ? longer : shorter) += 1;
      before_mm = length_mm;
    }
    monotone += longer == 0 || shorter == 0;
  }
  return monotone;
}

}  // namespace

std::vector<OffsetEnds> offset_ends(const Sheet& sheet, const PanelMotion& motion,
                                    const SpringBodies& bodies, double from_deg) {
  const Mechanism& mechanism = sheet.mechanism();
  const FoldingWay& way = motion.way();
  const double end = way.x_of(from_deg);
  assert(end <= motion.resolved_until());
  const double inset_mm = mechanism.springs.at_vertices() ? kInsetPart * mechanism.panel_width_mm
                                                          : mechanism.springs.inset_mm;
  std::vector<OffsetEnds> judged;
  for (const OffsetKind kind : kOffsetKinds) {
    OffsetEnds result{kind, inset_mm, {}, mechanism.springs};
    // Diagonals of a convex hole cross when it is flat: with less their springs touch there.
    const double least_mm = bodies.diameter_mm / (kind == OffsetKind::alternate ? 2 : 1);
    for (double k = std::ceil(least_mm / kOffsetStep_mm);
         k * kOffsetStep_mm <= 2 * bodies.diameter_mm && !result.offset_mm; ++k) {
      PerforatedSheet base = sheet.base();
      base.springs = raised_ends(mechanism, kind, inset_mm, k * kOffsetStep_mm);
      const auto axes = spring_axes(build_mechanism(base), sheet.panels(), way, bodies);
      const SpringMeetings met = springs_that_meet(motion, axes, bodies, end);
      if (!met.touching.empty()) continue;
      result.offset_mm = k * kOffsetStep_mm;
      result.ends = base.springs;
      result.springs = met;
      const Model model(base, {.sample_deg = sheet.model().sample_deg()});
      SheetSolver solver(model);
      const Sheet raised(solver, sheet.shifts_mm(), sheet.name());
      result.deploys_from_deg = raised.deploys_from_deg();
      result.monotone = monotone_diagonals(raised.history(), from_deg);
      result.diagonals = mechanism.diagonal_count();
    }
    judged.push_back(std::move(result));
  }
  return judged;
}

}  // namespace misalign::solver

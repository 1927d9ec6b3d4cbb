#include "solver/contact/spring_clearance.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {
namespace {

constexpr double kNoPair = std::numeric_limits<double>::infinity();
// Number of places of the first guess of the least clearance, which rules out most pairs at once.
constexpr int kSpringGuesses = 6;

// Two bodies, and the distance of their axes or mid-planes at which they touch.
struct BodyPair {
  SpringMeeting bodies;
  double limit_mm;
  SpringWalk walk;
};

SpringMeetings meetings_of(std::vector<BodyPair> pairs, const FoldingWay& way, double end) {
  SpringMeetings meetings;
  const auto meeting = [&](const BodyPair& pair, double apart_mm, double x) {
    SpringMeeting found = pair.bodies;
    found.apart_mm = apart_mm;
    found.clear_mm = apart_mm - pair.limit_mm;
    found.pilot_deg = way.pilot_deg(x);
    return found;
  };
  const auto keep_closest = [&](const SpringMeeting& found) {
    if (!meetings.closest || found.clear_mm < meetings.closest->clear_mm) meetings.closest = found;
  };
  for (int k = 0; k <= kSpringGuesses; ++k) {
    const double x = end * k / kSpringGuesses;
    for (BodyPair& pair : pairs) keep_closest(meeting(pair, pair.walk.move_to(x), x));
  }
  for (BodyPair& pair : pairs) {
    double at_x = 0;
    double apart_mm = pair.limit_mm + std::max(meetings.closest->clear_mm, kSpringTouch_mm);
    if (!lower_to_least(pair.walk, {0, kSpringTouch_mm}, end, apart_mm, at_x)) continue;
    const SpringMeeting found = meeting(pair, apart_mm, at_x);
    if (found.touches()) meetings.touching.push_back(found);
    keep_closest(found);
  }
  return meetings;
}

SpringMeetings panels_met(const PanelMotion& motion, const std::vector<SpringAxis>& axes,
                          const std::vector<PolygonCorners>& outlines, const SpringBodies& bodies,
                          double end) {
  std::vector<BodyPair> pairs;
  for (const SpringAxis& axis : axes) {
    for (int panel = 0; panel < motion.panels(); ++panel) {
      pairs.push_back({{.spring = axis.diagonal, .panel = panel},
                       (bodies.diameter_mm + bodies.panel_mm) / 2,
                       SpringWalk(motion, axis, panel, outlines[static_cast<std::size_t>(panel)])});
    }
  }
  return meetings_of(std::move(pairs), motion.way(), end);
}

// Distances at x of axes from each other and from mid-planes, seen from the first panel.
SpringClearance::Apart apart_at(const PanelMotion& motion, const Mechanism& mechanism,
                                const std::vector<SpringAxis>& axes,
                                const std::vector<PolygonCorners>& outlines, double x) {
  SpringClearance::Apart apart{kNoPair, 0, kNoPair, kNoPair};
  std::vector<PolygonCorners> lines, polygons;
  for (const SpringAxis& axis : axes) lines.push_back(axis.seen_from_panel(motion, 0, x));
  for (int panel = 0; panel < motion.panels(); ++panel) {
    const PanelMotion::Pose pose = motion.pose(x, panel);
    const PolygonCorners& outline = outlines[static_cast<std::size_t>(panel)];
    polygons.push_back((pose.rotation * outline).colwise() + pose.shift_mm);
  }
  const auto loop = [&](std::size_t k) {
    return mechanism.diagonals[static_cast<std::size_t>(axes[k].diagonal)].loop;
  };
  for (std::size_t k = 0; k < lines.size(); ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      const double mm = separation_of(lines[i], lines[k]).distance;
      if (loop(i) == loop(k)) {
        apart.least_hole_mm = std::min(apart.least_hole_mm, mm);
        apart.largest_hole_mm = std::max(apart.largest_hole_mm, mm);
      } else {
        apart.springs_mm = std::min(apart.springs_mm, mm);
      }
    }
    for (const PolygonCorners& polygon : polygons) {
      apart.panels_mm = std::min(apart.panels_mm, separation_of(polygon, lines[k]).distance);
    }
  }
  return apart;
}

}  // namespace

const SpringMeeting* closest_meeting(const SpringClearance& clearance) {
  const auto& springs = clearance.springs.closest;
  const auto& panels = clearance.panels.closest;
  if (springs && !(panels && panels->clear_mm < springs->clear_mm)) return &*springs;
  return panels ? &*panels : nullptr;
}

std::vector<int> sprung_diagonals(const Filling& filling) {
  std::vector<int> sprung;
  const Eigen::VectorXd& rates = filling.rates_n_per_mm();
  for (Eigen::Index d = 0; d < rates.size(); ++d) {
    if (rates(d) > 0) sprung.push_back(static_cast<int>(d));
  }
  return sprung;
}

std::vector<SpringAxis> spring_axes(const Mechanism& mechanism, const Panels& panels,
                                    const FoldingWay& way, const SpringBodies& bodies) {
  std::vector<SpringAxis> axes;
  for (const int diagonal : sprung_diagonals(filling_on(way, bodies.fill))) {
    axes.push_back(spring_axis(mechanism, panels, way.geometry(), diagonal, bodies.left_out_mm()));
  }
  return axes;
}

std::optional<OptionFault> nothing_left_of_springs(const Sheet& sheet, const SpringBodies& bodies,
                                                   const FoldingWay& way) {
  const double half_mm = way.flat_mm().size() > 0 ? way.flat_mm().minCoeff() / 2 : kNoPair;
  if (bodies.left_out_mm() < half_mm) return {};
  const bool is_given = bodies.end_mm.has_value();
  return OptionFault{is_given ? "end_mm" : "diameter_mm",
                     shown("%g", is_given ? *bodies.end_mm : bodies.diameter_mm),
                     "leaves nothing of the shortest spring of " + sheet.name() +
                         " between its ends of " + shown("%.4g", bodies.left_out_mm()) + " mm",
                     "take shorter ends or thinner springs"};
}

SpringMeetings springs_that_meet(const PanelMotion& motion, const std::vector<SpringAxis>& axes,
                                 const SpringBodies& bodies, double end) {
  std::vector<BodyPair> pairs;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      pairs.push_back({{.spring = axes[i].diagonal, .other = axes[k].diagonal},
                       bodies.diameter_mm,
                       SpringWalk(motion, axes[i], axes[k])});
    }
  }
  return meetings_of(std::move(pairs), motion.way(), end);
}

StudyResult<SpringClearance> spring_clearance(const Sheet& sheet, const PanelMotion& motion,
                                              const std::vector<PolygonCorners>& outlines,
                                              const SpringBodies& bodies, double end,
                                              const std::vector<double>& pilot_deg) {
  if (auto fault = nothing_left_of_springs(sheet, bodies, motion.way())) return *fault;
  const auto axes = spring_axes(sheet.mechanism(), sheet.panels(), motion.way(), bodies);
  SpringClearance study{bodies,
                        sheet.mechanism().diagonals,
                        springs_that_meet(motion, axes, bodies, end),
                        panels_met(motion, axes, outlines, bodies, end),
                        {}};
  for (const double angle_deg : pilot_deg) {
    study.apart.push_back(
        apart_at(motion, sheet.mechanism(), axes, outlines, motion.way().x_of(angle_deg)));
  }
  return study;
}

StudyResult<std::vector<std::pair<int, int>>> touching_springs(const Sheet& sheet,
                                                               const SpringBodies& bodies,
                                                               double from_deg) {
  if (auto fault = beyond_d(sheet, from_deg)) return *fault;
  const std::optional<PanelMotion> motion = resolved_motion(sheet);
  if (!motion) return NoResult::path_lost;
  if (auto fault = nothing_left_of_springs(sheet, bodies, motion->way())) return *fault;
  SpringBodies everywhere = bodies;
  everywhere.fill = Springs{};
  const FoldingWay& way = motion->way();
  const auto axes = spring_axes(sheet.mechanism(), sheet.panels(), way, everywhere);
  const double end = way.x_of(std::min(from_deg, way.pilot_deg(motion->resolved_until())));
  std::vector<std::pair<int, int>> pairs;
  for (const SpringMeeting& met : springs_that_meet(*motion, axes, everywhere, end).touching) {
    pairs.emplace_back(met.spring, met.other);
  }
  return pairs;
}

}  // namespace misalign::solver

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "schema/exchange/actuators_json.hpp"
#include "schema/pattern/fill_words.hpp"
#include "schema/pattern/preload_json.hpp"
#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

using solver::Deployment;
using solver::DeploymentStudy;
using solver::Outcome;

std::string released_sheet_text(int diagonals, const DeploymentStudy& study) {
  const solver::Fill& fill = study.sheet.fill;
  const auto* const springs = std::get_if<solver::Springs>(&fill);
  const solver::Plates& plates = study.sheet.plates;
  std::string text = fmt::format(
      "released at rest from {:g} deg: {}{}; panels of {:g} mm, mass {:.4g} g; {}\n",
      study.options.from_deg, schema::filling_words(fill, diagonals, schema::kDegreeWord),
      springs && !springs->other_rests_deg.empty() ? " (some at other angles)" : "",
      plates.thickness_mm, study.mass_t * 1e6,
      study.sheet.held ? "one panel held" : "free in space");
  if (springs && springs->preload.is_any()) {
    text += fmt::format("preload: {} in each spring at flat, its free length up to {:.4g} mm off\n",
                        schema::preload_words(springs->preload),
                        springs->preload.largest_n() / springs->stiffness_n_per_mm);
  }
  const solver::JointResistance& joints = study.sheet.joints;
  std::string hinges;
  const auto add = [&](double value, const char* what) {
    if (value > 0) hinges += fmt::format("{}{} {:g}", hinges.empty() ? "" : ", ", what, value);
  };
  add(joints.friction_n_mm_per_mm, "friction (N mm/mm)");
  add(joints.ball_friction_n_mm, "friction of ball joints (N mm)");
  add(joints.damping_n_mm_s_per_mm, "damping (N mm s/mm)");
  add(joints.stiffness_n_mm_per_mm, "crease stiffness (N mm/rad per mm)");
  return hinges.empty() ? text : text + "joints: " + hinges + "\n";
}

// Bounces off a stop: their number, and the speed and energy of the first.
std::string bounces_text(const DeploymentStudy& study) {
  for (const Deployment::Row& row : study.run.rows) {
    if (row.event != Deployment::Event::flat) continue;
    return fmt::format(", after {} bounces off the stop; the first at {:.4g} deg/s, {:.4g} N mm",
                       study.run.bounces, std::abs(row.rate_deg_per_s), row.kinetic_n_mm);
  }
  return "";
}

std::string damping_text(const DeploymentStudy& study) {
  if (!study.seeks_damping) return "";
  if (!study.least_damping) return "least damping: none found that brings the sheet to rest flat\n";
  return fmt::format(
      "least damping that stops the sheet at flat without passing through: {:.4g} N mm s/mm; "
      "deployment time {:.4g} s\n",
      study.least_damping->damping_n_mm_s_per_mm, study.least_damping->time_s);
}

std::string outcome_text(const DeploymentStudy& study) {
  const Deployment::Row& last = study.run.last();
  const std::string when = fmt::format("after {:.4g} s", last.time_s);
  const std::string speed = fmt::format("{:.4g} deg/s", std::abs(last.rate_deg_per_s));
  switch (study.run.outcome) {
    case Outcome::flat:
      return fmt::format("comes to rest flat ({:.3g} deg) {}{}\n", last.pilot_deg, when,
                         study.options.restitution ? bounces_text(study) : "");
    case Outcome::passed_flat:
      return fmt::format("passes through flat {}, at {}: it needs a latch, friction or damping\n",
                         when, speed);
    case Outcome::latched:
      return fmt::format("latched flat {}, at {}: the latch takes {:.4g} N mm\n", when, speed,
                         last.kinetic_n_mm);
    case Outcome::stalled:
      if (!study.sheet.joints.slows_down()) {
        return fmt::format("stays at {:.4g} deg: no moment drives it\n", last.pilot_deg);
      }
      return fmt::format("stalls at {:.4g} deg {}: friction holds it\n", last.pilot_deg, when);
    case Outcome::at_rest:
      return fmt::format("comes to rest at {:.4g} deg {}\n", last.pilot_deg, when);
    case Outcome::turned_back:
      return fmt::format("turns round at {:.4g} deg {}: nothing slows it down\n", last.pilot_deg,
                         when);
    case Outcome::fold_limit:
      return fmt::format("folds up to {:.4g} deg, its fold limit, {}\n", last.pilot_deg, when);
    case Outcome::time_limit:
      return fmt::format("still moves {}: at {:.4g} deg, with {}\n", when, last.pilot_deg, speed);
    case Outcome::failed:
      break;
  }
  return fmt::format("the integration failed {}, at {:.4g} deg\n", when, last.pilot_deg);
}

std::string friction_text(const DeploymentStudy& study) {
  const solver::FrictionLimits& limits = study.friction;
  const solver::JointResistance& joints = study.sheet.joints;
  std::string text =
      limits.critical_n_mm_per_mm
          ? fmt::format("critical friction: {:.4g} N mm/mm\n", *limits.critical_n_mm_per_mm)
      : joints.damping_n_mm_s_per_mm > 0
          ? "critical friction: none; with this damping the sheet does not reach flat in time\n"
          : "critical friction: none; the sheet does not reach flat\n";
  if (joints.friction_n_mm_per_mm <= 0 && joints.ball_friction_n_mm <= 0) return text;
  text += fmt::format("quasi-static motion would stall at {:.4g} deg\n", limits.static_stall_deg);
  if (limits.stiffness_needed_n_per_mm) {
    text += fmt::format("spring rate to reach flat: {:.4g} N/mm or more{}\n",
                        *limits.stiffness_needed_n_per_mm,
                        joints.damping_n_mm_s_per_mm > 0 ? ", without the damping" : "");
  }
  return text;
}

std::string equilibria_text(const DeploymentStudy& study) {
  if (study.equilibria.empty()) {
    return "no isolated equilibrium up to the fold limit\n";
  }
  constexpr double kNone_n_mm = 1e-12;  // lengths are known to 1e-10 mm
  std::string text;
  int wells = 0;
  for (const solver::Equilibrium& at : study.equilibria) {
    if (at.x < 0) continue;  // mirror images
    if (at.is_well) ++wells;
    text +=
        fmt::format("{} equilibrium at {:.4g} deg: {:.4g} N mm", at.is_well ? "stable" : "unstable",
                    at.pilot_deg, std::abs(at.energy_n_mm) < kNone_n_mm ? 0 : at.energy_n_mm);
    text += std::abs(at.x) > 0 ? fmt::format(", {:.4g} N mm/rad\n", at.stiffness_n_mm) : "\n";
  }
  const auto* const springs = std::get_if<solver::Springs>(&study.sheet.fill);
  if (wells == 1 && springs && !springs->other_rests_deg.empty()) {
    text +=
        "one stable equilibrium only: diagonals are nearly proportional, so springs agree on an "
        "angle\n";
  }
  if (const auto barrier = study.barrier_n_mm()) {
    text += fmt::format("energy barrier to the mirror image, at flat: {:.4g} N mm\n", *barrier);
  }
  return text;
}

std::string wires_text(const solver::Mechanism& mechanism, const DeploymentStudy& study) {
  const auto* const springs = std::get_if<solver::Springs>(&study.sheet.fill);
  if (!springs || !springs->pull_only || springs->rest_deg == 0) return "";
  const auto line = [&](const char* side, const std::vector<int>& diagonals) {
    return fmt::format("wires that pull {} {:g} deg: {}\n", side, springs->rest_deg,
                       schema::diagonal_labels(mechanism, diagonals));
  };
  return line("above", study.pulls_from_above) + line("below", study.pulls_from_below);
}

// The largest force or moment of each kind, with its place.
std::string forces_text(const solver::Mechanism& mechanism, const DeploymentStudy& study) {
  if (!study.forces) return "";
  const solver::JointForces& forces = *study.forces;
  const auto largest = [&](const Eigen::MatrixXd& vectors, const char* what, const char* unit,
                           const auto& label) {
    double most = -1;
    Eigen::Index row = 0, joint = 0;
    for (Eigen::Index i = 0; i < vectors.rows(); ++i) {
      for (Eigen::Index k = 0; k < vectors.cols() / 3; ++k) {
        const double size = vectors.block<1, 3>(i, 3 * k).norm();
        if (size > most) most = size, row = i, joint = k;
      }
    }
    if (most < 0) return std::string();
    return fmt::format("largest {}: {:.4g} {} at {}, {:.4g} deg\n", what, most, unit,
                       label(static_cast<std::size_t>(joint)),
                       forces.pilot_deg[static_cast<std::size_t>(row)]);
  };
  const auto crease = [&](std::size_t k) {
    return solver::line_label(mechanism.creases[k].a, mechanism.creases[k].b) +
           (forces.crease_shared[k] ? " (shared)" : "");
  };
  const auto ball = [&](std::size_t k) { return solver::vertex_label(mechanism.balls[k].vertex); };
  return largest(forces.crease_force_n, "force in a hinge", "N", crease) +
         largest(forces.crease_moment_n_mm, "moment in a hinge", "N mm", crease) +
         largest(forces.ball_force_n, "force in a ball joint", "N", ball) +
         fmt::format(
             "{} reactions of rank {}: statically indeterminate to degree {} at whole vertices, "
             "shared by least squares\n",
             forces.reactions, forces.rank, forces.reactions - forces.rank);
}

// Rows every few degrees, and at events: some twenty a swing.
std::string motion_text(const DeploymentStudy& study) {
  const double from_deg = std::abs(study.options.from_deg);
  const double every_deg = from_deg > 90 ? 10 : from_deg > 40 ? 5 : from_deg > 8 ? 2 : 0.5;
  std::string text = fmt::format("\n  time_s  pilot_deg  deg_per_s  {}_n_mm  kinetic_n_mm\n",
                                 schema::fill_nouns(study.sheet.fill).column);
  for (const Deployment::Row& row : study.run.rows) {
    const bool is_event = row.event != Deployment::Event::none;
    if (!is_event && std::abs(std::remainder(row.pilot_deg, every_deg)) > 1e-6) continue;
    const char* event = "";
    if (row.event == Deployment::Event::flat) event = "  flat";
    if (row.event == Deployment::Event::turn) event = "  turns";
    text += fmt::format("{:>8.4f} {:>10.4g} {:>10.4g} {:>13.5g} {:>13.5g}{}\n", row.time_s,
                        std::abs(row.pilot_deg) < 1e-9 ? 0 : row.pilot_deg, row.rate_deg_per_s,
                        row.springs_n_mm, row.kinetic_n_mm, event);
  }
  return text;
}

std::string pins_text(const char* where, const solver::PinFriction& pins, double own_mm) {
  const solver::PinFriction::Row& locks = pins.locks_first();
  std::string text = fmt::format("pins {}: ", where);
  text += pins.critical_mm ? fmt::format("critical friction coefficient times radius {:.4g} mm",
                                         *pins.critical_mm)
                           : "the sheet does not reach flat";
  text +=
      fmt::format("; locked at {:.4g} deg by {:.3g} mm or more", locks.pilot_deg, locks.locks_mm());
  const auto stall_deg = pins.stall_deg(own_mm);
  if (stall_deg && own_mm > 0)
    text += fmt::format("; with {:g} mm it locks at {:.4g} deg", own_mm, *stall_deg);
  return text + "\n";
}

}  // namespace

std::string pins_text(const solver::PinStudy& study) {
  return pins_text("in the middle of hinges", study.in_middle, study.own_mm) +
         pins_text("at both ends of hinges", study.at_ends, study.own_mm);
}

std::string deployment_text(const solver::Mechanism& mechanism, const DeploymentStudy& study) {
  return released_sheet_text(mechanism.diagonal_count(), study) + outcome_text(study) +
         damping_text(study) + friction_text(study) + equilibria_text(study) +
         wires_text(mechanism, study) + forces_text(mechanism, study) + motion_text(study);
}

}  // namespace misalign::search

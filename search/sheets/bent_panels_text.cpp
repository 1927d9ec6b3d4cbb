#include <fmt/format.h>

#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

std::string energy_text(const schema::Material& material, const solver::BentPanels& study) {
  const solver::BentAngle& start = study.angles.back();
  std::string text = fmt::format(
      "bending panels of {}, from {:g} deg\n"
      "stored energy: {:.4g} N mm (rigid panels: {:.4g} N mm)\n",
      material.name, study.from_deg, start.bent.n_mm, start.rigid_n_mm);
  if (study.method == solver::BendMethod::newton) {
    text += fmt::format("large bending, by Newton's method: {:.3g} times the linear energy\n",
                        study.newton_over_linear);
  }
  if (study.unsure() > 0) {
    text += fmt::format(
        "at {} of {} angles the equilibrium ends or is unstable: results there are linear and "
        "unreliable\n",
        study.unsure(), study.angles.size());
  }
  return text;
}

std::string bent_friction_text(const solver::BentPanels& study, const solver::BentAdvice& advice,
                               const solver::FrictionLimits& rigid) {
  const solver::BentFriction& friction = study.friction;
  std::string text =
      friction.critical_n_mm_per_mm
          ? fmt::format("critical friction: {:.4g} N mm/mm", *friction.critical_n_mm_per_mm)
          : "critical friction: none; the sheet does not reach flat";
  if (rigid.critical_n_mm_per_mm) {
    text += fmt::format(" (rigid panels: {:.4g} N mm/mm)", *rigid.critical_n_mm_per_mm);
  }
  text += friction.static_n_mm_per_mm > 0
              ? fmt::format(
                    "\nstatic friction overcome: {:.4g} N mm/mm down to {:g} deg, worst at {:.4g} "
                    "deg\n",
                    friction.static_n_mm_per_mm, study.options.to_deg, friction.static_deg)
              : fmt::format("\nat {:.4g} deg no moment drives the sheet towards flat\n",
                            friction.static_deg);
  if (!friction.static_margin) return text;
  text += fmt::format("static margin: {:.3g} (AIAA S-114 requires 1 at every angle)\n",
                      *friction.static_margin);
  if (friction.static_stall_deg) {
    text +=
        fmt::format("quasi-static motion would stall at {:.4g} deg\n", *friction.static_stall_deg);
  }
  text += advice.least_thickness_mm
              ? fmt::format("panel thickness for a static margin of {:g}: {:.3g} mm or more\n",
                            advice.wanted_margin, *advice.least_thickness_mm)
              : fmt::format("panel thickness for a static margin of {:g}: none up to {:g} mm\n",
                            advice.wanted_margin, solver::kMostThick_mm);
  return text;
}

std::string buckling_text(const solver::BucklingStudy::Least& least) {
  if (least.kind == solver::BucklingKind::none)
    return "buckling factor: none; nothing presses a panel\n";
  return fmt::format("buckling factor: {:.3g}, least at {:.3g} deg in panel {},{} ({})\n",
                     least.factor, least.pilot_deg, least.place[0], least.place[1],
                     least.kind == solver::BucklingKind::corner
                         ? "a corner between two holes, pressed inwards"
                         : "by its mean stress");
}

std::string preload_text(const solver::PreloadStudy& study) {
  std::string text = fmt::format(
      "preload: {:g} N at flat; stiffness there {:.4g} N mm/rad^2, natural frequency {:.3g} Hz; "
      "stiffest at {:.3g} N, no stiffness from {:.3g} N on\n",
      study.preload_n, study.at_flat.stiffness_n_mm(study.preload_n), study.frequency_hz,
      study.at_flat.best_n(), study.at_flat.none_left_n());
  if (study.best.preload_n > 0) {
    text += fmt::format("best preload against static friction: {:.3g} N overcomes {:.4g} N mm/mm\n",
                        study.best.preload_n, study.best.static_n_mm_per_mm);
  }
  if (study.modes.unstable > 0) {
    text += fmt::format(
        "flat is unstable under the preload: {} of {} rigid-folding modes grow, and a free sheet "
        "rests rippled; stops in the creases, a latch or a frame must hold it flat\n",
        study.modes.unstable, study.modes.rigid);
  }
  return text;
}

}  // namespace

std::string bent_panels_text(const schema::BentSheet& sheet, const solver::FrictionLimits& rigid) {
  const auto& [material, study, advice, buckling, preload] = sheet;
  const solver::BentPanels::MostBent most = study.most_bent();
  std::string text =
      energy_text(material, study) + bent_friction_text(study, advice, rigid) +
      fmt::format(
          "largest saddle {:.3g} mm, largest stress {:.3g} MPa, at {:.3g} deg; stress counts "
          "farther than {:g} panel widths from corners, where it is singular\n",
          most.largest_saddle_mm, most.largest_stress_mpa, most.pilot_deg, solver::kCornerWidths);
  text += buckling_text(buckling.least());
  if (advice.useful_stiffness_n_per_mm) {
    text += fmt::format("spring rate for {:g} % of the attainable friction: {:.3g} N/mm\n",
                        100 * solver::kUseful, *advice.useful_stiffness_n_per_mm);
  }
  if (preload) text += preload_text(*preload);
  return text + "rigid panels:\n";
}

}  // namespace misalign::search

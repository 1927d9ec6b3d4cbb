#include <fmt/format.h>

#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

std::string energy_text(const schema::Material& material, const solver::BentPanels& study) {
  const solver::BentAngle& start = study.angles.back();
  std::string text = fmt::format(
      "panels of {} bend: at {:g} deg springs and panels hold {:.4g} N mm; if panels were rigid, "
      "{:.4g}\n",
      material.name, study.from_deg, start.bent.n_mm, start.rigid_n_mm);
  if (study.method == solver::BendMethod::newton) {
    text += fmt::format("they bend far: Newton's method, {:.3g} times what is linear\n",
                        study.newton_over_linear);
  }
  if (study.unsure() > 0) {
    text += fmt::format(
        "at {} of {} angles the equilibrium cannot be followed (it ends there, or is not stable): "
        "what follows is linear there, and not to be relied upon\n",
        study.unsure(), study.angles.size());
  }
  return text;
}

std::string bent_friction_text(const solver::BentPanels& study, const solver::BentAdvice& advice,
                               const solver::FrictionLimits& rigid) {
  const solver::BentFriction& friction = study.friction;
  std::string text = friction.critical_n_mm_per_mm
                         ? fmt::format("critical friction: {:.4g} N mm per mm of crease",
                                       *friction.critical_n_mm_per_mm)
                         : "critical friction: none, it does not get to flat by itself";
  if (rigid.critical_n_mm_per_mm) {
    text += fmt::format("; if panels were rigid, {:.4g}", *rigid.critical_n_mm_per_mm);
  }
  text += friction.static_n_mm_per_mm > 0
              ? fmt::format(
                    "\nmoving slowly it overcomes {:.4g} N mm per mm at every angle down to {:g} "
                    "deg: least at {:.4g} deg\n",
                    friction.static_n_mm_per_mm, study.options.to_deg, friction.static_deg)
              : fmt::format("\nat {:.4g} deg nothing drives it on to flat\n", friction.static_deg);
  if (!friction.static_margin) return text;
  text += fmt::format("static margin: {:.3g} (AIAA S-114 asks for 1 at every angle)\n",
                      *friction.static_margin);
  if (friction.static_stall_deg) {
    text += fmt::format("moving slowly it would stall at {:.4g} deg\n", *friction.static_stall_deg);
  }
  text += advice.least_thickness_mm
              ? fmt::format("panels from {:.3g} mm on have a static margin of {:g}\n",
                            *advice.least_thickness_mm, advice.wanted_margin)
              : fmt::format("no panels up to {:g} mm have a static margin of {:g}\n",
                            solver::kMostThick_mm, advice.wanted_margin);
  return text;
}

std::string preload_text(const solver::PreloadStudy& study) {
  std::string text = fmt::format(
      "preload: {:g} N at flat, where the motion to it has {:.4g} N mm per rad^2, {:.3g} Hz; "
      "stiffest with {:.3g} N, none left from {:.3g} N on\n",
      study.preload_n, study.at_flat.stiffness_n_mm(study.preload_n), study.frequency_hz,
      study.at_flat.best_n(), study.at_flat.none_left_n());
  if (study.best.preload_n > 0) {
    text += fmt::format("most static friction is overcome with {:.3g} N: {:.4g} N mm per mm\n",
                        study.best.preload_n, study.best.static_n_mm_per_mm);
  }
  if (study.modes.unstable > 0) {
    text += fmt::format(
        "flat is not held by it: {} of the {} ways to leave flat without bending a panel are "
        "pushed on, and a free sheet rests rippled; a stop at flat in the creases, a latch or a "
        "frame holds it\n",
        study.modes.unstable, study.modes.rigid);
  }
  return text;
}

}  // namespace

std::string bent_panels_text(const schema::BentSheet& sheet, const solver::FrictionLimits& rigid) {
  const auto& [material, study, advice, preload] = sheet;
  const solver::BentAngle& most = study.most_bent();
  std::string text =
      energy_text(material, study) + bent_friction_text(study, advice, rigid) +
      fmt::format(
          "largest saddle {:.3g} mm, largest stress {:.3g} MPa, at {:.3g} deg; stress counts "
          "farther than {:g} of a panel's width from its corners, beside which that of a thin "
          "plate has no limit\n",
          most.largest_saddle_mm, most.largest_stress_mpa, most.pilot_deg, solver::kCornerWidths);
  if (advice.useful_stiffness_n_per_mm) {
    text += fmt::format("springs of {:.3g} N/mm overcome {:g} % of what the stiffest do\n",
                        *advice.useful_stiffness_n_per_mm, 100 * solver::kUseful);
  }
  if (preload) text += preload_text(*preload);
  return text + "rigid panels:\n";
}

}  // namespace misalign::search

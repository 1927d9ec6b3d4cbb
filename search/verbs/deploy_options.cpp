#include "search/verbs/deploy_options.hpp"

#include <fmt/format.h>

#include "search/verbs/options.hpp"

namespace misalign::search {
namespace {

constexpr double kMostAngle_deg = 180, kMostResistance = 1e9;

// Options of the motion's end.
void add_motion(CLI::App& verb, DeployInput& input) {
  solver::Deployment::Options& options = input.options.motion;
  auto* latch =
      verb.add_flag("--latch", options.latch, "a latch catches the sheet when it is flat");
  constexpr double kMostRestitution = 0.99;
  add_value(verb, "--stop", options.restitution,
            "a stop at flat with this coefficient of restitution; 0: the sheet rests there",
            within(0, kMostRestitution), "SHARE")
      ->excludes(latch);
  verb.add_flag(
      "--least-damping", input.options.seeks_damping,
      "also find the least damping of creases that stops it at flat without passing through");
  add_default(verb, "--swings", options.swings,
              "end after N passes through flat, or turns without losses", counted(0, 10000), "N");
  add_default(verb, "--time-limit", options.time_limit_s, "longest time of the motion, s",
              within(1e-9, 1e6), "S");
}

}  // namespace

void add_deployment(CLI::App& verb, DeployInput& input) {
  constexpr double kLeastFrom_deg = 1e-3;
  schema::Design& design = input.design;
  add_release_from(verb, design.from_deg, kLeastFrom_deg);
  add_stiffness(verb, design.stiffness_n_per_mm);
  add_thickness(verb, design.thickness_mm);
  add_value(verb, "--density", input.density_g_per_cm3,
            fmt::format("density of the panels, g/cm^3 [the material's, or {:g}]",
                        solver::Plates{}.density_g_per_cm3),
            within(kLeastDensity_g_per_cm3, kMostDensity_g_per_cm3), "G_PER_CM3");
  solver::JointResistance& joints = input.options.sheet.joints;
  const auto resistance = [&](const char* name, double& value, const char* meaning,
                              const char* unit) {
    add_default(verb, name, value, meaning, within(0, kMostResistance), unit);
  };
  const auto hinge = [&](const char* name, std::optional<double>& value, const char* meaning,
                         const char* key) {
    add_value(verb, name, value, std::string(meaning) + " [the design's, or 0]", within(key), "N");
  };
  hinge("--friction", design.friction_n_mm_per_mm, "dry friction of creases, N mm/mm",
        "hinges.friction_n_mm_per_mm");
  resistance("--ball-friction", joints.ball_friction_n_mm, "dry friction of each ball joint, N mm",
             "N_MM");
  resistance("--damping", joints.damping_n_mm_s_per_mm, "damping of creases, N mm/mm per rad/s",
             "N_S");
  hinge("--hinge-stiffness", design.hinge_stiffness_n_mm_per_mm,
        "stiffness of elastic creases, N mm/mm per rad", "hinges.stiffness_n_mm_per_mm");
  add_value(verb, "--pin-friction", design.pin_friction_mm,
            "friction coefficient times radius of hinge pins and ball joints, mm; 0: only show how "
            "much they may have [the design's, or none]",
            within("hinges.pin_friction_mm"), "MM");
  add_default(verb, "--hinge-rest", joints.rest_deg,
              "pilot angle where elastic creases are relaxed", within(0, kMostAngle_deg), "DEG");
  add_rest(verb, design.rest_deg);
  verb.add_option("--rest", input.other_rests,
                  "another such angle for one diagonal: A11-A17=60 (may be repeated)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("DIAGONAL=DEG");
  add_preload(verb, design.preload_n);
  verb.add_flag_callback(
      "--pull-only", [&design] { design.pull_only = true; }, "wires: springs that only pull");
  add_fill(verb, design);
  verb.add_option("--hold", input.held,
                  "hold this panel [the design's, or none: free in space, without momentum]")
      ->type_name("ROW,COLUMN");
  add_value(verb, "--gravity", input.gravity,
            "weight of the panels, in standard gravities: x right, y along rising rows, z up from "
            "the held panel, as 0,0,-1 [the design's, or none]",
            within(-1e3, 1e3), "X,Y,Z")
      ->delimiter(',')
      ->expected(3);
  add_motion(verb, input);
}

}  // namespace misalign::search

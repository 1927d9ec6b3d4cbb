#include "search/verbs/deploy_options.hpp"

#include <fmt/format.h>

#include "search/verbs/options.hpp"

namespace misalign::search {
namespace {

CLI::Option* add_number(CLI::App& verb, const std::string& name, double& value,
                        const std::string& meaning, double least, double most,
                        const std::string& unit) {
  return verb.add_option(name, value, fmt::format("{} [{:g}]", meaning, value))
      ->check(within(least, most))
      ->type_name(unit);
}

constexpr double kMostAngle_deg = 180, kMostResistance = 1e9, kMostPreload_n = 1e6;

}  // namespace

CLI::Option* add_deployment(CLI::App& verb, DeployInput& input) {
  constexpr double kLeastFrom_deg = 1e-3;
  add_from(verb, input.options.from_deg, kLeastFrom_deg);
  add_stiffness(verb, input.stiffness_n_per_mm);
  add_thickness(verb, input.options.sheet.plates);
  CLI::Option* const density = add_number(
      verb, "--density", input.options.sheet.plates.density_g_per_cm3, "of the panels, g/cm^3",
      kLeastDensity_g_per_cm3, kMostDensity_g_per_cm3, "G_PER_CM3");
  solver::JointResistance& joints = input.options.sheet.joints;
  const auto resistance = [&](const char* name, double& value, const char* meaning,
                              const char* unit) {
    add_number(verb, name, value, meaning, 0, kMostResistance, unit);
  };
  resistance("--friction", joints.friction_n_mm_per_mm, "dry friction of creases, N mm per mm",
             "N");
  resistance("--ball-friction", joints.ball_friction_n_mm, "dry friction of each ball joint, N mm",
             "N_MM");
  resistance("--damping", joints.damping_n_mm_s_per_mm,
             "damping of creases, N mm per mm for each rad/s", "N_S");
  resistance("--hinge-stiffness", joints.stiffness_n_mm_per_mm,
             "elastic creases, N mm per mm for each rad", "N");
  add_number(verb, "--hinge-rest", joints.rest_deg, "pilot angle where elastic creases are relaxed",
             0, kMostAngle_deg, "DEG");
  solver::Springs& springs = input.options.sheet.springs;
  add_number(verb, "--rest-deg", springs.rest_deg, "pilot angle where the springs are relaxed", 0,
             kMostAngle_deg, "DEG");
  verb.add_option("--rest", input.other_rests,
                  "another such angle for one diagonal: A11-A17=60 (again: and that one)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("DIAGONAL=DEG");
  add_number(
      verb, "--preload", springs.preload_n,
      "force of each spring at flat, N: pulling where diagonals lengthen as it folds, pushing "
      "where they shorten",
      0, kMostPreload_n, "N");
  verb.add_flag("--pull-only", springs.pull_only, "wires: springs that only pull");
  auto* const held = verb.add_option("--hold", input.held,
                                     "hold this panel [none: free in space, without momentum]");
  held->type_name("ROW,COLUMN");
  verb.add_option("--gravity", input.gravity,
                  "weight of the panels, in standard gravities: x right, y along rising rows, z up "
                  "from the held panel, as 0,0,-1 [none]")
      ->delimiter(',')
      ->expected(3)
      ->check(within(-1e3, 1e3))
      ->needs(held)
      ->type_name("X,Y,Z");
  solver::DeploymentOptions& options = input.options.motion;
  verb.add_flag("--latch", options.latch, "a latch catches the sheet when it is flat");
  verb.add_option("--swings", options.swings,
                  fmt::format("pass flat, or turn round without losses, this often before the end "
                              "[{}]",
                              options.swings))
      ->check(counted(0, 10000))
      ->type_name("N");
  add_number(verb, "--time-limit", options.time_limit_s, "end of the motion at the latest, s", 1e-9,
             1e6, "S");
  return density;
}

}  // namespace misalign::search

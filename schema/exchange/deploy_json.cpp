#include "schema/exchange/deploy_json.hpp"

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/fill_json.hpp"
#include "schema/pattern/preload_json.hpp"

namespace misalign::schema {
namespace {

const char* name_of(solver::Deployment::Event event) {
  constexpr const char* kNames[] = {"", "start", "flat", "turn", "end"};
  return kNames[static_cast<std::size_t>(event)];
}

// The springs of a motion, with rests of their own.
Json springs_json(const solver::Mechanism& mechanism, const solver::Springs& springs) {
  Json others = Json::object();
  for (const auto& [diagonal, rest_deg] : springs.other_rests_deg) {
    others[diagonal_label(mechanism, diagonal)] = rest_deg;
  }
  Json json = {{"stiffness_n_per_mm", springs.stiffness_n_per_mm},
               {"rest_deg", springs.rest_deg},
               {"other_rests_deg", others},
               {"pull_only", springs.pull_only}};
  add_preload(springs.preload, json);
  add_single_springs(springs, json);
  return json;
}

Json joints_json(const solver::JointResistance& joints) {
  return {{"friction_n_mm_per_mm", joints.friction_n_mm_per_mm},
          {"ball_friction_n_mm", joints.ball_friction_n_mm},
          {"damping_n_mm_s_per_mm", joints.damping_n_mm_s_per_mm},
          {"stiffness_n_mm_per_mm", joints.stiffness_n_mm_per_mm},
          {"rest_deg", joints.rest_deg}};
}

Json held_json(const std::optional<solver::HeldPanel>& held) {
  if (!held) return nullptr;
  const Eigen::Vector3d& gravity = held->gravity_mm_per_s2;
  return {{"panel", held->panel}, {"gravity_mm_per_s2", {gravity.x(), gravity.y(), gravity.z()}}};
}

Json equilibria_json(const std::vector<solver::Equilibrium>& equilibria) {
  return json_list(equilibria, [](const solver::Equilibrium& at) {
    return Json{{"pilot_deg", at.pilot_deg},
                {"energy_n_mm", at.energy_n_mm},
                {"stiffness_n_mm_per_rad", at.stiffness_n_mm},
                {"is_well", at.is_well}};
  });
}

// A list of the rows' vectors, in columns from `first` on.
Json vectors_json(const Eigen::MatrixXd& rows, Eigen::Index first) {
  Json list = Json::array();
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    list.push_back({rows(row, first), rows(row, first + 1), rows(row, first + 2)});
  }
  return list;
}

Json forces_json(const solver::Mechanism& mechanism, const solver::JointForces& forces) {
  Json hinges = Json::array(), balls = Json::array();
  for (std::size_t k = 0; k < mechanism.creases.size(); ++k) {
    const solver::Crease& crease = mechanism.creases[k];
    const auto first = 3 * static_cast<Eigen::Index>(k);
    hinges.push_back({{"from", solver::vertex_label(crease.a)},
                      {"to", solver::vertex_label(crease.b)},
                      {"shared", bool(forces.crease_shared[k])},
                      {"force_n", vectors_json(forces.crease_force_n, first)},
                      {"moment_n_mm", vectors_json(forces.crease_moment_n_mm, first)}});
  }
  for (std::size_t k = 0; k < mechanism.balls.size(); ++k) {
    const auto first = 3 * static_cast<Eigen::Index>(k);
    balls.push_back({{"vertex", solver::vertex_label(mechanism.balls[k].vertex)},
                     {"force_n", vectors_json(forces.ball_force_n, first)}});
  }
  return {{"pilot_deg", forces.pilot_deg},
          {"reactions", forces.reactions},
          {"rank", forces.rank},
          {"holding_n_mm", forces.holding_n_mm},
          {"creases", hinges},
          {"ball_joints", balls}};
}

Json pins_json(const solver::PinFriction& pins, double own_mm) {
  const solver::PinFriction::Row& locks = pins.locks_first();
  const Json rows = json_list(pins.rows, [](const solver::PinFriction::Row& row) {
    return Json{{"pilot_deg", row.pilot_deg}, {"locks_mm", row.locks_mm()}};
  });
  return {{"critical_mm", or_null(pins.critical_mm)},
          {"locks_mm", locks.locks_mm()},
          {"locks_deg", locks.pilot_deg},
          {"stall_deg", or_null(pins.stall_deg(own_mm))},
          {"rows", rows}};
}

Json labels_json(const solver::Mechanism& mechanism, const std::vector<int>& diagonals) {
  return json_list(diagonals, [&](int d) { return diagonal_label(mechanism, d); });
}

}  // namespace

Json deployment_metrics_json(const solver::DeploymentStudy& study) {
  return {{"deploy_time_s", or_null(study.deploy_time_s())},
          {"critical_friction_n_mm_per_mm", or_null(study.friction.critical_n_mm_per_mm)}};
}

Json pins_json(const solver::PinStudy& study) {
  return {{"pin_friction_mm", study.own_mm},
          {"in_middle", pins_json(study.in_middle, study.own_mm)},
          {"at_ends", pins_json(study.at_ends, study.own_mm)}};
}

Json exported_deployment_json(const solver::DeploymentStudy& study) {
  Json json = deployment_metrics_json(study);
  json.update({{"from_deg", study.options.from_deg},
               {"thickness_mm", study.sheet.plates.thickness_mm},
               {"density_g_per_cm3", study.sheet.plates.density_g_per_cm3}});
  if (const auto* const springs = std::get_if<solver::Springs>(&study.sheet.fill)) {
    json["stiffness_n_per_mm"] = springs->stiffness_n_per_mm;
  }
  return json;
}

Json deployment_json(const solver::Sheet& sheet, const solver::DeploymentStudy& study) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  Json json = deployment_metrics_json(study);
  const solver::Deployment::Row& last = study.run.last();
  const solver::Plates& plates = study.sheet.plates;
  json.update({{"from_deg", study.options.from_deg},
               {"joints", joints_json(study.sheet.joints)},
               {"plates",
                {{"thickness_mm", plates.thickness_mm},
                 {"density_g_per_cm3", plates.density_g_per_cm3},
                 {"mass_g", study.mass_t * 1e6}}},
               {"held", held_json(study.sheet.held)},
               {"outcome", solver::name_of(study.run.outcome)},
               {"end",
                {{"time_s", last.time_s},
                 {"pilot_deg", last.pilot_deg},
                 {"rate_deg_per_s", last.rate_deg_per_s}}},
               {"static_stall_deg", study.friction.static_stall_deg},
               {"stiffness_needed_n_per_mm", or_null(study.friction.stiffness_needed_n_per_mm)},
               {"equilibria", equilibria_json(study.equilibria)},
               {"barrier_n_mm", or_null(study.barrier_n_mm())},
               {"pulls_from_above", labels_json(mechanism, study.pulls_from_above)},
               {"pulls_from_below", labels_json(mechanism, study.pulls_from_below)}});
  if (const auto* const springs = std::get_if<solver::Springs>(&study.sheet.fill)) {
    json["springs"] = springs_json(mechanism, *springs);
  } else {
    json["fill"] = fill_json(study.sheet.fill, sheet.base());
  }
  if (study.options.restitution) {
    json["stop"] = {{"restitution", *study.options.restitution}, {"bounces", study.run.bounces}};
  }
  if (study.seeks_damping) {
    const auto& least = study.least_damping;
    json["least_damping"] = least ? Json{{"damping_n_mm_s_per_mm", least->damping_n_mm_s_per_mm},
                                         {"time_s", least->time_s}}
                                  : Json();
  }
  return json;
}

Json deployment_history_json(const solver::Sheet& sheet, const solver::DeploymentStudy& study) {
  Json json = deployment_json(sheet, study);
  using Row = solver::Deployment::Row;
  const std::vector<Row>& rows = study.run.rows;
  json.update({{"time_s", json_list(rows, &Row::time_s)},
               {"pilot_deg", json_list(rows, &Row::pilot_deg)},
               {"rate_deg_per_s", json_list(rows, &Row::rate_deg_per_s)},
               {"energy_n_mm", json_list(rows, &Row::springs_n_mm)},
               {"kinetic_n_mm", json_list(rows, &Row::kinetic_n_mm)},
               {"total_n_mm", json_list(rows, &Row::total_n_mm)}});
  if (study.forces) json["forces"] = forces_json(sheet.mechanism(), *study.forces);
  Json& events = json["events"] = Json::array();
  for (const Row& row : rows) {
    if (row.event == solver::Deployment::Event::none) continue;
    events.push_back({{"event", name_of(row.event)},
                      {"time_s", row.time_s},
                      {"pilot_deg", row.pilot_deg},
                      {"rate_deg_per_s", row.rate_deg_per_s}});
  }
  return json;
}

}  // namespace misalign::schema

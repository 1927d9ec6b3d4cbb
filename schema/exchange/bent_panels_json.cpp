#include "schema/exchange/bent_panels_json.hpp"

#include <cassert>
#include <vector>

#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

Json bent_angles_json(const solver::BentPanels& study, const Eigen::MatrixXd& stress_mpa) {
  Eigen::Index k = 0;
  return json_list(study.angles, [&](const solver::BentAngle& angle) {
    const Eigen::VectorXd panels_mpa = stress_mpa.col(k++);
    return Json{{"pilot_deg", angle.pilot_deg},
                {"energy_n_mm", angle.rigid_n_mm},
                {"bent_energy_n_mm", angle.bent.n_mm},
                {"largest_saddle_mm", angle.bent.largest_saddle_mm()},
                {"largest_stress_mpa", panels_mpa.maxCoeff()},
                {"panel_stress_mpa", std::vector<double>(panels_mpa.begin(), panels_mpa.end())},
                {"is_sure", angle.is_sure}};
  });
}

Json margins_json(const solver::BentFriction& friction) {
  return json_list(friction.rows, [](const solver::StaticMargin& row) {
    return Json{{"pilot_deg", row.pilot_deg},
                {"available_n_mm_per_mm", row.available_n},
                {"static_margin", or_null(row.margin)}};
  });
}

Json preload_json(const solver::PreloadStudy& study) {
  return {{"preload_n", study.preload_n},
          {"flat_stiffness_n_mm_per_rad2", study.at_flat.stiffness_n_mm(study.preload_n)},
          {"flat_frequency_hz", study.frequency_hz},
          {"stiffest_flat_n", study.at_flat.best_n()},
          {"none_left_n", study.at_flat.none_left_n()},
          {"best_n", study.best.preload_n},
          {"best_static_friction_n_mm_per_mm", study.best.static_n_mm_per_mm},
          {"rigid_modes_at_flat", study.modes.rigid},
          {"unstable_modes_at_flat", study.modes.unstable}};
}

const char* name_of(solver::BucklingKind kind) {
  constexpr const char* kNames[] = {"none", "corner", "mean_stress"};
  return kNames[static_cast<std::size_t>(kind)];
}

Json buckling_json(const solver::BucklingStudy& study) {
  const auto least_json = [](const solver::BucklingStudy::Least& panel) {
    return Json{{"panel", panel.place},
                {"factor", finite_or_null(panel.factor)},
                {"pilot_deg", panel.pilot_deg},
                {"kind", name_of(panel.kind)}};
  };
  Json angles = Json::array();
  for (std::size_t k = 0; k < study.pilot_deg.size(); ++k) {
    Json factors =
        json_list(study.factors[k], [](const auto& panel) { return finite_or_null(panel.factor); });
    angles.push_back({{"pilot_deg", study.pilot_deg[k]}, {"factors", std::move(factors)}});
  }
  return {{"least", least_json(study.least())},
          {"panels", json_list(study.panels, least_json)},
          {"angles", std::move(angles)}};
}

}  // namespace

Json bent_panels_json(const BentSheet& sheet) {
  const auto& [material, study, advice, buckling, preload] = sheet;
  const solver::BentFriction& friction = study.friction;
  assert(!study.angles.empty() && study.from_deg > study.options.to_deg);
  const Eigen::MatrixXd stress_mpa = study.stress_mpa();
  const solver::BentPanels::MostBent most = study.most_bent();
  Json json = {{"material", material_json(material)},
               {"thickness_mm", study.thickness_mm},
               {"from_deg", study.from_deg},
               {"to_deg", study.options.to_deg},
               {"method", study.method == solver::BendMethod::linear ? "linear" : "newton"},
               {"newton_over_linear", study.newton_over_linear},
               {"angles_not_converged", study.unsure()},
               {"bent_energy_n_mm", study.angles.back().bent.n_mm},
               {"bent_critical_friction_n_mm_per_mm", or_null(friction.critical_n_mm_per_mm)},
               {"static_friction_n_mm_per_mm", friction.static_n_mm_per_mm},
               {"static_friction_deg", friction.static_deg},
               {"static_margin", or_null(friction.static_margin)},
               {"static_stall_deg", or_null(friction.static_stall_deg)},
               {"largest_saddle_mm", most.largest_saddle_mm},
               {"largest_stress_mpa", most.largest_stress_mpa},
               {"largest_stress_deg", most.pilot_deg},
               {"stress_from_corners_widths", solver::kCornerWidths},
               {"buckling_factor", finite_or_null(buckling.least().factor)},
               {"useful_stiffness_n_per_mm", or_null(advice.useful_stiffness_n_per_mm)},
               {"wanted_static_margin", advice.wanted_margin},
               {"least_thickness_mm", or_null(advice.least_thickness_mm)},
               {"angles", bent_angles_json(study, stress_mpa)},
               {"margins", margins_json(friction)},
               {"buckling", buckling_json(buckling)}};
  if (preload) json["preload"] = preload_json(*preload);
  return json;
}

}  // namespace misalign::schema

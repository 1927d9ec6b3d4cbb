#include "schema/exchange/stress_json.hpp"

#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

Json at_json(const SimulatedSheet& sheet, const std::optional<solver::StressHistory::Peak>& at) {
  if (!at) return nullptr;
  return {{"stress_mpa", at->stress_mpa},
          {"time_s", at->time_s},
          {"panel", sheet.places[static_cast<std::size_t>(at->panel)]},
          {"x_mm", at->flat_mm.x()},
          {"y_mm", at->flat_mm.y()}};
}

Json rows_json(const std::vector<solver::StressStudy::Row>& rows) {
  using Row = solver::StressStudy::Row;
  return {{"time_s", json_list(rows, &Row::time_s)},
          {"pilot_deg", json_list(rows, &Row::pilot_deg)},
          {"widest_deg", json_list(rows, &Row::widest_deg)},
          {"springs_n_mm", json_list(rows, &Row::springs_n_mm)},
          {"bending_n_mm", json_list(rows, &Row::strain_n_mm)},
          {"kinetic_n_mm", json_list(rows, &Row::kinetic_n_mm)}};
}

}  // namespace

Json stress_json(const SimulatedSheet& sheet, const DeckOptions& deck, double disc_mm,
                 const solver::StressStudy& study) {
  Json panels = Json::array();
  for (std::size_t k = 0; k < sheet.places.size(); ++k) {
    panels.push_back(
        {{"panel", sheet.places[k]}, {"outside_discs_mpa", study.stress.panel_outside_mpa[k]}});
  }
  const Json rigid = {{"time_s", json_list(study.rigid, &solver::Deployment::Row::time_s)},
                      {"pilot_deg", json_list(study.rigid, &solver::Deployment::Row::pilot_deg)}};
  const Json history = {{"time_s", study.stress.time_s},
                        {"outside_discs_mpa", study.stress.outside_mpa},
                        {"anywhere_mpa", study.stress.anywhere_mpa}};
  return {{"from_deg", sheet.pilot_deg},
          {"rest_deg", sheet.rest_deg},
          {"stiffness_n_per_mm", sheet.stiffness_n_per_mm},
          {"thickness_mm", sheet.plates.thickness_mm},
          {"density_g_per_cm3", sheet.plates.density_g_per_cm3},
          {"material", material_json(deck.material)},
          {"elements_a_side", deck.elements},
          {"time_step_s", deck.time_step_s},
          {"time_limit_s", deck.end_s},
          {"damping_per_s", deck.damping_per_s},
          {"disc_mm", disc_mm},
          {"outcome", study.deployed_s    ? "deployed"
                      : study.was_stopped ? "stopped"
                      : study.gave_up     ? "failed"
                                          : "time_limit"},
          {"deployed_s", or_null(study.deployed_s)},
          {"largest_outside_discs", at_json(sheet, study.stress.outside)},
          {"largest_anywhere_mesh_dependent", at_json(sheet, study.stress.anywhere)},
          {"panels", panels},
          {"motion", rows_json(study.rows)},
          {"rigid_motion", rigid},
          {"stress", history},
          {"cpu_s", study.cpu_s},
          {"memory_mb", study.memory_mb}};
}

}  // namespace misalign::schema

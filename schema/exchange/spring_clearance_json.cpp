#include "schema/exchange/spring_clearance_json.hpp"

#include <cassert>

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

using Diagonals = std::vector<solver::Diagonal>;

Json meeting_json(const Pattern& base, const solver::Panels& panels, const Diagonals& diagonals,
                  const solver::SpringMeeting& met) {
  Json json = {{"springs", {diagonal_label(diagonals, met.spring)}},
               {"apart_mm", met.apart_mm},
               {"clear_mm", met.clear_mm},
               {"pilot_deg", met.pilot_deg}};
  if (met.other >= 0) json["springs"].push_back(diagonal_label(diagonals, met.other));
  if (met.panel >= 0) json["panel"] = place_of_panel(base, panels, met.panel);
  return json;
}

Json meetings_json(const Pattern& base, const solver::Panels& panels, const Diagonals& diagonals,
                   const solver::SpringMeetings& meetings) {
  Json touching = Json::array();
  for (const solver::SpringMeeting& met : meetings.touching) {
    touching.push_back(meeting_json(base, panels, diagonals, met));
  }
  return {{"closest",
           meetings.closest ? meeting_json(base, panels, diagonals, *meetings.closest) : Json()},
          {"touching", touching}};
}

}  // namespace

Json place_of_panel(const Pattern& base, const solver::Panels& panels, int panel) {
  assert(panel >= 0 && panel < std::ssize(panels.facets));
  return facet_json(base, panels.facets[static_cast<std::size_t>(panel)]);
}

std::string meeting_text(const Pattern& base, const solver::Panels& panels,
                         const Diagonals& diagonals, const solver::SpringMeeting& met) {
  const std::string spring = diagonal_label(diagonals, met.spring);
  if (met.other >= 0) return "springs " + spring + " and " + diagonal_label(diagonals, met.other);
  return "spring " + spring + " and panel " + place_of_panel(base, panels, met.panel).dump();
}

Json spring_clearance_json(const Pattern& base, const solver::Panels& panels,
                           const solver::ContactStudy& study) {
  if (!study.springs) return nullptr;
  const solver::SpringClearance& springs = *study.springs;
  const auto meetings = [&](const solver::SpringMeetings& all) {
    return meetings_json(base, panels, springs.diagonals, all);
  };
  Json apart = {{"pilot_deg", study.pilot_deg}};
  for (const solver::SpringClearance::Apart& at : springs.apart) {
    const bool has_holes = std::isfinite(at.least_hole_mm);
    apart["least_in_hole_mm"].push_back(finite_or_null(at.least_hole_mm));
    apart["largest_in_hole_mm"].push_back(has_holes ? Json(at.largest_hole_mm) : Json());
    apart["springs_mm"].push_back(finite_or_null(at.springs_mm));
    apart["panels_mm"].push_back(finite_or_null(at.panels_mm));
  }
  return {{"diameter_mm", springs.bodies.diameter_mm},
          {"end_mm", springs.bodies.left_out_mm()},
          {"thickness_mm", springs.bodies.panel_mm},
          {"reaches_deg", study.reach_deg},
          {"springs", meetings(springs.springs)},
          {"panels", meetings(springs.panels)},
          {"apart", apart}};
}

}  // namespace misalign::schema

#include "schema/exchange/rubber_json.hpp"

#include <cassert>

#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

using solver::PlateState;

Json history_json(const std::vector<PlateState>& states) {
  return {
      {"largest_stretch",
       json_list(states, [](const PlateState& at) { return at.stretches.largest; })},
      {"least_stretch", json_list(states, [](const PlateState& at) { return at.stretches.least; })},
      {"tense",
       json_list(states, [](const PlateState& at) { return tension_name(at.stretches.tension); })},
      {"edges_n_per_mm", json_list(states, &PlateState::edge_n_per_mm)}};
}

Json plate_json(const Pattern& base, const solver::PlateWay& plate) {
  return {{"hole", facet_json(base, plate.facet)},
          {"corners", json_list(plate.corners, solver::vertex_label)},
          {"stretch", {{"largest", plate.stretch.value}, {"pilot_deg", plate.stretch.pilot_deg}}},
          {"edges",
           {{"largest_n_per_mm", plate.edge_n_per_mm.value},
            {"pilot_deg", plate.edge_n_per_mm.pilot_deg}}},
          {"history", history_json(plate.states)}};
}

}  // namespace

const char* tension_name(solver::Tension tension) {
  constexpr const char* kNames[] = {"both", "one", "none"};
  return kNames[static_cast<std::size_t>(tension)];
}

Json rubber_json(const Pattern& base, const solver::RubberStudy& study) {
  assert(!study.pilot_deg.empty() && study.pilot_deg.front() == 0);
  const solver::RubberPlates& plates = study.options.plates;
  Json json = {{"shear_mpa", plates.shear_mpa},
               {"thickness_mm", plates.thickness_mm},
               {"equivalent_n_per_mm", study.equivalent_n_per_mm},
               {"pilot_deg", study.pilot_deg},
               {"plates", json_list(study.plates, [&](const solver::PlateWay& plate) {
                  return plate_json(base, plate);
                })}};
  if (study.options.from_deg) json["from_deg"] = *study.options.from_deg;
  return json;
}

Json choice_json(const solver::CutOutChoice& choice) {
  return {{"least_n_mm_per_rad2", choice.least_n_mm_per_rad2}, {"pilot_deg", choice.at_deg}};
}

}  // namespace misalign::schema

#include "schema/exchange/construct_json.hpp"

namespace misalign::schema {

Json construct_json(const Pattern& base, const solver::ConstructStudy& study, double at_deg) {
  Json holes = Json::array(), binding = Json::array();
  for (const solver::ConstructStudy::Hole& hole : study.holes) {
    holes.push_back({{"hole", facet_json(base, hole.facet)},
                     {"delta_mm", hole.delta_mm},
                     {"epsilon_mm", hole.epsilon_mm},
                     {"monotone", hole.direction != 0},
                     {"stroke", hole.stroke}});
  }
  for (const int vertex : study.binding) binding.push_back(solver::vertex_label(vertex));
  return {{"pattern", pattern_json(base, study.shifts_mm)},
          {"family_dimension", study.dimension},
          {"at_deg", at_deg},
          {"stroke", study.stroke},
          {"amplitude_mm", study.amplitude_mm},
          {"binding", binding},
          {"holes", holes},
          {"monotone_to_180_deg", study.is_monotone()},
          {"misfit_mm", study.misfit_mm},
          {"base_misfit_deg", study.base_misfit_rad / solver::kRadPerDeg}};
}

}  // namespace misalign::schema

#include "schema/exchange/construct_json.hpp"

#include "schema/files/json_values.hpp"

namespace misalign::schema {

Json construct_json(const Pattern& base, const solver::ConstructStudy& study, double at_deg) {
  const Json holes = json_list(study.holes, [&](const solver::ConstructStudy::Hole& hole) {
    return Json{{"hole", facet_json(base, hole.facet)},
                {"delta_mm", hole.delta_mm},
                {"epsilon_mm", hole.epsilon_mm},
                {"monotone", hole.direction != 0},
                {"stroke", hole.stroke}};
  });
  return {{"pattern", pattern_json(base, study.shifts_mm)},
          {"family_dimension", study.dimension},
          {"at_deg", at_deg},
          {"stroke", study.stroke},
          {"amplitude_mm", study.amplitude_mm},
          {"binding", json_list(study.binding, solver::vertex_label)},
          {"holes", holes},
          {"monotone_to_180_deg", study.is_monotone()},
          {"misfit_mm", study.misfit_mm},
          {"base_misfit_deg", study.base_misfit_rad / solver::kRadPerDeg}};
}

}  // namespace misalign::schema

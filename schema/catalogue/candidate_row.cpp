#include "schema/catalogue/candidate_row.hpp"

namespace misalign::schema {
namespace {

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace

Json diagonal_json(const Pattern& base, const solver::Mechanism& mechanism,
                   const solver::Diagonal& diagonal, double flat_mm) {
  return {{"hole", facet_json(base, mechanism.loops[diagonal.loop].hole)},
          {"from", solver::vertex_label(diagonal.from)},
          {"to", solver::vertex_label(diagonal.to)},
          {"flat_mm", flat_mm}};
}

Json diagonals_json(const Campaign& campaign, const solver::Mechanism& mechanism) {
  const auto& vertices = campaign.pattern.base.sheet.vertices_mm;
  Json list = Json::array();
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    const double flat_mm = (vertices.col(diagonal.from) - vertices.col(diagonal.to)).norm();
    list.push_back(diagonal_json(campaign.pattern, mechanism, diagonal, flat_mm));
  }
  return list;
}

std::string where_label(const solver::Mechanism& mechanism, const solver::Verdict& verdict) {
  if (verdict.where < 0) return "";
  switch (solver::entry_of(verdict.first_fault).shown_by) {
    case solver::ShownBy::nothing:
      return "";
    case solver::ShownBy::crease:
      return solver::line_label(mechanism.creases[verdict.where].a,
                                mechanism.creases[verdict.where].b);
    case solver::ShownBy::diagonal:
      return solver::line_label(mechanism.diagonals[verdict.where].from,
                                mechanism.diagonals[verdict.where].to);
  }
  return "";
}

const char* undecided_cause(const solver::Verdict& verdict) {
  return verdict.path_end == solver::PathEnd::start_lost ? "start_lost" : "stalled";
}

Json metrics_json(const solver::Metrics& m) {
  return {{"deploys_from_sample", m.deploys_from_sample},
          {"deploys_from_deg", m.deploys_from_deg},
          {"fold_limit_deg", m.fold_limit_deg},
          {"elongation_min", m.elongation_min},
          {"elongation_max", m.elongation_max},
          {"stroke_min", m.stroke_min},
          {"stroke_max", m.stroke_max},
          {"slope_min_mm_per_deg", or_null(m.slope_min_mm_per_deg)},
          {"slope_between_min_mm_per_deg", or_null(m.slope_between_min_mm_per_deg)},
          {"bump_deg", or_null(m.bump_deg)},
          {"miscut_margin_mm", or_null(m.miscut_margin_mm)},
          {"stretch_sq_mm2", m.stretch_sq_mm2},
          {"singular_value_min", m.singular_value_min},
          {"residual_max", m.residual_max},
          {"isometry_error_mm", m.isometry_error_mm},
          {"kawasaki_defect_deg", m.kawasaki_defect_deg},
          {"shifted_vertices", m.shifted_vertices},
          {"increasing", m.increasing},
          {"decreasing", m.decreasing}};
}

}  // namespace misalign::schema

#include "schema/exchange/shape_json.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

using solver::ShapeRow;

struct RowName {
  ShapeRow::Kind kind;
  const char* name;
};
constexpr RowName kRows[] = {
    {ShapeRow::Kind::corner, "corner"},       {ShapeRow::Kind::edge, "edge"},
    {ShapeRow::Kind::fold, "fold_angle"},     {ShapeRow::Kind::limit, "fold_limit"},
    {ShapeRow::Kind::direction, "direction"}, {ShapeRow::Kind::energy, "energy"},
    {ShapeRow::Kind::equal, "equal_lengths"}, {ShapeRow::Kind::barrier, "barrier"},
    {ShapeRow::Kind::floor, "floor"},         {ShapeRow::Kind::amplitude, "amplitude"}};

// The motion of the sheet, as exports and `fold` place it, onto the target; null where it has no
// sample there.
Json pose_json(const solver::Sheet& sheet, double at_deg, const solver::ShapePose& pose) {
  const auto row = sheet.row_at(at_deg);
  if (!row) return nullptr;
  const Eigen::Matrix4d motion = Eigen::umeyama(sheet.shapes_mm()[static_cast<std::size_t>(*row)],
                                                pose.placed(sheet.at(at_deg).vertices_mm), false);
  Json turn = Json::array(), move_mm = Json::array();
  for (Eigen::Index k = 0; k < 3; ++k) {
    turn.push_back({motion(k, 0), motion(k, 1), motion(k, 2)});
    move_mm.push_back(motion(k, 3));
  }
  return {{"turn", turn}, {"move_mm", move_mm}};
}

}  // namespace

const char* name_of(solver::ShapeKind kind) {
  return std::ranges::find(kShapeKinds, kind, &ShapeKindName::kind)->name;
}

const char* name_of(ShapeRow::Kind kind) {
  return std::ranges::find(kRows, kind, &RowName::kind)->name;
}

std::string place_of(const Pattern& base, const solver::Mechanism& mechanism,
                     const solver::ShapeOptions& options, const solver::ShapeLimit& limit) {
  const auto at = static_cast<std::size_t>(limit.where);
  switch (limit.kind) {
    case ShapeRow::Kind::corner:
      return facet_json(base, limit.where).dump();
    case ShapeRow::Kind::edge: {
      const auto& edge = base.base.sheet.edges[at];
      return solver::line_label(edge.a, edge.b);
    }
    case ShapeRow::Kind::fold:
      return solver::line_label(mechanism.creases[at].a, mechanism.creases[at].b);
    case ShapeRow::Kind::direction:
    case ShapeRow::Kind::equal:
      return diagonal_label(mechanism, limit.where);
    case ShapeRow::Kind::floor:
      return std::string(options.keeping.floors[at].goal->name);
    case ShapeRow::Kind::limit:
    case ShapeRow::Kind::energy:
    case ShapeRow::Kind::barrier:
    case ShapeRow::Kind::amplitude:
      break;
  }
  return "";
}

Json shape_json(const Pattern& base, const Target& target, const solver::Sheet& sheet,
                const solver::ShapeOptions& options, const solver::ShapeStudy& study) {
  const Json limits = json_list(study.limits, [&](const solver::ShapeLimit& limit) {
    return Json{{"kind", name_of(limit.kind)},
                {"place", place_of(base, sheet.mechanism(), options, limit)},
                {"pilot_deg", limit.pilot_deg},
                {"missing", limit.missing},
                {"price", limit.price}};
  });
  return {{"target", target.json},
          {"kind", name_of(options.kind)},
          {"at_deg", options.at_deg},
          {"from_deg", options.from_deg},
          {"reached", study.is_reached},
          {"rms_mm", study.rms_mm},
          {"max_mm", study.max_mm},
          {"shift_max_mm", study.shifts_mm.colwise().norm().maxCoeff()},
          {"half_depth_mm", study.pose.half_depth_mm},
          {"pose", pose_json(sheet, options.at_deg, study.pose)},
          {"deploys_from_deg", study.deploys_from_deg},
          {"driven_from_deg", study.driven_from_deg},
          {"fold_limit_deg", sheet.way()->ends_at_limit() ? Json(sheet.way()->end_deg()) : Json()},
          {"steps", study.steps},
          {"sheets_folded", study.evaluations},
          {"limits", limits}};
}

}  // namespace misalign::schema

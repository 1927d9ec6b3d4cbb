#include "schema/exchange/shape_json.hpp"

#include <algorithm>
#include <iterator>

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

using solver::ShapeRow;

struct KindName {
  solver::ShapeKind kind;
  const char* name;
};
constexpr KindName kKinds[] = {{solver::ShapeKind::free, "shape"},
                               {solver::ShapeKind::rest, "rest"},
                               {solver::ShapeKind::rest_by_energy, "energy"},
                               {solver::ShapeKind::bistable, "bistable"}};

struct RowName {
  ShapeRow::Kind kind;
  const char* name;
};
constexpr RowName kRows[] = {
    {ShapeRow::Kind::corner, "corner"},       {ShapeRow::Kind::edge, "edge"},
    {ShapeRow::Kind::fold, "fold_angle"},     {ShapeRow::Kind::limit, "fold_limit"},
    {ShapeRow::Kind::direction, "direction"}, {ShapeRow::Kind::energy, "energy"},
    {ShapeRow::Kind::equal, "equal_lengths"}, {ShapeRow::Kind::barrier, "barrier"},
    {ShapeRow::Kind::floor, "floor"}};

}  // namespace

const char* name_of(solver::ShapeKind kind) {
  return std::ranges::find(kKinds, kind, &KindName::kind)->name;
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
      break;
  }
  return "";
}

Json shape_json(const Pattern& base, const Target& target, const solver::Sheet& sheet,
                const solver::ShapeOptions& options, const solver::ShapeStudy& study) {
  const Eigen::Matrix3d& turn = study.pose.turn;
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
          {"rms_mm", study.rms_mm},
          {"max_mm", study.max_mm},
          {"shift_max_mm", study.shifts_mm.colwise().norm().maxCoeff()},
          {"half_depth_mm", study.pose.half_depth_mm},
          {"pose",
           {{"turn",
             {{turn(0, 0), turn(0, 1), turn(0, 2)},
              {turn(1, 0), turn(1, 1), turn(1, 2)},
              {turn(2, 0), turn(2, 1), turn(2, 2)}}},
            {"move_mm", {study.pose.move_mm.x(), study.pose.move_mm.y(), study.pose.move_mm.z()}}}},
          {"deploys_from_deg", study.deploys_from_deg},
          {"driven_from_deg", study.driven_from_deg},
          {"fold_limit_deg", sheet.way()->ends_at_limit() ? Json(sheet.way()->end_deg()) : Json()},
          {"steps", study.steps},
          {"sheets_folded", study.evaluations},
          {"limits", limits}};
}

}  // namespace misalign::schema

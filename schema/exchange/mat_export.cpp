#include "schema/exchange/mat_export.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/mat_file.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;

// Prepends the flat sheet to the stations.
Eigen::MatrixXd from_flat_on(const Eigen::MatrixXd& stations, const Eigen::RowVectorXd& flat) {
  Eigen::MatrixXd all(stations.rows() + 1, stations.cols());
  all << flat, stations;
  return all;
}

Eigen::MatrixXd from_zero_on(const Eigen::MatrixXd& stations) {
  return from_flat_on(stations, Eigen::RowVectorXd::Zero(stations.cols()));
}

// Rows of indices, converted to count from 1.
template <class Row>
Eigen::MatrixXd counted(const std::vector<Row>& rows) {
  const Index width = static_cast<Index>(std::tuple_size_v<Row>);
  Eigen::MatrixXd matrix(static_cast<Index>(rows.size()), width);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (Index k = 0; k < width; ++k) {
      matrix(static_cast<Index>(i), k) = rows[i][static_cast<std::size_t>(k)] + 1;
    }
  }
  return matrix;
}

// Facets, panels and holes as rows of corners; holes also as rows and columns of the sheet, counted
// from 0 as in a pattern file.
void add_mesh(const FoldingView& view, std::vector<MatValue>& variables) {
  const solver::PerforatedSheet& base = view.base.base;
  std::vector<std::array<int, 4>> panels, holes;
  Eigen::MatrixXd places(static_cast<Index>(base.holes.size()), 2);
  for (const int f : solver::kept_facets(base.sheet, base.holes)) {
    panels.push_back(base.sheet.facets[f]);
  }
  for (const int f : base.holes) {
    places.row(static_cast<Index>(holes.size())) << base.sheet.places[f][0],
        base.sheet.places[f][1];
    holes.push_back(base.sheet.facets[f]);
  }
  variables.push_back(MatValue::matrix("vertices_mm", view.sheet.vertices_mm().transpose()));
  variables.push_back(MatValue::matrix("shifts_mm", view.shifts_mm.transpose()));
  variables.push_back(MatValue::matrix("facets", counted(base.sheet.facets)));
  variables.push_back(MatValue::matrix("panels", counted(panels)));
  variables.push_back(MatValue::matrix("holes", counted(holes)));
  variables.push_back(MatValue::matrix("hole_row_column", places));
}

void add_joints(const FoldingView& view, std::vector<MatValue>& variables) {
  const solver::Mechanism& mechanism = view.mechanism;
  std::vector<std::array<int, 2>> creases, diagonals;
  std::vector<double> assignment, hole;
  for (const solver::Crease& crease : mechanism.creases) {
    creases.push_back({crease.a, crease.b});
    assignment.push_back(mechanism.is_valley(crease) ? 1 : -1);
  }
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    const std::vector<int>& holes = view.base.base.holes;
    const auto at = std::find(holes.begin(), holes.end(), mechanism.loops[diagonal.loop].hole);
    diagonals.push_back({diagonal.from, diagonal.to});
    hole.push_back(static_cast<double>(at - holes.begin() + 1));
  }
  variables.push_back(MatValue::matrix("creases", counted(creases)));
  variables.push_back(MatValue::column("crease_assignment", assignment));
  variables.push_back(MatValue::integer("pilot_crease", mechanism.pilot + 1));
  variables.push_back(MatValue::matrix("diagonals", counted(diagonals)));
  variables.push_back(MatValue::column("diagonal_hole", hole));
}

MatValue folded_vertices(const solver::Sheet& sheet) {
  const Eigen::Matrix2Xd& flat_mm = sheet.vertices_mm();
  const std::vector<Eigen::Matrix3Xd>& shapes_mm = sheet.shapes_mm();
  const auto rows = shapes_mm.size() + 1, count = static_cast<std::size_t>(flat_mm.cols());
  std::vector<double> numbers(rows * count * 3, 0.0);
  const auto at = [&](std::size_t row, Index v, Index axis) -> double& {
    return numbers[row +
                   rows * (static_cast<std::size_t>(v) + count * static_cast<std::size_t>(axis))];
  };
  for (Index v = 0; v < flat_mm.cols(); ++v) {
    for (Index axis = 0; axis < 3; ++axis) {
      if (axis < 2) at(0, v, axis) = flat_mm(axis, v);
      for (std::size_t row = 1; row < rows; ++row) {
        at(row, v, axis) = shapes_mm[row - 1](axis, v);
      }
    }
  }
  return MatValue::box("folded_vertices_mm", {rows, count, 3}, numbers);
}

void add_histories(const FoldingView& view, const solver::Actuation& actuation,
                   std::vector<MatValue>& variables) {
  const solver::FoldingHistory& history = view.history;
  const auto flat_mm =
      Eigen::RowVectorXd::Map(history.flat_mm.data(), static_cast<Index>(history.flat_mm.size()));
  variables.push_back(MatValue::column("pilot_deg", actuation.pilot_deg));
  variables.push_back(MatValue::matrix("length_mm", from_flat_on(history.length_mm, flat_mm)));
  // Rates are 0 when flat: lengths change with the square of the angle there.
  variables.push_back(MatValue::matrix("rate_mm_per_deg", from_zero_on(history.slope_mm_per_deg)));
  variables.push_back(MatValue::matrix("fold_angle_deg", from_zero_on(history.fold_angle_deg)));
  variables.push_back(folded_vertices(view.sheet));
}

// Numbers of diagonals, converted to count from 1.
Json limits_counted(const solver::Actuation& actuation) {
  Json limits = limits_json(actuation);
  for (const char* key : {"few", "over_stroke"}) {
    if (limits[key].is_null()) continue;
    for (Json& diagonal : limits[key]["diagonals"]) diagonal = diagonal.get<int>() + 1;
  }
  return limits;
}

// The filling of the holes: "springs", or "filling".
MatValue filling(const FoldingView& view, const solver::Actuation& actuation) {
  std::vector<MatValue> fields;
  const auto& limit = actuation.actuators.stroke_limit;
  const solver::Fill& fill = actuation.actuators.fill;
  Json keys;
  add_filling(fill, view.base.base, keys);
  for (const auto& [key, value] : keys.items()) fields.push_back(MatValue::json(key, value));
  fields.push_back(MatValue::json("stroke_limit", or_null(limit)));
  fields.push_back(MatValue::matrix("force_n", actuation.force_n));
  fields.push_back(MatValue::matrix("moment_by_n_mm", actuation.moment_by_n_mm));
  fields.push_back(MatValue::column("energy_n_mm", actuation.energy_n_mm));
  fields.push_back(MatValue::column("moment_n_mm", actuation.moment_n_mm));
  fields.push_back(MatValue::column("mechanical_advantage", actuation.mechanical_advantage));
  const Json limits = limits_counted(actuation);
  for (const char* key : {"weakest", "few", "over_stroke"}) {
    fields.push_back(MatValue::json(key, limits[key]));
  }
  return MatValue::structure(std::holds_alternative<solver::Springs>(fill) ? "springs" : "filling",
                             std::move(fields));
}

MatValue verdict(const FoldingView& view) {
  Json json = verdict_json(view);
  if (json["where"].is_null()) json["where"] = "";  // always a text
  json["fold_limit_deg"] = view.history.path.fold_limit_deg;
  return MatValue::json("verdict", json);
}

// The constant part of the file's `readme`: the variables with their axes and units.
constexpr const char* kMatReadme =
    "Lengths in mm, angles in degrees, forces in N; names end in their units.\n"
    "S samples: pilot angles, flat first. V vertices (row 1: A1), C creases, D diagonals.\n"
    "All indices count from 1: vertices, panels, holes, diagonals.\n"
    "vertices_mm [V x 2] x and y on the flat sheet, including shifts_mm [V x 2]\n"
    "facets [F x 4] corners, counter-clockwise in top view; panels [P x 4] facets that are kept;\n"
    "holes [H x 4] facets that are taken out; hole_row_column [H x 2] counts from 0\n"
    "creases [C x 2] vertices; crease_assignment [C x 1] 1 valley, -1 mountain, in top view\n"
    "pilot_crease: the crease whose fold angle pilot_deg is (absolute value for a mountain)\n"
    "diagonals [D x 2] vertices; diagonal_hole [D x 1] row in holes\n"
    "pilot_deg [S x 1], 0 flat; length_mm, rate_mm_per_deg [S x D] of diagonals\n"
    "fold_angle_deg [S x C], 0 flat, valleys positive\n"
    "folded_vertices_mm [S x V x 3] x, y, z, each state aligned with the flat sheet\n"
    "springs, or filling of other holes: fill as in a design (- in its names is _), force_n "
    "[S x D] positive in tension,\n"
    "  moment_by_n_mm [S x D] of each and moment_n_mm [S x 1] of all about the pilot crease, "
    "energy_n_mm [S x 1],\n"
    "  mechanical_advantage [S x 1], NaN when flat; weakest: the least moment from 5 deg, or a "
    "stop, to D;\n"
    "  few: the fewest diagonals that keep half of it; NaN where there is none\n"
    "verdict: deploys_from_deg (D), first_fault, fault_deg, where, fold_limit_deg\n"
    "metrics: over the samples up to D, units in their names; elongations and strokes are shares\n"
    "  (0.02 is 2 %); NaN where there is none\n";

}  // namespace

std::string folded_mat(const std::string& path, const FoldingView& view,
                       const solver::Actuation& actuation, const Sampling& sampling,
                       const std::string& title, const Json& origin) {
  std::vector<MatValue> variables;
  variables.push_back(MatValue::text("readme", title + "\n" + kMatReadme));
  if (origin.contains("draw")) {
    variables.push_back(MatValue::integer("draw", origin["draw"].get<std::int64_t>()));
    variables.push_back(MatValue::json("campaign", origin["campaign"]));
  }
  add_mesh(view, variables);
  add_joints(view, variables);
  add_histories(view, actuation, variables);
  variables.push_back(filling(view, actuation));
  variables.push_back(MatValue::json("sampling", sampling_json(sampling)));
  variables.push_back(verdict(view));
  const solver::Metrics* const metrics = view.sheet.metrics();
  variables.push_back(MatValue::json("metrics", metrics ? metrics_json(*metrics) : Json()));
  return mat_file(path, variables);
}

}  // namespace misalign::schema

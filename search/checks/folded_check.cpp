#include "search/checks/folded_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/files/features.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/draws/models.hpp"
#include "solver/kinematics/folded_springs.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::search {
namespace {

using schema::Finding;
using schema::Json;

Finding exceeds(const std::string& where, const std::string& what, double value, double limit) {
  return {where + ": " + what + " is " + Json(value).dump() +
              " on the folded shape, and must be below " + Json(limit).dump(),
          {{"where", where}, {"column", what}, {"stored", nullptr}, {"recomputed", value}}};
}

}  // namespace

FoldedCheck::FoldedCheck(const schema::Pattern& base, const schema::Sampling& sampling)
    : model_(std::make_unique<FoldingModel>(base, sampling, schema::Design())),
      tolerances_{mechanism().panel_width_mm, sampling.sample_deg} {}

FoldedCheck::FoldedCheck(const schema::Campaign& campaign)
    : model_(std::make_unique<FoldingModel>(campaign)),
      tolerances_{mechanism().panel_width_mm, campaign.sample_deg} {}

void FoldedCheck::check_shapes(const std::string& where, const solver::Sheet& sheet,
                               Eigen::Index samples, ShapeReport& report) const {
  const solver::FlatVertices& vertices_mm = sheet.vertices_mm();
  const solver::FoldingHistory& history = sheet.history();
  const solver::Panels& panels = sheet.panels();
  const solver::FoldedShape& shape = sheet.model().shape();
  solver::ShapeCheck shape_check(vertices_mm, panels.corners, panels.folds);
  solver::SheetGeometry<double> geometry;
  place(mechanism(), vertices_mm, geometry);
  std::vector<double> claimed_deg(panels.folds.size());
  for (Eigen::Index k = 0; k < samples; ++k) {
    const solver::FoldState<double>& state = sheet.states()[static_cast<std::size_t>(k)].state;
    const Eigen::Matrix3Xd folded_mm = shape.vertices_mm(geometry, state);
    const Eigen::Matrix3Xd corners_mm = shape.corners_mm(geometry, state);
    for (std::size_t i = 0; i < panels.folds.size(); ++i) {
      claimed_deg[i] = history.fold_angle_deg(k, static_cast<Eigen::Index>(i));
    }
    shape_check.see(folded_mm, corners_mm, claimed_deg);
    for (int d = 0; d < mechanism().diagonal_count(); ++d) {
      const solver::Diagonal& diagonal = mechanism().diagonals[d];
      const double length_mm = solver::FoldedSpring(mechanism(), diagonal, folded_mm).length_mm();
      report.diagonal_mm =
          std::max(report.diagonal_mm, std::abs(length_mm - history.length_mm(k, d)));
    }
  }
  report.shape = shape_check.worst();
  add_shape_findings(where, panels, report);
  find_crossing(sheet, samples, report);
  find_meeting(sheet, samples, report);
}

void FoldedCheck::find_crossing(const solver::Sheet& sheet, Eigen::Index samples,
                                ShapeReport& report) const {
  if constexpr (has("FCL")) {
    CrossingCheck check(sheet.vertices_mm(), sheet.panels().corners);
    solver::SheetGeometry<double> geometry;
    place(mechanism(), sheet.vertices_mm(), geometry);
    for (Eigen::Index k = 0; k < samples; ++k) {
      const auto& state = sheet.states()[static_cast<std::size_t>(k)].state;
      const auto panels = check.crossing(sheet.model().shape().corners_mm(geometry, state));
      if (!panels) continue;
      const auto place_of = [&](int panel) {
        return schema::facet_json(model_->base(), sheet.panels().facets[panel]).dump();
      };
      report.first_contact_deg = sheet.sample_deg(static_cast<int>(k) + 1);
      report.contact = place_of(panels->first) + " and " + place_of(panels->second);
      return;
    }
  }
}

void FoldedCheck::find_meeting(const solver::Sheet& sheet, Eigen::Index samples,
                               ShapeReport& report) const {
  const solver::Panels& panels = sheet.panels();
  const auto motion = solver::resolved_motion(sheet);
  if (!motion) {
    report.meet_text = "contact is unknown: the path cannot be resolved";
    return;
  }
  const solver::FoldingWay& way = motion->way();
  const double last_deg = static_cast<double>(samples) * sheet.sample_deg(1);
  const double end =
      std::min(way.x_of(std::min(last_deg, way.end_deg())), motion->resolved_until());
  report.met_until_deg = way.pilot_deg(end);
  const auto contact = solver::ContactFinder(panels, *motion).first(end);
  if (!contact) {
    report.meet_text = fmt::format("no panels meet up to {:.10g} deg", report.met_until_deg);
    return;
  }
  report.meet = schema::contact_json(model_->base(), panels, *contact);
  report.meet_text =
      fmt::format("{} first meet at {:.4f} deg",
                  schema::panels_text(model_->base(), panels, contact->pair), contact->pilot_deg);
}

void FoldedCheck::add_shape_findings(const std::string& where, const solver::Panels& panels,
                                     ShapeReport& report) const {
  const double limit_rad = solver::shape_tolerance(panels);
  const double limit_mm = limit_rad * mechanism().panel_width_mm;
  const double limit_deg = limit_rad / solver::kRadPerDeg;
  const solver::ShapeCheck::Errors& shape = report.shape;
  const auto compare = [&](const char* what, double value, double limit) {
    if (!(value <= limit)) report.findings.push_back(exceeds(where, what, value, limit));
  };
  compare("length_mm", shape.length_mm, limit_mm);
  compare("planarity_mm", shape.planarity_mm, limit_mm);
  compare("coincidence_mm", shape.coincidence_mm, limit_mm);
  compare("diagonal_mm", report.diagonal_mm, limit_mm);
  compare("angle_deg", shape.angle_deg, limit_deg);
  compare("beyond_deg", shape.beyond_deg, solver::kOverFoldBand_deg);
  if (shape.wrong_sign >= 0) {
    const solver::FoldLine& fold = panels.folds[static_cast<std::size_t>(shape.wrong_sign)];
    report.findings.push_back(schema::differs(where, "fold " + solver::line_label(fold.a, fold.b),
                                              fold.sign > 0 ? "valley" : "mountain", "the other"));
  }
}

std::string findings_text(const std::vector<schema::Finding>& findings) {
  std::string text;
  const std::size_t shown = std::min(findings.size(), schema::kMostListed);
  for (std::size_t k = 0; k < shown; ++k) {
    text += schema::printable(findings[k].sentence) + "\n";
  }
  if (findings.size() > shown) {
    text += "and " + std::to_string(findings.size() - shown) + " more; --json has them all\n";
  }
  return text;
}

schema::Json findings_json(const std::vector<schema::Finding>& findings) {
  schema::Json json = schema::Json::array();
  for (const schema::Finding& finding : findings) {
    json.push_back(finding.details);
    json.back()["sentence"] = finding.sentence;
  }
  return json;
}

std::string no_contacts_text() {
  if constexpr (has("FCL")) {
    return "crossings    none between panels without a common vertex\n";
  }
  return "crossings    panels were not checked: " + schema::missing_text("FCL") + "\n";
}

std::string worst_text(const solver::ShapeCheck::Errors& shape, double diagonal_mm) {
  const auto e = [](double value) { return fmt::format("{:.1e}", value); };
  return "length " + e(shape.length_mm) + " mm, planarity " + e(shape.planarity_mm) +
         " mm, coincidence " + e(shape.coincidence_mm) + " mm, diagonal " + e(diagonal_mm) +
         " mm, angle " + e(shape.angle_deg) + " deg";
}

schema::Json worst_json(const solver::ShapeCheck::Errors& shape, double diagonal_mm) {
  return {{"length_mm", shape.length_mm},
          {"planarity_mm", shape.planarity_mm},
          {"coincidence_mm", shape.coincidence_mm},
          {"diagonal_mm", diagonal_mm},
          {"angle_deg", shape.angle_deg}};
}

}  // namespace misalign::search

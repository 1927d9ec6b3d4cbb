#include "search/sheets/contact_study.hpp"

#include <fmt/format.h>

#include <cmath>

#include "search/draws/models.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

std::string thickness_text(const schema::Pattern& base, const solver::Panels& panels,
                           const schema::ContactStudy& study) {
  if (!study.thickness) return "";
  const solver::PlateThickness& plates = *study.thickness;
  const std::string start =
      fmt::format("thickness    up to {:.4g} mm reaches {:g} deg (corners trimmed by {:g} mm): ",
                  plates.thickness_mm, study.reach_deg, study.trim_mm);
  if (plates.limit == solver::ThicknessLimit::taper) {
    return start + "there tapers leave nothing of panel " +
           schema::facet_json(base, panels.facets[static_cast<std::size_t>(plates.panel)]).dump() +
           " as thick\n";
  }
  return start + fmt::format("there {} meet at {:.4g} deg\n",
                             schema::panels_text(base, panels, plates.pair), plates.pilot_deg);
}

}  // namespace

ContactStudier::ContactStudier(const schema::Pattern& base, const schema::Sampling& sampling)
    : base_(base),
      sample_deg_(sampling.sample_deg),
      model_(model_of(base, sampling)),
      panels_(solver::panels_of(base.base, model_.mechanism())),
      ways_(model_, panels_) {}

double ContactStudier::checked_trim_mm(std::optional<double> trim_mm,
                                       const solver::FlatVertices& vertices_mm,
                                       const std::string& name) const {
  const double largest_mm = solver::largest_trim_mm(panels_, vertices_mm);
  const double wanted_mm = trim_mm.value_or(schema::kTrimPart * model_.mechanism().panel_width_mm);
  if (wanted_mm < largest_mm) return wanted_mm;
  throw UserError(
      schema::kExitUsage,
      fmt::format("--trim {:g}: leaves nothing of an edge of {} (that takes {:.4g} mm); "
                  "trim less",
                  wanted_mm, name, largest_mm));
}

schema::ContactStudy ContactStudier::study(const Eigen::Matrix2Xd& shifts_mm,
                                           std::optional<double> trim_mm, const std::string& name) {
  const solver::FlatVertices vertices_mm = base_.base.sheet.vertices_mm + shifts_mm;
  schema::ContactStudy study;
  study.trim_mm = checked_trim_mm(trim_mm, vertices_mm, name);
  study.deploys_from_deg =
      solver::record_path(model_, vertices_mm).verdict.deploys_from_sample * sample_deg_;
  const solver::PanelMotion* motion = ways_.follow(vertices_mm);
  if (!motion) {
    throw UserError(schema::kExitFailure,
                    name +
                        ": its folding path is lost (a numerical failure), so it is not known "
                        "where panels meet; `misalign fold` says how far the path is known");
  }
  const solver::FoldingWay& way = motion->way();
  const double known = motion->resolved_until();
  study.end_deg = way.end_deg();
  study.known_until_deg = way.pilot_deg(known);
  const solver::ContactFinder finder(panels_, *motion);
  study.first = finder.first(known);
  const double last_deg = study.first ? study.first->pilot_deg : study.known_until_deg;
  for (double pilot_deg = 0; pilot_deg <= last_deg; pilot_deg += schema::kClearanceStep_deg) {
    study.pilot_deg.push_back(pilot_deg);
    study.clearances.push_back(finder.clearance(way.x_of(pilot_deg)));
  }
  study.reach_deg = std::min(study.deploys_from_deg, last_deg);
  if (study.reach_deg > 0) {
    study.thickness =
        solver::largest_thickness(panels_, *motion, way.x_of(study.reach_deg), {study.trim_mm});
  }
  return study;
}

std::string contact_text(const schema::Pattern& base, const solver::Panels& panels,
                         const schema::ContactStudy& study) {
  std::string text;
  if (study.first) {
    text +=
        fmt::format("first meet   {} at {:.4f} deg\n",
                    schema::panels_text(base, panels, study.first->pair), study.first->pilot_deg);
  } else {
    text += fmt::format("first meet   none up to {:.4f} deg\n", study.known_until_deg);
  }
  if (study.known_until_deg < study.end_deg - 1e-6) {
    text += fmt::format(
        "not known    beyond {:.4f} deg: there the path, which ends at {:.4f} deg, "
        "turns too sharply\n",
        study.known_until_deg, study.end_deg);
  }
  text += thickness_text(base, panels, study);
  text += "\npilot_deg  apart_mm  vertex_deg  crease_deg\n";
  for (std::size_t k = 0; k < study.pilot_deg.size(); ++k) {
    const bool is_last = k + 1 == study.pilot_deg.size();
    if (!is_last && std::abs(std::remainder(study.pilot_deg[k], 10)) > 1e-9) continue;
    const solver::Clearance& least = study.clearances[k];
    text += fmt::format("{:>9g} {:>9.3f} {:>11.3f} {:>11.3f}\n", study.pilot_deg[k], least.apart_mm,
                        least.vertex_deg, least.crease_deg);
  }
  return text;
}

}  // namespace misalign::search

#include "search/sheets/contact_study.hpp"

#include <fmt/format.h>

#include "search/draws/models.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

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
  const double wanted_mm = trim_mm.value_or(solver::kTrimPart * model_.mechanism().panel_width_mm);
  if (wanted_mm < largest_mm) return wanted_mm;
  throw UserError(
      schema::Cause::bad_request,
      fmt::format("--trim {:g}: leaves nothing of an edge of {} (that takes {:.4g} mm); "
                  "trim less",
                  wanted_mm, name, largest_mm));
}

solver::ContactStudy ContactStudier::study(const Eigen::Matrix2Xd& shifts_mm,
                                           std::optional<double> trim_mm, const std::string& name) {
  const solver::FlatVertices vertices_mm = base_.base.sheet.vertices_mm + shifts_mm;
  solver::ContactStudy study;
  study.trim_mm = checked_trim_mm(trim_mm, vertices_mm, name);
  study.deploys_from_deg =
      solver::record_path(model_, vertices_mm).verdict.deploys_from_sample * sample_deg_;
  const solver::PanelMotion* motion = ways_.follow(vertices_mm);
  if (!motion) {
    throw UserError(schema::Cause::failure,
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
  for (double pilot_deg = 0; pilot_deg <= last_deg; pilot_deg += solver::kClearanceStep_deg) {
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

}  // namespace misalign::search

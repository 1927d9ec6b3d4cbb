#include <fmt/format.h>

#include <cmath>

#include "schema/exchange/contact_json.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

std::string thickness_text(const schema::Pattern& base, const solver::Panels& panels,
                           const solver::ContactStudy& study) {
  if (!study.thickness) return "";
  const solver::PlateThickness& plates = *study.thickness;
  const std::string start = fmt::format(
      "thickness      up to {:.4g} mm folds to {:.10g} deg (corners trimmed by {:g} mm), limited "
      "by ",
      plates.thickness_mm, study.reach_deg, study.trim_mm);
  if (plates.limit == solver::PlateThickness::Limit::taper) {
    return start + "the tapers of panel " +
           schema::facet_json(base, panels.facets[static_cast<std::size_t>(plates.panel)]).dump() +
           "\n";
  }
  return start + fmt::format("contact of {} at {:.4g} deg\n",
                             schema::panels_text(base, panels, plates.pair), plates.pilot_deg);
}

}  // namespace

std::string contact_text(const schema::Pattern& base, const solver::Panels& panels,
                         const solver::ContactStudy& study) {
  std::string text;
  if (study.first) {
    text +=
        fmt::format("first contact  {} at {:.4f} deg\n",
                    schema::panels_text(base, panels, study.first->pair), study.first->pilot_deg);
  } else {
    text += fmt::format("first contact  none up to {:.4f} deg\n", study.known_until_deg);
  }
  if (study.known_until_deg < study.end_deg - 1e-6) {
    text += fmt::format(
        "unknown        beyond {:.4f} deg: there the path, which ends at {:.4f} deg, turns too "
        "sharply\n",
        study.known_until_deg, study.end_deg);
  }
  text += thickness_text(base, panels, study);
  text += "\npilot_deg  apart_mm  vertex_deg  crease_deg\n";
  for (std::size_t k = 0; k < study.pilot_deg.size(); ++k) {
    const bool is_last = k + 1 == study.pilot_deg.size();
    if (!is_last && std::abs(std::remainder(study.pilot_deg[k], 10)) > 1e-9) continue;
    const solver::ContactFinder::Clearance& least = study.clearances[k];
    text += fmt::format("{:>9g} {:>9.3f} {:>11.3f} {:>11.3f}\n", study.pilot_deg[k], least.apart_mm,
                        least.vertex_deg, least.crease_deg);
  }
  return text + spring_clearance_text(base, panels, study);
}

}  // namespace misalign::search

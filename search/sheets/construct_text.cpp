#include <fmt/format.h>

#include "search/sheets/study_texts.hpp"

namespace misalign::search {

std::string construct_text(const schema::Pattern& base, const solver::ConstructStudy& study,
                           double at_deg) {
  std::string text = fmt::format(
      "stroke       every diagonal changes by {:.4g} % or more at {:g} deg\n"
      "shifts       up to {:.4g} mm in x or y\n"
      "folds        by the base's fold angles, to 180 deg: creases keep their directions, and\n"
      "             opposite edges of holes change alike (to {:.1e} mm)\n",
      100 * study.stroke, at_deg, study.amplitude_mm, study.misfit_mm);
  text +=
      study.is_monotone()
          ? "diagonals    all monotone from flat to 180 deg (closed form)\n"
          : "diagonals    not all monotone to 180 deg; `misalign fold` shows up to which angle\n";
  text += fmt::format("family       {} coordinates\n\n", study.dimension);
  text += "hole       delta_mm  epsilon_mm  stroke_%  monotone\n";
  for (const solver::ConstructStudy::Hole& hole : study.holes) {
    text += fmt::format("{:<9} {:>9.5f} {:>11.5f} {:>9.3f}  {}\n",
                        schema::facet_json(base, hole.facet).dump(), hole.delta_mm, hole.epsilon_mm,
                        100 * hole.stroke, hole.direction != 0 ? "yes" : "no");
  }
  return text;
}

}  // namespace misalign::search

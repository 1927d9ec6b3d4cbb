#include "schema/exchange/simulated_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace misalign::schema {

int SimulatedSheet::panel_at(int vertex) const {
  const auto has_it = [&](const std::array<int, 4>& corners) {
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  };
  const auto at = std::find_if(panels.corners.begin(), panels.corners.end(), has_it);
  return static_cast<int>(at - panels.corners.begin());
}

std::vector<std::string> SimulatedSheet::head() const {
  const solver::Crease& pilot = mechanism.creases[mechanism.pilot];
  return {title,
          fmt::format("released at rest with the pilot crease {} at {:.10g} deg; free in space",
                      solver::line_label(pilot.a, pilot.b), pilot_deg),
          fmt::format("{} panels, {:.10g} mm thick, {:.10g} g/cm^3; {} springs of {:.10g} N/mm, "
                      "relaxed {}",
                      panels.corners.size(), plates.thickness_mm, plates.density_g_per_cm3,
                      mechanism.diagonals.size(), stiffness_n_per_mm,
                      rest_deg > 0 ? fmt::format("with the pilot at {:.10g} deg", rest_deg)
                                   : "on the flat sheet")};
}

}  // namespace misalign::schema

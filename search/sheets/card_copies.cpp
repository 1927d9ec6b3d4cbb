#include "search/sheets/card_copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/pattern/perforation_check.hpp"
#include "search/sheets/backlash.hpp"
#include "search/sheets/joint_of_design.hpp"
#include "search/sheets/tolerance.hpp"

namespace misalign::search {
namespace {

using schema::CardLine;
using Bound = CardLine::Bound;

solver::Tolerance tolerance_of(const CardSheet& on, const schema::Campaign& campaign,
                               const CopyTrials& copies) {
  const auto& [chosen, sheet, design, used_deg] = on;
  const double miscut_mm = *design.miscut_mm;
  check_miscut(miscut_mm, sheet.base().sheet, chosen.shifts_mm, sheet.name());
  ToleranceOptions study;
  study.amplitude_mm = miscut_mm;
  study.trials = copies.trials;
  study.jobs = copies.jobs;
  study.progress = show_copies;
  study.filled = filled_by(design, sheet.base());
  study.set = solver::available_instruction_sets().back();
  // The first sample from the angle of use on: copies are judged at samples.
  const double sample_deg = chosen.sampling.sample_deg,
               from_deg = std::ceil(used_deg / sample_deg - 1e-9) * sample_deg;
  const std::vector<Eigen::Matrix2Xd> shifts_mm = {chosen.shifts_mm};
  const schema::Campaign used =
      used_from(campaign, from_deg, shifts_mm, study, [&](std::size_t) { return on.sheet.name(); });
  return study_tolerance(used, shifts_mm, study).front();
}

// The largest distance of the stops of 90 of 100 copies, with friction, from the wanted stop.
CardLine stop_line(const solver::Tolerance& tolerance) {
  const solver::MiscutStops& stops = tolerance.copies.stops;
  CardLine line{"stop_error_deg",
                fmt::format("Error of the stop at ±{:g} mm cutting error, 90 % of copies",
                            tolerance.amplitude_mm),
                "deg",
                {},
                {},
                Bound::at_most,
                ""};
  if (const std::uint64_t others = stops.flat + stops.held; others > 0) {
    line.note = fmt::format("{} of {} copies do not stop", others, stops.trials());
  }
  const double own_deg = tolerance.own_stop ? tolerance.own_stop->at_deg : 0;
  const double wanted_deg = tolerance.rest_deg > 0 ? tolerance.rest_deg : own_deg;
  if (own_deg == 0) {
    line.note = "the sheet itself does not stop";
  } else if (!stops.stops.empty()) {
    const std::vector<double> at_deg = stops.sorted(&solver::Stop::at_deg);
    line.found = std::max(std::abs(solver::quantile(at_deg, 0.05) - wanted_deg),
                          std::abs(solver::quantile(at_deg, 0.95) - wanted_deg));
  }
  return line;
}

// The largest distance of copies from the target where they stop.
CardLine shape_line(const solver::Tolerance& tolerance) {
  CardLine line{
      "shape_error_mm",
      fmt::format("Largest distance from the target at ±{:g} mm cutting error, 95 % of copies",
                  tolerance.amplitude_mm),
      "mm",
      {},
      {},
      Bound::at_most,
      ""};
  const solver::MiscutStops& stops = tolerance.copies.stops;
  if (stops.stops.empty()) {
    line.note = "no copy stops";
  } else {
    line.found = solver::quantile(stops.sorted(&solver::Stop::shape_max_mm), 0.95);
  }
  return line;
}

}  // namespace

std::vector<CardLine> copy_lines(const CardSheet& on, const CopyTrials& copies) {
  const auto& [chosen, sheet, design, used_deg] = on;
  std::vector<CardLine> lines;
  const schema::Campaign campaign = chosen.drawn ? chosen.drawn->campaign : chosen.as_campaign();
  const bool is_overconstrained = schema::is_overconstrained(sheet.base());
  if (design.miscut_mm) {
    const double wanted = design.yield.value_or(solver::kWantedShare);
    if (is_overconstrained) {
      lines.push_back({"yield", "Yield of miscut copies", "", wanted, 0, Bound::at_least,
                       "no miscut copy of an overconstrained sheet folds; `misalign tolerance` "
                       "gives its joint gaps"});
    } else {
      const solver::Tolerance tolerance = tolerance_of(on, campaign, copies);
      const double share =
          static_cast<double>(tolerance.survivors()) /
          static_cast<double>(std::max<std::uint64_t>(1, tolerance.copies.decided()));
      lines.push_back({"yield", fmt::format("Yield at ±{:g} mm cutting error", *design.miscut_mm),
                       "", wanted, share, Bound::at_least, ""});
      if (tolerance.copies.stops.trials() > 0) {
        lines.push_back(stop_line(tolerance));
        if (tolerance.has_shapes) lines.push_back(shape_line(tolerance));
      }
    }
  }
  const std::optional<double> play_mm = play_of(design, sheet);
  if (play_mm && is_overconstrained) {
    lines.push_back({"play_mm",
                     "Largest joint clearance",
                     "mm",
                     play_mm,
                     {},
                     Bound::at_least,
                     "the joints of an overconstrained sheet allow none"});
  } else if (play_mm) {
    const std::vector<Eigen::Matrix2Xd> shifts_mm = {chosen.shifts_mm};
    const BacklashStudy study(campaign, shifts_mm, {.used_from_deg = used_deg});
    const auto loose = study.run({*play_mm, copies.trials, copies.jobs, show_copies}).front();
    lines.push_back(
        {"play_mm",
         fmt::format("Largest joint clearance, from {:g}° to {:g}°", loose.from_deg, loose.to_deg),
         "mm", play_mm, loose.largest_mm, Bound::at_least, ""});
  }
  return lines;
}

}  // namespace misalign::search

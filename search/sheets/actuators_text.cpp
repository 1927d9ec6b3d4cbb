#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/exchange/actuators_json.hpp"
#include "schema/pattern/fill_words.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

using Eigen::Index;
using solver::Actuation;

std::string springs_summary(const solver::Mechanism& mechanism, const Actuation& actuation) {
  const auto& limit = actuation.actuators.stroke_limit;
  const std::string where =
      actuation.from_deg ? fmt::format("{:.10g} deg", *actuation.from_deg) : "D";
  std::string text =
      fmt::format("{}{}\n",
                  schema::filling_words(actuation.actuators.fill, mechanism.diagonal_count(),
                                        schema::kDegreeWord),
                  limit ? fmt::format("; stroke limit {:.10g} %", 100 * *limit) : "");
  if (actuation.weakest) {
    text +=
        fmt::format("weakest{} at {:g} deg: {:.4g} N mm about the pilot crease\n",
                    actuation.counts_from_deg > solver::kSlopeFrom_deg ? " beyond the stop" : "",
                    actuation.weakest->pilot_deg, actuation.weakest->moment_n_mm);
  } else {
    text += (actuation.from_deg ? "used" : "deploys") +
            fmt::format(" from less than {:g} deg: no weakest point\n", actuation.counts_from_deg);
  }
  if (actuation.few) {
    text += fmt::format("{} of {} diagonals keep {:.3g} % of that: {}{}\n",
                        actuation.few->diagonals.size(), mechanism.diagonal_count(),
                        100 * actuation.few->share,
                        schema::diagonal_labels(mechanism, actuation.few->diagonals),
                        actuation.few->proven ? " (proven minimum)" : " (perhaps not the minimum)");
  }
  if (actuation.over_stroke) {
    text += fmt::format("the stroke limit is first exceeded at {:g} deg; up to {} by {}\n",
                        actuation.over_stroke->from_deg, where,
                        schema::diagonal_labels(mechanism, actuation.over_stroke->diagonals));
  } else if (limit) {
    text += "no diagonal goes beyond the stroke limit up to " + where + "\n";
  }
  return text;
}

// Every 10 degrees, and at the angle of use.
std::string energies_text(const Actuation& actuation) {
  std::string text = "\npilot_deg deployment  energy_n_mm  moment_n_mm  advantage\n";
  for (std::size_t row = 1; row < actuation.pilot_deg.size(); ++row) {
    const double pilot_deg = actuation.pilot_deg[row];
    const bool is_d = static_cast<Index>(row) == actuation.from_row;
    if (!is_d && std::abs(std::remainder(pilot_deg, 10)) > 1e-9) continue;
    text += fmt::format("{:>9g} {:>10.4f} {:>12.6g} {:>12.6g} {:>10.4g}{}\n", pilot_deg,
                        (180 - pilot_deg) / 180, actuation.energy_n_mm[row],
                        actuation.moment_n_mm[row], actuation.mechanical_advantage[row],
                        !is_d                ? ""
                        : actuation.from_deg ? "  <- used from here"
                                             : "  <- deploys from here");
  }
  return text;
}

std::string springs_text(const solver::Sheet& sheet, const Actuation& actuation) {
  const solver::Fill& fill = actuation.actuators.fill;
  if (std::holds_alternative<solver::NoFill>(fill)) return "";
  const solver::Mechanism& mechanism = sheet.mechanism();
  std::string text =
      fmt::format("\n diagonal {:>11}  {}  elongation\n",
                  std::holds_alternative<solver::RubberPlates>(fill) ? "cut_out_mm" : "free_mm",
                  actuation.from_deg ? "force there" : "force_at_D");
  const Index row = actuation.from_row;
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    const double force_n = actuation.force_n(row, d);
    const auto at = static_cast<std::size_t>(d);
    const double flat_mm = sheet.history().flat_mm[at];
    const double longer_mm = row == 0 ? 0 : sheet.history().length_mm(row - 1, d) - flat_mm;
    const bool kept = actuation.few && std::binary_search(actuation.few->diagonals.begin(),
                                                          actuation.few->diagonals.end(), d);
    text += fmt::format("{:>9} {:>11.3f} {:>9.3f} N {:>9.3f} % {}\n",
                        schema::diagonal_label(mechanism, d), actuation.free_mm[at], force_n,
                        100 * longer_mm / flat_mm, kept ? " in that set" : "");
  }
  return text;
}

}  // namespace

std::string actuators_text(const solver::Sheet& sheet, const Actuation& actuation) {
  std::string text = springs_summary(sheet.mechanism(), actuation) + energies_text(actuation) +
                     springs_text(sheet, actuation);
  if (const auto rubber = rubber_of(sheet, actuation)) text += "\n" + rubber_text(sheet, *rubber);
  return text;
}

}  // namespace misalign::search

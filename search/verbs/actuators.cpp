#include "search/verbs/actuators.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "schema/exchange/actuation_json.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"

namespace misalign::search {
namespace {

using Eigen::Index;

std::string labels(const solver::Mechanism& mechanism, const std::vector<int>& diagonals) {
  std::string text;
  for (const int d : diagonals) {
    text += (text.empty() ? "" : ", ") + schema::diagonal_label(mechanism, d);
  }
  return text;
}

void print_summary(const solver::Mechanism& mechanism, const FoldedSheet& folded) {
  const solver::Actuation& actuation = folded.actuation;
  const auto& limit = actuation.actuators.stroke_limit;
  put_format("springs of %g N/mm on every diagonal, relaxed when flat%s\n",
             actuation.actuators.stiffness_n_per_mm,
             limit ? ("; stroke limit " + schema::shown_number(100 * *limit) + " %").c_str() : "");
  if (actuation.weakest) {
    put_format("weakest at %g deg: %.4g N mm about the pilot crease\n",
               actuation.weakest->pilot_deg, actuation.weakest->moment_n_mm);
  } else {
    put_format("deploys from less than 5 deg: no weakest point\n");
  }
  if (actuation.few) {
    put_format("%zu of %d diagonals keep %.3g %% of that: %s%s\n", actuation.few->diagonals.size(),
               mechanism.diagonal_count(), 100 * actuation.few->share,
               labels(mechanism, actuation.few->diagonals).c_str(),
               actuation.few->proven ? "; no fewer do" : "; fewer might");
  }
  if (actuation.over_stroke) {
    put_format("the stroke limit is first exceeded at %g deg; up to D by %s\n",
               actuation.over_stroke->from_deg,
               labels(mechanism, actuation.over_stroke->diagonals).c_str());
  } else if (limit) {
    put_format("no diagonal goes beyond the stroke limit up to D\n");
  }
}

// Every 10 degrees, and at D.
void print_way(const FoldedSheet& folded) {
  const solver::Actuation& actuation = folded.actuation;
  const Index at_d = folded.path.rows_up_to_d();
  put_format("\n%9s %10s %12s %12s %10s\n", "pilot_deg", "deployment", "energy_n_mm", "moment_n_mm",
             "advantage");
  for (std::size_t row = 1; row < actuation.pilot_deg.size(); ++row) {
    const double pilot_deg = actuation.pilot_deg[row];
    const bool is_d = static_cast<Index>(row) == at_d;
    if (!is_d && std::abs(std::remainder(pilot_deg, 10)) > 1e-9) continue;
    put_format("%9g %10.4f %12.6g %12.6g %10.4g%s\n", pilot_deg, (180 - pilot_deg) / 180,
               actuation.energy_n_mm[row], actuation.moment_n_mm[row],
               actuation.mechanical_advantage[row], is_d ? "  <- deploys from here" : "");
  }
}

void print_forces(const solver::Mechanism& mechanism, const FoldedSheet& folded) {
  const solver::Actuation& actuation = folded.actuation;
  const Index at_d = folded.path.rows_up_to_d();
  put_format("\n%9s %11s %11s\n", "diagonal", "force_at_D", "elongation");
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    const double force_n = actuation.force_n(at_d, d);
    const double stretch_mm = force_n / actuation.actuators.stiffness_n_per_mm;
    const double elongation = stretch_mm / folded.path.history.flat_mm[static_cast<std::size_t>(d)];
    const bool kept = actuation.few && std::binary_search(actuation.few->diagonals.begin(),
                                                          actuation.few->diagonals.end(), d);
    put_format("%9s %9.3f N %9.3f %% %s\n", schema::diagonal_label(mechanism, d).c_str(), force_n,
               100 * elongation, kept ? " one of the few" : "");
  }
}

}  // namespace

void show_actuators(const ActuatorsOptions& options) {
  const ChosenSheet sheet = choose_sheet(options.path, options.draw);
  const SheetFolder folder(sheet.base, sheet.sampling,
                           options.actuators.instead_of(sheet.actuators));
  const FoldedSheet folded = folder.fold(sheet.shifts_mm);
  const schema::FoldingView view = folder.view(folded);
  const schema::Json verdict = schema::verdict_json(view);
  if (options.json) {
    schema::Json json = schema::actuation_history_json(view, folded.path, folded.actuation);
    json.update(sheet.key_json());
    json["deploys_from_deg"] = verdict["deploys_from_deg"];
    put_json(json);
    return;
  }
  const char* standing = "";
  if (sheet.drawn) {
    const bool accepted = sheet.drawn->campaign.accepts(folded.path.history.verdict);
    standing = accepted ? "accepted, " : "not accepted, ";
  }
  put_format("%s: %sdeploys from %g deg%s\n", schema::printable(sheet.name()).c_str(), standing,
             verdict["deploys_from_deg"].get<double>(),
             verdict.contains("cause") ? " as far as could be told (undecided)" : "");
  print_summary(folder.mechanism(), folded);
  print_way(folded);
  print_forces(folder.mechanism(), folded);
}

}  // namespace misalign::search

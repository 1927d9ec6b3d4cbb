// `misalign actuators`: springs on the diagonals of one sheet.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/exchange/actuators_json.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ActuatorsCall {
  std::string path;                   // a catalogue or a pattern file
  std::optional<std::uint64_t> draw;  // of a catalogue's campaign, accepted or not
  OtherActuators actuators;
  bool json = false;
};

using Eigen::Index;

std::string labels(const solver::Mechanism& mechanism, const std::vector<int>& diagonals) {
  std::vector<std::string> names;
  for (const int d : diagonals) names.push_back(schema::diagonal_label(mechanism, d));
  return fmt::to_string(fmt::join(names, ", "));
}

void print_summary(const solver::Mechanism& mechanism, const FoldedSheet& folded) {
  const solver::Actuation& actuation = folded.actuation;
  const auto& limit = actuation.actuators.stroke_limit;
  put("springs of {:g} N/mm on every diagonal, relaxed when flat{}\n",
      actuation.actuators.stiffness_n_per_mm,
      limit ? fmt::format("; stroke limit {:.10g} %", 100 * *limit) : "");
  if (actuation.weakest) {
    put("weakest at {:g} deg: {:.4g} N mm about the pilot crease\n", actuation.weakest->pilot_deg,
        actuation.weakest->moment_n_mm);
  } else {
    put("deploys from less than 5 deg: no weakest point\n");
  }
  if (actuation.few) {
    put("{} of {} diagonals keep {:.3g} % of that: {}{}\n", actuation.few->diagonals.size(),
        mechanism.diagonal_count(), 100 * actuation.few->share,
        labels(mechanism, actuation.few->diagonals),
        actuation.few->proven ? "; no fewer do" : "; fewer might");
  }
  if (actuation.over_stroke) {
    put("the stroke limit is first exceeded at {:g} deg; up to D by {}\n",
        actuation.over_stroke->from_deg, labels(mechanism, actuation.over_stroke->diagonals));
  } else if (limit) {
    put("no diagonal goes beyond the stroke limit up to D\n");
  }
}

// Every 10 degrees, and at D.
void print_way(const FoldedSheet& folded) {
  const solver::Actuation& actuation = folded.actuation;
  const Index at_d = folded.path.rows_up_to_d();
  put("\npilot_deg deployment  energy_n_mm  moment_n_mm  advantage\n");
  for (std::size_t row = 1; row < actuation.pilot_deg.size(); ++row) {
    const double pilot_deg = actuation.pilot_deg[row];
    const bool is_d = static_cast<Index>(row) == at_d;
    if (!is_d && std::abs(std::remainder(pilot_deg, 10)) > 1e-9) continue;
    put("{:>9g} {:>10.4f} {:>12.6g} {:>12.6g} {:>10.4g}{}\n", pilot_deg, (180 - pilot_deg) / 180,
        actuation.energy_n_mm[row], actuation.moment_n_mm[row], actuation.mechanical_advantage[row],
        is_d ? "  <- deploys from here" : "");
  }
}

void print_forces(const solver::Mechanism& mechanism, const FoldedSheet& folded) {
  const solver::Actuation& actuation = folded.actuation;
  const Index at_d = folded.path.rows_up_to_d();
  put("\n diagonal  force_at_D  elongation\n");
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    const double force_n = actuation.force_n(at_d, d);
    const double stretch_mm = force_n / actuation.actuators.stiffness_n_per_mm;
    const double elongation = stretch_mm / folded.path.history.flat_mm[static_cast<std::size_t>(d)];
    const bool kept = actuation.few && std::binary_search(actuation.few->diagonals.begin(),
                                                          actuation.few->diagonals.end(), d);
    put("{:>9} {:>9.3f} N {:>9.3f} % {}\n", schema::diagonal_label(mechanism, d), force_n,
        100 * elongation, kept ? " one of the few" : "");
  }
}

void show_actuators(const ActuatorsCall& call) {
  const ChosenSheet sheet = choose_sheet(call.path, call.draw);
  const SheetFolder folder(sheet.base, sheet.sampling, call.actuators.instead_of(sheet.actuators));
  const FoldedSheet folded = folder.fold(sheet.shifts_mm);
  if (call.json) {
    schema::Json json = folder.springs_json(folded);
    json.update(sheet.key().json());
    put_json(json);
    return;
  }
  const solver::Verdict& verdict = folded.path.history.verdict;
  const double deploys_from_deg = verdict.deploys_from_sample * folder.sampling().sample_deg;
  const char* decision = "";
  if (sheet.drawn) {
    const bool accepted = sheet.drawn->campaign.accepts(verdict);
    decision = accepted ? "accepted, " : "not accepted, ";
  }
  const bool is_undecided = verdict.first_fault == solver::Fault::undecided;
  put("{}: {}deploys from {:g} deg{}\n", schema::printable(sheet.name()), decision,
      deploys_from_deg, is_undecided ? " as far as could be told (undecided)" : "");
  print_summary(folder.mechanism(), folded);
  print_way(folded);
  print_forces(folder.mechanism(), folded);
}

}  // namespace

Action actuators_verb(CLI::App& verb) {
  verb.description("springs on the diagonals of one sheet");
  verb.footer(
      "Along the path:\n"
      "  energy       of all springs\n"
      "  moment       about the pilot crease, dE/d(pilot angle); negative: the springs would\n"
      "               fold the sheet further\n"
      "  advantage    newtons on the sheet's span for each newton in every diagonal\n"
      "  deployment   (180 - pilot)/180: 1 when flat\n"
      "Before it: where the moment is least, and the fewest diagonals that keep half of that\n"
      "moment. After it: the force on each diagonal at D. Forces and elongations are positive\n"
      "where a spring is longer than when flat, and pulls.\n\n"
      "Examples:\n  misalign actuators results/miura-6x6-1a2b3c4d.db 1234\n"
      "  misalign actuators results/miura-6x6-1a2b3c4d.db 1234 --stroke-limit 0.08\n"
      "  misalign actuators search/patterns/table1.json");
  auto call = std::make_shared<ActuatorsCall>();
  add_catalogue_or_pattern(verb, call->path);
  add_draw_of_catalogue(verb, call->draw);
  add_other_actuators(verb, call->actuators);
  verb.add_flag("--json", call->json, "as JSON, with all histories");
  return [call] {
    show_actuators(*call);
    return 0;
  };
}

}  // namespace misalign::search

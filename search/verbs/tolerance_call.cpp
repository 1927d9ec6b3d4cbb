#include "search/verbs/tolerance_call.hpp"

#include "schema/catalogue/catalogue_state.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/terminal/shell_word.hpp"

namespace misalign::search {

using schema::UserError;

ToleranceTargets choose_sheets(const ToleranceCall& call) {
  const auto database = schema::open_for_reading(call.path);
  if (!call.choice.chooses()) {
    throw UserError(schema::Cause::bad_request,
                    "tolerance: no candidates are chosen (a catalogue holds many); give draw "
                    "numbers, --best K, --diverse K or --where SQL");
  }
  ToleranceTargets sheets{schema::read_campaign_of(*database, call.path), {}, {}, {}, ""};
  sheets.design = sheets.campaign.design;
  add_study_functions(*database, sheets.campaign, call.path);
  sheets.draws = chosen_draws(*database, call.choice);
  for (const std::uint64_t draw : sheets.draws) {
    sheets.shifts_mm.push_back(shifts_of_number(*database, sheets.campaign, draw));
  }
  return sheets;
}

ToleranceTargets chosen_sheet(const ToleranceCall& call, const ChosenSheet& chosen) {
  ToleranceTargets sheets{{}, chosen.design, {chosen.shifts_mm}, {}, chosen.pattern};
  schema::Campaign& campaign = sheets.campaign = chosen.as_campaign();
  ToleranceOptions itself = call.study;
  itself.trials = 0;
  itself.vertices = false;
  const int own_sample = study_tolerance(campaign, sheets.shifts_mm, itself).front().own_sample;
  if (own_sample == 0) {
    throw UserError(
        schema::Cause::bad_input,
        call.path +
            ": the sheet does not deploy (D = 0), so that miscut copies have nothing to "
            "lose; shift its vertices by displacements_mm, or see its first fault: "
            "misalign fold " +
            shell_path(call.path));
  }
  campaign.threshold_deg = own_sample * campaign.sample_deg;
  return sheets;
}

schema::Campaign campaign_of_use(const ToleranceCall& call, const ToleranceTargets& sheets) {
  const auto from_deg = call.from_deg ? call.from_deg : sheets.design.from_deg;
  if (!from_deg) return sheets.campaign;
  return used_from(sheets.campaign, *from_deg, sheets.shifts_mm, call.study,
                   [&](std::size_t k) { return sheets.key(k).name(); });
}

bool is_single(const ToleranceCall& call, const ToleranceTargets& sheets) {
  return sheets.draws.empty() || call.choice.draws.size() == 1;
}

}  // namespace misalign::search

#include "search/verbs/tolerance_call.hpp"

#include <fmt/format.h>

#include <cmath>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/shell_word.hpp"
#include "solver/design/angle_of_use.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

ChosenSheets sheets_of_catalogue(const ToleranceCall& call) {
  const auto database = schema::open_for_reading(call.path);
  if (!call.choice.chooses()) {
    throw UserError(schema::Cause::bad_request,
                    "tolerance: of which candidates? (none is named); add the number of a draw, "
                    "--best K, --diverse K or --where SQL");
  }
  ChosenSheets sheets{schema::read_campaign_of(*database, call.path), {}, {}, {}, ""};
  sheets.design = sheets.campaign.design;
  sheets.draws = chosen_draws(*database, call.choice);
  for (const std::uint64_t draw : sheets.draws) {
    sheets.shifts_mm.push_back(shifts_of_number(*database, sheets.campaign, draw));
  }
  return sheets;
}

// As a campaign of its own, from whose threshold the sheet itself just deploys. The seed is the
// default one: an exported candidate does not say its campaign's.
ChosenSheets sheet_of_file(const ToleranceCall& call) {
  const ChosenSheet chosen = sheet_of_pattern_file(call.path);
  ChosenSheets sheets{{}, chosen.design, {chosen.shifts_mm}, {}, chosen.pattern};
  schema::Campaign& campaign = sheets.campaign;
  campaign.pattern = chosen.base;
  campaign.sample_deg = chosen.sampling.sample_deg;
  campaign.end_deg = chosen.sampling.end_deg;
  campaign.between_samples = chosen.sampling.between_samples;
  campaign.threshold_deg = campaign.sample_deg;
  ToleranceOptions itself = call.study;
  itself.trials = 0;
  itself.vertices = false;
  const int own_sample = study_tolerance(campaign, sheets.shifts_mm, itself).front().own_sample;
  if (own_sample == 0) {
    throw UserError(schema::Cause::bad_input,
                    call.path +
                        ": the sheet deploys from nothing (its D is 0), so that there is nothing "
                        "that miscut copies could lose; shift its vertices by displacements_mm, "
                        "or see what is in the way: misalign fold " +
                        shell_path(call.path));
  }
  campaign.threshold_deg = own_sample * campaign.sample_deg;
  return sheets;
}

// Copies are judged at samples: the angle of use must be one.
void check_is_sample(double from_deg, double sample_deg) {
  constexpr double kMultipleTolerance = 1e-9;  // as campaign files have it
  const double samples = from_deg / sample_deg;
  if (std::abs(samples - std::round(samples)) <= kMultipleTolerance * std::max(1.0, samples))
    return;
  throw UserError(solver::OptionFault{
      "from_deg", schema::shown_number(from_deg),
      fmt::format("must be a whole multiple of sample_deg = {} (copies are judged at samples)",
                  schema::shown_number(sample_deg)),
      "try " + schema::shown_number(std::max(1.0, std::round(samples)) * sample_deg)});
}

}  // namespace

schema::Campaign campaign_of_use(const ToleranceCall& call, const ChosenSheets& sheets) {
  schema::Campaign campaign = sheets.campaign;
  const auto from_deg = call.from_deg ? call.from_deg : sheets.design.from_deg;
  if (!from_deg) return campaign;
  check_is_sample(*from_deg, campaign.sample_deg);
  ToleranceOptions alone = call.study;
  alone.trials = 0;
  alone.vertices = false;
  alone.progress = nullptr;
  campaign.threshold_deg = *from_deg;
  const auto themselves = study_tolerance(campaign, sheets.shifts_mm, alone);
  for (std::size_t k = 0; k < themselves.size(); ++k) {
    if (themselves[k].own_sample >= campaign.threshold_sample()) continue;
    throw UserError(solver::beyond_d_fault(sheets.key(k).name(), *from_deg,
                                           themselves[k].own_sample * campaign.sample_deg));
  }
  return campaign;
}

ChosenSheets choose_sheets(const ToleranceCall& call) {
  return is_pattern_file(call.path) ? sheet_of_file(call) : sheets_of_catalogue(call);
}

bool is_single(const ToleranceCall& call, const ChosenSheets& sheets) {
  return sheets.draws.empty() || call.choice.draws.size() == 1;
}

void show_copies(const CopiesDone& copies) { show_work("copies judged", copies.done, copies.all); }

}  // namespace misalign::search

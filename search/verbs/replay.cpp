// `misalign replay`: any draw of a campaign again.
#include <fmt/format.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/folding_model.hpp"
#include "search/sheets/folding_text.hpp"
#include "search/sheets/whole_program.hpp"
#include "search/splitting/climber.hpp"
#include "search/splitting/origin.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ReplayCall {
  std::string catalogue_path;
  std::uint64_t draw = 0;
  bool again = false, json = false, table = false;
};

// The optimum of an optimising campaign's draw, or the draw if it is not accepted.
Eigen::Matrix2Xd end_of(const schema::Campaign& campaign, std::uint64_t draw) {
  DrawEvaluator evaluator(campaign, solver::available_instruction_sets().back(), kWithoutProofs);
  const schema::UnitRecord unit = work_off(evaluator, {draw, draw + 1});
  return unit.candidates.empty() ? shifts_of_draw(campaign, draw) : unit.candidates[0].shifts_mm;
}

// The shifts as stored, or made again.
Eigen::Matrix2Xd shifts_of(SQLite::Database& database, const schema::Campaign& campaign,
                           const ReplayCall& call) {
  if (!call.again || !campaign.search.stores_sheets()) {
    return shifts_of_number(database, campaign, call.draw);
  }
  if (!campaign.search.splitting) return end_of(campaign, call.draw);
  Climber climber(campaign, solver::available_instruction_sets().back(), kWithoutProofs);
  const Ladder ladder = stored_ladder(campaign, schema::read_levels(database));
  const Origin origin = origin_of(call.draw, *campaign.search.splitting);
  for (const FoundCandidate& found : climbed(ladder, origin.population, climber).found) {
    if (found.origin == origin) return found.candidate.shifts_mm;
  }
  throw schema::UserError(
      schema::Cause::bad_request,
      fmt::format(
          "population {} meets no candidate for the first time at level {}, step {}, by particle "
          "{}, which is what the number {} means; take one that `misalign query` shows",
          origin.population, origin.level, origin.step, origin.particle, call.draw));
}

void replay(const ReplayCall& call) {
  const auto database = schema::open_for_reading(call.catalogue_path);
  const schema::Campaign campaign = schema::read_campaign_of(*database, call.catalogue_path);
  const Eigen::Matrix2Xd shifts_mm = shifts_of(*database, campaign, call);
  FoldingModel model(campaign);
  const solver::Sheet sheet = model.sheet(shifts_mm);
  const schema::FoldingView view(campaign.pattern, sheet);
  const bool accepted = campaign.accepts(view.history.verdict);
  const solver::Fill fill = fill_shown(campaign.sampling(), campaign.design, campaign.pattern);
  if (!call.json) {
    const Paint paint = paint_for(STDOUT_FILENO);
    put("draw {} of {}: {}\n", call.draw, campaign.name,
        accepted ? paint.good("accepted") : paint.bad("not accepted"));
    put_folding(view, campaign.design, fill, call.table);
    return;
  }
  schema::Json json = schema::folding_json(view);
  json["energy"] = schema::energy_json(view, fill);
  if (campaign.pattern.folded_target) json["target"] = schema::target_json(view, fill);
  json["campaign"] = {{"name", campaign.name}, {"identity", schema::identity(campaign)}};
  json["draw"] = call.draw;
  json["verdict"]["accepted"] = accepted;
  put_json(json);
}

}  // namespace

Action replay_verb(CLI::App& verb) {
  verb.description("fold any draw of a campaign again, from its number");
  verb.footer(
      "Makes the draw's shifts again, follows its path, and shows its verdict.\n\n"
      "Examples:\n  misalign replay results/miura-6x6-1a2b3c4d.db 1234");
  auto call = std::make_shared<ReplayCall>();
  verb.add_option("CATALOGUE", call->catalogue_path, "catalogue file")->required();
  verb.add_option("DRAW", call->draw, "number of the draw")->required()->check(a_draw());
  verb.add_flag("--table", call->table,
                "print the lengths every 10 degrees even where they are too wide for the terminal");
  verb.add_flag("--again", call->again,
                "instead of showing what is stored make it again: the population of a splitting "
                "campaign, the ascent of an optimising one");
  verb.add_flag("--json", call->json, "as JSON");
  return showing(call, replay);
}

}  // namespace misalign::search

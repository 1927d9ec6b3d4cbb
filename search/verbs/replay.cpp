// `misalign replay`: any draw of a campaign again.
#include <fmt/format.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/terminal/folding_text.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ReplayCall {
  std::string catalogue_path;
  std::uint64_t draw = 0;
  bool json = false, table = false;
};

void replay(const ReplayCall& call) {
  const auto database = schema::open_for_reading(call.catalogue_path);
  DrawEvaluator evaluator(schema::read_campaign_of(*database, call.catalogue_path));
  const schema::Campaign& campaign = evaluator.campaign();
  const auto history = evaluator.history(call.draw);
  const Eigen::Matrix2Xd shifts_mm = evaluator.shifts_mm(call.draw);
  const schema::FoldingView view{campaign.pattern, shifts_mm, evaluator.mechanism(), history,
                                 campaign.sample_deg};
  const bool accepted = campaign.accepts(history.verdict);
  if (!call.json) {
    const Paint paint = paint_for(STDOUT_FILENO);
    put("draw {} of {}: {}\n", call.draw, campaign.name,
        accepted ? paint.good("accepted") : paint.bad("not accepted"));
    put_folding(view, call.table);
    return;
  }
  schema::Json json = schema::folding_json(view);
  json["campaign"] = {{"name", campaign.name}, {"identity", schema::identity(campaign)}};
  json["draw"] = call.draw;
  json["verdict"]["accepted"] = accepted;
  put_json(json);
}

}  // namespace

Action replay_verb(CLI::App& verb) {
  verb.description("any draw of a campaign again, from its number");
  verb.footer(
      "Makes the draw's shifts again, follows its path, and says whether it is accepted and\n"
      "why.\n\n"
      "Examples:\n  misalign replay results/miura-6x6-1a2b3c4d.db 1234");
  auto call = std::make_shared<ReplayCall>();
  verb.add_option("CATALOGUE", call->catalogue_path, "catalogue file")->required();
  verb.add_option("DRAW", call->draw, "number of the draw")->required()->check(a_draw());
  verb.add_flag("--table", call->table,
                "print the lengths every 10 degrees even where they are too wide for the terminal");
  verb.add_flag("--json", call->json, "as JSON");
  return [call] {
    replay(*call);
    return 0;
  };
}

}  // namespace misalign::search

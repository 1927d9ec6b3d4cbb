// Proofs of wells of `misalign certify`.
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/exchange/certify_json.hpp"
#include "search/sheets/certify_text.hpp"
#include "search/sheets/springs_at_vertices.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/certify_call.hpp"

namespace misalign::search {

int prove_wells(const CertifyCall& call) {
  const std::string& path = call.options.path;
  std::vector<std::optional<std::uint64_t>> draws = {std::nullopt};
  if (!is_pattern_file(path)) {
    const auto database = schema::open_for_reading(path);
    add_study_functions(*database, path);
    const auto chosen = chosen_draws(*database, call.choice);
    draws.assign(chosen.begin(), chosen.end());
  }
  const LongWork work("certify is under way", work_style(), false);
  std::string text;
  schema::Json list = schema::Json::array();
  for (const auto& draw : draws) {
    const Subject subject = choose_sheet(path, draw, call.design);
    const auto& [chosen, model, sheet] = subject;
    need_springs_in_mid_plane(sheet.base().springs, "certify: proofs");
    const double asked_deg = call.options.to_deg       ? *call.options.to_deg
                             : model.design().from_deg ? *model.design().from_deg
                                                       : deploys_from_deg(sheet, path);
    const solver::EnergyWells wells =
        value_or_throw(solver::prove_wells(sheet, model.design().fill(sheet.base()), asked_deg),
                       sheet.name(), "its wells are not known");
    text += wells_text(sheet, wells);
    list.push_back(chosen.key().json());
    list.back().update(schema::wells_json(sheet.mechanism(), wells));
    if (draws.size() > 1) show_work("candidates proven", list.size(), draws.size());
  }
  const bool is_single = !draws.empty() && (!draws.front() || call.choice.draws.size() == 1);
  call.json ? put_json(is_single ? list.front() : list) : put(text);
  return 0;
}

}  // namespace misalign::search

#include "schema/catalogue/ladder_json.hpp"

#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

Json share_json(std::uint64_t some, std::uint64_t all) {
  return all > 0 ? Json(static_cast<double>(some) / static_cast<double>(all)) : Json();
}

}  // namespace

Json ladder_json(const CatalogueState& state) {
  Json levels = Json::array();
  for (const LadderLevel& level : state.ladder->levels) {
    const SplitRate& rate = level.rate;
    levels.push_back({{"level", levels.size()},
                      {"deploys_from_deg", levels.empty() ? Json() : Json(level.deploys_from_deg)},
                      {"rate", rate.mean},
                      {"rate_low", rate.interval ? Json(rate.interval->low) : Json()},
                      {"rate_high", rate.interval ? Json(rate.interval->high) : Json()},
                      {"relative_error", or_null(rate.relative_half_width())},
                      {"populations_here", rate.reached},
                      {"largest_part", rate.largest_part},
                      {"reach_next", share_json(level.survivors, level.particles)},
                      {"ancestors", level.ancestors},
                      {"tried", level.tried},
                      {"taken", level.taken},
                      {"undecided", level.undecided},
                      {"met", level.met},
                      {"core_s", level.seconds}});
  }
  const SplitRate* const rate = state.ladder->rate();
  return {{"populations", state.ladder->populations},
          {"missing", state.missing_populations()},
          {"converged", rate && has_converged(*rate)},
          {"levels", levels}};
}

}  // namespace misalign::schema

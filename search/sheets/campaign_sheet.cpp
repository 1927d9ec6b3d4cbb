#include "search/sheets/campaign_sheet.hpp"

#include <fmt/format.h>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/draw.hpp"

namespace misalign::search {

Eigen::Matrix2Xd shifts_of_number(SQLite::Database& database, const schema::Campaign& campaign,
                                  std::uint64_t number) {
  if (!campaign.search.stores_sheets()) return shifts_of_draw(campaign, number);
  const schema::Json row = schema::read_candidate(database, number);
  if (!row.is_object() && !campaign.search.splitting) return shifts_of_draw(campaign, number);
  if (!row.is_object()) {
    throw schema::UserError(
        schema::Cause::bad_request,
        fmt::format("{} is no candidate of this catalogue (of a splitting campaign only those are "
                    "kept); take one that `misalign query` shows, or make its population again "
                    "with `misalign replay --again`",
                    number));
  }
  const auto shifts_mm = schema::read_shifts(row.value("displacements_mm", schema::Json()),
                                             campaign.pattern.base.sheet.vertex_count());
  if (!shifts_mm || !can_be_kept(campaign, *shifts_mm)) {
    throw schema::damaged(database,
                          fmt::format("candidate {} has no displacements of its campaign", number));
  }
  return *shifts_mm;
}

}  // namespace misalign::search

#include "search/report/live_state.hpp"

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/catalogue/status_json.hpp"
#include "schema/report/report.hpp"

namespace misalign::search {
namespace {

using schema::Json;

constexpr int kBest = 5;

}  // namespace

// Reads the index alone, a hundredth of the table's size.
Json angles_json(SQLite::Database& database, double sample_deg) {
  Json angles = Json::array();
  SQLite::Statement rows(database,
                         "SELECT deploys_from_sample, count(*) FROM candidate INDEXED BY "
                         "candidate_by_deploys_from GROUP BY 1 ORDER BY 1");
  while (rows.executeStep()) {
    angles.push_back(
        {rows.getColumn(0).getDouble() * sample_deg, schema::draw_of(rows.getColumn(1))});
  }
  return angles;
}

Json live_state_json(SQLite::Database& database, const schema::Campaign& campaign) {
  return schema::reading(database, [&] {
    const SQLite::Transaction moment(database);
    Json live = {{"state", schema::page_state_json(schema::read_state(database))},
                 {"faults", schema::faults_json(database, campaign)}};
    live["state"].erase("gaps");
    const Json best = schema::candidates_json(database, kBest);
    live["total"] = best["total"];
    live["best"] = best["columns"];
    if (!campaign.search.splitting) live["angles"] = angles_json(database, campaign.sample_deg);
    return live;
  });
}

}  // namespace misalign::search

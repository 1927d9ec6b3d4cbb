#include "schema/catalogue/older_schema.hpp"

#include <cassert>
#include <string>

#include "schema/catalogue/metric_table.hpp"
#include "schema/files/carried_files.hpp"

namespace misalign::schema {
namespace {

// Returns "CREATE TEMP VIEW name AS ...;" as in catalogue.sql.
std::string temporary_view(const std::string& name) {
  const std::string sql = carried_text("schema/catalogue.sql");
  const std::string head = "CREATE VIEW " + name + " AS";
  const std::size_t begin = sql.find(head), end = sql.find(';', begin);
  assert(begin != std::string::npos && end != std::string::npos);
  return "CREATE TEMP VIEW " + name + " AS" +
         sql.substr(begin + head.size(), end + 1 - begin - head.size());
}

}  // namespace

void show_as_of_today(SQLite::Database& database, int version) {
  constexpr int kYieldAngleSince = 8, kAscentSince = 9;
  if (version < kYieldAngleSince) {
    database.exec(
        "CREATE TEMP VIEW yield AS SELECT *, (SELECT json_extract(configuration, "
        "'$.accept.deploys_from_deg') FROM campaign) AS from_deg FROM main.yield");
  }
  if (version < kAscentSince) {
    database.exec(
        "CREATE TEMP VIEW ascent AS SELECT NULL AS draw, NULL AS start_value, NULL AS end_value, "
        "NULL AS steps, NULL AS sheets_folded, NULL AS ended, NULL AS limited_by WHERE 0");
  }
  std::string later;
  for (const MetricEntry& metric : metric_table()) {
    if (version < metric.schema_since) later += std::string(", NULL AS ") + metric.name;
  }
  if (later.empty()) return;
  std::string candidates = temporary_view("candidates");
  const std::string table = "FROM candidate;";
  candidates.replace(candidates.rfind(table), table.size(),
                     "FROM (SELECT *" + later + " FROM main.candidate) AS candidate;");
  database.exec(candidates);
  database.exec(temporary_view("ends"));
  std::string yields = temporary_view("yields");
  const std::string join = "JOIN candidate USING (draw)";
  yields.replace(yields.rfind(join), join.size(), "JOIN temp.candidates USING (draw)");
  database.exec(yields);
}

}  // namespace misalign::schema
